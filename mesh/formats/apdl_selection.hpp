// The nodes that APDL has selected, and the commands that name some of them.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

class ApdlSelection {
 public:
  /// `deck` has the nodes and the components, which CM adds to, and outlives this.
  explicit ApdlSelection(ApdlDeck& deck) : deck_(deck) {}

  void all() { all_ = true; }
  /// NSEL,S|R|A|U,LOC|NODE,component,min,max,step and NSEL,ALL|NONE; `place` gives the coordinates that are in use.
  void select(const FieldLine& line, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place);
  /// CMSEL,S|R|A|U,name.
  void select_component(const FieldLine& line);
  /// CM,name,NODE: a component of what is selected; those of others are left out.
  void make_component(const FieldLine& line);
  /// Nodes (or keypoints) that field 1 names, by number, ALL or a component, or a range up to field `last` in steps of the next one. What is none
  /// of them is reported.
  std::vector<int> named(const FieldLine& line, std::size_t last) const;

 private:
  bool contains(int node) const { return all_ || selected_.contains(node); }
  std::vector<int> nodes() const;
  void apply(const std::string& mode, const std::function<bool(int, const Eigen::Vector3d&)>& test);

  ApdlDeck& deck_;
  std::set<int> selected_;
  bool all_ = true;
};

}  // namespace snug::mesh
