// Rigid tools of a case: where they stand on the body's mesh, who moves them, and what a state says of them.
#pragma once

#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "postproc/result.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/state.hpp"
#include "solver/scene/model.hpp"
#include "solver/terms/rigid_tool.hpp"
#include "solver/terms/tool_surface.hpp"

namespace snug::solver {

class Scene;

/// Names of the fields of a tool: of its tip's place, and of the pressures under it.
std::string tip_field(const input::ToolSpec& tool);
std::string tool_pressures(const input::ToolSpec& tool);

/// A tool before the body at rest.
struct PlacedTool {
  RigidTool shape;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< m, of its tip
  double first_touch = 0.0;                         ///< m, of its travel, where it meets the surface at rest
  ToolSurface surface;                              ///< what of the named surface it may meet: what faces it, within its radius and its travel beside its line
};
/// Throws input::InputError: no such surface, a tool that starts inside the body, a travel that does not meet the surface.
PlacedTool place_tool(const mesh::BodyMesh& body, const input::ToolSpec& tool);
/// How far a placed tool goes (m, from its start) until it meets what cannot give way: the rigid bone, or a surface that supports hold in all directions.
/// Of the body at rest; infinite where nothing such lies before it.
double way_to_what_is_held(const mesh::BodyMesh& body, const std::vector<input::SupportSpec>& supports, const PlacedTool& placed);

/// What moves the tools and what they meet, as a line of the plan each.
std::vector<std::string> tool_parts(const Model& model, const mesh::BodyMesh& body);

/// Adds the contact of each tool to a scene that has the body.
void add_tools(const Model& model, const mesh::BodyMesh& body, double (*stiffness)(const Model&, double edge), Scene& scene);

/// The tools with the state as the last row of their way, behind the rows of `way`, one list a tool (or empty); the balance gets the moments that guides bear.
void fill_tools(const Scene& scene, const State& state, const Model& model, const mesh::BodyMesh& body,
                const std::vector<std::vector<postproc::ToolRow>>& way, postproc::RunResult& result);
/// The state's row of every tool.
std::vector<postproc::ToolRow> tool_rows(const Scene& scene, const State& state, const Model& model, const mesh::BodyMesh& body);

/// Finest facets that meet a tool, m; infinite where there is none.
double tool_edge(const Model& model, const mesh::BodyMesh& body);
/// Rows of the force over the travel that the case asks for; 1 without tools.
int tool_steps(const Model& model);

}  // namespace snug::solver
