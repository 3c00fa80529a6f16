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
struct SleeveErrors {
  double pressure = 0.0, displacement = 0.0, nodal_rms = 0.0, nodal_max = 0.0, seconds = 0.0;
  long unknowns = 0;
};

void measure_nodes(const postproc::BodyResult& body, double hem, double exact, SleeveErrors& errors) {
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
    const double error = body.fields[postproc::field::contact_pressure][node] / exact - 1.0;
    errors.nodal_max = std::max(errors.nodal_max, std::abs(error));
    sum += error * error;
    ++count;
  }
  if (count > 0) errors.nodal_rms = std::sqrt(sum / static_cast<double>(count));
}

SleeveErrors run_against(const Exact& exact, const input::Case& description) {
  const solver::Meshes meshes = make_meshes(description);
  const auto start = std::chrono::steady_clock::now();
  const postproc::RunResult result = tests::solve(description, meshes);
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  SleeveErrors errors;
  errors.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const auto& [part, unknowns] : result.unknowns) errors.unknowns += unknowns;
  errors.pressure = result.numbers.at("mean_contact_pressure_Pa") / exact.pressure - 1.0;
  errors.displacement = result.numbers.at("mean_skin_radial_displacement_m") / exact.displacement - 1.0;
  measure_nodes(result.body, meshes.garments.front().mean_edge, exact.pressure, errors);
  return errors;
}

void print_sleeve_head() {
  fmt::print("{:28} {:>9} {:>11} {:>11} {:>10} {:>10} {:>7} {:>7} {:>7}\n", "mesh or row", "unknowns", "p error",
             "u error", "nodal rms", "nodal max", "order p", "order u", "seconds");
}

void print_row(const std::string& name, const SleeveErrors& e, const SleeveErrors* coarser = nullptr) {
  const auto order = [&](double SleeveErrors::*error) {
    return coarser ? fmt::format("{:.2f}", std::log2(std::abs((*coarser).*error / (e.*error)))) : std::string("-");
  };
  fmt::print("{:28} {:9} {:11.3e} {:11.3e} {:10.2e} {:10.2e} {:>7} {:>7} {:7.1f}\n", name, e.unknowns, e.pressure,
             e.displacement, e.nodal_rms, e.nodal_max, order(&SleeveErrors::pressure), order(&SleeveErrors::displacement),
             e.seconds);
}

/// Both into the verification book.
void book_both(const std::string& name, const Exact& exact, const SleeveErrors& errors, double tolerance) {
  const std::string source = "reference book 1.6 C, collocation";
  book("1.6 C sleeve, " + name, "contact pressure, Pa", exact.pressure * (1.0 + errors.pressure), exact.pressure, tolerance,
       source);
  book("1.6 C sleeve, " + name, "displacement of the skin, m", exact.displacement * (1.0 + errors.displacement),
       exact.displacement, tolerance, source);
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
  const SleeveErrors errors = run_against(svk_049, shipped);
  print_sleeve_head();
  print_row("cases/verification", errors);
  book_both("shipped case", svk_049, errors, 1e-3);
  EXPECT_LE(errors.nodal_max, 1e-2);
}

TEST(TubeSleeve, ErrorsFallAtLeastWithTheSquareOfTheCellSize) {
  print_sleeve_head();
  std::vector<SleeveErrors> errors;
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
  print_sleeve_head();
  for (const input::Elements elements : {input::Elements::P2P1, input::Elements::Q1P0}) {
    std::vector<SleeveErrors> errors;
    for (int l = 0; l < 3; ++l) {
      input::Case description = describe_tube(level(l));
      description.body->elements = elements;
      errors.push_back(run_against(svk_049, description));
      print_row(fmt::format("{} level {}", text_of(elements), l), errors[l], l > 0 ? &errors[l - 1] : nullptr);
    }
    const double order = elements == input::Elements::P2P1 ? 3.0 : 1.9, nodal = elements == input::Elements::P2P1 ? 2.0 : 1.0;
    EXPECT_GE(std::log2(std::abs(errors[1].pressure / errors[2].pressure)), order);
    EXPECT_GE(std::log2(std::abs(errors[1].displacement / errors[2].displacement)), order);
    EXPECT_GE(std::log2(errors[1].nodal_rms / errors[2].nodal_rms), nodal);
  }
}

/// A row of the table in reference book 1.6 C.
struct SleeveRow {
  int layers;                         ///< 1: mu = 10 kPa from 20 to 55 mm; 3: muscle, fat and solid skin
  std::string poisson_ratio, tension;
  double pressure, outer_radius;      ///< kPa, mm
};

