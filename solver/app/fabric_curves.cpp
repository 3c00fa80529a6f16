#include "solver/app/fabric_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/input/case.hpp"
#include "cases/input/suggestion.hpp"
#include "materials/database/exchange.hpp"
#include "materials/database/named.hpp"
#include "materials/laws/solid_law.hpp"
#include "postproc/tables.hpp"
#include "solver/app/library_commands.hpp"
#include "solver/app/data_directory.hpp"
#include "solver/app/library_file.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

using materials::FabricData, materials::Kind, materials::TensionCurve;
using Test = FabricCurve::Test;

constexpr double degree = std::numbers::pi / 180.0, gf_per_cm = 0.980665;  // rad, N/m
constexpr double straight_end = 0.3;                                       // of a law without range, strain
constexpr double kes_shear_end = 8 * degree;                               // where the machine turns
constexpr double beyond = 1.25;                                            // of the data's end

double green(double strain) { return strain * (1.0 + 0.5 * strain); }
double engineering(double green_strain) {
  return std::isinf(green_strain) ? green_strain : std::sqrt(1.0 + 2.0 * green_strain) - 1.0;
}
/// Nominal force (N/m): F = (1 + e) S.
double nominal(const TensionCurve& curve, double strain) { return (1.0 + strain) * curve.at(green(strain)).force; }

std::vector<FabricData> of_case(const fs::path& directory) {
  std::vector<FabricData> fabrics;
  for (const input::GarmentSpec& garment : input::read_case(directory, {.overrides = {}, .bodies = bodies_folder()}).garments) {
    const auto add = [&](const input::MaterialEntry& fabric) { fabrics.push_back(materials::fabric_data(materials::resolved(fabric, Kind::fabric, library_file()))); };
    add(garment.fabric);
    for (const input::ZoneSpec& zone : garment.zone) add(zone.fabric);
  }
  if (fabrics.empty())
    throw input::InputError({(directory / "case.toml").string(), 0, 0}, "the case has no garment",
                            "name a fabric, or a case with a garment");
  return fabrics;
}

std::vector<FabricData> of_entries(const fs::path& file) {
  materials::UnitBook units;
  std::vector<FabricData> fabrics;
  for (const materials::Entity& entity : materials::read_entries(file, Kind::fabric, units).entities)
    if (entity.kind == Kind::fabric)
      fabrics.push_back(materials::fabric_data(materials::entry_of(entity, entity.where, units)));
  if (fabrics.empty())
    throw input::InputError({file.string(), 0, 0}, "the file has no fabric",
                            "write one as [fabric.\"my knit\"], or name the directory of a case");
  return fabrics;
}

[[noreturn]] void refuse(const std::string& name) {
  std::vector<std::string> known = materials::fabric_names();
  for (const auto& more :
       {materials::further_shipped(Kind::fabric), own_entities(Kind::fabric), materials::tissue_names()})
    known.insert(known.end(), more.begin(), more.end());
  throw input::InputError({"snug materials curve", 0, 0}, "there is no fabric, tissue or case \"" + name + "\"",
                          input::did_you_mean(name, known));
}

FabricCurve tensile(const TensionCurve& curve, const std::string& direction, const std::string& branch, int steps,
                    bool goes_on) {
  FabricCurve sampled{.test = Test::tensile,
                      .direction = direction,
                      .branch = branch,
                      .points = {},
                      .data_end = engineering(curve.data_end())};
  const double end = std::isinf(sampled.data_end) ? straight_end : sampled.data_end;
  const int last = goes_on && !std::isinf(sampled.data_end) ? steps + (steps + 3) / 4 : steps;
  for (int k = 0; k <= last; ++k) {
    const double at = k <= steps ? end * k / steps : end * (1.0 + (beyond - 1.0) * (k - steps) / (last - steps));
    sampled.points.push_back({at, nominal(curve, at), k > steps});
  }
  return sampled;
}

