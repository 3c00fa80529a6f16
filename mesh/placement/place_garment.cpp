#include "mesh/placement/place_garment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/placement/garment_chart.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using input::InputError;
using Places = std::vector<Vector3d>;

constexpr double closing = 0.003;         // m, of a seam in a step
constexpr double clear_of_shoulder = 0.010;  // m

/// The vertices of a sewn mesh, numbered without mid-edge nodes.
struct Vertices {
  std::vector<int> node;    // vertex -> node of the mesh
  std::vector<int> number;  // node -> vertex, -1: mid-edge
};

/// The vertices of all pieces; `same` gives each node what stands for it.
Vertices vertices_of(const SewnMesh& sewn, const std::vector<int>& same) {
  Vertices vertices{{}, std::vector<int>(sewn.flat.size(), -1)};
  for (const auto& t : sewn.triangles)
    for (int n = 0; n < 3; ++n) {
      int& number = vertices.number[same[t[n]]];
      if (number < 0) number = static_cast<int>(vertices.node.size()), vertices.node.push_back(same[t[n]]);
    }
  for (std::size_t n = 0; n < same.size(); ++n) vertices.number[n] = vertices.number[same[n]];
  return vertices;
}

ClothTriangles triangles_of(const SewnMesh& sewn, const std::vector<int>& number) {
  ClothTriangles cloth;
  for (const auto& t : sewn.triangles) {
    cloth.nodes.push_back({number[t[0]], number[t[1]], number[t[2]]});
    cloth.flat.push_back({sewn.flat[t[0]], sewn.flat[t[1]], sewn.flat[t[2]]});
  }
  return cloth;
}

/// Whether the pieces have places of their own.
bool have_places(const Pattern& pattern) {
  const auto placed = [](const Piece& piece) { return piece.place.has_value(); };
  const auto count = std::count_if(pattern.pieces.begin(), pattern.pieces.end(), placed);
  if (count == 0 || count == static_cast<long>(pattern.pieces.size())) return count > 0;
  const Piece& piece = *std::find_if_not(pattern.pieces.begin(), pattern.pieces.end(), placed);
  throw InputError(piece.where, fmt::format("the piece {} has no place in space, others have", piece.name),
                   "give all pieces a translation and rotation, or none");
}

/// Where the pieces themselves put their vertices.
Places given_places(const Pattern& pattern, const SewnMesh& sewn, const Vertices& vertices, const DressForm& form) {
  Places places;
  for (const int node : vertices.node) {
    const GivenPlace& place = *pattern.pieces[sewn.node_piece[node]].place;
    const Vector3d in_file =
        place.rotation * Vector3d(sewn.flat[node].x(), sewn.flat[node].y(), 0.0) + place.translation;
    places.push_back(form.body.rotation * in_file + form.body.translation);
  }
  return places;
}