const SleeveRow sleeve_rows[] = {
    {1, "0.45", "T=200(l-1)", 0.89514028723, 54.78980324762},
    {1, "0.45", "T=1000(l-1)", 4.21599591610, 54.02112507964},
    {1, "0.45", "T=100e+2000e^3", 2.39189322748, 54.44116519977},
    {1, "0.45", "SVK 1000", 5.57060394520, 53.71268614523},
    {1, "0.49", "T=200(l-1)", 0.90623807730, 54.95688474438},
    {1, "0.49", "T=1000(l-1)", 4.47494979646, 54.78754697638},
    {1, "0.49", "T=100e+2000e^3", 2.55338004184, 54.87863786745},
    {1, "0.49", "SVK 1000", 6.20261651745, 54.70582574868},
    {1, "0.499", "T=200(l-1)", 0.90880420193, 54.99566389611},
    {1, "0.499", "T=1000(l-1)", 4.53829512155, 54.97835126726},
    {1, "0.499", "T=100e+2000e^3", 2.59470952248, 54.98762125876},
    {1, "0.499", "SVK 1000", 6.37242613754, 54.96960520324},
    {3, "0.45", "T=200(l-1)", 0.88576493983, 54.64944340987},
    {3, "0.45", "T=1000(l-1)", 4.01993489563, 53.45496024072},
    {3, "0.45", "T=100e+2000e^3", 2.27472986147, 54.11124180670},
    {3, "0.45", "SVK 1000", 5.15018881856, 53.04175118377},
    {3, "0.49", "T=200(l-1)", 0.90406955072, 54.92415668462},
    {3, "0.49", "T=1000(l-1)", 4.42270652258, 54.63117720560},
    {3, "0.49", "T=100e+2000e^3", 2.51978721908, 54.78918741068},
    {3, "0.49", "SVK 1000", 6.06774792318, 54.49541336825},
    {3, "0.499", "T=200(l-1)", 0.90857965935, 54.99226843475},
    {3, "0.499", "T=1000(l-1)", 4.53270239078, 54.96145176861},
    {3, "0.499", "T=100e+2000e^3", 2.59102699034, 54.97795769426},
    {3, "0.499", "SVK 1000", 6.35716578338, 54.94595180888}};

/// Rest radius of the sleeve of a row, m.
double rest_radius(const std::string& tension) { return tension == "T=100e+2000e^3" ? 0.040 : 0.044; }

/// Nominal force per width F = k1 e + k3 e^3 with e = l - 1 (axial stretch 1, so that T = F), or S = 1000 N/m E.
std::string fabric_of(const std::string& tension) {
  const auto cubic = [](const char* k1, const char* k3) {
    return fmt::format("law = 'cubic'\nk1 = '{} N/m'\nk3 = '{} N/m'\nshear = '300 N/m'\npoisson = 0", k1, k3);
  };
  if (tension == "T=200(l-1)") return cubic("200", "0");
  if (tension == "T=1000(l-1)") return cubic("1000", "0");
  if (tension == "T=100e+2000e^3") return cubic("100", "2000");
  return TubeCase{}.fabric;
}

/// Muscle 20 to 45 mm (8 kPa), fat to 53 mm (3 kPa), solid skin to 55 mm (50 kPa).
void make_three_layers(const std::string& poisson_ratio, input::Case& c) {
  c.body->layers.resize(1);
  const auto add = [&](const std::string& name, const std::string& shear_modulus, double thickness, int cells) {
    input::LayerSpec& layer = c.body->layers.emplace_back();
    layer.name = name, layer.cells = cells;
    layer.material.table = input::table_of("law = 'neo-Hooke'\nshear_modulus = '" + shear_modulus + "'\npoisson_ratio = " + poisson_ratio);
    if (thickness > 0.0) layer.thickness = thickness;
  };
  add("muscle", "8 kPa", 0.0, 3);
  add("fat", "3 kPa", 0.008, 2);
  add("skin", "50 kPa", 0.002, 1);
}

TEST(TubeSleeve, EveryTissueAndFabricLawMeetsItsRowWithinATenThousandth) {
  print_sleeve_head();
  for (const SleeveRow& row : sleeve_rows) {
    TubeCase tube = level(1);
    tube.tissue = "law = 'neo-Hooke'\nshear_modulus = '10 kPa'\npoisson_ratio = " + row.poisson_ratio;
    tube.fabric = fabric_of(row.tension);
    tube.sleeve = rest_radius(row.tension);
    input::Case c = describe_tube(tube);
    if (row.layers == 3) make_three_layers(row.poisson_ratio, c);
    const Exact exact = {1e3 * row.pressure, 1e-3 * (row.outer_radius - 55.0)};
    const SleeveErrors errors = run_against(exact, c);
    const std::string name = fmt::format("{}, nu {} {}", row.layers == 1 ? "one layer" : "three layers", row.poisson_ratio, row.tension);
    print_row(name, errors);
    book_both(name, exact, errors, 1e-4);
  }
}

}  // namespace
}  // namespace snug::tests
