// Plain result data that recorders look at. Nothing here knows how a step was made.
#pragma once

#include <Eigen/Core>

#include <array>
#include <iosfwd>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "postproc/fields.hpp"
#include "postproc/location_row.hpp"

namespace snug::postproc {

/// One quadrature point of the garment that touches or faces the skin.
struct ContactSample {
  int facet = -1;                  ///< skin facet
  double xi = 0.0, eta = 0.0;      ///< on the facet: in [-1, 1]^2, or >= 0 with sum <= 1 on a triangle
  double force = 0.0;              ///< N, contact force along the skin normal (>= 0 with the hat basis)
  double area = 0.0;               ///< m2, current garment area of the point; 0 where it faces no skin
  bool touching = false;
  Eigen::Vector3d shear = Eigen::Vector3d::Zero();  ///< N, friction of the garment on the skin
  bool slips = false;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();     ///< m, on the skin as it is now; where it faces none, on the garment
  int hem = -1;                    ///< index into RunResult::hems: in the strip beside that edge; -1: in none
};

/// The deformed body with nodal fields.
struct BodyResult {
  std::vector<Eigen::Vector3d> nodes;                 ///< reference positions, m
  std::vector<int> node_numbers;                      ///< of an imported body; empty: node n has number n + 1
  int cell_nodes = 27, facet_nodes = 9;               ///< 27 and 9, 8 and 4 (hexahedra), 10 and 6 (tetrahedra)
  std::vector<std::array<int, 27>> cells;             ///< in the order of mesh::CellKind; empty for a rigid body
  std::vector<std::array<int, 9>> skin_facets;        ///< in the order of mesh::FacetKind
  std::vector<std::string> layers;                    ///< names
  std::vector<int> cell_layer;
  std::vector<std::string> locations;                 ///< names
  std::vector<int> node_location;                     ///< -1: none
  std::vector<std::vector<double>> location_shares;   ///< per location and node: how much of its area lies inside; empty: nodes belong wholly to `node_location`
  Fields fields;                                      ///< what is known at the nodes (fields.hpp): of every body `displacement`,
                                                      ///< `contact_pressure` and `coverage` (0 off the skin), then what its scene has

  /// How much of a node's area lies in a location, 0 to 1.
  double share_in(std::size_t location, std::size_t node) const {
    if (!location_shares.empty()) return location_shares[location][node];
    return node < node_location.size() && node_location[node] == static_cast<int>(location) ? 1.0 : 0.0;
  }
  int node_number(std::size_t node) const {
    return node_numbers.empty() ? static_cast<int>(node) + 1 : node_numbers[node];
  }
};

/// A named edge of the garment as it lies: its sides are vertex, mid-edge node, vertex of the pattern.
struct GarmentEdge {
  std::string name;
  std::vector<std::array<int, 3>> sides;
  int garment = 0;                                    ///< index into GarmentResult::parts
};

/// One of several garments in the lists of a GarmentResult: nodes [first_node, end_node), triangles likewise.
struct GarmentPart {
  std::string name;
  int first_node = 0, end_node = 0, first_triangle = 0, end_triangle = 0;
  std::vector<std::string> pieces = {};  ///< names
};

/// All garments, one behind the other.
struct GarmentResult {
  std::vector<GarmentPart> parts;
  std::vector<Eigen::Vector3d> placed, current;       ///< m, one entry a pattern node
  std::vector<Eigen::Vector2d> pattern;               ///< m
  std::vector<std::array<int, 6>> triangles;
  std::vector<int> piece;                             ///< per triangle: index into its part's pieces
  std::vector<GarmentEdge> edges;
  Fields fields;                                      ///< a value a pattern node or a triangle (fields.hpp)
};

struct Iteration {  ///< one row of history.csv
  int increment = 0;
  double load = 0.0;              ///< s, the load parameter
  int iteration = 0;
  double residual = 0.0;          ///< |R| over the sum of contact forces
  double complementarity = 0.0;   ///< over the reference pressure
  double step = 0.0;              ///< accepted fraction of the Newton step
  int contact_nodes = 0, changed = 0;
  double energy = std::numeric_limits<double>::quiet_NaN();  ///< J, of converged states that have one
  double seconds = 0.0;           ///< since the start of the solve
  std::string event;              ///< "", "refactored", "proximal", ...
  int attempt = 1;                ///< at this increment: 2 after one that failed and was cut
};

struct Balance {
  Eigen::Vector3d garment_force = Eigen::Vector3d::Zero();   ///< N, skin on garment
  Eigen::Vector3d skin_force = Eigen::Vector3d::Zero();      ///< N, garment on skin
  Eigen::Vector3d garment_weight = Eigen::Vector3d::Zero();  ///< N, of the fabric, where the scene has it
  Eigen::Vector3d force_error = Eigen::Vector3d::Zero();     ///< N, sum of all forces on body and garment
  Eigen::Vector3d moment_error = Eigen::Vector3d::Zero();    ///< N m, about the origin
  double contact_force = 0.0;                                ///< N, sum of |normal point forces|
  double friction_force = 0.0;                               ///< N, sum of |tangential point forces|
  std::optional<double> free_motions_share;                  ///< of the loads, borne by what holds free parts of the body; empty: none is
  std::map<std::string, Eigen::Vector3d> reactions;          ///< "upper edge", "bone", "lower cut", ... N
};

/// What a named edge of the garment puts on the skin: a force per length (hem.hpp).
struct Hem {
  std::string edge;
  double length = 0.0;            ///< m, of the edge as worn
  double strip = 0.0;             ///< m, width of the strip beside it that the statistics of the pressure leave out
  double reach = 0.0;             ///< m, width within which its force is summed: one skin cell
  double force = 0.0;             ///< N, normal contact force within reach
  double line_load = 0.0;         ///< N/m, of that force what the pressure beyond reach does not explain, per length
};

/// How wide a garment is against the body at one height, as it was placed.
struct FitRow {
  std::string garment;
  double height = 0.0, body_girth = 0.0, garment_girth = 0.0;  ///< m; of the garment as cut
  double cover = 1.0;             ///< share of the way round that it goes
  std::string limb = {};          ///< of a body that branches: "trunk", "right leg", "left leg"

