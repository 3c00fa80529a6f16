// Sleeves that are wider than the limb somewhere: cloth stands off there, hangs by its weight, and presses by its hoop
// tension where it is tight.
#include "materials/fabric/fabric.hpp"
#include "solver/stepping/drape.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// A limb of 90 mm whose radius grows from 46 to 58 mm, and a sleeve of 70 mm from 10 mm up that hangs from its upper edge.
struct Hanging {
  double lower = 0.046, upper = 0.058, length = 0.090, position = 0.010, sleeve_length = 0.070;  ///< m
  double rest_radius = 0.051;  ///< m
  double stiffness = 200.0;    ///< N/m
  double friction = 0.0;
  input::Tier tier = input::Tier::L1;

  double radius(double z) const { return lower + (upper - lower) * z / length; }
  /// Sum of the contact forces: int T cos(a)/r dA with dA = 2 pi r dz/cos(a), T = S l of the hoop stretch l.
  double contact_force() const {
    double sum = 0.0;
    constexpr int panels = 2000;
    for (int i = 0; i < panels; ++i) {
      const double z = position + (i + 0.5) / panels * sleeve_length, l = radius(z) / rest_radius;
      if (l > 1.0) sum += 2.0 * std::numbers::pi * stiffness * 0.5 * (l * l - 1.0) * l * sleeve_length / panels;
    }
    return sum;
  }
};

input::Case describe(const Hanging& scene) {
  TubeCase tube;
  tube.around = 12, tube.along = 5, tube.through = 1, tube.length = scene.length, tube.sleeve = scene.rest_radius, tube.tier = scene.tier;
  tube.tissue = "law = 'neo-Hooke'\nshear_modulus = '40 kPa'\npoisson_ratio = 0.49";
  tube.fabric = fmt::format("law = 'linear'\nwarp = '{0} N/m'\nweft = '{0} N/m'\nshear = '{1} N/m'\nB = '3e-6 N m'\nweight = '200 g/m2'",
                            scene.stiffness, 0.3 * scene.stiffness);
  input::Case c = describe_tube(tube);
  c.body->stations = std::filesystem::temp_directory_path() / fmt::format("snug-hanging-{}.csv", ::getpid());
  std::ofstream out(c.body->stations);
  out.precision(17);
  out << "height [m], girth [m], bone_girth [m]\n";
  for (const double s : {0.0, 0.5, 1.0})
    out << s * scene.length << ", " << 2.0 * std::numbers::pi * scene.radius(s * scene.length) << ", 0.12\n";
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}};
  c.garments.front().position = scene.position, c.garments.front().pattern.length = scene.sleeve_length;
  c.contacts.front().friction = scene.friction;
  return c;
}

struct Hung {
  postproc::RunResult result;
  solver::Meshes meshes;
};

Hung hang(const Hanging& scene) {
  const input::Case c = describe(scene);
  solver::Meshes meshes = make_meshes(c);
  postproc::RunResult result = tests::solve(c, meshes);
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  return {std::move(result), std::move(meshes)};
}

/// Mean distance of the lower hem from its own middle, m: nothing holds a loose sleeve beside the axis.
double hem_radius(const Hung& hung) {
  const auto& hem = hung.meshes.garments.front().edges.at("lower");
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int node : hem) middle += hung.result.garment.current[node] / static_cast<double>(hem.size());
  double sum = 0.0;
  for (const int node : hem) sum += (hung.result.garment.current[node] - middle).head<2>().norm();
  return sum / static_cast<double>(hem.size());
}

// Twelve facets round, axial stretch under a contact that pushes down the cone, friction's axial share and a body that gives
// way: together within 5 %.
TEST(LooseCloth, PartlyLooseItPressesByItsTensionAndStandsOffWhereItIsWider) {
  struct Row { std::string name; input::Tier tier; double friction; };
  for (const Row& row : {Row{"rigid limb", input::Tier::L1, 0.0}, Row{"soft limb", input::Tier::L4, 0.0}, Row{"soft limb, friction 0.3", input::Tier::L4, 0.3}}) {
    Hanging scene;
    scene.tier = row.tier, scene.friction = row.friction;
    const Hung hung = hang(scene);
    const auto& balance = hung.result.balance;
    const std::string source = "hoop tension over radius, integrated over the limb";
    book("partly loose sleeve, " + row.name, "sum of contact forces [N]", balance.contact_force, scene.contact_force(), 5e-2, source);
    EXPECT_LE(balance.force_error.norm(), 1e-6 * balance.contact_force);
    EXPECT_GT(hem_radius(hung), scene.radius(scene.position) + 0.5 * (scene.rest_radius - scene.radius(scene.position)));
    EXPECT_LT(hung.result.iterations, 80);
  }
}

