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
  std::map<std::string, std::vector<int>> sides;  // lines, one behind the other
  std::vector<int> surfaces;
};

/// Divisions of a side, at least `least`.
int divisions(double length, double cell_size, int least) {
  return std::max(least, static_cast<int>(std::lround(length / cell_size)));
}

double rounded(double length) { return std::round(1e9 * length) / 1e9; }  // to a nanometre

// Strips between heights, from below. Lines of left and right all run upwards, so that gmsh divides them at the same heights; left
// comes first, so that its nodes have the smaller numbers and stand for a merged pair.
RectangleTags add_rectangle(double width, const std::vector<double>& heights, double cell_size) {
  namespace geo = gmsh::model::geo;
  const auto point = [&](double x, double y) { return geo::addPoint(x, y, 0, cell_size); };
  std::vector<int> left, right;
  for (const double y : heights) left.push_back(point(0, y));
  for (const double y : heights) right.push_back(point(width, y));
  RectangleTags tags;
  const auto line = [&](int from, int to, double length, int least) {
    const int tag = geo::addLine(from, to);
    geo::mesh::setTransfiniteCurve(tag, 1 + divisions(length, cell_size, least));
    return tag;
  };
  const std::size_t strips = heights.size() - 1;
  for (const auto& [name, points] : {std::pair<const char*, const std::vector<int>&>{"left", left}, {"right", right}})
    for (std::size_t s = 0; s < strips; ++s) tags.sides[name].push_back(line(points[s], points[s + 1], heights[s + 1] - heights[s], 1));
  std::vector<int> across(heights.size());
  across.front() = line(left.front(), right.front(), width, 6), across.back() = line(left.back(), right.back(), width, 6);
  for (std::size_t s = 1; s < strips; ++s) across[s] = line(left[s], right[s], width, 6);
  tags.sides["lower"] = {across.front()}, tags.sides["upper"] = {across.back()};
  for (std::size_t s = 0; s < strips; ++s) {
    const int loop = geo::addCurveLoop({across[s], tags.sides["right"][s], -across[s + 1], -tags.sides["left"][s]});
    tags.surfaces.push_back(geo::addPlaneSurface({loop}));
  }
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
  for (const auto& [name, lines] : tags.sides) {
    std::vector<int>& side = pattern.sides[name];
    for (const int line : lines) {
      std::vector<std::size_t> nodes;
      std::vector<double> x, parameters;
      gmsh::model::mesh::getNodes(nodes, x, parameters, 1, line, true);
      for (std::size_t node : nodes) side.push_back(number.at(node));
    }
    const int axis = name == "left" || name == "right" ? 1 : 0;
    std::sort(side.begin(), side.end(), [&](int a, int b) { return pattern.nodes[a][axis] < pattern.nodes[b][axis]; });
    side.erase(std::unique(side.begin(), side.end()), side.end());  // lines share their ends
  }
}

}  // namespace

PatternMesh mesh_rectangle(double width, double length, double cell_size, const std::vector<double>& borders) {
  const GmshSession session;
  gmsh::option::setNumber("Mesh.Algorithm", 5);  // Delaunay
  gmsh::model::add("pattern");
  // Rounded, so that the same garment in other units has the same mesh and not one that round-off turned.
  const double across = rounded(width), along = rounded(length);
  std::vector<double> heights{0.0};
  for (const double border : borders) heights.push_back(rounded(border));
  heights.push_back(along);
  const RectangleTags tags = add_rectangle(across, heights, rounded(cell_size));
  gmsh::model::mesh::generate(2);
  gmsh::model::mesh::setOrder(2);
  PatternMesh pattern;
  const auto number = read_nodes(pattern);
  for (const int surface : tags.surfaces) read_triangles(surface, number, pattern);
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