  double ease() const { return body_girth > 0.0 ? garment_girth / body_girth - 1.0 : 0.0; }
};

/// A piece of a garment, or a zone of a tube, as worn: what it is of, how large, how tight. Means are over its cloth.
struct PieceRow {
  std::string garment, piece, fabric;
  double area = 0.0, worn_area = 0.0;                ///< m2, as cut and as worn
  double weight = 0.0;                               ///< kg, by the fabric's areal density (or the usual one: loads.hpp)
  double thickness = 0.0;                            ///< m; 0: not known
  double tension_warp = 0.0, tension_weft = 0.0;     ///< N/m, Cauchy, mean
  double largest_tension = 0.0;                      ///< N/m, of a triangle, along warp or weft
  double stretch_warp = 1.0, stretch_weft = 1.0;     ///< mean
};

/// A seam as worn: the force per length that it transmits.
struct SeamRow {
  std::string garment, seam;
  double length = 0.0;            ///< m
  double line_load = 0.0;         ///< N/m, across, mean of both sides over its length
  double largest = 0.0;           ///< N/m, across, at a point
  double along = 0.0;             ///< N/m, shear along it, amount, mean
};

/// What a graduated tube presses with at a height that its pressures name: the mean over a ring of the skin.
struct ProfileRow {
  std::string garment;
  double height = 0.0;            ///< m, over its lower edge
  double from = 0.0, to = 0.0;    ///< m, of the ring, likewise
  double wanted = 0.0, found = 0.0;  ///< Pa
};

/// An elastic band along an edge of a garment, as worn.
struct Band {
  std::string garment, edge;
  double rest_length = 0.0, length = 0.0;        ///< m
  double tension = 0.0;                          ///< N, mean over its length
  double least_tension = 0.0, largest_tension = 0.0;  ///< N
  double line_load = 0.0;                        ///< N/m, tension times curvature in the mean: what it presses with by itself
};

/// Two surfaces of the body that touch, or a garment and what it lies on where garments lie over one another.
struct SurfaceContact {
  std::string name, slave, master;
  double force = 0.0;             ///< N, sum of the normal point forces
  double area = 0.0;              ///< m2, of the slave as it is now, where it touches
  double largest_pressure = 0.0;  ///< Pa, nodal
  double friction_force = 0.0;    ///< N, sum of the tangential point forces

  double mean_pressure() const { return area > 0.0 ? force / area : 0.0; }  ///< Pa, over the touching part
};

/// A rigid tool somewhere on its way.
struct ToolRow {
  double travel = 0.0;            ///< m, since its start
  double depth = 0.0;             ///< m, since it first touched (the surface at rest); 0 before
  double force = 0.0;             ///< N, what moves it on along its direction
  double across = 0.0;            ///< N, what else keeps it on its line, amount
  double area = 0.0;              ///< m2, of the surface as it is now, where it touches
  double largest_pressure = 0.0;  ///< Pa, at a vertex of the surface, per its area now
  double friction_force = 0.0;    ///< N, sum of the tangential point forces
};

/// A rigid tool that was moved into a surface of the body.
struct ToolResult {
  std::string name, surface, shape;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();        ///< m, at its start
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();   ///< N, of the body on the tool, at the end
  std::vector<ToolRow> history;   ///< converged states of the way, the last one is what the result shows

