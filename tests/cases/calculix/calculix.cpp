// The same body in snug and in CalculiX. Registered where ccx is installed.
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "mesh/formats/model.hpp"
#include "postproc/nodal_field.hpp"
#include "tests/cases/program.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/shell_models.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

using Displacements = std::map<int, Eigen::Vector3d>;

class CalculiX : public Program {
 protected:
  /// Displacements by node number that CalculiX prints at the end of its step for NAME.inp in the folder.
  Displacements theirs(const std::string& name) const {
    const std::string command = "cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 ccx " + name + " > log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << name;
    Displacements found;
    std::ifstream in(folder_ / (name + ".dat"));
    for (std::string line; std::getline(in, line);) {
      if (line.find("displacements") != std::string::npos) found.clear();  // of a later time
      int n = 0;
      Eigen::Vector3d u;
      if (std::sscanf(line.c_str(), "%d %lf %lf %lf", &n, &u[0], &u[1], &u[2]) == 4) found[n] = u;
    }
    return found;
  }
  /// Runs the file of another program as the body of a case, and gives its displacements by node number.
  Displacements ours(const std::string& file) const {
    fs::create_directories(folder_ / "mine");
    write("mine/case.toml", "title = \"" + file + "\"\n[body]\nkind = \"imported\"\nmesh = \"" + file + "\"\n");
    fs::copy_file(folder_ / file, folder_ / "mine" / file, fs::copy_options::overwrite_existing);
    const Outcome run = snug("run mine --quiet");
    EXPECT_EQ(run.status, 0) << run.text;
    const postproc::NodalField field = postproc::read_field(folder_ / "mine/out");
    Displacements found;
    for (std::size_t n = 0; n < field.nodes.size(); ++n)
      found[field.nodes[n]] = {field.find("UX")->values[n], field.find("UY")->values[n], field.find("UZ")->values[n]};
    return found;
  }
  void write_model(const std::string& name, const mesh::Model& model) const {
    std::ofstream inp(folder_ / (name + ".inp")), cdb(folder_ / (name + ".cdb"));
    mesh::write_calculix(inp, model);
    mesh::write_cdb(cdb, model);
  }
};

/// Largest difference at the nodes of `theirs` over their largest displacement.
double largest_difference(const Displacements& ours, const Displacements& theirs) {
  double difference = 0.0, scale = 0.0;
  for (const auto& [node, u] : theirs) scale = std::max(scale, u.norm());
  for (const auto& [node, u] : theirs) difference = std::max(difference, (ours.at(node) - u).norm());
  EXPECT_GT(scale, 0.0);
  return difference / scale;
}

/// Mean radial displacement of nodes round the z axis.
double mean_radial(const Displacements& u, const mesh::Model& model, const std::vector<int>& nodes) {
  double sum = 0.0;
  for (const mesh::ModelNode& node : model.nodes)
    if (std::binary_search(nodes.begin(), nodes.end(), node.number))
      sum += node.at.head<2>().normalized().dot(u.at(node.number).head<2>()) / static_cast<double>(nodes.size());
  return sum;
}

// The limb alone under pressure, written by snug convert and solved by CalculiX with 20-node bricks, moves as in snug.
TEST_F(CalculiX, MovesTheLimbUnderPressureAsSnugDoesWithinATenThousandth) {
  const std::string limb = std::string(SNUG_SOURCE_DIR) + "/cases/verification/peer-limb-alone";
  const Outcome converted = snug("convert '" + limb + "' limb.inp");
  ASSERT_EQ(converted.status, 0) << converted.text;
  const mesh::Model model = mesh::read_model(folder_ / "limb.inp");
  const double reference = mean_radial(theirs("limb"), model, model.node_sets.at("SKIN"));
  const Outcome run = snug("run '" + limb + "' --quiet --out out");
  ASSERT_EQ(run.status, 0) << run.text;
  std::ifstream file(folder_ / "out/summary.json");
  const double mine = nlohmann::json::parse(file)["numbers"]["mean_skin_radial_displacement_m"];
  tests::book("peers P0", "displacement of the skin, m", mine, reference, 1e-4, "CalculiX, the same cells as C3D20R");
}

// A limb written as .inp and as .cdb comes back as a foreign body with its law, supports and pressure; CalculiX runs the
// same file. 20-node cells become 27-node ones here: the 2 %.
TEST_F(CalculiX, ReadsTheSameFileAsSnug) {
  const std::string limb = "'" + std::string(SNUG_SOURCE_DIR) + "/cases/verification/limb-alone'";
  const std::string coarse = " --set body.cells_around=12 --set body.cells_along=1";
  for (const std::string file : {"limb.inp", "limb.cdb"}) {
    const Outcome converted = snug("convert " + limb + " " + file + coarse);
    ASSERT_EQ(converted.status, 0) << converted.text;
    EXPECT_NE(converted.text.find("note: layer \"tissue\""), std::string::npos) << converted.text;  // the volumetric law
  }
  const Displacements reference = theirs("limb");
  tests::book("foreign limb", "largest difference over largest displacement, .inp", largest_difference(ours("limb.inp"), reference), 0.0, 0.02, "CalculiX, the same file");
  tests::book("foreign limb", "largest difference over largest displacement, .cdb", largest_difference(ours("limb.cdb"), reference), 0.0, 0.02, "CalculiX, the same body");
}

