// snug materials: what ships and a law's curve; the library's own commands stand in library_commands.cpp.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "cases/input/suggestion.hpp"
#include "materials/laws/one_point.hpp"
#include "materials/laws/solid_law.hpp"
#include "solver/app/command.hpp"
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
void print_curve(const std::string& name, const Curve& curve) {
  const Loading loading = loadings().at(curve.mode);
  if (loading != Loading::shear && !(curve.from > 0.0 && curve.to > 0.0))
    throw wrong(fmt::format("a stretch from {} to {}", curve.from, curve.to),
                "stretches are greater than 0; 1 is the rest");
  input::MaterialEntry asked;
  asked.name = name;
  asked.where = {"snug materials curve", 0, 0};
  const materials::Tissue tissue = materials::find_tissue(asked);
  fmt::print("{},nominal stress [Pa],Cauchy stress [Pa],J,lateral stretch\n",
             loading == Loading::shear ? "shear" : "stretch");
  for (int i = 0; i <= curve.steps; ++i) {
    const double stretch = curve.from + (curve.to - curve.from) * i / curve.steps;
    const auto state = materials::one_point(tissue.law, loading, stretch);
    if (!state)
      throw wrong(fmt::format("{} has no stable state at stretch {:.6g}", name, stretch),
                  "stay between the stretches printed");
    fmt::print("{:.10g},{:.10g},{:.10g},{:.12g},{:.12g}\n", stretch, state->nominal_stress, state->cauchy_stress,
               state->J, state->lateral);
  }
}

bool is_tissue(const std::string& name) {
  const std::vector<std::string> names = materials::tissue_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A picture where one is asked for, else the table.
void show_fabrics(const std::string& name, const Curve& options) {
  const auto fabrics = fabrics_to_draw(name);
  if (!options.picture.empty()) {
    write_fabric_picture(fabrics, options.picture);
    fmt::print("picture: {}\n", options.picture);
  }
  if (options.picture.empty() || options.table) fmt::print("{}", fabric_table(fabrics, options.steps));
}

class Materials : public Command {
 public:
  std::string name() const override { return "materials"; }
  std::string summary() const override {
    return "fabrics, tissues and the engineering database: what is known, questions, own entries";
  }

  Materials() { library_.push_back(make_fit()); }
  void declare(CLI::App& app) override {
    app.require_subcommand(1);
    app.add_subcommand("list", "the names of all entries that a case may have");
    show_ = app.add_subcommand("show", "values and source of one entry");
    show_->add_option("NAME", entry_, "fabric, tissue or anything else of the library")->required();
    curve_ = app.add_subcommand("curve", "stress over stretch of a tissue, or the tensile and shear curves of a fabric: CSV, a picture");
    curve_->add_option("NAME", entry_, "tissue; fabric of the library; directory of a case, whose garments' fabrics are drawn; or a .toml file of fabrics")
        ->required();
    curve_->add_option("--out", options_.picture, "fabric: file of the picture, .svg");
    curve_->add_flag("--csv", options_.table, "fabric: the table, too, where there is a picture");
    std::vector<std::string> modes;
    for (const auto& [mode, loading] : loadings()) modes.push_back(mode);
    curve_
        ->add_option("--mode", options_.mode,
                     input::joined(modes) + "; what is not driven is free, or held where the mode says so")
        ->check(CLI::IsMember(modes))
        ->capture_default_str();
    curve_->add_option("--from", options_.from, "first stretch (shear: amount of shear)")->capture_default_str();
    curve_->add_option("--to", options_.to, "last one")->capture_default_str();
    curve_->add_option("--steps", options_.steps, "number of steps")->check(CLI::PositiveNumber)->capture_default_str();
    for (const auto& command : library_) {
      CLI::App* sub = app.add_subcommand(command->name(), command->summary());
      command->declare(*sub);
      parsers_.push_back(sub);
    }
    app.footer(
        "The library is the file that SNUG_LIBRARY names, else snug/library.db in your data folder; it is made when it "
        "is first needed. docs/library.md shows it by example.");
  }

  int execute() override {
    for (std::size_t n = 0; n < library_.size(); ++n)
      if (parsers_[n]->parsed()) return library_[n]->execute();
    if (curve_->parsed()) {
      if (is_tissue(entry_)) print_curve(entry_, options_);
      else show_fabrics(entry_, options_);
      return done;
    }
    fmt::print("{}", show_->parsed() ? material_text(entry_) : materials_text());
    return done;
  }

 private:
  CLI::App *show_ = nullptr, *curve_ = nullptr;  // owned by the program's parser
  std::vector<std::unique_ptr<Command>> library_ = library_commands();
  std::vector<CLI::App*> parsers_;
  std::string entry_;
  Curve options_;
};

}  // namespace

std::unique_ptr<Command> make_materials() { return std::make_unique<Materials>(); }

}  // namespace snug::app
