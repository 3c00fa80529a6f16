#include "mesh/surface/tetrahedra.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>

#include "mesh/formats/contained.hpp"
#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {

namespace {

constexpr int triangle3 = 2, tetrahedron4 = 4;  // gmsh's numbers of element types

/// What a child process found: new points, and the nodes of the cells.
struct Found {
  std::vector<double> x;
  std::vector<int> cells;
};

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <class T>
std::vector<T> taken(const std::string& bytes, std::size_t& at) {
  std::uint64_t count = 0;
  if (at + sizeof count > bytes.size()) throw std::runtime_error("gmsh gave no mesh");
  std::memcpy(&count, bytes.data() + at, sizeof count);
  at += sizeof count;
  if (count > (bytes.size() - at) / sizeof(T)) throw std::runtime_error("gmsh gave no mesh");
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), bytes.data() + at, count * sizeof(T));
  at += count * sizeof(T);
  return values;
}

/// Runs `work` in gmsh in a process of its own.
Found by_gmsh(const std::function<Found()>& work) {
  const auto guarded = [&] {
    std::string fault, bytes;
    Found found;
    try {
      const GmshSession session;
      gmsh::option::setNumber("Mesh.Renumber", 0);  // nodes given keep their tags
      gmsh::logger::start();
      std::vector<std::string> log;
      try {
        found = work();
      } catch (const std::string& text) {
        fault = text;
      } catch (const std::exception& error) {
        fault = error.what();
      }
      gmsh::logger::get(log);
      for (const std::string& line : log)
        if (line.starts_with("Error")) {
          fault = line;
          break;
        }
    } catch (...) {
      fault = "gmsh cannot be started";
    }
    append(bytes, std::vector<char>(fault.begin(), fault.end()));
    append(bytes, found.x), append(bytes, found.cells);
    return bytes;
  };
  Limits limits;
  limits.memory = 4.0 * limits.memory;
  const Contained result = contained(guarded, limits);
  if (result.end == Contained::End::out_of_time) throw std::runtime_error("gmsh was not done in time");
  if (result.end != Contained::End::done) throw std::runtime_error("gmsh crashed");
  std::size_t at = 0;
  const std::vector<char> fault = taken<char>(result.output, at);
  if (!fault.empty()) throw std::runtime_error(std::string(fault.begin(), fault.end()));
  Found found;
  found.x = taken<double>(result.output, at), found.cells = taken<int>(result.output, at);
  return found;
}

/// The nodes given keep their numbers (tags less one), then come the others in the order in which they are met. Their tags tell nothing: gmsh
/// goes on from the largest it was given, which need not be that of all nodes.
class NodeNumbers {
 public:
  explicit NodeNumbers(std::vector<char> given) : given_(std::move(given)) {
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters);
    for (std::size_t n = 0; n < tags.size(); ++n) place_[tags[n]] = {x[3 * n], x[3 * n + 1], x[3 * n + 2]};
  }
  int operator()(std::size_t tag, std::vector<double>& x) {
    if (tag <= given_.size() && given_[tag - 1]) return static_cast<int>(tag) - 1;
    const auto [it, fresh] = number_.try_emplace(tag, static_cast<int>(given_.size() + number_.size()));
    if (fresh) x.insert(x.end(), place_.at(tag).begin(), place_.at(tag).end());
    return it->second;
  }

 private:
  std::vector<char> given_;
  std::map<std::size_t, std::array<double, 3>> place_;
  std::map<std::size_t, int> number_;
};

