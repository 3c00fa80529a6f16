#include "postproc/hem.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "postproc/skin_pressure.hpp"

namespace snug::postproc {
namespace {

using Point = Eigen::Vector3d;

constexpr double divisions_of_an_edge = 24.0;
constexpr double beside_an_edge = 3.0;  // to which distance, in its reach, the pressure is looked at

/// How far a point is from an edge, and whether it is on the side of its cloth.
struct Beside {
  double distance = 0.0;
  bool inside = true;
};

/// An edge as a chain of straight pieces. `opposite`: of a mid-edge node, the vertex across its triangle.
class Chain {
 public:
  Chain(const GarmentEdge& edge, const std::vector<Point>& nodes, const std::map<int, int>& opposite) {
    for (const auto& [a, middle, b] : edge.sides) {
      const auto across = opposite.find(middle);
      const Point cloth = across == opposite.end() ? Point(Point::Zero()) : Point(nodes[across->second] - nodes[middle]);
      pieces_.push_back({nodes[a], nodes[middle], cloth}), pieces_.push_back({nodes[middle], nodes[b], cloth});
    }
    for (const auto& [a, b, cloth] : pieces_) box_.extend(a), box_.extend(b), length_ += (b - a).norm();
  }
  double length() const { return length_; }
  /// Distance of x, or `limit` where it is farther.
  Beside beside(const Point& x, double limit) const {
    double squared = limit * limit;
    bool inside = true;
    if (box_.squaredExteriorDistance(x) >= squared) return {limit, inside};
    for (const auto& [a, b, cloth] : pieces_) {
      const Point along = b - a;
      const double t = std::clamp((x - a).dot(along) / std::max(along.squaredNorm(), 1e-30), 0.0, 1.0);
      const Point away = x - a - t * along;
      if (away.squaredNorm() >= squared) continue;
      squared = away.squaredNorm(), inside = away.dot(cloth) >= 0.0;
    }
    return {std::sqrt(squared), inside};
  }

 private:
  struct Piece {
    Point a, b, cloth;  ///< its ends, and where the cloth lies
  };
  std::vector<Piece> pieces_;
  Eigen::AlignedBox3d box_;
  double length_ = 0.0;
};

/// The nearest edge within `limit`, its distance, and whether it is that of the cloth over the point.
struct Near {
  int edge = -1;
  double distance = 0.0;
  bool inside = true;
};
Near nearest(const std::vector<Chain>& chains, const Point& x, double limit) {
  Near near{-1, limit};
  for (std::size_t e = 0; e < chains.size(); ++e)
    if (const auto [d, inside] = chains[e].beside(x, near.distance); d < near.distance) near = {static_cast<int>(e), d, inside};
  return near;
}

/// Of the mid-edge nodes of all triangles, the vertex across.
std::map<int, int> opposite_vertices(const GarmentResult& garment) {
  std::map<int, int> opposite;
  for (const auto& t : garment.triangles)
    for (int k = 0; k < 3; ++k) opposite[t[3 + k]] = t[(k + 2) % 3];
  return opposite;
}

/// Pressure over the distance from an edge, a straight line by least squares of force - area (p0 + slope d), weighted by area.
class Slope {
 public:
  void add(double distance, double force, double area) {
    area_ += area, moment_ += area * distance, second_ += area * distance * distance;
    force_ += force, turned_ += force * distance;
  }
  /// The pressure at a distance.
  bool empty() const { return !(area_ > 0.0); }
  double at(double distance) const {
    if (!(area_ > 0.0)) return 0.0;
    const double middle = moment_ / area_, spread = second_ - middle * moment_;
    const double slope = spread > 1e-9 * second_ ? (turned_ - middle * force_) / spread : 0.0;
    return std::max(0.0, force_ / area_ + slope * (distance - middle));
  }

 private:
  double area_ = 0.0, moment_ = 0.0, second_ = 0.0, force_ = 0.0, turned_ = 0.0;
};

/// One side of an edge: the pressure beyond its reach, and what lies within.
struct Side {
  Slope beyond;
  double area = 0.0, moment = 0.0;

