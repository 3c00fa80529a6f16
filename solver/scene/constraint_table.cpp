#include "solver/scene/constraint_table.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

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
    if (row.motion.moves()) gap[entry] = row.motion.at(row.rest, load)[row.component] - values[entry];
  return gap;
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
