// Friction on bodies that give way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <ctime>
#include <map>

#include "solver/scene/scene.hpp"
#include "solver/stepping/load_path.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/strip.hpp"
#include "tests/verification/tube.hpp"

namespace {

using namespace snug;
using tests::Strip;

using std::numbers::pi;

/// A band round a soft tube on a rigid bone, as wide as the tube is long: plane strain. Its ends are led round the tube.
struct SoftDrum {
  Strip strip;
  mesh::GarmentMesh band;
  mesh::BodyMesh body;

  explicit SoftDrum(const Strip& s) : strip(s), band(tests::strip_mesh(s)) {
    tests::TubeCase tube;
    tube.radius = s.radius, tube.length = tests::strip_width(s);
    tube.around = static_cast<int>(std::lround(2.0 * pi * s.radius / (s.skin_cell * band.mean_edge))), tube.along = 1;
    const input::Case c = tests::describe_tube(tube);
    body = mesh::make_body_mesh(*c.body, mesh::make_limb(*c.body));
    for (Eigen::Vector3d& x : band.placed) x.z() += 0.5 * tube.length;
  }

  solver::Numbering numbering(const solver::Layout& layout) const {
    std::vector<int> master(layout.size());
    for (int i = 0; i < layout.size(); ++i) master[i] = i;
    for (int i = 0; i < layout["body cells"].count; ++i) master[layout["body cells"](i)] = -1;
    for (int node = 0; node < layout["body"].count; ++node) master[layout["body"](node, 2)] = -1;
    for (const int node : body.bone_nodes)
      for (int c = 0; c < 2; ++c) master[layout["body"](node, c)] = -1;
    for (int node = 0; node < layout["garment"].count; ++node) master[layout["garment"](node, 2)] = -1;
    for (const auto& [name, nodes] : band.edges)
      for (const int node : nodes)
        for (int c = 0; c < 2; ++c) master[layout["garment"](node, c)] = -1;
    return solver::Numbering(std::move(master));
  }

  solver::Scene scene(double friction) const {
    const solver::Layout layout = tests::make_layout(body, band, true, true);
    solver::Scene scene(layout, numbering(layout));
    materials::SolidLaw tissue = materials::find_tissue(body.layers.front().material).law;
    scene.add(std::make_unique<solver::Tissue>("tissue", solver::body_fields(layout, "body"), body, std::vector<materials::SolidLaw>(body.layers.size(), tissue)));
    scene.add(std::make_unique<solver::FabricMembrane>("garment", layout["garment"], band, std::vector{tests::straight_fabric(strip.k, 0.3 * strip.k)}));
    scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{layout["contact"], solver::garment_slave(layout["garment"], band), solver::MasterSurface(layout["body"], body, body.skin_facets)},
                                                strip.k / (band.mean_edge * band.mean_edge), solver::GapBasis::hat));
    if (friction > 0.0)
      scene.add(std::make_unique<solver::Friction>("friction", *scene.find<solver::Contact>(), friction,
                                                   strip.elastic_slip * band.mean_edge));
    return scene;
  }

  /// Force of the support on an edge, N.
  Eigen::Vector3d pull(const solver::Scene& scene, const solver::State& state, const std::string& edge) const {
    const Eigen::VectorXd residual = scene.full_residual(state);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int node : band.edges.at(edge)) sum += residual.segment<3>(scene.layout()["garment"](node));
    return sum;
  }
};