/// By how much given places are to be raised so that the seams above the trunk's shoulders lie as much above the body
/// as charted ones: a pattern that was placed on another body brings that body's height along. 0 without such seams.
double shoulder_lift(const DressForm& form, const SewnMesh& sewn, const Vertices& vertices, const Places& places) {
  double sum = 0.0;
  int count = 0;
  for (const SewnSeam& seam : sewn.seams) {
    Vector3d middle = Vector3d::Zero();
    int ends = 0;
    for (const auto& [a, b] : seam.pairs)
      if (vertices.number[a] >= 0 && vertices.number[b] >= 0)
        middle += places[vertices.number[a]] + places[vertices.number[b]], ends += 2;
    if (ends > 0) middle /= ends;
    const double top = shoulder_top(form.body, form.marks, middle.x());
    if (std::abs(middle.x()) > 1.2 * form.marks.armpit_half_width || middle.z() < 0.5 * (form.marks.armpit + top))
      continue;
    sum += top + clear_of_shoulder - middle.z();
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

Places charted_places(const GarmentChart& chart, const SewnMesh& sewn, const Vertices& vertices) {
  Places places;
  for (const int node : vertices.node) places.push_back(chart.place(sewn.node_piece[node], sewn.flat[node]));
  return places;
}

/// The middle between the legs by height, and on which side of it the particles of the legs belong. Particles are
/// numbered by `number`; where two become one that belong to both sides, they belong to none.
LimbGap gap_between_legs(const GarmentChart& chart, const DressForm& form, const SewnMesh& sewn,
                         const std::vector<int>& number) {
  LimbGap gap{form.marks.crotch, 0.005, {}, {}};
  for (double z = 0.5 * gap.spacing; z < gap.top; z += gap.spacing) {
    gap.middle.push_back(gap.middle.empty() ? 0.0 : gap.middle.back());
    if (const auto inner = form.sections.between_legs(z)) gap.middle.back() = 0.5 * ((*inner)[0] + (*inner)[1]);
  }
  gap.side.assign(1 + *std::max_element(number.begin(), number.end()), 2);
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    int& side = gap.side[number[n]];
    const int here = chart.leg_side(sewn.node_piece[n], sewn.flat[n]);
    side = side == 2 || side == here ? here : 0;
  }
  return gap;
}

struct SeamPair {
  int seam = 0;
  Stitching stitching;  // the gap as it starts
};

std::vector<SeamPair> seam_pairs(const SewnMesh& sewn, const Vertices& vertices, const Places& places) {
  std::vector<SeamPair> pairs;
  for (std::size_t s = 0; s < sewn.seams.size(); ++s)
    for (const auto& [a, b] : sewn.seams[s].pairs) {
      const int one = vertices.number[a], other = vertices.number[b];
      if (one >= 0 && other >= 0 && one != other)
        pairs.push_back({static_cast<int>(s), {one, other, (places[one] - places[other]).norm()}});
    }
  return pairs;
}

/// Whether the sides of all seams meet where they start.
bool lies_closed(const SewnMesh& sewn, const Vertices& vertices, const Places& places) {
  const std::vector<SeamPair> pairs = seam_pairs(sewn, vertices, places);
  return std::all_of(pairs.begin(), pairs.end(), [](const SeamPair& pair) { return pair.stitching.gap < 1e-6; });
}

double gap_of(const SeamPair& pair, const Places& places) {
  return (places[pair.stitching.a] - places[pair.stitching.b]).norm();
}

/// Of pairs, one at least.
const SeamPair* widest(const std::vector<SeamPair>& pairs, const Places& places) {
  const auto nearer = [&](const SeamPair& a, const SeamPair& b) { return gap_of(a, places) < gap_of(b, places); };
  return &*std::max_element(pairs.begin(), pairs.end(), nearer);
}

/// Closes the seams in the first half of the steps, those first that are open farthest, so that sleeves wait for
/// nobody.
void sew_together(ClothParticles& cloth, const std::vector<SeamPair>& pairs, const ParticleStep& step,
                  const DistanceGrid& body, int steps) {
  const double widest_gap = widest(pairs, cloth.places())->stitching.gap;
  std::vector<Stitching> stitching;
  for (const SeamPair& pair : pairs) stitching.push_back(pair.stitching);
  for (int n = 0; n < steps; ++n) {
    const double open = widest_gap * std::max(0.0, 1.0 - 2.0 * n / steps);
    for (Stitching& one : stitching) one.gap = std::min(one.gap, open);
    cloth.advance(step, stitching, body);
  }
}

/// Evens the cloth out; with its whole stiffness to the end it would keep stripes.
void settle(ClothParticles& cloth, ParticleStep step, const DistanceGrid& body, int steps) {
  for (int n = 0; n < steps; ++n) {
    step.stiffness = 0.5 * std::pow(0.1, static_cast<double>(n) / steps);
    cloth.advance(step, {}, body);
  }
}

/// Places of the merged vertices: the middles of those that become one.
Places merged_places(const Vertices& apart, const Vertices& sewn_vertices, const Places& places) {
  Places result(sewn_vertices.node.size(), Vector3d::Zero());
  std::vector<int> count(result.size(), 0);
  for (std::size_t v = 0; v < apart.node.size(); ++v) {
    const int to = sewn_vertices.number[apart.node[v]];
    result[to] += places[v];
    ++count[to];
  }
  for (std::size_t v = 0; v < result.size(); ++v) result[v] /= count[v];
  return result;
}

/// Every node, mid-edge nodes in the middle of their edges.
Places all_nodes(const SewnMesh& sewn, const Vertices& vertices, const Places& places) {
  Places result(sewn.flat.size(), Vector3d::Zero());
  for (const auto& t : sewn.triangles)
    for (int n = 0; n < 3; ++n) {
      const Vector3d &a = places[vertices.number[t[n]]], &b = places[vertices.number[t[(n + 1) % 3]]];
      result[t[n]] = a;
      result[t[3 + n]] = 0.5 * (a + b);
    }
  for (std::size_t n = 0; n < result.size(); ++n) result[n] = result[sewn.merged[n]];
  return result;
}

void check_gap(const PlacedGarment& placed, const SeamPair& pair, const Places& places, const CheckedPattern& checked,
               const SewnMesh& sewn) {
  if (placed.last_gap <= 0.5 * sewn.mean_edge) return;
  const Seam& seam = checked.pattern.seams[pair.seam];
  throw InputError(seam.where,
                   fmt::format("the seam {} of {} and {} stays open by {:.1f} mm at a height of {:.0f} mm", seam.name,
                               name_of(checked.pattern, seam.a), name_of(checked.pattern, seam.b),
                               1e3 * placed.last_gap, 1e3 * places[pair.stitching.a].z()),
                   "raise or lower the garment, grade it to the body's size, or give its pieces places nearer to where "
                   "they are worn");
}

OpenLoops open_loops(const CheckedPattern& checked, const SewnMesh& sewn, const Places& nodes) {
  OpenLoops result;
  for (const OpenLoop& loop : checked.sewing.open)
    for (const int node : sewn.open.at(loop.name)) result[loop.name].push_back(nodes[node]);
  return result;
}

/// Closes the seams and says how well.
void sew(const CheckedPattern& checked, const SewnMesh& sewn, const DressForm& form, const Vertices& vertices,
         ClothParticles& cloth, const ParticleStep& step, int steps, PlacedGarment& placed) {
  const std::vector<SeamPair> pairs = seam_pairs(sewn, vertices, cloth.places());
  if (pairs.empty()) return;
  placed.first_gap = gap_of(*widest(pairs, cloth.places()), cloth.places());
  sew_together(cloth, pairs, step, form.distance, std::max(steps, static_cast<int>(2.0 * placed.first_gap / closing)));
  const SeamPair& pair = *widest(pairs, cloth.places());
  placed.last_gap = gap_of(pair, cloth.places());
  placed.widest_seam = sewn.seams[pair.seam].name;
  check_gap(placed, pair, cloth.places(), checked, sewn);
}

/// Settles what is sewn, mends what is left and judges it.
void finish(const CheckedPattern& checked, const SewnMesh& sewn, const DressForm& form, const Vertices& vertices,
            ClothParticles& cloth, const ParticleStep& step, int settling_steps, PlacedGarment& placed) {
  settle(cloth, step, form.distance, settling_steps);
  placed.mended = mend(cloth, step.clearance, form);
  placed.places = all_nodes(sewn, vertices, cloth.places());
  placed.cloth = cloth.triangles();
  placed.stretches = principal_stretches(placed.cloth, cloth.places());
  placed.self_crossings = static_cast<int>(self_crossings(placed.cloth, cloth.places()).size());
  placed.figures = stretch_figures(placed.cloth, placed.stretches);
  placed.acceptance =
      acceptance(placed.cloth, cloth.places(), open_loops(checked, sewn, placed.places), form, placed.kind);
  for (auto& t : placed.cloth.nodes)
    for (int& node : t) node = vertices.node[node];
}

}  // namespace

