// Frictionless contact of a slave, garment or surface of a body, on what lies under it: an interface.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "postproc/result.hpp"
#include "solver/terms/active_set.hpp"
#include "solver/terms/contact_slave.hpp"
#include "solver/terms/master_stack.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Test functions of the weighted gap on a triangle: hats L_i, or the dual functions 3 L_i - L_j - L_k.
enum class GapBasis { hat, dual };

/// A surface, what it may meet, and the field of the pressures between them, one a vertex of the slave.
struct Interface {
  Field pressures;
  ContactSlave slave;
  MasterStack master;
};

/// What contact remembers: the active set, the points of its quadrature with the places where they meet the master, and the
/// facets that each triangle couples (they make the pattern of the matrix).
struct ContactHistory : public History {
  explicit ContactHistory(int vertices = 0) : active(vertices) {}
  void write(ByteWriter& writer) const override;

  struct Element {
    std::vector<int> facets = {};        ///< whose nodes the element couples
    std::vector<int> master_nodes = {};  ///< those nodes
    std::vector<ContactPoint> points = {};
  };
  std::vector<Element> elements;         ///< one a triangle of the slave
  ActiveSet active;
  std::vector<double> weighted_gap;      ///< g~_i, m3, at the state that was updated last
  std::vector<double> reference;         ///< Pa, p^0 of contact that yields, since the last `renew`
  std::vector<double> facing_area;       ///< the part of A_i that faces the master, m2
  std::shared_ptr<const ElementEntries> entries;
  MasterStack::Trees trees;              ///< of the master, as it was at the last `renew`; not stored: a stored state begins a path, which renews it
};

/// Multipliers p_i (Pa per rest area of the slave) stand on the slave's vertices. With points q of rest weight w_q,
/// g_q = (x_q - y(xi_q)) . n_q and basis Phi_i,
///   weighted gap  g~_i = sum_q w_q Phi_i g_q,   A_i = sum_q w_q L_i,
///   trial  p_i - c_i g~_i / A_i > 0  <=>  vertex i is in contact (primal-dual active set, Hueeber & Wohlmuth 2005),
///   force on the slave  sum_q w_q (sum_i Phi_i p_i) n_q, its opposite on the master at y(xi_q).
/// Rows of active vertices: -g~_i - eps_i (p_i - p_i^old) = 0 with eps_i = A_i / (1e4 c_i), of the others: -eps_i p_i = 0.
/// As p^old follows the iterate, eps_i regularises the step only (augmented Lagrangian updated every iteration): the
/// matrix [K, -G^T; -G, -eps] is quasi-definite and the converged state has g~_i = 0 exactly.
/// Where contact yields (State::yielding y > 0) there is no set to be found: p_i = max(0, p_i^0 - c_i / y g~_i / A_i) follows from the
/// positions, with p^0 the pressures that the increment starts from (method of multipliers: Hestenes, J. Optim. Theory Appl. 4 (1969)), and
/// the forces are the slope of an energy, sum_i A_i y / (2 c_i) p_i^2.
/// The quadrature stands still in the pattern while Newton's method iterates, so a point's facet may be found anew at every
/// evaluation and is frozen in the tangent  -sum_q w_q p_q d2 g_q. `renew` cuts the triangles along the facets' edges as
/// they lie then (facet_cut.hpp).
class Contact : public Term {
 public:
  /// `stiffness` c (Pa/m) is computed by the scene from the parts' own stiffnesses.
  Contact(std::string name, Interface interface, double stiffness, GapBasis basis);

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;
  void measure(const State& state, Measure& measure) const override;
  /// Pressure per current area at the slave's nodes; mid-edge nodes have the mean of their edge.
  void publish(const State& state, PublishedFields& fields) const override;
  void update(State& state) const override;
  void renew(State& state) const override;
  void restore(State& state) const override;
  bool renews_near_answer() const override { return true; }
  double stored_energy(const State&) const override { return 0.0; }

