#include "solver/scene/rigid_motions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <numeric>

#include "solver/terms/shell.hpp"

namespace snug::solver {

namespace {

using Row = Eigen::Matrix<double, 6, 1>;
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Squared lengths: a support of a hundred-thousandth of the part's size still holds a turn.
constexpr double none = 1e-10;

class Parts {
 public:
  explicit Parts(std::size_t nodes) : parent_(nodes), used_(nodes, 0) { std::iota(parent_.begin(), parent_.end(), 0); }
  template <class Nodes>
  void connect(const Nodes& element, int count) {
    for (int a = 0; a < count; ++a) used_[element[a]] = 1, parent_[root(element[a])] = root(element[0]);
  }
  int root(int node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  bool used(int node) const { return used_[node] != 0; }

 private:
  std::vector<int> parent_;
  std::vector<char> used_;
};

std::vector<FreePart> connected_parts(const mesh::BodyMesh& mesh) {
  Parts parts(mesh.nodes.size());
  for (const auto& cell : mesh.cells) parts.connect(cell, node_count(mesh.kind));
  for (const auto& triangle : mesh.shell) parts.connect(triangle.nodes, 6);
  std::map<int, FreePart> by_root;
  std::vector<int> order;
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    if (!parts.used(node)) continue;
    auto [it, fresh] = by_root.try_emplace(parts.root(node));
    if (fresh) order.push_back(it->first);
    it->second.nodes.push_back(node);
  }
  std::vector<FreePart> list;
  for (const int root : order) {
    FreePart& part = list.emplace_back(std::move(by_root.at(root)));
    for (const int node : part.nodes) part.centre += mesh.nodes[node] / static_cast<double>(part.nodes.size());
    for (const int node : part.nodes) part.size = std::max(part.size, (mesh.nodes[node] - part.centre).norm());
  }
  return list;
}

// What a motion does to a point along a direction, as a row: e . (t + w x d).
Row moves(const FreePart& part, const Eigen::Vector3d& at, const Eigen::Vector3d& along) {
  Row row;
  row << along, (at - part.centre).cross(along) / part.size;
  return row;
}

Row turns(const Eigen::Vector3d& about) {
  Row row;
  row << Eigen::Vector3d::Zero(), about;
  return row;
}

// Sum of row row^T over all that holds the part.
Eigen::Matrix<double, 6, 6> holds(const FreePart& part, const mesh::BodyMesh& mesh, const std::set<NodeComponent>& held,
                                  const std::vector<NodeLine>& lines) {
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  const auto add = [&](const Row& row) { sum += row * row.transpose(); };
  for (const int node : part.nodes)
    for (int c = 0; c < 3; ++c)
      if (held.contains({node, c})) add(moves(part, mesh.nodes[node], Eigen::Vector3d::Unit(c)));
  const std::set<int> mine(part.nodes.begin(), part.nodes.end());
  for (const NodeLine& line : lines)
    if (mine.contains(line.node)) add(moves(part, mesh.nodes[line.node], line.along));
  for (const mesh::ShellTriangle& triangle : mesh.shell) {
    if (!mine.contains(triangle.nodes[0]) || triangle.foundation == 0.0) continue;
    const Eigen::Vector3d &a = mesh.nodes[triangle.nodes[0]], &b = mesh.nodes[triangle.nodes[1]], &c = mesh.nodes[triangle.nodes[2]];
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    for (int k = 0; k < 6; ++k) add(moves(part, mesh.nodes[triangle.nodes[k]], normal));
  }
  for (const auto& [first, last] : clamped_edges(mesh))
    if (mine.contains(first)) add(turns((mesh.nodes[last] - mesh.nodes[first]).normalized()));
  return sum;
}

std::string name_of(const FreePart& part, const mesh::BodyMesh& mesh, bool alone) {
  if (alone) return "the body";
  const std::set<int> mine(part.nodes.begin(), part.nodes.end());
  std::set<std::string> layers;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (mine.contains(mesh.cells[c][0])) layers.insert(mesh.layers[mesh.cell_layer[c]].name);
  for (const mesh::ShellTriangle& triangle : mesh.shell)
    if (mine.contains(triangle.nodes[0])) layers.insert(mesh.layers[triangle.layer].name);
  const Eigen::Vector3d middle = 1e3 * part.centre;
  return fmt::format("the part of the body round ({:.4g}, {:.4g}, {:.4g}) mm, of \"{}\",", middle.x(), middle.y(), middle.z(),
                     fmt::join(layers, "\", \""));
}

// The motions of `all` whose rows from `first` on (three of them) vanish.
Motions without(const Motions& all, int first) {
  if (all.cols() == 0) return all;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(all.middleRows(first, 3), Eigen::ComputeFullV);
  int rank = 0;
  for (const double s : svd.singularValues()) rank += s * s > none;
  return all * svd.matrixV().rightCols(all.cols() - rank);
}

// "along x and y": the axes in the span of the columns, or the columns themselves where they are no axes.
std::string directions(const Eigen::Matrix3Xd& span) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(span, Eigen::ComputeThinU);
  std::vector<std::string> names;
  int rank = 0;
  for (const double s : svd.singularValues()) rank += s * s > none;
  const Eigen::MatrixXd basis = svd.matrixU().leftCols(rank);
  for (int axis = 0; axis < 3; ++axis)
    if (basis.row(axis).squaredNorm() > 1.0 - 1e-6) names.push_back(std::string(1, "xyz"[axis]));
  if (static_cast<int>(names.size()) != rank) {
    names.clear();
    for (Eigen::Vector3d way : basis.colwise()) {
      way = (way.array().abs() > 1e-6).select(way, 0.0);
      Eigen::Index largest = 0;
      way.cwiseAbs().maxCoeff(&largest);
      if (way[largest] < 0.0) way = -way;
      names.push_back(fmt::format("({:.3g}, {:.3g}, {:.3g})", way.x() + 0.0, way.y() + 0.0, way.z() + 0.0));
    }
  }
  if (names.size() > 2) return fmt::format("{}, {} and {}", names[0], names[1], names[2]);
  return fmt::format("{}", fmt::join(names, " and "));
}

}  // namespace

