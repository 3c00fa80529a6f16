// snug library page: what the library holds, as one page to browse.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "materials/database/named.hpp"
#include "materials/laws/one_point.hpp"
#include "materials/laws/solid_law.hpp"
#include "postproc/report/page.hpp"
#include "solver/app/fabric_curves.hpp"
#include "solver/app/library_command.hpp"
#include "solver/app/recorded_commands.hpp"
#include "solver/app/report_files.hpp"

namespace snug::app {

namespace {

using Json = nlohmann::ordered_json;
using materials::Datum, materials::DatumType, materials::Entity, materials::Kind, materials::Library;

constexpr int steps = 24;

Json data_json(const Entity& entity, materials::UnitBook& units) {
  Json data = Json::array();
  for (const Datum& one : entity.data) {
    const auto unit = units.find(one.unit);
    std::string printed = one.type == DatumType::table || one.type == DatumType::figure ? input::text_of(one.type)
                          : one.type == DatumType::equation                            ? one.value + (one.unit.empty() ? "" : " [" + one.unit + "]")
                                                                                       : materials::quantity_text(one);
    if (!one.low.empty()) printed += (printed.empty() ? "" : ", ") + one.low + " to " + one.high + (one.value.empty() ? " " + one.unit : "");
    data.push_back({{"name", one.name}, {"printed", printed}, {"unit", one.unit}, {"source", one.source}, {"si", one.si ? Json(*one.si) : Json()},
                    {"factor", unit ? unit->factor : 1.0}});
  }
  return data;
}

Json fabric_json(const Entity& entity, materials::UnitBook& units) {
  Json curves = Json::array();
  for (const FabricCurve& curve : fabric_curves(materials::fabric_data(materials::entry_of(entity, entity.where, units)), steps)) {
    const bool tensile = curve.test == FabricCurve::Test::tensile;
    Json points = Json::array();
    for (const FabricCurve::Point& point : curve.points) points.push_back({tensile ? 100.0 * point.at : point.at * 57.29577951308232, point.force, point.beyond});
    curves.push_back({{"test", tensile ? "tensile" : "shear"}, {"name", curve.name()}, {"x", tensile ? "strain, %" : "angle, degree"}, {"y", "N/m"}, {"points", points}});
  }
  return curves;
}

Json tissue_json(const Entity& entity, materials::UnitBook& units) {
  const materials::Tissue tissue = materials::find_tissue(materials::entry_of(entity, entity.where, units));
  Json points = Json::array();
  for (int k = 0; k <= steps; ++k) {
    const double stretch = 0.7 + 0.8 * k / steps;
    if (const auto state = materials::one_point(tissue.law, materials::Loading::uniaxial, stretch)) points.push_back({stretch, 1e-3 * state->nominal_stress, false});
  }
  return Json::array({{{"test", "uniaxial"}, {"name", "loading"}, {"x", "stretch"}, {"y", "nominal stress, kPa"}, {"points", points}}});
}

/// None for an entity without a law, or whose law lacks a number.
Json curves_json(const Entity& entity, materials::UnitBook& units) {
  if (!entity.find("law")) return Json::array();
  try {
    if (entity.kind == Kind::fabric) return fabric_json(entity, units);
    if (entity.kind == Kind::tissue) return tissue_json(entity, units);
  } catch (const input::InputError&) {
  }
  return Json::array();
}

class LibraryPage : public LibraryCommand {
 public:
  LibraryPage() : LibraryCommand("page", "everything that the library holds as one page: search, filter, sort, curves, two side by side") {}
  void declare(CLI::App& app) override {
    app.add_option("QUESTION", question_, "only those (snug materials find)");
    app.add_option("--out", file_, "where it goes")->type_name("FILE")->capture_default_str();
  }

 private:
  int act(Library& library) override {
    Json entities = Json::array();
    for (const std::string& id : question_.empty() ? library.ids() : library.find_where(question_)) {
      const Entity entity = library.entity(id);
      entities.push_back({{"kind", input::text_of(entity.kind)}, {"id", id}, {"parent", entity.parent}, {"own", !entity.shipped},
                          {"data", data_json(entity, library.units())}, {"curves", curves_json(entity, library.units())}});
    }
    write_page(postproc::report::library_page(question_.empty() ? "The library" : question_, fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))), {{"entities", entities}}), file_);
    console().print("{}: {} entities\n", file_, entities.size());
    console().document() = {{"file", file_}, {"entities", entities.size()}};
    return done;
  }
  std::string question_, file_ = "library.html";
};

class LibraryPages : public CommandGroup {
 public:
  LibraryPages() : CommandGroup("library", "the library as a page to browse (snug materials asks and changes it)", "") { commands_.push_back(std::make_unique<LibraryPage>()); }
};

}  // namespace

std::unique_ptr<Command> make_library() { return std::make_unique<LibraryPages>(); }

}  // namespace snug::app
