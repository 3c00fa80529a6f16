#include "mesh/garment/pattern.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {

namespace {

constexpr int gmsh_triangle6 = 9;

struct RectangleTags {
  std::map<std::string, int> sides;
  int surface = 0;
};

/// Divisions of a side, at least `least`.
int divisions(double length, double cell_size, int least) {
  return std::max(least, static_cast<int>(std::lround(length / cell_size)));
}

double rounded(double length) { return std::round(1e9 * length) / 1e9; }  // to a nanometre

RectangleTags add_rectangle(double width, double length, double cell_size) {
  namespace geo = gmsh::model::geo;
  // Left and right both run upwards, so that gmsh divides them at the same heights; left comes first, so that its nodes
  // have the smaller numbers and stand for a merged pair.
  const int a = geo::addPoint(0, 0, 0, cell_size), d = geo::addPoint(0, length, 0, cell_size);
  const int b = geo::addPoint(width, 0, 0, cell_size), c = geo::addPoint(width, length, 0, cell_size);
  const std::map<std::string, int> side{{"left", geo::addLine(a, d)},
                                        {"right", geo::addLine(b, c)},
                                        {"lower", geo::addLine(a, b)},
                                        {"upper", geo::addLine(d, c)}};
  for (const auto& [name, line] : side) {
    const bool seam = name == "left" || name == "right";
    geo::mesh::setTransfiniteCurve(line, 1 + (seam ? divisions(length, cell_size, 1) : divisions(width, cell_size, 6)));
  }
  const int loop = geo::addCurveLoop({side.at("lower"), side.at("right"), -side.at("upper"), -side.at("left")});
  RectangleTags tags{side, geo::addPlaneSurface({loop})};
  geo::synchronize();
  return tags;
}

std::unordered_map<std::size_t, int> read_nodes(PatternMesh& pattern) {
  std::vector<std::size_t> tags;
  std::vector<double> x, parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  std::unordered_map<std::size_t, int> number;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    number[tags[n]] = static_cast<int>(pattern.nodes.size());
    pattern.nodes.emplace_back(x[3 * n], x[3 * n + 1]);
  }
  return number;
}

void read_triangles(int surface, const std::unordered_map<std::size_t, int>& number, PatternMesh& pattern) {
  std::vector<std::size_t> elements, tags;
  gmsh::model::mesh::getElementsByType(gmsh_triangle6, elements, tags, surface);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    std::array<int, 6> t;
    for (int n = 0; n < 6; ++n) t[n] = number.at(tags[6 * e + n]);
    const Eigen::Vector2d u = pattern.nodes[t[1]] - pattern.nodes[t[0]], v = pattern.nodes[t[2]] - pattern.nodes[t[0]];
    if (u.x() * v.y() - u.y() * v.x() < 0.0) t = {t[0], t[2], t[1], t[5], t[4], t[3]};
    pattern.triangles.push_back(t);
  }
}

void read_sides(const RectangleTags& tags, const std::unordered_map<std::size_t, int>& number, PatternMesh& pattern) {
  for (const auto& [name, line] : tags.sides) {
    std::vector<std::size_t> nodes;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(nodes, x, parameters, 1, line, true);
    std::vector<int>& side = pattern.sides[name];
    for (std::size_t node : nodes) side.push_back(number.at(node));
    const int axis = name == "left" || name == "right" ? 1 : 0;
    std::sort(side.begin(), side.end(), [&](int a, int b) { return pattern.nodes[a][axis] < pattern.nodes[b][axis]; });
  }
}

}  // namespace

PatternMesh mesh_rectangle(double width, double length, double cell_size) {
  const GmshSession session;
  gmsh::option::setNumber("Mesh.Algorithm", 5);  // Delaunay
  gmsh::model::add("pattern");
  // Rounded, so that the same garment in other units has the same mesh and not one that round-off turned.
  const double across = rounded(width), along = rounded(length);
  const RectangleTags tags = add_rectangle(across, along, rounded(cell_size));
  gmsh::model::mesh::generate(2);
  gmsh::model::mesh::setOrder(2);
  PatternMesh pattern;
  const auto number = read_nodes(pattern);
  read_triangles(tags.surface, number, pattern);
  read_sides(tags, number, pattern);
  for (Eigen::Vector2d& x : pattern.nodes) x = {x.x() / across * width, x.y() / along * length};
  return pattern;
}

double mean_edge_length(const PatternMesh& pattern) {
  double sum = 0.0;
  for (const auto& t : pattern.triangles)
    for (int n = 0; n < 3; ++n) sum += (pattern.nodes[t[n]] - pattern.nodes[t[(n + 1) % 3]]).norm();
  return sum / (3.0 * static_cast<double>(pattern.triangles.size()));
}

}  // namespace snug::mesh