// The hem is drawn in a little: the second form is measured along the pattern, so that cloth bends less when it is shorter,
// and slack cloth bears B/r^2 by the thousandth of its stiffness that wrinkles keep, strain B/(r^2 eta k) = 4.2e-3.
TEST(LooseCloth, LooseAllOverItHangsFromItsHeldEdgeAndTouchesNothing) {
  for (const input::Tier tier : {input::Tier::L1, input::Tier::L4})
    for (const double friction : {0.0, 0.3}) {
      Hanging scene;
      scene.rest_radius = 0.060, scene.tier = tier, scene.friction = friction;
      const Hung hung = hang(scene);
      const double weight = 0.2 * 9.80665 * 2.0 * std::numbers::pi * scene.rest_radius * scene.sleeve_length;
      book(fmt::format("loose sleeve, {}, friction {:g}", text_of(tier), friction), "force of the held edge [N]",
           hung.result.balance.reactions.at("upper edge").z(), weight, 1e-6, "its weight");
      EXPECT_EQ(hung.result.balance.contact_force, 0.0);
      const double drawn_in = 3e-6 / (scene.rest_radius * scene.rest_radius * 1e-3 * scene.stiffness);
      EXPECT_NEAR(hem_radius(hung), scene.rest_radius * (1.0 - drawn_in), 1e-3 * scene.rest_radius);
    }
}

// Tier particle: the same sleeves as particles. Loose all over it comes to rest, touches nothing, and its held edge bears its weight.
// Its fields are of the forces that it has: of the air, not of a band.
TEST(LooseCloth, AsParticlesALooseSleeveHangsFromItsHeldEdge) {
  Hanging scene;
  scene.rest_radius = 0.060, scene.tier = input::Tier::particle;
  const Hung hung = hang(scene);
  const double weight = 0.2 * 9.80665 * 2.0 * std::numbers::pi * scene.rest_radius * scene.sleeve_length;
  book("loose sleeve of particles", "force of the held edge [N]", hung.result.balance.reactions.at("upper edge").z(), weight, 1e-3, "its weight");
  EXPECT_LT(hung.result.balance.force_error.norm(), 1e-3 * weight);
  EXPECT_EQ(hung.result.balance.contact_force, 0.0);
  EXPECT_NEAR(hem_radius(hung), scene.rest_radius, 0.01 * scene.rest_radius);
  EXPECT_FALSE(hung.result.body.fields.has(postproc::field::contact_pressure));  // it claims none
  EXPECT_NE(hung.result.garment.fields.find("drag_force"), nullptr);
  EXPECT_EQ(hung.result.garment.fields.find("band_force"), nullptr);
}

// What nothing holds falls off, and is no answer; what has not come to rest in the steps given is none either.
TEST(LooseCloth, AsParticlesItIsConvergedAtRestOnly) {
  Hanging scene;
  scene.rest_radius = 0.060, scene.tier = input::Tier::particle;
  input::Case c = describe(scene);
  const solver::Meshes meshes = make_meshes(c);
  const auto fall = [&](int steps) {
    postproc::RunResult result;
    const solver::Observer nobody;
    solver::RunLog log(result, nobody);
    solver::drape(solver::make_model(c, meshes.body), meshes, {}, {}, log, result, {.steps = steps});
    return result;
  };
  const postproc::RunResult soon = fall(3);
  EXPECT_EQ(soon.status, postproc::Status::partial);
  EXPECT_NE(soon.message.find("not at rest after 3 steps"), std::string::npos) << soon.message;
  c.garments.front().held.clear();
  const postproc::RunResult off = fall(1500);
  EXPECT_EQ(off.status, postproc::Status::failed);
  EXPECT_NE(off.message.find("slides off"), std::string::npos) << off.message;
  EXPECT_FALSE(off.remedies.empty());
}

}  // namespace
}  // namespace snug::tests
