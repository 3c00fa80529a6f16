// snug materials: what ships and a law's curve; the library's own commands stand in library_commands.cpp.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "cases/input/suggestion.hpp"
#include "materials/laws/one_point.hpp"
#include "materials/laws/solid_law.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/library_commands.hpp"
#include "solver/app/fabric_curves.hpp"
#include "solver/app/material_fit.hpp"
#include "solver/app/material_list.hpp"

namespace snug::app {

namespace {

using materials::Loading;

const std::map<std::string, Loading>& loadings() {
  static const std::map<std::string, Loading> all = {{"uniaxial", Loading::uniaxial},
                                                     {"equibiaxial", Loading::equibiaxial},
                                                     {"planar", Loading::planar},
                                                     {"shear", Loading::shear},
                                                     {"confined", Loading::confined}};
  return all;
}

/// What the curve of one entry runs over.
struct Curve {
  std::string mode = "uniaxial";
  double from = 0.7, to = 1.5;
  int steps = 16;
  std::string picture;
  bool table = false;
};

input::InputError wrong(const std::string& found, const std::string& remedy) {
  return {{"snug materials curve", 0, 0}, found, remedy};
}

/// CSV of one-point states, one row a stretch (in shear: amount of shear).
void print_curve(const std::string& name, const Curve& curve, Console& console) {
  const Loading loading = loadings().at(curve.mode);
  if (loading != Loading::shear && !(curve.from > 0.0 && curve.to > 0.0))
    throw wrong(fmt::format("a stretch from {} to {}", curve.from, curve.to),
                "stretches are greater than 0; 1 is the rest");
  input::MaterialEntry asked;
  asked.name = name;
  asked.where = {"snug materials curve", 0, 0};
  const materials::Tissue tissue = materials::find_tissue(asked);
  console.document() = {{"name", name}, {"mode", curve.mode}, {"states", Json::array()}};
  console.print("{},nominal stress [Pa],Cauchy stress [Pa],J,lateral stretch\n",
             loading == Loading::shear ? "shear" : "stretch");
  for (int i = 0; i <= curve.steps; ++i) {
    const double stretch = curve.from + (curve.to - curve.from) * i / curve.steps;
    const auto state = materials::one_point(tissue.law, loading, stretch);
    if (!state)
      throw wrong(fmt::format("{} has no stable state at stretch {:.6g}", name, stretch),
                  "stay between the stretches printed");
    console.print("{:.10g},{:.10g},{:.10g},{:.12g},{:.12g}\n", stretch, state->nominal_stress, state->cauchy_stress, state->J, state->lateral);
    console.document()["states"].push_back({{loading == Loading::shear ? "shear" : "stretch", stretch}, {"nominal_stress_Pa", state->nominal_stress}, {"Cauchy_stress_Pa", state->cauchy_stress},
                                            {"J", state->J}, {"lateral_stretch", state->lateral}});
  }
}

bool is_tissue(const std::string& name) {
  const std::vector<std::string> names = materials::tissue_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

Json curves_json(const std::vector<materials::FabricData>& fabrics, int steps) {
  Json json = Json::array();
  for (const materials::FabricData& fabric : fabrics) {
    Json curves = Json::array();
    for (const FabricCurve& curve : fabric_curves(fabric, steps)) {
      const char* at = curve.test == FabricCurve::Test::tensile ? "strain" : "angle_rad";
      Json points = Json::array();
      for (const FabricCurve::Point& point : curve.points) points.push_back({{at, point.at}, {"force_N_per_m", point.force}, {"beyond_data", point.beyond}});
      curves.push_back({{"curve", curve.name()}, {"points", points}});
    }
    json.push_back({{"fabric", fabric.loading.name}, {"curves", curves}});
  }
  return json;
}

class ListMaterials : public Command {
 public:
  std::string name() const override { return "list"; }
  std::string summary() const override { return "the names of all entries that a case may have"; }
  void declare(CLI::App&) override {}
  int execute() override {
    console().say(materials_text());
    console().document() = materials_json();
    return done;
  }
};

class ShowMaterial : public Command {
 public:
  std::string name() const override { return "show"; }
  std::string summary() const override { return "values and source of one entry"; }
  void declare(CLI::App& app) override { app.add_option("NAME", entry_, "fabric, tissue or anything else of the library")->required(); }
  int execute() override {
    console().say(material_text(entry_));
    console().document()["entity"] = known_data_json(entry_);
    return done;
  }

 private:
  std::string entry_;
};

class ShowCurve : public Command {
 public:
  std::string name() const override { return "curve"; }
  std::string summary() const override { return "stress over stretch of a tissue, or the tensile and shear curves of a fabric: CSV, a picture"; }
  void declare(CLI::App& app) override {
    app.add_option("NAME", entry_, "tissue; fabric of the library; directory of a case, whose garments' fabrics are drawn; or a .toml file of fabrics")->required();
    app.add_option("--out", options_.picture, "fabric: file of the picture, .svg");
    app.add_flag("--csv", options_.table, "fabric: the table, too, where there is a picture");
    std::vector<std::string> modes;
    for (const auto& [mode, loading] : loadings()) modes.push_back(mode);
    app.add_option("--mode", options_.mode, input::joined(modes) + "; what is not driven is free, or held where the mode says so")->check(CLI::IsMember(modes))->capture_default_str();
    app.add_option("--from", options_.from, "first stretch (shear: amount of shear)")->capture_default_str();
    app.add_option("--to", options_.to, "last one")->capture_default_str();
    app.add_option("--steps", options_.steps, "number of steps")->check(CLI::PositiveNumber)->capture_default_str();
  }
  int execute() override {
    if (is_tissue(entry_)) print_curve(entry_, options_, console());
    else show_fabrics();
    return done;
  }

 private:
  /// A picture where one is asked for, else the table.
  void show_fabrics() const {
    const auto fabrics = fabrics_to_draw(entry_);
    console().document()["fabrics"] = curves_json(fabrics, options_.steps);
    if (!options_.picture.empty()) {
      write_fabric_picture(fabrics, options_.picture);
      console().print("picture: {}\n", options_.picture);
    }
    if (options_.picture.empty() || options_.table) console().say_as_it_is(fabric_table(fabrics, options_.steps));
  }

  std::string entry_;
  Curve options_;
};

class Materials : public CommandGroup {
 public:
  Materials()
      : CommandGroup("materials", "fabrics, tissues and the engineering database: what is known, questions, own entries",
                     "The library is the file that SNUG_LIBRARY names, else snug/library.db in your data folder; it is made when it is first needed. docs/library.md shows it by example.") {
    commands_.push_back(std::make_unique<ListMaterials>());
    commands_.push_back(std::make_unique<ShowMaterial>());
    commands_.push_back(std::make_unique<ShowCurve>());
    commands_.push_back(make_fit());
    for (auto& command : library_commands()) commands_.push_back(std::move(command));
  }
};

}  // namespace

std::unique_ptr<Command> make_materials() { return std::make_unique<Materials>(); }

}  // namespace snug::app