/// One region, with the nodes of all.
Found fill_volume(const PatchComplex& complex, std::size_t r) {
  std::vector<char> placed(complex.nodes.size(), 0);
  for (const int p : complex.regions[r].patches) {
    const int surface = gmsh::model::addDiscreteEntity(2, p + 1);
    std::vector<std::size_t> tags, corners;
    std::vector<double> x;
    for (const auto& t : complex.patches[p].triangles)
      for (const int n : t) {
        corners.push_back(static_cast<std::size_t>(n) + 1);
        if (placed[n]) continue;
        placed[n] = 1;
        tags.push_back(static_cast<std::size_t>(n) + 1);
        x.insert(x.end(), complex.nodes[n].data(), complex.nodes[n].data() + 3);
      }
    gmsh::model::mesh::addNodes(2, surface, tags, x);
    gmsh::model::mesh::addElementsByType(surface, triangle3, {}, corners);
  }
  std::vector<int> bounds;
  for (const int p : complex.regions[r].patches) bounds.push_back(p + 1);
  const int volume = gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(bounds)});
  gmsh::model::geo::synchronize();
  gmsh::option::setNumber("Mesh.Optimize", 1);
  gmsh::option::setNumber("Mesh.OptimizeNetgen", 0);
  gmsh::model::mesh::generate(3);
  Found found;
  NodeNumbers number(std::move(placed));
  std::vector<std::size_t> tags, nodes;
  gmsh::model::mesh::getElementsByType(tetrahedron4, tags, nodes, volume);
  for (const std::size_t node : nodes) found.cells.push_back(number(node, found.x));
  return found;
}

Found fill_plane(const std::vector<std::vector<Eigen::Vector2d>>& loops) {
  int count = 0;
  std::vector<int> curves;
  for (const auto& loop : loops) {
    const int first = count + 1;
    for (const auto& p : loop) gmsh::model::geo::addPoint(p.x(), p.y(), 0.0, 0.0, ++count);
    std::vector<int> lines;
    for (int n = first; n <= count; ++n) {
      lines.push_back(gmsh::model::geo::addLine(n, n < count ? n + 1 : first));
      gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), 2);
    }
    curves.push_back(gmsh::model::geo::addCurveLoop(lines));
  }
  const int surface = gmsh::model::geo::addPlaneSurface(curves);
  gmsh::model::geo::synchronize();
  gmsh::option::setNumber("Mesh.Algorithm", 5);
  gmsh::model::mesh::generate(2);
  Found found;
  NodeNumbers number(std::vector<char>(static_cast<std::size_t>(count), 1));
  std::vector<std::size_t> tags, nodes;
  gmsh::model::mesh::getElementsByType(triangle3, tags, nodes, surface);
  for (const std::size_t node : nodes) found.cells.push_back(number(node, found.x));
  return found;
}

}  // namespace

Tetrahedra filled(const PatchComplex& complex) {
  Tetrahedra mesh;
  mesh.nodes = complex.nodes;
  const int known = static_cast<int>(complex.nodes.size());
  for (std::size_t r = 0; r < complex.regions.size(); ++r) {  // one at a time: where regions touch, gmsh gives cells of one to the other, too
    const Found found = by_gmsh([&] { return fill_volume(complex, r); });
    const int more = static_cast<int>(mesh.nodes.size()) - known;
    const auto node = [&](int n) { return n < known ? n : n + more; };
    for (std::size_t n = 0; n + 2 < found.x.size(); n += 3) mesh.nodes.emplace_back(found.x[n], found.x[n + 1], found.x[n + 2]);
    for (std::size_t n = 0; n + 3 < found.cells.size(); n += 4) {
      mesh.cells.push_back({node(found.cells[n]), node(found.cells[n + 1]), node(found.cells[n + 2]), node(found.cells[n + 3])});
      mesh.region.push_back(static_cast<int>(r));
    }
  }
  return mesh;
}

PlaneMesh filled(const std::vector<Eigen::Vector2d>& outer, const std::vector<std::vector<Eigen::Vector2d>>& holes) {
  std::vector<std::vector<Eigen::Vector2d>> loops = {outer};
  loops.insert(loops.end(), holes.begin(), holes.end());
  const Found found = by_gmsh([&] { return fill_plane(loops); });
  PlaneMesh mesh;
  for (const auto& loop : loops) mesh.nodes.insert(mesh.nodes.end(), loop.begin(), loop.end());
  for (std::size_t n = 0; n + 2 < found.x.size(); n += 3) mesh.nodes.emplace_back(found.x[n], found.x[n + 1]);
  for (std::size_t n = 0; n + 2 < found.cells.size(); n += 3) {
    std::array<int, 3> t = {found.cells[n], found.cells[n + 1], found.cells[n + 2]};
    const Eigen::Vector2d a = mesh.nodes[t[1]] - mesh.nodes[t[0]], b = mesh.nodes[t[2]] - mesh.nodes[t[0]];
    if (a.x() * b.y() - a.y() * b.x() < 0.0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace snug::mesh
