// Contact of a surface of the body with a rigid tool that is moved.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "solver/terms/active_set.hpp"
#include "solver/terms/rigid_tool.hpp"
#include "solver/terms/term.hpp"
#include "solver/terms/tool_surface.hpp"

namespace snug::solver {

struct ToolHistory : public History {
  explicit ToolHistory(int vertices = 0) : active(vertices) {}
  void write(ByteWriter& writer) const override;

  ActiveSet active;
  std::vector<double> weighted_gap;  ///< m3, of the vertices, at the state that was updated last
};

/// The surface is the slave: pressures p_i (Pa per rest area) stand on its facets' corners with hats L_i. With points q of rest weight w_q, the
/// place d of the tool's tip and its distance function g (rigid_tool.hpp), the scene's Lagrangian gets
///   - sum_i p_i g~_i,   g~_i = sum_q w_q L_i g(x_q - d),
/// so that forces are exact slopes and their derivative is symmetric. Which vertices touch is found as in Contact (contact.hpp): trial
/// p_i - c g~_i / A_i; rows of active vertices -g~_i - eps_i (p_i - p_i^old), of the others -eps_i p_i.
/// The tip is a field of the state, three entries: who moves the tool prescribes them, and the residual there is what moves it.
class ToolContact : public Term {
 public:
  struct Fields {
    Field body, tip, pressures;
  };
  /// `stiffness` c (Pa/m): the body's own over a cell.
  ToolContact(std::string name, Fields fields, const mesh::BodyMesh& mesh, ToolSurface surface, RigidTool tool, double stiffness);

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  /// -sum_i p_i g~_i, which is 0 where gap and pressure exclude each other.
  double energy(const State& state) const override;
  double stored_energy(const State&) const override { return 0.0; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  /// Tool and surface go at most half a facet towards each other in a step, so that distances stay those of near points.
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;
  void measure(const State& state, Measure& measure) const override;
  /// Pressure per current area at the surface's nodes.
  void publish(const State& state, PublishedFields& fields) const override;
  void renew(State& state) const override;
  void update(State& state) const override;
  void restore(State& state) const override;

  const Field& tip() const { return fields_.tip; }
  const RigidTool& tool() const { return tool_; }
  int vertices() const { return static_cast<int>(area_.size()); }
  int facets() const { return static_cast<int>(surface_.facets.size()); }
  int corners() const { return surface_.kind == mesh::FacetKind::tri6 ? 3 : 4; }
  const std::array<int, 4>& vertices_of(int facet) const { return surface_.vertices[facet]; }
  double rest_area(int vertex) const { return area_[vertex]; }  ///< m2
  const std::vector<char>& active(const State& state) const { return history(state).active.flags(); }
  /// Pa per rest area; 0 where it does not touch.
  double pressure(const State& state, int vertex) const { return active(state)[vertex] ? state.values[fields_.pressures(vertex)] : 0.0; }

  /// What the surface puts on the tool.
  struct Sums {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< N m, about the tip
    double pressing = 0.0;                             ///< N, sum of |point forces|
    double area = 0.0;                                 ///< m2, of the surface now, of the vertices that touch
    double largest_pressure = 0.0;                     ///< Pa, per area now
    double inside = 0.0;                               ///< m, how deep a point lies in the tool: gaps are zero as weighted over a cell, not at points
  };
  Sums sums(const State& state) const;

  /// A point of a facet before the tool. Entries of a facet: its nodes' in nine slots and the tip's, three each, then its corners' multipliers.
  struct Meeting {
    double weight;                           ///< rest area, m2
    const Eigen::Vector4d& hat;
    const Eigen::Matrix<double, 10, 1> part; ///< of the slots and the tip in x - tip
    Eigen::Vector3d from_tip, normal;        ///< m; unit vector away from the tool
    double gap;                              ///< m
  };
  template <class Visit>
  void for_points(const State& state, int facet, const Visit& visit) const {
    const std::vector<ToolPoint>& points = tool_points(surface_.kind);
    const FacetNodes x = facet_positions(state, fields_.body, surface_.facets[facet]);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Eigen::Vector3d from_tip = x * points[q].shape.N - tip(state);
      Eigen::Matrix<double, 10, 1> part;
      part << points[q].shape.N, -1.0;
      const ToolGap gap = tool_.gap(from_tip);
      visit(Meeting{weights_[facet * points.size() + q], points[q].hat, part, from_tip, gap.normal, gap.value});
    }
  }
  static constexpr int size = 34;  ///< entries of a facet

 private:
  static constexpr int pressure_row = 30;
  struct Slot {
    Eigen::Matrix<double, size, 1> residual;
    Eigen::Matrix<double, size, size, Eigen::RowMajor> matrix;
  };
  const ToolHistory& history(const State& state) const { return state.history.get<ToolHistory>(name_); }
  ToolHistory& edit(State& state) const;
  Eigen::Vector4d pressures(const State& state, int facet) const;
  Eigen::Vector3d tip(const State& state) const { return state.values.segment<3>(fields_.tip(0)); }
  std::vector<double> weighted_gaps(const State& state) const;
  std::vector<double> current_areas(const State& state) const;
  void add_points(const State& state, int facet, Tangent tangent, Slot& slot) const;
  void add_rows(const State& state, int facet, Slot& slot) const;

  std::string name_;
  Fields fields_;
  ToolSurface surface_;
  RigidTool tool_;
  double stiffness_;
  std::vector<double> weights_;            ///< rest area of the points, facet by facet, m2
  std::vector<double> area_, share_;       ///< of the vertices: m2, 1 / number of facets
  int mesh_nodes_ = 0;
  ElementEntries entries_;
};

}  // namespace snug::solver