/// The capstan's law T2/T1 = exp(mu theta) needs no circle: theta is the angle through which the band turns, here between
/// the pulls at its ends, whatever shape the soft tube has taken under it.
TEST(SoftFriction, CapstanHoldsOnATubeThatGivesWay) {
  for (const double mu : {0.1, 0.3}) {
    Strip s;
    s.cells = 45, s.span = 0.75 * pi;
    s.rest_length = s.radius * s.span / 1.1;
    const SoftDrum drum(s);
    solver::Scene smooth = drum.scene(0.0), rough = drum.scene(mu);
    solver::State start = tests::placed_state(smooth.layout(), drum.body, drum.band);
    start.load = 1.0;
    start.values.tail(smooth.layout()["contact"].count).setConstant(s.k * 0.1 * 1.1 / s.radius);
    solver::PathSettings settings;
    settings.newton.penetration = 1e-6 * drum.band.mean_edge;
    int iterations = 0;
    const auto count = [&](const postproc::Iteration&) { ++iterations; };
    const auto tight = solver::follow_path(smooth, start, solver::releasing(10.0), settings, count);
    ASSERT_TRUE(tight.complete) << tight.message;
    const auto lead = [&](solver::State& state, double t) {  // and off the skin, so that only the band touches it
      const double lift = 1.0 + 0.1 * t;
      for (const char* edge : {"start", "end"})
        for (const int node : drum.band.edges.at(edge))
          state.values.segment<3>(rough.layout()["garment"](node)) =
              Eigen::AngleAxisd(0.25 * t, Eigen::Vector3d::UnitZ()) *
              drum.band.placed[node].cwiseProduct(Eigen::Vector3d(lift, lift, 1.0));
    };
    settings.first_step = 0.1;
    iterations = 0;
    const auto path = solver::follow_path(rough, tight.state, lead, settings, count);
    ASSERT_TRUE(path.complete) << path.message << " at " << path.reached;
    const Eigen::Vector3d first = drum.pull(rough, path.state, "start"), last = drum.pull(rough, path.state, "end");
    const double turned = std::acos(-first.normalized().dot(last.normalized()));
    int sticks = 0;
    for (const auto& vertex : rough.find<solver::Friction>()->vertex_tractions(path.state))
      sticks += vertex.slip == solver::Friction::Slip::stick;
    double sunk = 0.0;
    for (int node = 0; node < rough.layout()["body"].count; ++node)
      sunk = std::max(sunk, (path.state.values.segment<3>(rough.layout()["body"](node)) - drum.body.nodes[node]).norm());
    fmt::print("soft capstan, mu {}: turns {:.2f} deg, pulls {:.5f} and {:.5f} N, skin moves {:.2f} mm, {} vertices stick, {} increments, {} iterations\n",
               mu, turned * 180 / pi, first.norm(), last.norm(), sunk * 1e3, sticks, path.increments, iterations);
    EXPECT_EQ(sticks, 0);
    EXPECT_GT(sunk, 1e-3);
    tests::book("capstan on a soft tube", fmt::format("T2/T1, mu = {}", mu), last.norm() / first.norm(),
                std::exp(mu * turned), 5e-3, "exp(mu theta), theta between the pulls");
  }
}

/// A tapering soft limb and a sleeve whose upper edge is held.
input::Case tapered(double friction) {
  tests::TubeCase tube;
  tube.length = 0.12, tube.along = 6, tube.sleeve = 0.049;
  input::Case c = tests::describe_tube(tube);
  c.body->stations = std::filesystem::temp_directory_path() / fmt::format("snug-taper-{}.csv", ::getpid());
  std::ofstream out(c.body->stations);
  out << "height [m], girth [m], bone_girth [m]\n";
  for (const double s : {0.0, 0.5, 1.0}) out << s * tube.length << ", " << 0.32 + 0.04 * s << ", 0.12\n";
  out.close();
  c.garments.front().pattern.length = 0.08;
  c.garments.front().position = 0.02;
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}};
  c.contacts.front().friction = friction;
  c.contacts.front().spread = true;
  return c;
}

struct Timed {
  postproc::RunResult result;
  double seconds;  ///< of the processor
};

Timed solved(const input::Case& c) {
  const std::clock_t start = std::clock();
  Timed timed{tests::solve(c, tests::make_meshes(c)), 0.0};
  timed.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return timed;
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]), size += b[i] * b[i];
  return std::sqrt(sum / size);
}

