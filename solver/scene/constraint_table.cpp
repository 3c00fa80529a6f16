#include "solver/scene/constraint_table.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace snug::solver {

namespace {

// Two motions are the same when they agree here, relative to how far they go.
constexpr std::array<double, 2> compared_at = {0.37, 1.0};
constexpr double same = 1e-9;

bool differ(const Motion& a, const Motion& b, const Eigen::Vector3d& x, int component) {
  return std::any_of(compared_at.begin(), compared_at.end(), [&](double load) {
    const double u = (a.at(x, load) - x)[component], v = (b.at(x, load) - x)[component];
    return std::abs(u - v) > same * std::max(std::abs(u), std::abs(v));
  });
}

std::string told(const Motion& motion, const Eigen::Vector3d& x, int component) {
  const double way = (motion.at(x, 1.0) - x)[component];
  return motion.moves() ? fmt::format("moves it by {:.6g} mm", 1e3 * way) : "holds it";
}

}  // namespace

Eigen::Vector3d Motion::at(const Eigen::Vector3d& x, double load) const {
  Eigen::Vector3d to = x + load * displacement;
  if (turn == 0.0) return to;
  const Eigen::Vector2d arm = x.head<2>() - middle;
  to.head<2>() += Eigen::Rotation2D<double>(load * turn) * arm - arm;
  return to;
}

int ConstraintTable::add(Holder holder) {
  holders_.push_back(std::move(holder));
  return static_cast<int>(holders_.size()) - 1;
}

void ConstraintTable::prescribe(int entry, int holder, int component, const Motion& motion, const Eigen::Vector3d& rest, int node) {
  const auto [it, fresh] = rows_.try_emplace(entry, Row{.component = component, .motion = motion, .rest = rest});
  Row& row = it->second;
  if (!fresh && differ(row.motion, motion, rest, component)) {
    const Holder &first = holders_[row.holders.front()], &second = holders_[holder];
    const char axis = "xyz"[component];
    throw input::InputError(second.where.file.empty() ? first.where : second.where,
                            fmt::format("two supports contradict each other at node {} along {}: \"{}\" {}, \"{}\" {}", node, axis, first.name,
                                        told(row.motion, rest, component), second.name, told(motion, rest, component)),
                            fmt::format("leave {} out of one of them, give both the same value, or name surfaces that share no node", axis));
  }
  if (std::find(row.holders.begin(), row.holders.end(), holder) == row.holders.end()) row.holders.push_back(holder);
  moves_ = moves_ || motion.moves();
}

void ConstraintTable::hold_along(int first, const std::vector<Line>& lines, const Eigen::Vector3d& rest, int node) {
  constexpr double none = 1e-9;  // of a unit vector
  Eigen::MatrixXd a(lines.size(), 4);  // direction . u = displacement
  for (std::size_t l = 0; l < lines.size(); ++l) a.row(l) << lines[l].direction.transpose(), lines[l].displacement;
  std::array<bool, 3> taken{};
  for (int c = 0; c < 3; ++c) taken[c] = prescribed(first + c);
  std::vector<std::pair<Eigen::Index, int>> pivots;  // row and component that follows
  std::vector<bool> used(lines.size(), false);
  while (true) {  // Gauss-Jordan with the largest pivot
    Eigen::Index row = -1;
    int component = -1;
    double largest = none;
    for (std::size_t l = 0; l < lines.size(); ++l)
      for (int c = 0; c < 3; ++c)
        if (!used[l] && !taken[c] && std::abs(a(l, c)) > largest) largest = std::abs(a(l, c)), row = static_cast<Eigen::Index>(l), component = c;
    if (row < 0) break;
    used[row] = taken[component] = true;
    pivots.emplace_back(row, component);
    a.row(row) /= double(a(row, component));
    for (Eigen::Index other = 0; other < a.rows(); ++other)
      if (other != row) a.row(other) -= double(a(other, component)) * a.row(row);
  }
  for (std::size_t l = 0; l < lines.size(); ++l)
    if (!used[l]) check_line(first, a.row(l), lines[l], rest, node);
  for (const auto& [row, component] : pivots) {
    Row line{.component = component, .rest = rest, .along = true, .way = a(row, 3)};
    for (int c = 0; c < 3; ++c)
      if (c != component && std::abs(a(row, c)) > none) line.follows.push_back({first + c, -a(row, c)});
    moves_ = moves_ || line.way != 0.0;
    rows_.emplace(first + component, std::move(line));
  }
}

