// Who may move and how: one table of what is not free, which refuses contradictions.
#pragma once

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "solver/algebra/numbering.hpp"

namespace snug::solver {

/// How a held node goes: a displacement that grows with the load, and a turn about a line along z.
struct Motion {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();   ///< m, at full load
  double turn = 0.0;                                        ///< rad, at full load
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();         ///< m, of the line

  bool moves() const { return turn != 0.0 || !displacement.isZero(0.0); }
  /// From the place x at rest (m), at a load.
  Eigen::Vector3d at(const Eigen::Vector3d& x, double load) const;
};

/// A node keeps its place along a direction (a unit vector) but for a displacement (m, at full load).
struct Line {
  int holder = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  double displacement = 0.0;
};

/// Somebody who prescribes entries, as results and messages name him.
struct Holder {
  std::string name;
  input::Location where = {};
};

/// Rows: prescribed entries (by one or more holders who say the same), and entries that follow others: tied to one, or bound to a
/// weighted sum of several. Whoever comes first to an entry that follows others keeps it; prescribing one twice is checked.
class ConstraintTable {
 public:
  explicit ConstraintTable(int entries) : entries_(entries) {}

  /// A holder for the calls of `prescribe` that follow.
  int add(Holder holder);
  /// A component of a node goes by the motion of a holder; `rest`: the node's place at rest, `node`: its number in messages.
  /// Throws input::InputError naming both holders and the node when it is prescribed otherwise already.
  void prescribe(int entry, int holder, int component, const Motion& motion, const Eigen::Vector3d& rest, int node);
  /// A node goes as lines of any number and direction say; `first` is its x entry, whose y and z follow. Components that are prescribed already stay so;
  /// of the others as many follow the rest as the lines take. For when all else is prescribed. Throws input::InputError where they contradict each other.
  void hold_along(int first, const std::vector<Line>& lines, const Eigen::Vector3d& rest, int node);
  /// An entry without a place of its own: it has no unknown.
  void fix(int entry);
  /// The entry takes the step of `to`, or the weighted sum of several. Nothing where it is prescribed already.
  void tie(int entry, int to) { follow(entry, {{to, 1.0}}, true); }
  void bind(int entry, std::vector<Follow> others) { follow(entry, std::move(others), false); }

  bool prescribed(int entry) const { return rows_.contains(entry) && !rows_.at(entry).along && rows_.at(entry).follows.empty(); }
  const std::vector<Holder>& holders() const { return holders_; }
  /// What a holder holds: entries, with the share of its force that is his. Several on one entry bear the same.
  struct Held {
    int entry;
    double share;
  };
  std::vector<Held> held_by(int holder) const;
  /// Prescribed entries, in their order.
  std::vector<int> prescribed_entries() const;
  bool moves() const { return moves_; }
  /// From `values` to where prescribed entries should be at a load, one value an entry; of entries that lines hold what is left when those that they
  /// follow keep their place, or go to where they are prescribed. Empty where nothing moves.
  Eigen::VectorXd gap(const Eigen::VectorXd& values, double load) const;

  /// Unknowns of the free entries, those that follow resolved to the end; `owner[i]` is the rank of entry i.
  Numbering numbering(const std::vector<int>& owner, int ranks) const;

 private:
  struct Row {
    std::vector<int> holders = {};
    std::vector<Follow> follows = {};
    bool tied = false;
    int component = 0;
    Motion motion = {};
    Eigen::Vector3d rest = Eigen::Vector3d::Zero();
    bool along = false;   ///< one of a line
    double way = 0.0;     ///< m, at full load, besides what it follows
  };
  void check_line(int first, const Eigen::Vector4d& left, const Line& line, const Eigen::Vector3d& rest, int node) const;
  double gap_along(int entry, const Row& row, const Eigen::VectorXd& values, double load) const;
  void follow(int entry, std::vector<Follow> others, bool tied);

  int entries_;
  std::vector<Holder> holders_;
  std::map<int, Row> rows_;
  bool moves_ = false;
};

}  // namespace snug::solver