/// F = G phi, with the hysteresis of a KES test + and - half the width of its loop.
FabricCurve shear(const FabricData& fabric, double sign, const std::string& branch, int steps) {
  const bool measured = fabric.sheet.hysteresis.shear || fabric.sheet.hysteresis.wide_shear;
  FabricCurve sampled{.test = Test::shear,
                      .direction = {},
                      .branch = branch,
                      .points = {},
                      .data_end = measured ? kes_shear_end : std::numeric_limits<double>::infinity()};
  const int last = measured && sign >= 0.0 ? steps + (steps + 3) / 4 : steps;
  for (int k = 0; k <= last; ++k) {
    const double at =
        kes_shear_end * (k <= steps ? 1.0 * k / steps : 1.0 + (beyond - 1.0) * (k - steps) / (last - steps));
    sampled.points.push_back(
        {at, fabric.loading.shear * at + sign * fabric.sheet.hysteresis.half_shear(at), k > steps});
  }
  return sampled;
}

bool same(const FabricCurve& a, const FabricCurve& b) {
  return a.points.size() == b.points.size() &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(),
                    [](const auto& p, const auto& q) { return p.at == q.at && p.force == q.force; });
}

void add_tensile(const materials::Fabric& fabric, const std::string& branch, int steps, bool goes_on,
                 std::vector<FabricCurve>& curves) {
  FabricCurve warp = tensile(fabric.warp, "warp", branch, steps, goes_on),
              weft = tensile(fabric.weft, "weft", branch, steps, goes_on);
  if (same(warp, weft)) {
    warp.direction = "warp and weft";
    return curves.push_back(std::move(warp));
  }
  curves.push_back(std::move(warp)), curves.push_back(std::move(weft));
}

}  // namespace

std::vector<FabricData> fabrics_to_draw(const std::string& name) {
  std::error_code ignored;
  const fs::path path = name;
  if (fs::is_directory(path, ignored)) return of_case(path);
  if (path.filename() == "case.toml") return of_case(path.parent_path().empty() ? fs::path(".") : path.parent_path());
  if (path.extension() == ".toml" || path.extension() == ".json") return of_entries(path);
  const std::vector<std::string> shipped = materials::fabric_names();
  const input::MaterialEntry asked{.name = name, .table = {}, .where = {"snug materials curve", 0, 0}};
  if (std::find(shipped.begin(), shipped.end(), name) == shipped.end() && known_data_text(name).empty()) refuse(name);
  return {materials::fabric_data(materials::resolved(asked, Kind::fabric, library_file()))};
}

std::vector<FabricCurve> fabric_curves(const FabricData& fabric, int steps) {
  std::vector<FabricCurve> curves;
  add_tensile(fabric.loading, "loading", steps, true, curves);
  if (fabric.unloading) add_tensile(*fabric.unloading, "unloading", steps, false, curves);
  curves.push_back(shear(fabric, 1.0, "loading", steps));
  if (!std::isinf(curves.back().data_end)) curves.push_back(shear(fabric, -1.0, "unloading", steps));
  return curves;
}

std::string fabric_table(const std::vector<FabricData>& fabrics, int steps) {
  std::string text = "fabric,curve,strain [%],angle [deg],force [N/m],force [gf/cm],range\n";
  for (const FabricData& fabric : fabrics)
    for (const FabricCurve& curve : fabric_curves(fabric, steps))
      for (const auto& point : curve.points) {
        const std::string at =
            fmt::format("{:.8g}", curve.test == Test::tensile ? 100.0 * point.at : point.at / degree);
        text += fmt::format("{},{},{},{},{:.8g},{:.8g},{}\n", postproc::csv_cell(fabric.loading.name), curve.name(),
                            curve.test == Test::tensile ? at : "", curve.test == Test::shear ? at : "", point.force,
                            point.force / gf_per_cm,
                            std::isinf(curve.data_end) ? "law without range"
                            : point.beyond             ? "beyond the data"
                                                       : "data");
      }
  return text;
}

}  // namespace snug::app