/// A cantilever of 20-node bricks, 10 x 1 x 1, held at x = 0, 3e-4 EI/L^2 pulling up at its end face.
mesh::Model cantilever() {
  mesh::Model model;
  model.materials = {{"STEEL", mesh::ModelLaw::elastic, {1000.0, 0.3}, 0.0}};
  constexpr std::array<int, 20> order = {0, 2, 8, 6, 18, 20, 26, 24, 1, 5, 7, 3, 19, 23, 25, 21, 9, 11, 17, 15};
  std::map<std::array<int, 3>, int> number;
  const auto node = [&](int i, int j, int k) {
    const auto [it, fresh] = number.emplace(std::array{i, j, k}, static_cast<int>(model.nodes.size()) + 1);
    if (fresh) model.nodes.push_back({it->second, Eigen::Vector3d(0.5 * i, 0.25 * j, 0.25 * k)});
    return it->second;
  };
  for (int c = 0; c < 40; ++c) {
    mesh::ModelElement element{c + 1, mesh::ElementKind::hex20, {}, 0, -1};
    for (const int a : order) element.nodes.push_back(node(2 * (c / 4) + a % 3, 2 * (c % 2) + a / 3 % 3, 2 * (c / 2 % 2) + a / 9));
    model.elements.push_back(element);
  }
  for (const auto& [at, n] : number) {
    if (at[0] == 0)
      for (int c = 0; c < 3; ++c) model.supports.push_back({n, c, 0.0});
    if (at[0] == 20 && at[1] == 2) model.forces.push_back({n, 2, 0.01});
  }
  return model;
}

TEST_F(CalculiX, BendsASolidUnderNodalForcesAsSnugDoes) {
  write_model("beam", cantilever());
  const Displacements reference = theirs("beam");
  for (const char* file : {"beam.inp", "beam.cdb"})
    tests::book("foreign cantilever", fmt::format("largest difference over largest displacement, {}", file), largest_difference(ours(file), reference), 0.0, 0.02, "CalculiX C3D20R, the same file");
}

// A clamped plate under forces and a pressurised sphere, as S6 in CalculiX: within 2 %.
TEST_F(CalculiX, BendsAndInflatesShellsAsSnugDoes) {
  mesh::Model plate = tests::square_shell(20, 20, [](double u, double v) { return Eigen::Vector3d(0.5 * u, 0.5 * v, 0.0); }, 1e6, 0.3, 0.02);
  tests::hold(plate, [](const Eigen::Vector3d& x) { return x.x() > 0.5 - 1e-9 || x.y() > 0.5 - 1e-9; }, {0, 1, 2, 3, 4, 5});
  tests::hold_symmetry(plate, {0, 1});
  for (const mesh::ModelElement& element : plate.elements) plate.pressures.push_back({element.number, 0, 0.1});
  write_model("plate", plate);
  tests::book("foreign clamped plate", "largest difference over largest displacement", largest_difference(ours("plate.inp"), theirs("plate")), 0.0, 0.02, "CalculiX S6, the same file");
  mesh::Model sphere = tests::octant(16, 0.1, 1e6, 0.3, 2e-3);
  tests::hold_symmetry(sphere, {0, 1, 2});
  for (const mesh::ModelElement& element : sphere.elements) sphere.pressures.push_back({element.number, 0, 1.0});
  write_model("sphere", sphere);
  tests::book("foreign sphere", "largest difference over largest displacement", largest_difference(ours("sphere.inp"), theirs("sphere")), 0.0, 0.02, "CalculiX S6, the same file");
}

// What neither program can say is refused with the remedy.
TEST_F(CalculiX, RefusesWhatCannotBeWritten) {
  const std::string cases = std::string(SNUG_SOURCE_DIR) + "/cases/verification/";
  const Outcome garment = snug("convert '" + cases + "peer-limb' limb.inp");
  EXPECT_EQ(garment.status, 2);
  EXPECT_NE(garment.text.find("without [garment]"), std::string::npos) << garment.text;
  EXPECT_FALSE(fs::exists(folder_ / "limb.inp"));
  EXPECT_EQ(snug("convert '" + cases + "limb-alone' limb.stl").status, 2);
}

}  // namespace
}  // namespace snug
