// Coulomb friction between a surface of the body and a rigid tool.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "solver/terms/tool_contact.hpp"

namespace snug::solver {

/// What it remembers: the accepted state that slip counts from with the traction there, and the frozen problem.
struct ToolFrictionHistory : public History {
  void write(ByteWriter& writer) const override { writer(anchor), writer(traction), writer(stiffness); }

  /// A corner of a facet.
  struct Corner {
    double area = 0.0;                                   ///< int L_v dA of the facet, m2
    double bound = 0.0;                                  ///< mu p_v, Pa; 0: it does not touch
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, 30> slip;                   ///< area times the slip by the change of the facet's and the tip's entries
    Eigen::Vector3d slipping = Eigen::Vector3d::Zero();  ///< traction of this iterate where it slips, Pa; 0 where it sticks
    bool turned = false;                                 ///< it slips against the way in which the iterate before slipped
  };
  using Element = std::array<Corner, 4>;

  Eigen::VectorXd anchor;    ///< values of the accepted state
  Eigen::VectorXd traction;  ///< on the tool there, Pa per rest area; four corners a facet
  double stiffness = 0.0;    ///< k, Pa/m; 0: nothing touches yet
  bool fresh = true;         ///< no iterate has been looked at since the accepted state
  std::shared_ptr<const std::vector<Element>> frames;  ///< of the last update
};

/// The return mapping of Friction (friction.hpp), corner by corner of the facets, where the other side is a tool that is moved: with the contact's points q,
///   slip  u_v = sum_q w_q L_v P_q (dx_q - dd) / A_v,   trial t* = t_v^old + k u_v,   t_v = t* min(1, mu p_v / |t*|),
/// d the change since the last accepted state and P_q = I - n n^T. Frames and bounds are those of the last update; with them frozen the forces derive from a
/// convex potential and the tangent is symmetric; a corner whose slip has turned against the last iterate's has the secant's stiffness along it (friction.hpp). k = mu p_ref / elastic slip, p_ref the mean pressure in contact.
class ToolFriction : public Term {
 public:
  /// `contact` has to outlive the term and to be updated before it; `elastic_slip` in m.
  ToolFriction(std::string name, const ToolContact& contact, double coefficient, double elastic_slip);

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State& state) const override { return contact_.entries(state); }
  double energy(const State& state) const override;
  double stored_energy(const State&) const override { return 0.0; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void renew(State& state) const override;
  void update(State& state) const override;
  void commit(State& state) const override;
  void restore(State& state) const override;

  double coefficient() const { return coefficient_; }
  /// What the surface rubs the tool with: force, moment about the tip, `pressing` the sum of |point forces|.
  ToolContact::Sums sums(const State& state) const;

 private:
  using Corner = ToolFrictionHistory::Corner;
  using Change = Eigen::Matrix<double, 30, 1>;
  struct Return {
    Eigen::Vector3d trial, traction;
    bool slips;
  };
  const ToolFrictionHistory& history(const State& state) const { return state.history.get<ToolFrictionHistory>(name_); }
  ToolFrictionHistory& edit(State& state) const;
  double slip_stiffness(const State& state) const;
  std::shared_ptr<std::vector<ToolFrictionHistory::Element>> frames(const State& state) const;
  void follow_slip(const State& state, const ToolFrictionHistory& history, const std::vector<ToolFrictionHistory::Element>* before,
                   std::vector<ToolFrictionHistory::Element>& now) const;
  Change change(const State& state, const ToolFrictionHistory& history, int facet) const;
  static Return traction(const ToolFrictionHistory& history, const Change& change, int facet, int corner);

  std::string name_;
  const ToolContact& contact_;
  double coefficient_, elastic_slip_;
};

}  // namespace snug::solver