std::vector<FreePart> free_parts(const mesh::BodyMesh& mesh, const std::set<NodeComponent>& held, const std::vector<NodeLine>& lines) {
  std::vector<FreePart> parts = connected_parts(mesh), list;
  for (FreePart& part : parts) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(holds(part, mesh, held, lines));
    const double bound = none * std::max(1.0, eigen.eigenvalues()[5]);
    const int free = static_cast<int>((eigen.eigenvalues().array() <= bound).count());
    if (free == 0) continue;
    part.motions = eigen.eigenvectors().leftCols(free);
    part.name = name_of(part, mesh, parts.size() == 1);
    list.push_back(std::move(part));
  }
  return list;
}

std::string motions_text(const FreePart& part) {
  const Motions shifts = without(part.motions, 3);
  const Eigen::Matrix3Xd turns = part.motions.bottomRows(3);
  std::vector<std::string> texts;
  if (shifts.cols() > 0) texts.push_back("to move along " + directions(shifts.topRows(3)));
  if (shifts.cols() < part.motions.cols()) texts.push_back("to turn about " + directions(turns));
  return fmt::format("{}", fmt::join(texts, " and "));
}

std::vector<NodeComponent> determinate_supports(const FreePart& part, const mesh::BodyMesh& mesh, const std::set<int>& without) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3 * part.nodes.size(), part.motions.cols());
  for (std::size_t i = 0; i < part.nodes.size(); ++i)
    for (int c = 0; c < 3 && !without.contains(part.nodes[i]); ++c)
      rows.row(3 * i + c) = moves(part, mesh.nodes[part.nodes[i]], Eigen::Vector3d::Unit(c)).transpose() * part.motions;
  std::vector<NodeComponent> chosen;
  for (Eigen::Index k = 0; k < part.motions.cols(); ++k) {
    const Eigen::VectorXd moved = rows.rowwise().norm();
    Eigen::Index best = 0;
    while (moved[best] < (1.0 - 1e-6) * moved.maxCoeff()) ++best;
    chosen.emplace_back(part.nodes[best / 3], static_cast<int>(best % 3));
    const Eigen::RowVectorXd direction = rows.row(best).normalized();
    rows -= (rows * direction.transpose()) * direction;
  }
  return chosen;
}

NetLoad net_load(const FreePart& part, const mesh::BodyMesh& mesh, const std::vector<Eigen::Vector3d>& forces) {
  Row sum = Row::Zero();
  double size = 0.0;
  for (const int node : part.nodes) {
    sum.head<3>() += forces[node];
    sum.tail<3>() += (mesh.nodes[node] - part.centre).cross(forces[node]) / part.size;
    size += forces[node].norm();
  }
  const Row along = part.motions * (part.motions.transpose() * sum);
  return {along.head<3>(), part.size * along.tail<3>(), along.norm() <= 1e-6 * size};
}

}  // namespace snug::solver