/// What is left of a line where its components are prescribed has to be so already.
void ConstraintTable::check_line(int first, const Eigen::Vector4d& left, const Line& line, const Eigen::Vector3d& rest, int node) const {
  const double scale = std::max(std::abs(line.displacement), 1e-9 * rest.norm());
  for (const double load : compared_at) {
    double off = -load * left[3];
    for (int c = 0; c < 3; ++c)
      if (const auto row = rows_.find(first + c); row != rows_.end() && left[c] != 0.0) off += left[c] * (row->second.motion.at(rest, load) - rest)[c];
    if (std::abs(off) <= 1e-9 * std::max(scale, std::abs(load * left[3]))) continue;
    const Holder& holder = holders_[line.holder];
    const Eigen::Vector3d& n = line.direction;
    throw input::InputError(holder.where, fmt::format("two supports contradict each other at node {}: \"{}\" moves it by {:.6g} mm along ({:.3g}, {:.3g}, {:.3g})", node,
                                                      holder.name, 1e3 * line.displacement, n.x(), n.y(), n.z()),
                            "leave one of them out, or name surfaces that share no node");
  }
}

void ConstraintTable::fix(int entry) { rows_.try_emplace(entry); }

void ConstraintTable::follow(int entry, std::vector<Follow> others, bool tied) {
  rows_.try_emplace(entry, Row{.follows = std::move(others), .tied = tied});
}

std::vector<ConstraintTable::Held> ConstraintTable::held_by(int holder) const {
  std::vector<Held> list;
  for (const auto& [entry, row] : rows_)
    if (std::find(row.holders.begin(), row.holders.end(), holder) != row.holders.end())
      list.push_back({entry, 1.0 / static_cast<double>(row.holders.size())});
  return list;
}

std::vector<int> ConstraintTable::prescribed_entries() const {
  std::vector<int> list;
  for (const auto& [entry, row] : rows_)
    if (!row.holders.empty()) list.push_back(entry);
  return list;
}

Eigen::VectorXd ConstraintTable::gap(const Eigen::VectorXd& values, double load) const {
  if (!moves_) return {};
  Eigen::VectorXd gap = Eigen::VectorXd::Zero(values.size());
  for (const auto& [entry, row] : rows_)
    if (row.along) gap[entry] = gap_along(entry, row, values, load);
    else if (row.motion.moves()) gap[entry] = row.motion.at(row.rest, load)[row.component] - values[entry];
  return gap;
}

double ConstraintTable::gap_along(int entry, const Row& row, const Eigen::VectorXd& values, double load) const {
  const int first = entry - row.component;
  double place = row.rest[row.component] + load * row.way, size = std::abs(place);
  for (const Follow& of : row.follows) {
    const int c = of.entry - first;
    const auto prescribed = rows_.find(of.entry);
    const double now = prescribed != rows_.end() && prescribed->second.motion.moves() ? prescribed->second.motion.at(row.rest, load)[c] : values[of.entry];
    place += of.weight * (now - row.rest[c]);
    size += std::abs(of.weight) * (std::abs(now) + std::abs(row.rest[c]));
  }
  const double gap = place - values[entry];
  return std::abs(gap) <= 4.0 * std::numeric_limits<double>::epsilon() * size ? 0.0 : gap;  // round-off of the sum is no way to go
}

Numbering ConstraintTable::numbering(const std::vector<int>& owner, int ranks) const {
  fem::Lines lines;
  for (const auto& [entry, row] : rows_) lines[entry] = row.follows;
  lines = fem::closed(lines);
  std::vector<int> master(entries_);
  Bound bound;
  for (int i = 0; i < entries_; ++i) {
    master[i] = i;
    const auto row = rows_.find(i);
    if (row == rows_.end()) continue;
    const auto& line = lines.at(i);
    const bool tied = row->second.tied && line.size() == 1 && line.front().weight == 1.0;
    master[i] = tied ? line.front().entry : -1;
    if (!tied && !line.empty()) bound[i] = line;
  }
  return Numbering(std::move(master), owner, ranks, std::move(bound));
}

}  // namespace snug::solver