  const ToolRow& end() const { return history.back(); }
  double mean_pressure() const { return !history.empty() && end().area > 0.0 ? end().force / end().area : 0.0; }  ///< Pa
  /// N/m: force over depth at the end, and the slope of the force between the last two states of the way. NaN where there is none.
  double stiffness() const;
  double slope() const;
};

/// How a bone stands in a state of a movement, against the one that it hangs on.
struct BoneRow {
  std::string bone;
  double turn = 0.0;                                ///< rad
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m
};

/// A converged state of the movement through the postures of a case; the first one is the position in which the garment was put on.
struct MovementState {
  std::string posture;            ///< that it is on the way to; "dressed"
  double progress = 0.0;          ///< postures gone through: 0 dressed, 1 the first posture, 1.5 half of the way to the second
  double share = 1.0;             ///< of the way to the posture
  std::vector<BoneRow> bones;     ///< those with a joint
  double contact_area = 0.0;      ///< m2
  double mean_pressure = 0.0, max_pressure = 0.0;  ///< Pa, over the touched skin; largest beside the hems
  double contact_force = 0.0, friction_force = 0.0, force_error = 0.0, moment_error = 0.0;  ///< N, N m, as in Balance
  std::vector<LocationRow> locations = {};
  int overlapping_facets = 0;     ///< of the skin, that have gone through others

  bool reached() const { return share == 1.0; }
};

struct Phase {
  std::string name;
  double seconds = 0.0;
  std::vector<Phase> parts = {};  ///< what of it went where; need not add up
};

/// Pressure on the rigid skin for one assumption on where on its way friction acts. The way on which a garment was really
/// put on is unknown, so that the spread over these rows belongs to the answer.
struct DonningRow {
  std::string name;               ///< "without friction", "friction over the last 10 % of the tightening", ...
  double from = 1.0;              ///< fraction of the tightening from which friction acts
  bool converged = false;
  double mean_pressure = 0.0, max_pressure = 0.0;  ///< Pa, over the touched skin; largest nodal value
};

/// Something about a result that its reader should know before using it; found by measuring the result, with what was measured.
struct Warning {
  std::string name;               ///< "fabric beyond its data"
  std::string text;               ///< what was found, with its figures
  std::string place;              ///< where: "heights 150 to 220 mm, most at 212 mm"; empty: everywhere
  std::string remedy;             ///< what to do about it
  std::string quantity;           ///< the key of RunResult::numbers that was looked at
  double value = 0.0, limit = 0.0;  ///< of that quantity
};

/// What a reported state is: where on the load path it stands, and what is not its own there.
struct StateTruth {
  std::string stage;              ///< name of the stage; empty where there is no path
  bool deformable = false;        ///< the body gives way there
  double fraction = 1.0;          ///< of that stage
  double stiffening = 1.0;        ///< factor on the body's stiffness, 1: its own
  double friction_bound = 1.0;    ///< factor on the bound of friction, 1: its own, infinite: the garment sticks
};

/// How a run ended: at its answer, on the way to it with what is there kept, or with nothing that is an answer.
enum class Status { failed, partial, converged };

/// The word of files and tables: "failed", "partial" or "converged".
const char* name_of(Status status);
std::ostream& operator<<(std::ostream& out, Status status);

struct RunResult {
  std::string title, tier;
  Status status = Status::failed;
  std::string message;            ///< why it is not converged, and the remedy
  StateTruth truth;               ///< of the state that everything here belongs to
  std::vector<std::string> remedies;     ///< what to try when it is not converged, one sentence each
  std::vector<std::string> assumptions;  ///< what the case does not say and the run took, with its source
  std::vector<Warning> warnings;
  BodyResult body;
  GarmentResult garment;          ///< no triangles: the scene has no garment
  std::vector<ContactSample> samples;
  std::vector<Iteration> history;
  Balance balance;
  std::vector<Hem> hems;          ///< named edges of a garment in contact
  std::vector<FitRow> fit;        ///< of the garments by limb, from below
  std::vector<SurfaceContact> surface_contacts;
  std::vector<Band> bands;
  std::vector<PieceRow> pieces;   ///< of the garments, in the order of their patterns
  std::vector<SeamRow> seams;
  std::vector<ProfileRow> profile;  ///< of graduated tubes that are made for pressures
  std::map<std::string, long> unknowns;   ///< a part: "body", "garment", "contact"
  std::vector<std::string> parts_in, parts_out;
  std::vector<DonningRow> donning;  ///< empty without friction
  std::vector<Phase> phases;
  std::map<std::string, long> linear_solver;  ///< "factorisations", "solutions", "krylov_iterations", "ranks"
  std::string factor;                         ///< how the last factor was made: order of elimination, precision
  double max_penetration = 0.0;   ///< m
  double peak_memory = 0.0;       ///< bytes, of all ranks together
  double peak_memory_of_a_rank = 0.0;  ///< bytes, the largest
  int increments = 0, iterations = 0;
  double mean_laplace_pressure = 0.0;     ///< Pa, L0 sanity value over the covered skin
  std::map<std::string, double> numbers;  ///< further named values for expected.toml ("mean_contact_pressure_Pa", ...)
  std::vector<ToolResult> tools;
  std::vector<MovementState> movement;    ///< empty: the case has no postures
};

}  // namespace snug::postproc
