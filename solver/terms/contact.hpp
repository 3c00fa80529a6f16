// Frictionless contact of a slave, garment or surface of a body, on the skin (master).
#pragma once

#include <array>
#include <vector>

#include "postproc/result.hpp"
#include "solver/terms/active_set.hpp"
#include "solver/terms/contact_slave.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Test functions of the weighted gap on a triangle: hats L_i, or the dual functions 3 L_i - L_j - L_k.
enum class GapBasis { hat, dual };

/// Multipliers p_i (Pa per rest area of the slave) stand on the slave's vertices. With points q of rest weight w_q,
/// g_q = (x_q - y(xi_q)) . n_q and basis Phi_i,
///   weighted gap  g~_i = sum_q w_q Phi_i g_q,   A_i = sum_q w_q L_i,
///   trial  p_i - c_i g~_i / A_i > 0  <=>  vertex i is in contact (primal-dual active set, Hueeber & Wohlmuth 2005),
///   force on the slave  sum_q w_q (sum_i Phi_i p_i) n_q, its opposite on the skin at y(xi_q).
/// Rows of active vertices: -g~_i - eps_i (p_i - p_i^old) = 0 with eps_i = A_i / c_i, of the others: -eps_i p_i = 0.
/// As p^old follows the iterate, eps_i regularises the step only (augmented Lagrangian updated every iteration): the
/// matrix [K, -G^T; -G, -eps] is quasi-definite and the converged state has g~_i = 0 exactly.
/// The quadrature stands still in the pattern while Newton's method iterates, so a point's facet may be found anew at every
/// evaluation and is frozen in the tangent  -sum_q w_q p_q d2 g_q. `renew` cuts the triangles along the facets' edges as
/// they lie then (facet_cut.hpp).
class Contact : public Term {
 public:
  /// The master is the skin of `body`. `stiffness` c (Pa/m) is computed by the scene from the parts' own stiffnesses.
  Contact(const Layout& layout, ContactSlave slave, const mesh::BodyMesh& body, bool deformable, double stiffness,
          GapBasis basis);

  std::string name() const override { return "contact"; }
  const ElementEntries& entries() const override { return entries_; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;
  bool update(const State& state) override;
  void renew(const State& state) override;
  void measure(const State& state, Measure& measure) const override;

  int vertices() const { return slave_.vertices(); }
  /// Multiplier of a node of the slave's mesh, -1 where the node is no vertex.
  int multiplier_of(int node) const { return slave_.vertex_of_node[node]; }
  void set_stiffness(double stiffness) { stiffness_ = stiffness; }
  /// Active set as found by the last update, one flag a vertex.
  const std::vector<char>& active() const { return active_.flags(); }
  /// The facets that each triangle couples.
  std::vector<std::vector<int>> coupled() const;
  /// As a contact with these was left.
  void recall(const std::vector<char>& active, const std::vector<std::vector<int>>& coupled);
  /// Quadrature points with their forces, in the order of `places`; `area` is filled by the caller, who knows the
  /// garment's stretch.
  std::vector<postproc::ContactSample> samples(const State& state) const;
  /// Position, force on the slave (N) of every point, in the order of `samples`.
  struct PointForce { Eigen::Vector3d x, y, force; };
  std::vector<PointForce> point_forces(const State& state) const;
  /// Where the quadrature points stand on the slave; `weight` is the fraction of the triangle's rest area.
  struct Place { int triangle; Eigen::Vector3d L; double weight; };
  std::vector<Place> places() const;

  /// A quadrature point that faces the skin, with what meets there in `state` (for friction). Entries of a triangle:
  /// its six nodes, then `skin_nodes_of`, three components each, then its vertices' multipliers.
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
  int triangles() const { return static_cast<int>(elements_.size()); }
  const std::array<int, 3>& vertices_of(int triangle) const { return slave_.triangles[triangle].vertices; }
  const std::vector<int>& skin_nodes_of(int triangle) const { return elements_[triangle].skin_nodes; }
  const SkinSurface& skin() const { return skin_; }
  double rest_area(int vertex) const { return slave_.area[vertex]; }

 private:
  struct Element {
    std::vector<int> facets;         ///< whose nodes the element couples
    std::vector<int> skin_nodes;
    std::vector<ContactPoint> points;
  };
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
  double pressure(const State& state, int triangle, const ContactPoint& point) const;
  int points() const;
  bool locate(const State& state);
  void couple(Element& element);
  void couple(int facet, Element& element);
  void rebuild_entries();
  void weigh(const State& state);
  bool faces(int vertex) const;
  void decide(const State& state);
  struct Patch;
  void add_points(const State& state, int triangle, Tangent tangent, Slot& slot) const;
  void add_point(const State& state, int triangle, const TriangleNodes& x, const ContactPoint& point,
                 Tangent tangent, Patch& patch) const;
  void add_curvature(const ContactPoint& point, const Gap& gap, double force, bool skin_moves, Patch& patch) const;
  void scatter(const Patch& patch, const Element& element, int facet, bool tangent, Slot& slot) const;
  void add_rows(const State& state, int triangle, bool tangent, Slot& slot) const;

  Layout layout_;
  ContactSlave slave_;
  SkinSurface skin_;
  int fallback_parts_, skin_nodes_;
  GapBasis basis_;
  double stiffness_;
  double reach_;                         ///< m, points farther from the skin face none
  double step_limit_;                    ///< m, half an edge of the slave
  std::vector<Element> elements_;        ///< one a triangle of the slave
  std::vector<double> share_;            ///< 1 / number of triangles at a vertex (its row is spread over them)
  std::vector<double> weighted_gap_;     ///< g~_i at the last update, m3
  std::vector<double> facing_area_;      ///< the part of A_i that faces the skin
  ActiveSet active_;
  ElementEntries entries_;
};

}  // namespace snug::solver
