// snug pattern FILE: draws, checks and grades a sewing pattern.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cases/input/units.hpp"
#include "mesh/pattern/checks.hpp"
#include "mesh/pattern/drawing.hpp"
#include "mesh/pattern/garmentcode.hpp"
#include "mesh/pattern/read_pattern.hpp"
#include "mesh/pattern/sewn_mesh.hpp"
#include "solver/app/command.hpp"
#include "solver/app/pattern_table.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

class PatternCommand : public Command {
 public:
  std::string name() const override { return "pattern"; }
  std::string summary() const override { return "draws, checks and grades the pieces of a sewing pattern"; }

  void declare(CLI::App& app) override {
    app.add_option("FILE", file_,
                   "pattern: .toml (ours, docs/patterns.md), .json (GarmentCode), .dxf (AAMA, ASTM) or .svg (outlines)")
        ->required();
    app.add_option("--out", out_, "folder for the drawing, NAME.svg")->capture_default_str();
    app.add_option("--grade", grade_, "GIRTH LENGTH: stretch every piece across and along by these factors, 0.96 1.02")
        ->expected(2)
        ->check(CLI::Range(0.2, 5.0));
    app.add_option("--write", write_,
                   "also write the pattern, graded where that is asked for, as this file: .json (GarmentCode)");
    app.add_option("--cells", cells_, "mesh the pieces with cells of this size (\"8 mm\"), count and draw them");
  }

  int execute() override {
    mesh::Pattern pattern = mesh::read_pattern(file_);
    if (!grade_.empty()) {
      mesh::check_pieces(pattern);
      pattern = mesh::graded(pattern, grade_[0], grade_[1]);
      pattern.title += fmt::format(" (girth x {:g}, length x {:g})", grade_[0], grade_[1]);
    }
    const mesh::CheckedPattern checked = mesh::checked(std::move(pattern));
    for (const input::Diagnostic& warning : checked.warnings) fmt::print(stderr, "{}\n", input::warning_text(warning));
    fmt::print("{}", pattern_table(checked));
    std::optional<mesh::SewnMesh> mesh;
    if (!cells_.empty()) {
      mesh = mesh::mesh_pattern(checked, cell_size());
      fmt::print("{}", mesh_table(*mesh));
    }
    fs::create_directories(out_);
    const fs::path drawing = fs::path(out_) / (fs::path(file_).stem().string() + ".svg");
    write_named(drawing.string(), mesh::drawing_svg(checked, mesh ? &*mesh : nullptr));
    fmt::print("\ndrawing: {}\n", drawing.string());
    if (!write_.empty()) write(checked);
    return done;
  }

 private:
  double cell_size() const {
    const input::Quantity size = input::to_si(cells_, "m");
    if (size.ok() && size.value > 0.0) return size.value;
    throw input::InputError({.file = "--cells"}, size.ok() ? "\"" + cells_ + "\" is no size" : size.found,
                            "give a length with its unit, \"8 mm\"");
  }

  void write(const mesh::CheckedPattern& checked) const {
    if (fs::path(write_).extension() != ".json")
      throw input::InputError({.file = "--write"}, "\"" + write_ + "\" has no ending that patterns are written with",
                              "name a .json file (GarmentCode)");
    write_named(write_, mesh::garmentcode_text(checked));
    fmt::print("pattern: {}\n", write_);
  }

  std::string file_, out_ = ".", cells_, write_;
  std::vector<double> grade_;
};

}  // namespace

std::unique_ptr<Command> make_pattern() { return std::make_unique<PatternCommand>(); }

}  // namespace snug::app