bool PlacedGarment::accepted() const {
  return std::all_of(acceptance.begin(), acceptance.end(), [](const Criterion& one) { return one.met; });
}

namespace {

/// Places it once; where cloth that is drawn tight shortens, it ends above where it was to lie.
PlacedGarment place_once(const CheckedPattern& checked, const SewnMesh& sewn, const DressForm& form, const PlacementOptions& options) {
  std::vector<int> itself(sewn.flat.size());
  for (std::size_t n = 0; n < itself.size(); ++n) itself[n] = static_cast<int>(n);
  const Vertices apart = vertices_of(sewn, itself), together = vertices_of(sewn, sewn.merged);
  PlacedGarment placed;
  std::optional<GarmentChart> chart;
  if (!have_places(checked.pattern)) {
    chart.emplace(checked, form.sections, form.marks, form.body, options.raise, options.lowest);
    placed.kind = chart->rings().kind;
  }
  Places start = chart ? charted_places(*chart, sewn, apart) : given_places(checked.pattern, sewn, apart, form);
  if (!chart) {
    const auto lower = [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); };
    placed.lift = options.lowest ? *options.lowest - std::min_element(start.begin(), start.end(), lower)->z()
                                 : shoulder_lift(form, sewn, apart, start) + options.raise;
    for (Vector3d& place : start) place.z() += placed.lift;
  }
  const bool legs = placed.kind == GarmentKind::legs;
  const ClothTriangles flat = triangles_of(sewn, apart.number);
  const bool tight = stretch_figures(flat, principal_stretches(flat, start)).median > 1.05;
  ParticleStep step;
  step.compression = tight ? 0.05 : 0.3;
  step.clearance = options.clearance;
  const ClothTriangles joined = triangles_of(sewn, together.number);
  if (chart && sewn.pieces.size() == 1 && lies_closed(sewn, apart, start)) {  // a tube: nothing to sew, and particles would only shorten it
    ClothParticles as_charted(merged_places(apart, together, start), joined);
    PlacedGarment charted = placed;
    finish(checked, sewn, form, together, as_charted, step, 0, charted);
    if (charted.accepted()) return charted;
  }
  ClothParticles cloth(start, flat);
  if (legs) cloth.set_gap(gap_between_legs(*chart, form, sewn, apart.number));
  sew(checked, sewn, form, apart, cloth, step, options.sewing_steps, placed);
  ClothParticles whole(merged_places(apart, together, cloth.places()), joined);
  if (legs) whole.set_gap(gap_between_legs(*chart, form, sewn, together.number));
  step.compression = 0.3;  // sewn, it need not give way: cloth that is stretched round the body would go on shortening along it
  finish(checked, sewn, form, together, whole, step, options.settling_steps, placed);
  return placed;
}

