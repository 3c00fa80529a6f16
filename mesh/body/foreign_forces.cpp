#include "mesh/body/foreign_forces.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <set>

#include "solver/fem/element.hpp"

namespace snug::mesh {

namespace {

/// A face of the file whose nodes are all loaded, with the body's nodes on it.
struct LoadedFace {
  std::vector<int> file, full;                ///< nodes of the body
  Eigen::MatrixXd values;                     ///< E: full x file
  std::vector<FacetNodeNumbers> facets = {};
};

class Spreading {
 public:
  Spreading(const Model& model, const ForeignNodes& nodes, BodyMesh& mesh) : model_(model), nodes_(nodes), mesh_(mesh) {
    for (const NodalForce& force : mesh.forces) force_[force.node] = force.force;
  }

  void operator()() {
    for (const auto& [element, face] : outer_faces()) add(*element, face);
    find_facets();
    std::erase_if(faces_, [](const LoadedFace& face) { return face.facets.empty(); });
    if (faces_.empty()) return;
    for (LoadedFace& face : faces_) masses_.push_back(mass(face));
    const Eigen::MatrixXd traction = tractions();
    for (const auto& [node, unknown] : unknown_) force_.erase(node);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      Eigen::MatrixXd at_file(faces_[f].file.size(), 3);
      for (std::size_t n = 0; n < faces_[f].file.size(); ++n) at_file.row(n) = traction.row(unknown_.at(faces_[f].file[n]));
      const Eigen::MatrixXd forces = masses_[f] * faces_[f].values * at_file;
      for (std::size_t n = 0; n < faces_[f].full.size(); ++n)
        force_.try_emplace(faces_[f].full[n], Eigen::Vector3d::Zero()).first->second += forces.row(n).transpose();
    }
    mesh_.forces.clear();
    for (const auto& [node, force] : force_) mesh_.forces.push_back({node, force});
  }

 private:
  using Outer = std::pair<const ModelElement*, int>;
  /// Faces of one element only; of a shell its elements.
  std::vector<Outer> outer_faces() const {
    std::map<std::vector<int>, std::pair<Outer, int>> seen;
    for (const ModelElement& element : model_.elements)
      for (int f = 0; f < static_cast<int>(model_faces(element.kind).size()); ++f) {
        std::vector<int> corners;
        for (const int a : model_faces(element.kind)[f]) corners.push_back(element.nodes[a]);
        if (!std::all_of(corners.begin(), corners.end(), [&](int n) { return force_.contains(nodes_.at(n)); })) continue;
        std::sort(corners.begin(), corners.end());
        ++seen.try_emplace(std::move(corners), Outer{&element, f}, 0).first->second.second;
      }
    std::vector<Outer> outer;
    for (const auto& [corners, at] : seen)
      if (at.second == 1) outer.push_back(at.first);
    return outer;
  }

  /// Corners, the middles of the edges and, of quadrilaterals, the node amid them; quadratic faces weigh theirs by the serendipity
  /// shape functions, linear ones take means.
  void add(const ModelElement& element, int face_number) {
    const std::vector<int>& places = model_faces(element.kind)[face_number];
    const std::size_t corners = places.size();
    LoadedFace face;
    for (const int a : places) face.file.push_back(nodes_.at(element.nodes[a]));
    face.full = face.file;
    std::vector<Eigen::VectorXd> rows;
    const std::size_t most = 2 * corners;
    for (std::size_t c = 0; c < corners; ++c) rows.push_back(Eigen::VectorXd::Unit(most, c));
    Eigen::VectorXd centre = Eigen::VectorXd::Zero(most);
    for (std::size_t c = 0; c < corners; ++c) {
      const std::size_t next = (c + 1) % corners;
      const int middle = nodes_.find({face.full[c], face.full[next]});
      if (middle < 0) return;
      Eigen::VectorXd value = 0.5 * (rows[c] + rows[next]);
      if (mesh_.node_numbers[middle] != 0 && is_of_file(middle)) {
        if (!force_.contains(middle)) return;
        value = Eigen::VectorXd::Unit(most, face.file.size());
        face.file.push_back(middle);
      }
      centre += 0.5 * value - 0.25 * rows[c];
      face.full.push_back(middle);
      rows.push_back(value);
    }
    if (corners == 4) {
      const auto& n = face.full;
      int amid = nodes_.find({n[0], n[1], n[2], n[3]});
      if (amid < 0) amid = std::max(nodes_.find({n[0], n[2]}), nodes_.find({n[1], n[3]}));
      if (amid < 0) return;
      face.full.push_back(amid);
      rows.push_back(centre);
    }
    face.values.resize(rows.size(), face.file.size());
    for (std::size_t r = 0; r < rows.size(); ++r) face.values.row(r) = rows[r].head(face.file.size()).transpose();
    if (face.file.size() < face.full.size()) unlike_ = true;
    faces_.push_back(std::move(face));
  }
  bool is_of_file(int node) const { return nodes_.has(mesh_.node_numbers[node]) && nodes_.at(mesh_.node_numbers[node]) == node; }

