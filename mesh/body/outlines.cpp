#include "mesh/body/outlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cases/input/files.hpp"
#include "mesh/body/spline_outline.hpp"
#include "mesh/body/usual_bone.hpp"
#include "mesh/formats/ring_net.hpp"

namespace snug::mesh {

namespace {

using curves::Net;

/// Every section drawn together towards its own middle.
Net shrunk(Net net, double share) {
  for (int i = 0; i < net.rows; ++i) {
    auto row = net.points.middleCols(i * net.columns, net.columns);
    const Eigen::Vector3d middle = middle_of_row(net, i);
    row = ((share * (row.colwise() - middle)).colwise() + middle).eval();
  }
  return net;
}

std::pair<double, double> heights_of_row(const Net& net, int row) {
  const auto z = net.points.row(2).segment(row * net.columns, net.columns);
  return {z.minCoeff(), z.maxCoeff()};
}

std::unique_ptr<Outline> outline_of(const RingNet& ring) {
  check_rises(ring);
  return std::make_unique<SplineOutline>(ring.net, ring.text, ring.where);
}

/// Of the sizes that parts of bodies have; the unit of the file is likely another.
void check_size(const Limb& limb, const RingNet& ring) {
  const double girth = limb.girth(0.5 * (limb.lower + limb.upper));
  if (girth > 0.01 && girth < 5.0) return;
  throw input::InputError(ring.where, fmt::format("the girth of {} is {:.4g} m half way up", ring.text, girth), "look at \"unit\" in the file, e.g. \"1 mm\"");
}

}  // namespace

Limb limb_from_outlines(const input::BodySpec& spec) {
  const CurveSet set = parse_curve_json(input::read_file(spec.stations), spec.stations.string());
  const input::Location where{spec.stations.string()};
  const auto read = [&](const std::string& name) { return ring_net(set, spec.stations, name, where); };
  const RingNet skin = read(has_net(set, "skin") ? "skin" : "");
  const bool bone_given = has_net(set, "bone") && set.nets.size() > 1;
  RingNet bone = bone_given ? read("bone") : RingNet{shrunk(skin.net, usual_bone), "the bone of " + skin.text, where};
  Limb limb{outline_of(skin), outline_of(bone), heights_of_row(skin.net, 0).second, heights_of_row(skin.net, skin.net.rows - 1).first};
  if (!(limb.lower < limb.upper))
    throw input::InputError(where, fmt::format("the lowest section of {} reaches above the highest", skin.text), "let the sections lie level, or give more of the limb");
  check_size(limb, skin);
  if (!bone_given) limb.remarks.push_back({where, fmt::format("there is no net \"bone\": {:.0f} % of each section is taken for the bone", 100.0 * usual_bone), usual_bone_remedy("net")});
  check_bone_inside(limb, where);
  return limb;
}

}  // namespace snug::mesh
