// A sleeve on a soft tube, and the tube alone under pressure, against the exact radial solutions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// Reference book 1.6 C (s03_layered_tube_sleeve): contact pressure, Pa, and radial displacement of the skin, m.
struct Exact {
  double pressure, displacement;
};

/// Relative errors of a run; `nodal` runs over skin nodes farther than one garment cell from the hems.
struct Errors {
  double pressure = 0.0, displacement = 0.0, nodal_rms = 0.0, nodal_max = 0.0, seconds = 0.0;
  long unknowns = 0;
};

void measure_nodes(const postproc::BodyResult& body, double hem, double exact, Errors& errors) {
  double top = 0.0, sum = 0.0;
  for (const auto& node : body.nodes) top = std::max(top, node.z());
  std::vector<char> skin(body.nodes.size(), 0);
  for (const auto& facet : body.skin_facets)
    for (const int node : facet)
      if (node >= 0) skin[node] = 1;
  long count = 0;
  for (std::size_t node = 0; node < skin.size(); ++node) {
    const double z = body.nodes[node].z();
    if (!skin[node] || z < hem || z > top - hem) continue;
    const double error = body.contact_pressure[node] / exact - 1.0;
    errors.nodal_max = std::max(errors.nodal_max, std::abs(error));
    sum += error * error;
    ++count;
  }
  if (count > 0) errors.nodal_rms = std::sqrt(sum / static_cast<double>(count));
}

Errors run_against(const Exact& exact, const input::Case& description) {
  const solver::Meshes meshes = make_meshes(description);
  const auto start = std::chrono::steady_clock::now();
  const postproc::RunResult result = solver::solve(description, meshes);
  EXPECT_EQ(result.status, "converged") << result.message;
  Errors errors;
  errors.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const auto& [part, unknowns] : result.unknowns) errors.unknowns += unknowns;
  errors.pressure = result.numbers.at("mean_contact_pressure_Pa") / exact.pressure - 1.0;
  errors.displacement = result.numbers.at("mean_skin_radial_displacement_m") / exact.displacement - 1.0;
  measure_nodes(result.body, meshes.garment.mean_edge, exact.pressure, errors);
  return errors;
}

void print_head() {
  fmt::print("{:28} {:>9} {:>11} {:>11} {:>10} {:>10} {:>7} {:>7} {:>7}\n", "mesh or row", "unknowns", "p error",
             "u error", "nodal rms", "nodal max", "order p", "order u", "seconds");
}

void print_row(const std::string& name, const Errors& e, const Errors* coarser = nullptr) {
  const auto order = [&](double Errors::*error) {
    return coarser ? fmt::format("{:.2f}", std::log2(std::abs((*coarser).*error / (e.*error)))) : std::string("-");
  };
  fmt::print("{:28} {:9} {:11.3e} {:11.3e} {:10.2e} {:10.2e} {:>7} {:>7} {:7.1f}\n", name, e.unknowns, e.pressure,
             e.displacement, e.nodal_rms, e.nodal_max, order(&Errors::pressure), order(&Errors::displacement),
             e.seconds);
}

/// Both into the verification book, asserted within a thousandth.
void book_both(const std::string& name, const Exact& exact, const Errors& errors) {
  const std::string source = "reference book 1.6 C, collocation";
  book("1.6 C sleeve, " + name, "contact pressure, Pa", exact.pressure * (1.0 + errors.pressure), exact.pressure, 1e-3,
       source);
  book("1.6 C sleeve, " + name, "displacement of the skin, m", exact.displacement * (1.0 + errors.displacement),
       exact.displacement, 1e-3, source);
}

const Exact svk_049 = {6202.61651745, (54.70582574868 - 55.0) * 1e-3};  // row 1layer 0.4900 44 SVK 1000

/// A short piece of the tube (plane strain: its length does not matter); cells halve with every level.
TubeCase level(int l) {
  TubeCase tube;
  tube.length = 0.030;
  tube.around = 12 << l, tube.along = 1 << l, tube.through = 1 << l;
  return tube;
}

TEST(TubeSleeve, TheShippedCaseMeetsTheExactPressureAndDisplacementWithinAThousandth) {
  const input::Case shipped = input::read_case(std::string(SNUG_SOURCE_DIR) + "/cases/verification/tube-sleeve");
  const Errors errors = run_against(svk_049, shipped);
  print_head();
  print_row("cases/verification", errors);
  book_both("shipped case", svk_049, errors);
  EXPECT_LE(errors.nodal_max, 1e-2);
}