std::optional<PlacedGarment> placed_if_it_can(const CheckedPattern& checked, const SewnMesh& sewn, const DressForm& form, const PlacementOptions& options) {
  try {
    return place_once(checked, sewn, form, options);
  } catch (const InputError&) {
    return {};
  }
}

double lowest_of(const PlacedGarment& placed) {
  double lowest = std::numeric_limits<double>::max();
  for (const Vector3d& place : placed.places) lowest = std::min(lowest, place.z());
  return lowest;
}

}  // namespace

PlacedGarment place_garment(const CheckedPattern& checked, const SewnMesh& sewn, const DressForm& form,
                            const PlacementOptions& options) {
  PlacedGarment placed = place_once(checked, sewn, form, options);
  if (!options.lowest) return placed;
  constexpr int rounds = 3;
  constexpr double near = 0.002;  // m
  PlacementOptions again = options;
  for (int round = 0; round < rounds; ++round) {
    const double miss = lowest_of(placed) - *options.lowest;
    if (std::abs(miss) < near) break;
    *again.lowest -= miss;
    std::optional<PlacedGarment> moved = placed_if_it_can(checked, sewn, form, again);
    if (!moved || !moved->accepted() || std::abs(lowest_of(*moved) - *options.lowest) > std::abs(miss)) break;
    placed = std::move(*moved);
  }
  return placed;
}

namespace {

/// Barycentric coordinates of a point in the plane of a triangle.
Vector3d barycentric(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& x) {
  const auto twice = [](const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); };
  const double whole = twice(b - a, c - a), at_b = twice(x - a, c - a) / whole, at_c = twice(b - a, x - a) / whole;
  return {1.0 - at_b - at_c, at_b, at_c};
}

/// Where a point of a flat piece lies: in the triangle that holds it, or beyond a chord of the border in the plane of the nearest one.
Vector3d place_of(int piece, const Vector2d& x, const SewnMesh& mesh, const Places& places) {
  double best = -std::numeric_limits<double>::max();
  Vector3d place = Vector3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_piece[t] != piece) continue;
    const auto& node = mesh.triangles[t];
    const Vector3d share = barycentric(mesh.flat[node[0]], mesh.flat[node[1]], mesh.flat[node[2]], x);
    if (share.minCoeff() <= best) continue;
    best = share.minCoeff();
    place = share[0] * places[node[0]] + share[1] * places[node[1]] + share[2] * places[node[2]];
    if (best >= 0.0) break;
  }
  return place;
}

}  // namespace

PlacedGarment carried_over(const PlacedGarment& placed, const SewnMesh& from, const CheckedPattern& checked, const SewnMesh& to, const DressForm& form,
                           const PlacementOptions& options) {
  std::vector<int> itself(to.flat.size());
  std::iota(itself.begin(), itself.end(), 0);
  const Vertices apart = vertices_of(to, itself), together = vertices_of(to, to.merged);
  Places places;
  for (const int node : apart.node) places.push_back(place_of(to.node_piece[node], to.flat[node], from, placed.places));
  ClothParticles cloth(merged_places(apart, together, places), triangles_of(to, together.number));
  ParticleStep off_the_skin;  // without any pull: that alone
  off_the_skin.stiffness = off_the_skin.bending = 0.0;
  off_the_skin.clearance = options.clearance;
  cloth.advance(off_the_skin, {}, form.distance);
  PlacedGarment carried = placed;
  finish(checked, to, form, together, cloth, off_the_skin, 0, carried);
  return carried;
}

void check_accepted(const PlacedGarment& placed, const Pattern& pattern) {
  input::Diagnostics diagnostics;
  for (const Criterion& one : placed.acceptance)
    if (!one.met)
      diagnostics.error(
          {.file = pattern.file}, fmt::format("the garment cannot be placed: {}: {}", one.what, one.found),
          "raise or lower it, grade it to the body's size, or give its pieces places nearer to where they are worn");
  diagnostics.throw_if_any();
}

}  // namespace snug::mesh
