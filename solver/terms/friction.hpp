// Coulomb friction between a slave, mostly a garment, and what lies under it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/terms/contact.hpp"

namespace snug::solver {

/// What friction remembers: the accepted state that slip counts from with the traction there, and the frozen problem.
struct FrictionHistory : public History {
  void write(ByteWriter& writer) const override { writer(anchor), writer(traction), writer(held), writer(stiffness); }

  using Operator = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  struct Corner {
    double area = 0.0;    ///< A_v of the points that face the skin, m2
    double bound = 0.0;   ///< mu p_v / release + (1 - release) |t_v| of the last state that stuck without a bound, Pa
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Operator slip;        ///< A_v u_v = slip * (change of the triangle's entries) in the plane of `normal`, m2
    Eigen::Vector3d slipping = Eigen::Vector3d::Zero();  ///< traction of this iterate where it slips, Pa; 0 where it sticks
    bool turned = false;  ///< it slips against the way in which the iterate before slipped
  };
  using Element = std::array<Corner, 3>;

  Eigen::VectorXd anchor;    ///< values of the accepted state
  Eigen::VectorXd traction;  ///< on the skin there, Pa per rest area of the garment; three corners a triangle
  Eigen::VectorXd held;      ///< its length where the garment last stuck without a bound, Pa; a corner of a triangle
  double stiffness = 0.0;    ///< k, Pa/m; 0: nothing touches yet
  bool fresh = true;         ///< no iterate has been looked at since the accepted state
  std::shared_ptr<const std::vector<Element>> frames;  ///< of the last update
};

/// Return mapping at the garment's vertices, triangle by triangle: with quadrature points q of the triangle,
///   U_q = P_q (dx_q - sum_b N_b dy_b) + g_q sum_b (y^a N_b,a) (n_q . dy_b)   (d: since the last accepted state),
///   slip  u_v = sum_q w_q L_v U_q / A_v,   A_v = sum_q w_q L_v,
///   trial traction  t* = t_v^old + k u_v,   t_v = t* min(1, mu p_v / |t*|),
/// and the garment feels -w_q sum_v L_v P_q t_v at point q, the skin its opposite. U_q vanishes when garment and skin turn
/// together, so that forces and moments balance to round-off whatever the gap. The elastic slip k = mu p_ref / (0.005 h)
/// regularises the stick (p_ref: mean pressure in contact, h: the garment's mean edge).
/// Where the state is not released (State::release = 0) every vertex that faces the skin sticks to it, touching or not,
/// with a stiffness k of its own and without a bound; in between the bound is mu p_v / release + (1 - release) |t_v|, t_v the traction of
/// the last state that stuck: cloth that touches nothing, whose mu p_v is 0, gives way by and by instead of all at once.
/// Wriggers, Computational Contact Mechanics (2nd ed. 2006), sec. 5.2 and 9.4 (return mapping); Laursen, Computational
/// Contact and Impact Mechanics (2002), ch. 5 (U_q).
/// The points' frames and the bound mu p_v are those of the last `update`. With them frozen the forces derive from the
/// convex potential A_v psi(u_v) (Huber's function: Tresca friction), so that the tangent is symmetric and positive
/// semidefinite. A corner that slips has no stiffness along its slip, so that a whole step may carry it past where it would stick, and
/// the next one back: where its slip has turned against the last iterate's it has the secant's stiffness, mu p_v / |u_v|, along it, too
/// (Kacanov's iteration, which goes downhill on Huber's function). As every iterate updates them, the converged state obeys Coulomb's law without any lag.
class Friction : public Term {
 public:
  static constexpr double usual_elastic_slip = 0.005;  ///< over the garment's mean edge

  /// `contact` has to outlive the term and to be updated before it; `elastic_slip` in m. `sticking`, Pa/m: stiffness of
  /// the slip while nothing is released.
  Friction(std::string name, const Contact& contact, double coefficient, double elastic_slip, double sticking = 0.0);

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State& state) const override { return contact_.entries(state); }
  /// Of the frozen problem.
  double energy(const State& state) const override;
  double stored_energy(const State&) const override { return 0.0; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void add_one_way(const State& state, std::vector<Eigen::Triplet<double>>& derivative) const override;
  void update(State& state) const override;
  void renew(State& state) const override;
  void commit(State& state) const override;
  void carry(const State& from, State& state) const override;
  void restore(State& state) const override;
  /// Traction on the slave per current area and whether it slips, at its nodes: mid-edge nodes have the mean of their edge, and slip
  /// where one of its ends does.
  void publish(const State& state, PublishedFields& fields) const override;

  double coefficient() const { return coefficient_; }
  /// Force on the garment (N) at the points of `Contact::meetings`, triangle by triangle.
  struct PointForce { int triangle, facet; Eigen::Vector3d L, x, force; };
  std::vector<PointForce> point_forces(const State& state) const;
  enum class Slip { none, stick, slip };
  /// Traction on the garment (Pa per rest area) and state of its vertices: the mean over the triangles of a vertex.
  struct VertexTraction {
    Eigen::Vector3d traction = Eigen::Vector3d::Zero();
    Slip slip = Slip::none;
  };
  std::vector<VertexTraction> vertex_tractions(const State& state) const;

 private:
  using Corner = FrictionHistory::Corner;
  struct Return {
    Eigen::Vector3d trial, traction;
    bool slips;
  };
  struct Slot;
  const FrictionHistory& history(const State& state) const { return state.history.get<FrictionHistory>(name_); }
  FrictionHistory& edit(State& state) const;
  double vertex_pressure(const State& state, int vertex) const;
  double slip_stiffness(const State& state) const;
  FrictionHistory::Element frame(const State& state, const Eigen::VectorXd& held, int triangle) const;
  std::shared_ptr<std::vector<FrictionHistory::Element>> frames(const State& state, const Eigen::VectorXd& held) const;
  /// Which corners slip, and which of them against the way of the iterate before (may be null).
  void follow_slip(const State& state, const FrictionHistory& history, const std::vector<FrictionHistory::Element>* before,
                   std::vector<FrictionHistory::Element>& now) const;
  /// What a triangle's entries have changed by (m) since the accepted state. While the body moves (State::posture) that is counted from where the accepted state would be if it had turned
  /// with the triangle, and its tractions turn along: a rigid motion, however far, neither slips nor turns a traction against the cloth.
  struct Change {
    Eigen::VectorXd by;
    std::optional<Eigen::Matrix3d> turn;
  };
  Change change(const State& state, const FrictionHistory& history, int triangle) const;
  static Return traction(const FrictionHistory& history, const Change& change, int triangle, int corner);

  std::string name_;
  const Contact& contact_;
  double coefficient_, elastic_slip_, sticking_;
};

}  // namespace snug::solver