  /// The body's facets on each face: those with corners of it only.
  void find_facets() {
    if (!unlike_) faces_.clear();  // forces of quadratic triangles are those of the body
    if (faces_.empty()) return;
    std::vector<FacetNodeNumbers> all = mesh_.shell.empty() ? boundary_facets(mesh_, std::vector<char>(mesh_.nodes.size(), 1)) : mesh_.skin_facets;
    std::map<int, std::vector<std::size_t>> at_node;
    for (std::size_t f = 0; f < all.size(); ++f) at_node[all[f][0]].push_back(f);
    const int corners_of_facet = facet_kind(mesh_.kind) == FacetKind::tri6 ? 3 : 4;
    for (LoadedFace& face : faces_) {
      const std::size_t corners = face.full.size() > 6 ? 4 : 3;
      const std::set<int> own(face.full.begin(), face.full.begin() + static_cast<std::ptrdiff_t>(corners));
      for (const int corner : own)
        for (const std::size_t f : at_node[corner])
          if (std::count_if(all[f].begin(), all[f].end(), [&](int n) { return own.contains(n); }) == corners_of_facet) face.facets.push_back(all[f]);
    }
  }

  Eigen::MatrixXd mass(const LoadedFace& face) const {
    const fem::Element element = facet_kind(mesh_.kind) == FacetKind::tri6 ? fem::Element::tri6 : fem::Element::quad9;
    static const auto rules = [] {
      const auto make = [](fem::Element e) {
        const fem::Rule rule = fem::quadrature(fem::domain(e), 5);
        return std::pair(fem::tabulate(e, rule.points), rule.weights);
      };
      return std::array{make(fem::Element::tri6), make(fem::Element::quad9)};
    }();
    const auto& [table, weights] = rules[element == fem::Element::tri6 ? 0 : 1];
    const int count = fem::node_count(element);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(face.full.size(), face.full.size());
    for (const FacetNodeNumbers& facet : face.facets) {
      Eigen::Matrix3Xd x(3, count);
      std::vector<int> place;
      for (int a = 0; a < count; ++a) {
        x.col(a) = mesh_.nodes[facet[a]];
        place.push_back(static_cast<int>(std::find(face.full.begin(), face.full.end(), facet[a]) - face.full.begin()));
      }
      for (Eigen::Index q = 0; q < weights.size(); ++q) {
        const Eigen::Matrix<double, 3, 2> tangents = x * table.gradients[q];
        const double area = weights[q] * tangents.col(0).cross(tangents.col(1)).norm();
        for (int a = 0; a < count; ++a)
          for (int b = 0; b < count; ++b) result(place[a], place[b]) += area * table.values(a, q) * table.values(b, q);
      }
    }
    return result;
  }

  Eigen::MatrixXd tractions() {
    std::vector<Eigen::Triplet<double>> entries;
    for (const LoadedFace& face : faces_)
      for (const int node : face.file) unknown_.emplace(node, static_cast<int>(unknown_.size()));
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Eigen::MatrixXd of_file = faces_[f].values.transpose() * masses_[f] * faces_[f].values;
      for (std::size_t a = 0; a < faces_[f].file.size(); ++a)
        for (std::size_t b = 0; b < faces_[f].file.size(); ++b)
          entries.emplace_back(unknown_.at(faces_[f].file[a]), unknown_.at(faces_[f].file[b]), of_file(a, b));
    }
    Eigen::SparseMatrix<double> matrix(unknown_.size(), unknown_.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::MatrixXd forces(unknown_.size(), 3);
    for (const auto& [node, unknown] : unknown_) forces.row(unknown) = force_.at(node).transpose();
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(forces);
  }

  const Model& model_;
  const ForeignNodes& nodes_;
  BodyMesh& mesh_;
  std::map<int, Eigen::Vector3d> force_;  ///< N, by node of the body
  std::vector<LoadedFace> faces_;
  std::vector<Eigen::MatrixXd> masses_;
  std::map<int, int> unknown_;  ///< node -> row
  bool unlike_ = false;         ///< some face has nodes that the file does not have
};

}  // namespace

void spread_forces(const Model& model, const ForeignNodes& nodes, BodyMesh& mesh) {
  if (!mesh.forces.empty() && mesh.kind != CellKind::hex8) Spreading(model, nodes, mesh)();
}

}  // namespace snug::mesh
