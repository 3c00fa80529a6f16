#include "solver/scene/layers.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace snug::solver {

namespace {

constexpr double lift_of_a_layer = 2e-4;  // m, over what it is placed on

Eigen::AlignedBox3d box(const mesh::GarmentMesh& garment) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : garment.placed) box.extend(x);
  return box;
}

/// The first garment, counted inwards from g, that its contact lets it meet; -1: none.
int first_under(const Model& model, int g) {
  const ContactModel* contact = model.contact_of(g);
  if (!contact || contact->master == "skin") return -1;
  if (contact->master.empty()) return g - 1;
  const auto named = std::find_if(model.garments.begin(), model.garments.end(), [&](const auto& garment) { return garment.spec.name == contact->master; });
  return static_cast<int>(named - model.garments.begin());
}

bool share_heights(const mesh::GarmentFit& one, const mesh::GarmentFit& other) { return one.lower < other.upper && other.lower < one.upper; }

double lift(const Model& model, const std::vector<mesh::GarmentMesh>& placed, int g, const mesh::GarmentFit& fit) {
  double below = 0.0;
  for (int k = first_under(model, g); k >= 0; --k)
    if (share_heights(placed[k].fit, fit)) below = std::max({below, lift(model, placed, k, placed[k].fit), placed[k].stand_off});
  return below + lift_of_a_layer;
}

}  // namespace

std::vector<int> layers_under(const Model& model, const std::vector<mesh::GarmentMesh>& garments, int g) {
  std::vector<int> under;
  const Eigen::AlignedBox3d own = box(garments[g]);
  for (int k = first_under(model, g); k >= 0; --k) {
    if (!own.intersects(box(garments[k]))) {
      if (model.contact_of(g)->master != garments[k].name) continue;
      throw input::InputError(model.contact_of(g)->where, fmt::format("{} is to lie on {}, which it is nowhere near", garments[g].name, garments[k].name),
                              "move one of them (position), or leave master out");
    }
    if (garments[k].order != 2)
      throw input::InputError(model.garments[k].spec.where,
                              fmt::format("{} is made of linear triangles and {} lies on it", garments[k].name, garments[g].name),
                              "leave its order out");
    under.push_back(k);
  }
  return under;
}

MasterStack over_layers(const Layout& layout, const std::vector<mesh::GarmentMesh>& garments, const std::vector<int>& under, MasterSurface ground) {
  std::vector<MasterSurface> surfaces;
  for (const int k : under) surfaces.emplace_back(layout[garments[k].name], garments[k]);
  surfaces.push_back(std::move(ground));
  return MasterStack(std::move(surfaces));
}

std::vector<std::string> master_names(const std::vector<mesh::GarmentMesh>& garments, const std::vector<int>& under) {
  std::vector<std::string> names;
  for (const int k : under) names.push_back(garments[k].name);
  names.push_back("skin");
  return names;
}

double placing_lift(const Model& model, const std::vector<mesh::GarmentMesh>& placed, const mesh::GarmentFit& next) {
  return lift(model, placed, static_cast<int>(placed.size()), next);
}

}  // namespace snug::solver
