#include "mesh/body/layering.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace snug::mesh {

namespace {

using input::InputError;
using input::LayerSpec;

void check_order(const std::vector<LayerSpec>& layers, const input::Location& where) {
  if (layers.empty()) throw InputError(where, "the body has no layers", "list the layers from the inside out");
  if (layers.front().form == input::LayerForm::solid && layers.front().thickness)
    throw InputError(layers.front().where, fmt::format("the bone \"{}\" has a thickness", layers.front().name),
                     "leave it out: the outline of the bone comes from the stations or the scan");
  for (std::size_t n = 1; n < layers.size(); ++n) {
    if (layers[n].form == input::LayerForm::rigid)
      throw InputError(layers[n].where, fmt::format("layer \"{}\" is rigid but not innermost", layers[n].name),
                       "list the rigid bone first");
    if (layers[n].form == input::LayerForm::membrane && n + 1 != layers.size())
      throw InputError(layers[n].where, fmt::format("membrane \"{}\" is not the outermost layer", layers[n].name),
                       "list the skin last, or give this layer form = \"solid\"");
  }
}

void check_sizes(const LayerSpec& layer) {
  if (layer.thickness && !(*layer.thickness > 0.0))
    throw InputError(layer.where, fmt::format("layer \"{}\" has thickness {:g} m", layer.name, *layer.thickness),
                     "write a positive thickness such as \"1.5 mm\"");
  if (layer.form == input::LayerForm::membrane && !layer.thickness)
    throw InputError(layer.where, fmt::format("membrane \"{}\" has no thickness", layer.name),
                     "write its thickness such as \"1.5 mm\"");
  if (layer.form == input::LayerForm::solid && layer.cells < 1)
    throw InputError(layer.where, fmt::format("layer \"{}\" has {} cells", layer.name, layer.cells),
                     "write at least 1 cell through the layer");
}

/// Which solid takes what the others leave.
std::size_t find_rest(const std::vector<LayerSpec>& solids, const input::Location& where) {
  if (solids.empty())
    throw InputError(where, "the body has no solid layer between bone and skin", "add one, for example tissue");
  const auto open = [](const LayerSpec& layer) { return !layer.thickness; };
  if (std::count_if(solids.begin(), solids.end(), open) != 1)
    throw InputError(where, "not exactly one solid layer is without thickness",
                     "leave out the thickness of the one layer that takes the rest between bone and skin");
  return std::find_if(solids.begin(), solids.end(), open) - solids.begin();
}

/// Mild grading of the layer that takes the rest: cells at the outside are half as thick as those at the inside.
double graded(double s) { return s * (1.0 + (1.0 - s) / 3.0); }

}  // namespace

Layering::Layering(const input::BodySpec& spec) {
  check_order(spec.layers, spec.where);
  for (const LayerSpec& layer : spec.layers) {
    check_sizes(layer);
    if (layer.form == input::LayerForm::membrane) membranes_.push_back(layer);
    if (layer.form == input::LayerForm::solid && &layer == &spec.layers.front()) bone_ = layer;
    if (layer.form == input::LayerForm::solid && &layer != &spec.layers.front()) solids_.push_back(layer);
  }
  rest_ = find_rest(solids_, spec.where);
}

std::vector<LatticeLayer> Layering::lattice_layers() const {
  std::vector<LatticeLayer> layers;
  if (bone_) layers.push_back({bone_->name, bone_->cells});
  for (const LayerSpec& solid : solids_) layers.push_back({solid.name, solid.cells});
  return layers;
}

std::vector<double> Layering::interfaces(const Limb& limb, double turn, double z) const {
  const Eigen::Vector3d from = limb.bone->at(turn, z), way = limb.skin->at(turn, z) - from;
  const double length = way.norm();
  // A thickness d across the normal takes d / cos along the ray; the bound keeps a wrong bone from dividing by zero.
  const double along_bone = std::max(0.1 * length, way.dot(outward_normal(*limb.bone, turn, z)));
  const double along_skin = std::max(0.1 * length, way.dot(outward_normal(*limb.skin, turn, z)));
  std::vector<double> fraction(solids_.size() + 1, 0.0);
  fraction.back() = 1.0;
  for (std::size_t n = 0; n < rest_; ++n) fraction[n + 1] = fraction[n] + *solids_[n].thickness / along_bone;
  for (std::size_t n = solids_.size() - 1; n > rest_; --n)
    fraction[n] = fraction[n + 1] - *solids_[n].thickness / along_skin;
  if (fraction[rest_ + 1] - fraction[rest_] > 1e-3) return fraction;
  throw InputError(solids_[rest_].where,
                   fmt::format("nothing is left for layer \"{}\" at angle {:.0f} deg, height {:.1f} mm ({:.1f} mm "
                               "between bone and skin)",
                               solids_[rest_].name, 360.0 * turn, 1e3 * z, 1e3 * length),
                   "make the other layers thinner or the bone smaller");
}

Eigen::Vector3d Layering::point(const Limb& limb, double turn, double z, int k) const {
  std::size_t layer = 0;
  int below = 0;
  while (layer + 1 < solids_.size() && k > 2 * (below + solids_[layer].cells)) below += solids_[layer++].cells;
  const double s = (k - 2.0 * below) / (2.0 * solids_[layer].cells);
  const double share = layer == rest_ ? graded(s) : s;
  const std::vector<double> fraction = interfaces(limb, turn, z);
  const double t = fraction[layer] + share * (fraction[layer + 1] - fraction[layer]);
  // Written so that the ends are met exactly: nodes on skin and bone lie on the true surfaces.
  return (1.0 - t) * limb.bone->at(turn, z) + t * limb.skin->at(turn, z);
}

}  // namespace snug::mesh