  void add(double distance, double reach, const ContactSample& sample) {
    if (distance < reach) area += sample.area, moment += sample.area * distance;
    else if (distance < beside_an_edge * reach) beyond.add(distance, sample.force, sample.area);
  }
  /// The force within reach that the pressure beyond explains; that of the other side where there is none on this one.
  double explained(const Side& other) const {
    return area > 0.0 ? (beyond.empty() ? other : *this).beyond.at(moment / area) * area : 0.0;
  }
};

// An edge that lies on other cloth has pressure on both of its sides, one more than the other.
void fill_lines(const std::vector<Near>& near, RunResult& run) {
  std::vector<std::array<Side, 2>> sides(run.hems.size());
  for (std::size_t s = 0; s < run.samples.size(); ++s) {
    const ContactSample& sample = run.samples[s];
    const auto [edge, distance, inside] = near[s];
    if (edge < 0 || sample.facet < 0) continue;
    if (distance < run.hems[edge].reach) run.hems[edge].force += sample.force;
    sides[edge][inside ? 0 : 1].add(distance, run.hems[edge].reach, sample);
  }
  for (std::size_t e = 0; e < run.hems.size(); ++e) {
    Hem& hem = run.hems[e];
    const auto& [in, out] = sides[e];
    const double explained = in.explained(out) + out.explained(in);
    if (hem.length > 0.0) hem.line_load = (hem.force - explained) / hem.length;
  }
}

/// Raises the largest pressures of the nodes of a facet that a strip's border runs through to those of its points beside the strip.
void raise_to_border(const std::vector<ContactSample>& samples, const BodyResult& body, std::vector<double>& largest_inside) {
  const std::vector<double>&hem = body.fields[field::hem], &nodal = body.fields[field::contact_pressure];
  for (const ContactSample& sample : samples) {
    if (sample.facet < 0 || sample.hem >= 0) continue;
    const auto& facet = body.skin_facets[sample.facet];
    const bool border = std::any_of(facet.begin(), facet.end(), [&](int n) { return n >= 0 && hem[n] == 1.0; });
    if (!border) continue;
    const double pressure = field_at(body.skin_facets, sample, nodal);
    for (const int n : facet)
      if (n >= 0) largest_inside[n] = std::max(largest_inside[n], pressure);
  }
}

void fill_body(const std::vector<Chain>& chains, const RunResult& run, BodyResult& body) {
  const std::vector<Point> now = nodes_now(body);
  std::vector<double>& inside = body.fields.set(field::pressure_inside, body.fields[field::contact_pressure]);
  std::vector<double>& hem = body.fields.set(field::hem, std::vector<double>(now.size(), 0.0));
  std::vector<char> skin(now.size(), 0);
  for (const auto& facet : body.skin_facets)
    for (const int node : facet)
      if (node >= 0) skin[node] = 1;
  double widest = 0.0;
  for (const Hem& one : run.hems) widest = std::max(widest, one.strip);
  for (std::size_t n = 0; n < now.size(); ++n) {
    const Near near = skin[n] ? nearest(chains, now[n], widest) : Near{};
    if (near.edge >= 0 && near.distance < run.hems[near.edge].strip) hem[n] = 1.0;
  }
  for (std::size_t n = 0; n < now.size(); ++n)
    if (hem[n] == 1.0) inside[n] = 0.0;
  raise_to_border(run.samples, body, body.fields.set(field::largest_inside, inside));
}

}  // namespace

namespace {

/// Of every garment the distance of the node that is farthest from all of its edges, m.
std::vector<double> depths(const std::vector<Chain>& chains, const GarmentResult& garment) {
  std::vector<GarmentPart> parts = garment.parts;
  if (parts.empty()) parts.push_back({"garment", 0, static_cast<int>(garment.current.size()), 0, 0});
  std::vector<double> depth(parts.size(), 0.0);
  for (std::size_t g = 0; g < parts.size(); ++g) {
    std::vector<Chain> own;
    for (std::size_t e = 0; e < chains.size(); ++e)
      if (garment.edges[e].garment == static_cast<int>(g)) own.push_back(chains[e]);
    for (int n = parts[g].first_node; n < parts[g].end_node; ++n)
      depth[g] = std::max(depth[g], nearest(own, garment.current[n], std::numeric_limits<double>::max()).distance);
  }
  return depth;
}

}  // namespace

double keep_hems_apart(double cell, RunResult& run) {
  run.hems.clear();
  if (run.samples.empty()) return 0.0;
  std::vector<Chain> chains;
  const std::map<int, int> opposite = opposite_vertices(run.garment);
  for (const GarmentEdge& edge : run.garment.edges) {
    chains.emplace_back(edge, run.garment.current, opposite);
    run.hems.push_back({edge.name, chains.back().length(), std::max(cell, chains.back().length() / divisions_of_an_edge)});
  }
  const std::vector<double> depth = depths(chains, run.garment);
  double widest = 0.0;
  for (std::size_t e = 0; e < run.hems.size(); ++e) {
    Hem& hem = run.hems[e];
    hem.strip = std::min(hem.strip, 0.5 * depth[run.garment.edges[e].garment]), hem.reach = std::min(cell, hem.strip);
    widest = std::max({widest, hem.strip, beside_an_edge * hem.reach});
  }
  std::vector<Near> near;
  for (ContactSample& sample : run.samples) {
    near.push_back(nearest(chains, sample.at, widest));
    const auto [edge, distance, inside] = near.back();
    sample.hem = edge >= 0 && distance < run.hems[edge].strip ? edge : -1;
  }
  fill_lines(near, run);
  fill_body(chains, run, run.body);
  const std::vector<double>& largest = run.body.fields[field::largest_inside];
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace snug::postproc
