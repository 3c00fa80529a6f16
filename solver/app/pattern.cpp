// snug pattern FILE: draws, checks and grades a sewing pattern, and places it on a scanned body.
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
#include "solver/app/documents.hpp"
#include "solver/app/pattern_placing.hpp"
#include "solver/app/pattern_table.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

class PatternCommand : public Command {
 public:
  std::string name() const override { return "pattern"; }
  std::string summary() const override { return "draws, checks and grades the pieces of a sewing pattern, places it on a body"; }

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
    app.add_option("--on", scan_,
                   "place the garment on this closed surface of a standing body (OBJ, STL, v/f text) and write garment.vtu, "
                   "body.vtu and placed.svg into the folder; cells of 13 mm unless --cells says another size");
    app.add_option("--up", up_, "axis of the surface's file that points up: x, y, z, -x, -y, -z")->capture_default_str();
    app.add_option("--front", front_, "axis of that file that points to the front of the body; left out: where the toes are");
    app.add_option("--unit", unit_, "length of one unit of that file")->capture_default_str();
    app.add_option("--height", height_, "raise the garment by this (\"-20 mm\": lower) against where it would be laid");
  }

  int execute() override {
    mesh::Pattern pattern = mesh::read_pattern(file_);
    if (!grade_.empty()) {
      mesh::check_pieces(pattern);
      pattern = mesh::graded(pattern, grade_[0], grade_[1]);
      pattern.title += fmt::format(" (girth x {:g}, length x {:g})", grade_[0], grade_[1]);
    }
    const mesh::CheckedPattern checked = mesh::checked(std::move(pattern));
    for (const input::Diagnostic& warning : checked.warnings) console().warn(warning);
    console().say(pattern_table(checked));
    console().document() = pattern_json(checked);
    std::optional<mesh::SewnMesh> mesh;
    if (!cells_.empty() || !scan_.empty()) {
      mesh = mesh::mesh_pattern(checked, cells_.empty() ? 0.013 : positive("--cells", cells_));
      console().say(mesh_table(*mesh));
      console().document()["mesh"] = mesh_json(*mesh);
    }
    fs::create_directories(out_);
    const fs::path drawing = fs::path(out_) / (fs::path(file_).stem().string() + ".svg");
    write_named(drawing.string(), mesh::drawing_svg(checked, mesh ? &*mesh : nullptr));
    console().print("\ndrawing: {}\n", drawing.string());
    console().document()["files"].push_back(drawing.string());
    if (!write_.empty()) write(checked);
    if (!scan_.empty()) place_on_scan(checked, *mesh, request(), console());
    return done;
  }

 private:
  double length(const char* option, const std::string& text) const {
    const input::Quantity size = input::to_si(text, "m");
    if (size.ok()) return size.value;
    throw input::InputError({.file = option}, size.found, "give a length with its unit, \"8 mm\"");
  }

  double positive(const char* option, const std::string& text) const {
    const double size = length(option, text);
    if (size > 0.0) return size;
    throw input::InputError({.file = option}, "\"" + text + "\" is no size", "give a length with its unit, \"8 mm\"");
  }

  input::FileAxis axis(const char* option, const std::string& text) const {
    if (const auto found = input::choice_of<input::FileAxis>(text)) return *found;
    throw input::InputError({.file = option}, "\"" + text + "\" is no axis", "write x, y, z, -x, -y or -z");
  }

  PlacingRequest request() const {
    PlacingRequest result{.scan = scan_, .axes = {positive("--unit", unit_), axis("--up", up_)}, .options = {}, .out = out_};
    if (!front_.empty()) result.axes.front = axis("--front", front_);
    if (!height_.empty()) result.options.raise = length("--height", height_);
    return result;
  }

  void write(const mesh::CheckedPattern& checked) const {
    if (fs::path(write_).extension() != ".json")
      throw input::InputError({.file = "--write"}, "\"" + write_ + "\" has no ending that patterns are written with",
                              "name a .json file (GarmentCode)");
    write_named(write_, mesh::garmentcode_text(checked));
    console().print("pattern: {}\n", write_);
    console().document()["files"].push_back(write_);
  }

  std::string file_, out_ = ".", cells_, write_, scan_, up_ = "y", front_, unit_ = "1 m", height_;
  std::vector<double> grade_;
};

}  // namespace

std::unique_ptr<Command> make_pattern() { return std::make_unique<PatternCommand>(); }

}  // namespace snug::app