  int vertices() const { return interface_.slave.vertices(); }
  /// Multiplier of a node of the slave's mesh, -1 where the node is no vertex.
  int multiplier_of(int node) const { return interface_.slave.vertex_of_node[node]; }
  /// Pa, per rest area of the slave: the multiplier as the iterate has it.
  double multiplier(const State& state, int vertex) const { return state.values[interface_.pressures(vertex)]; }
  /// The same where the vertex is in contact, 0 elsewhere: the solver leaves round-off there, which would count as touching.
  double pressure(const State& state, int vertex) const { return active(state)[vertex] ? multiplier(state, vertex) : 0.0; }
  void set_stiffness(double stiffness) { stiffness_ = stiffness; }
  const ContactHistory& history(const State& state) const { return state.history.get<ContactHistory>(name_); }
  /// Active set as found by the last update, one flag a vertex.
  const std::vector<char>& active(const State& state) const { return history(state).active.flags(); }
  /// A quadrature point of the slave and what acts on the slave there.
  struct PointForce {
    Eigen::Vector3d x, y;                               ///< m, on the slave and on the master; y = x where it faces none
    Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< N, `pressing` along the master's normal
    double pressing = 0.0;                              ///< N
    int facet = -1;                                     ///< of the master, -1: it faces none
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();       ///< on the facet
    int triangle = 0;                                   ///< of the slave
    Eigen::Vector3d L = Eigen::Vector3d::Zero();        ///< its area coordinates there
    double weight = 0.0;                                ///< fraction of the triangle's rest area; of a line's point 0
  };
  std::vector<PointForce> point_forces(const State& state) const;

  /// A quadrature point that faces the master, with what meets there in `state` (for friction). Entries of a triangle:
  /// its six nodes, then those of its element's `master_nodes`, three components each, then its vertices' multipliers.
  struct Meeting {
    double weight = 0.0;             ///< rest area, m2
    Eigen::Vector3d L;
    Eigen::Matrix<double, 6, 1> N;
    int facet = -1;
    Eigen::Vector3d x;               ///< on the slave
    double gap = 0.0;                ///< m
    FacetShape shape;
    FacetPoint at;
  };
  void meetings(const State& state, int triangle, std::vector<Meeting>& list) const;
  int triangles() const { return static_cast<int>(interface_.slave.triangles.size()); }
  const std::array<int, 3>& vertices_of(int triangle) const { return interface_.slave.triangles[triangle].vertices; }
  const MasterStack& master() const { return interface_.master; }
  double rest_area(int vertex) const { return interface_.slave.area[vertex]; }
  const ContactSlave& slave() const { return interface_.slave; }
  /// int L_i da of the vertices as they are now, m2: with it the pressures carry the forces of the multipliers.
  std::vector<double> current_areas(const State& state) const;

 private:
  using Element = ContactHistory::Element;
  struct Slot;
  struct Gap {
    bool facing = false;
    double value = 0.0;
    Eigen::Vector3d x;
    FacetShape shape;
    FacetPoint at;
  };
  Eigen::Vector3d basis(const Eigen::Vector3d& L) const;
  TriangleNodes positions(const State& state, int triangle) const;
  Gap gap(const State& state, const TriangleNodes& x, const ContactPoint& point) const;
  double multiplier(const State& state, int triangle, const Eigen::Vector3d& L) const;
  double pressure(const State& state, int triangle, const Eigen::Vector3d& L) const;
  ContactHistory& edit(State& state) const;
  void locate(const State& state, ContactHistory& history) const;
  void couple(Element& element) const;
  void couple(int facet, Element& element) const;
  void rebuild_entries(ContactHistory& history) const;
  void weigh(const State& state, ContactHistory& history) const;
  bool faces(const ContactHistory& history, int vertex) const;
  void decide(const State& state, ContactHistory& history) const;
  void yield(State& state, ContactHistory& history) const;
  struct Patch;
  void add_points(const State& state, const ContactHistory& history, int triangle, Tangent tangent, Slot& slot) const;
  void add_point(const State& state, const ContactHistory& history, int triangle, const TriangleNodes& x, const ContactPoint& point,
                 Tangent tangent, Patch& patch) const;
  void add_curvature(const ContactPoint& point, const Gap& gap, double force, bool master_moves, bool definite,
                     Patch& patch) const;
  void scatter(const Patch& patch, const Element& element, int facet, bool tangent, Slot& slot) const;
  void add_rows(const State& state, const ContactHistory& history, int triangle, bool tangent, Slot& slot) const;

  std::string name_;
  Interface interface_;
  GapBasis basis_;
  double stiffness_;
  int fallback_parts_;
  double reach_;                         ///< m, points farther from the master face none
  double step_limit_;                    ///< m, half an edge of the slave
  std::vector<double> share_;            ///< 1 / number of triangles at a vertex (its row is spread over them)
};

}  // namespace snug::solver