/// Means round the limb, one a height of the skin's nodes: what holds the frictionless sleeve against a turn about the axis is
/// only the mesh, so that nodes of two runs see the garment's cells at different places.
std::vector<double> ring_means(const postproc::BodyResult& body) {
  std::map<long, std::pair<double, int>> rings;  // by height in micrometres
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    auto& [sum, count] = rings[std::lround(1e6 * body.nodes[n].z())];
    sum += body.fields[postproc::field::contact_pressure][n], ++count;
  }
  std::vector<double> means;
  for (const auto& [height, ring] : rings) means.push_back(ring.first / ring.second);
  return means;
}

/// Forces and moments balance, no traction exceeds mu p, with vanishing friction the frictionless pressure comes back.
TEST(SoftFriction, ObeysItsBoundBalancesAndVanishesWithItsCoefficient) {
  const Timed smooth = solved(tapered(0.0));
  ASSERT_EQ(smooth.result.status, postproc::Status::converged) << smooth.result.message;
  for (const double mu : {1e-4, 1e-3, 0.1, 0.25, 0.5}) {
    const Timed rough = solved(tapered(mu));
    const postproc::RunResult& r = rough.result;
    ASSERT_EQ(r.status, postproc::Status::converged) << r.message;
    const auto& balance = r.balance;
    const double change = mean_difference(ring_means(r.body), ring_means(smooth.result.body));
    fmt::print("tapering soft limb, mu {}: pressure changes by {:.2e} rms, friction {:.4f} of {:.3f} N, {:.0f} % slips, forces balance to "
               "{:.1e}, {:.2f} times the frictionless run's time\n",
               mu, change, balance.friction_force, balance.contact_force, 100.0 * r.numbers.at("slipping_share_of_contact"),
               balance.force_error.norm() / balance.contact_force, rough.seconds / smooth.seconds);
    EXPECT_LE(balance.force_error.norm(), 1e-8 * balance.contact_force);
    EXPECT_LE(balance.moment_error.norm(), 1e-8 * balance.contact_force * 0.055);
    EXPECT_LE((balance.garment_force + balance.skin_force).norm(), 1e-8 * balance.contact_force);
    EXPECT_GT(balance.friction_force, 0.0);
    for (std::size_t n = 0; n < r.body.nodes.size(); ++n)
      EXPECT_LE(r.body.fields[postproc::field::shear_traction][n].norm(), (1.0 + 1e-9) * mu * r.body.fields[postproc::field::contact_pressure][n]) << "skin node " << n;
    for (std::size_t n = 0; n < r.garment.fields[postproc::field::shear_traction].size(); ++n)
      EXPECT_LE(r.garment.fields[postproc::field::shear_traction][n].norm(), (1.0 + 1e-9) * mu * r.garment.fields[postproc::field::contact_pressure][n]) << "garment node " << n;
    EXPECT_LE(change, mu);
    ASSERT_EQ(r.donning.size(), 3u);
    for (const auto& row : r.donning) EXPECT_TRUE(row.converged) << row.name;
    if (mu == 1e-4)
      tests::book("tapering soft limb", "mean pressure, Pa, mu = 1e-4", r.numbers.at("mean_contact_pressure_Pa"),
                  smooth.result.numbers.at("mean_contact_pressure_Pa"), 1e-4, "frictionless run");
  }
}

/// What no edge holds is held by friction on the soft limb too; the frictionless sleeve slides off.
TEST(SoftFriction, HoldsASleeveThatNoEdgeHolds) {
  input::Case c = tapered(0.25);
  c.garments.front().held.clear();
  const auto held = solved(c).result;
  EXPECT_EQ(held.status, postproc::Status::converged) << held.message;
  EXPECT_LE(held.balance.force_error.norm(), 1e-8 * held.balance.contact_force);
  EXPECT_LE(held.balance.skin_force.norm(), 1e-8 * held.balance.contact_force);  // nothing else holds the garment
  EXPECT_GT(held.balance.friction_force, 1e-2 * held.balance.contact_force);
  c.contacts.front().friction = 0.0;
  EXPECT_EQ(solved(c).result.status, postproc::Status::failed);
}

}  // namespace