TEST(TubeSleeve, ErrorsFallAtLeastWithTheSquareOfTheCellSize) {
  print_head();
  std::vector<Errors> errors;
  for (int l = 0; l < 3; ++l) {
    errors.push_back(run_against(svk_049, describe_tube(level(l))));
    const TubeCase t = level(l);
    print_row(fmt::format("{} x {} x {}", t.around, t.along, t.through), errors[l], l > 0 ? &errors[l - 1] : nullptr);
  }
  for (int l = 1; l < 3; ++l) {
    EXPECT_GE(std::log2(std::abs(errors[l - 1].pressure / errors[l].pressure)), 2.0);
    EXPECT_GE(std::log2(std::abs(errors[l - 1].displacement / errors[l].displacement)), 2.0);
  }
  // The coarsest mesh has no node away from the hems; from there the noise of nodal pressures falls too.
  EXPECT_GE(std::log2(errors[1].nodal_rms / errors[2].nodal_rms), 2.0);
}

// A garment lies on every kind of cell: curved triangles converge like curved quadrilaterals, straight ones with h^2.
TEST(TubeSleeve, EveryKindOfCellCarriesAGarment) {
  print_head();
  for (const std::string elements : {"P2/P1", "Q1/P0"}) {
    std::vector<Errors> errors;
    for (int l = 0; l < 3; ++l) {
      input::Case description = describe_tube(level(l));
      description.body->elements = elements;
      errors.push_back(run_against(svk_049, description));
      print_row(fmt::format("{} level {}", elements, l), errors[l], l > 0 ? &errors[l - 1] : nullptr);
    }
    const double order = elements == "P2/P1" ? 3.0 : 1.9, nodal = elements == "P2/P1" ? 2.0 : 1.0;
    EXPECT_GE(std::log2(std::abs(errors[1].pressure / errors[2].pressure)), order);
    EXPECT_GE(std::log2(std::abs(errors[1].displacement / errors[2].displacement)), order);
    EXPECT_GE(std::log2(errors[1].nodal_rms / errors[2].nodal_rms), nodal);
  }
}

/// A row of the table in reference book 1.6 C: tissue mu = 10 kPa of 20 to 55 mm, rest radius of the sleeve, its law.
struct Row {
  std::string name, poisson_ratio, fabric;
  double sleeve, pressure, outer_radius;  ///< m, kPa, mm
};

/// `tension` as nominal force per width: F = k1 e + k3 e^3 with e = l - 1 (axial stretch 1, so that T = F).
std::string cubic(const std::string& k1, const std::string& k3) {
  return "law = 'cubic'\nk1 = '" + k1 + " N/m'\nk3 = '" + k3 + " N/m'\nshear = '300 N/m'\npoisson = 0";
}

std::vector<Row> rows() {
  const std::string svk = TubeCase{}.fabric;
  return {{"nu 0.45  SVK 1000", "0.45", svk, 0.044, 5.57060394520, 53.71268614523},
          {"nu 0.499 SVK 1000", "0.499", svk, 0.044, 6.37242613754, 54.96960520324},
          {"nu 0.49  T=200(l-1)", "0.49", cubic("200", "0"), 0.044, 0.90623807730, 54.95688474438},
          {"nu 0.49  T=1000(l-1)", "0.49", cubic("1000", "0"), 0.044, 4.47494979646, 54.78754697638},
          {"nu 0.49  T=100e+2000e^3", "0.49", cubic("100", "2000"), 0.040, 2.55338004184, 54.87863786745}};
}

TEST(TubeSleeve, EveryTissueAndFabricLawMeetsItsRowWithinAThousandth) {
  print_head();
  for (const Row& row : rows()) {
    TubeCase tube = level(1);
    tube.tissue = "law = 'neo-Hooke'\nshear_modulus = '10 kPa'\npoisson_ratio = " + row.poisson_ratio;
    tube.fabric = row.fabric;
    tube.sleeve = row.sleeve;
    const Exact exact = {1e3 * row.pressure, 1e-3 * (row.outer_radius - 55.0)};
    const Errors errors = run_against(exact, describe_tube(tube));
    print_row(row.name, errors);
    book_both(row.name, exact, errors);
  }
}

/// Row 3layer 0.4900 44 SVK 1000: muscle 20 to 45 mm (8 kPa), fat to 53 mm (3 kPa), solid skin to 55 mm (50 kPa).
TEST(TubeSleeve, ThreeLayersMeetTheirRowWithinAThousandth) {
  input::Case c = describe_tube(level(1));
  c.body->layers.resize(1);
  const auto add = [&](const std::string& name, const std::string& shear_modulus, double thickness, int cells) {
    input::LayerSpec& layer = c.body->layers.emplace_back();
    layer.name = name, layer.cells = cells;
    layer.material.table = "law = 'neo-Hooke'\nshear_modulus = '" + shear_modulus + "'\npoisson_ratio = 0.49";
    if (thickness > 0.0) layer.thickness = thickness;
  };
  add("muscle", "8 kPa", 0.0, 3);
  add("fat", "3 kPa", 0.008, 2);
  add("skin", "50 kPa", 0.002, 1);
  const Exact exact = {6067.74792318, (54.49541336825 - 55.0) * 1e-3};
  const Errors errors = run_against(exact, c);
  print_head();
  print_row("three layers", errors);
  book_both("three layers", exact, errors);
}

}  // namespace
}  // namespace snug::tests
