// snug compare RESULT REFERENCE: nodal values against each other.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cases/input/units.hpp"
#include "postproc/comparison.hpp"
#include "postproc/field_cells.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

double quantity_in(const std::string& option, const std::string& text, const std::string& unit) {
  const input::Quantity quantity = input::to_si(text, unit);
  if (!quantity.ok())
    throw input::InputError(
        {option, 0, 0}, quantity.found,
        fmt::format("write {} such as \"{}\"", input::dimension_name(unit), input::example_quantity(unit)));
  return quantity.value;
}

class Compare : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string summary() const override {
    return "nodal tables against each other: RMS, maximum, worst nodes and extremes of every column";
  }

  void declare(CLI::App& app) override {
    app.add_option("RESULT", result_, "results of a run (a directory), a VTU file of a body, or a listing")->required();
    app.add_option("REFERENCE", reference_, "the same: PRNSOL, PRESOL and NLIST listings are read")->required();
    app.add_option("--match", match_,
                   "how nodes find each other; automatic: by number where places agree or are not known")
        ->check(CLI::IsMember({"automatic", "number", "coordinates"}))
        ->capture_default_str();
    app.add_option("--columns", columns_, "columns to compare, e.g. UX,UY,UZ (all of the reference)")->delimiter(',');
    app.add_option("--relative", relative_, "what a node may differ by, over the largest value of the same quantity")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--absolute-displacement", absolute_displacement_, "what a displacement may differ by besides")
        ->type_name("LENGTH");
    app.add_option("--absolute-stress", absolute_stress_, "what a stress may differ by besides")->type_name("STRESS");
    app.add_option("--within", within_, "how far a node may lie from its counterpart (by coordinates)")
        ->type_name("LENGTH");
    app.add_option("--reference-nodes", reference_nodes_, "listing of the reference's nodes (NLIST)")
        ->type_name("FILE");
    app.add_option("--result-nodes", result_nodes_, "listing of the result's nodes (NLIST)")->type_name("FILE");
    app.add_option("--length-unit", length_unit_, "unit of the reference listing's lengths")->capture_default_str();
    app.add_option("--stress-unit", stress_unit_, "unit of the reference listing's stresses")->capture_default_str();
    app.add_option("--load-step", load_step_, "load step of the reference listing that is taken (the last)")->check(CLI::PositiveNumber);
    app.add_option("--surface", surface_, "surface of shells that is taken: top, middle or bottom (all)")
        ->check(CLI::IsMember({"top", "middle", "bottom"}));
    app.add_flag("--all", all_, "list the worst nodes of the columns within their tolerance too");
    app.add_option("--vtu", vtu_, "write result, reference and difference at the nodes")->type_name("FILE");
    app.footer(
        "Exit status: 0 within the tolerance, 1 outside or with nodes that have no counterpart, 2 wrong input.\n"
        "The tolerance left out is the precision with which a listing is printed, 5e-5 of the largest value.");
  }

  int execute() override {
    const postproc::NodalField result = postproc::read_field(result_, {.surface = surface(), .nodes = result_nodes_});
    const postproc::NodalField reference =
        postproc::read_field(reference_, {.length_unit = quantity_in("--length-unit", "1 " + length_unit_, "m"),
                                          .stress_unit = quantity_in("--stress-unit", "1 " + stress_unit_, "Pa"),
                                          .surface = surface(),
                                          .load_step = load_step_ > 0 ? std::optional(load_step_) : std::nullopt,
                                          .nodes = reference_nodes_});
    const postproc::Comparison comparison = postproc::compare(result, reference, options());
    write_difference(comparison);
    console().say(postproc::comparison_text(comparison, all_ ? postproc::Detail::all : postproc::Detail::outside));
    console().document() = comparison_json(comparison);
    return comparison.within() ? done : outside_tolerance;
  }

 private:
  std::optional<postproc::ShellSurface> surface() const {
    if (surface_.empty()) return std::nullopt;
    return surface_ == "top"      ? postproc::ShellSurface::top
           : surface_ == "middle" ? postproc::ShellSurface::middle
                                  : postproc::ShellSurface::bottom;
  }

  postproc::ComparisonOptions options() const {
    postproc::ComparisonOptions options;
    options.matching = match_ == "number"        ? postproc::Matching::by_number
                       : match_ == "coordinates" ? postproc::Matching::by_coordinates
                                                 : postproc::Matching::automatic;
    options.displacement = options.stress = options.other = {relative_, 0.0};
    if (!absolute_displacement_.empty())
      options.displacement.absolute = quantity_in("--absolute-displacement", absolute_displacement_, "m");
    if (!absolute_stress_.empty()) options.stress.absolute = quantity_in("--absolute-stress", absolute_stress_, "Pa");
    if (!within_.empty()) options.within = quantity_in("--within", within_, "m");
    options.columns = columns_;
    return options;
  }

  void write_difference(const postproc::Comparison& comparison) const {
    if (vtu_.empty()) return;
    if (comparison.difference.places.empty())
      throw input::InputError({"--vtu", 0, 0}, "the coordinates of the nodes are not known",
                              "give them with --reference-nodes or --result-nodes");
    const fs::path folder = fs::absolute(vtu_).parent_path();
    if (!fs::is_directory(folder))
      throw input::InputError({"--vtu", 0, 0}, "there is no directory " + folder.string(), "make it, or name another");
    postproc::write_columns(comparison.difference, vtu_);
  }

  std::string result_, reference_, match_ = "automatic", absolute_displacement_, absolute_stress_, within_;
  std::string reference_nodes_, result_nodes_, length_unit_ = "m", stress_unit_ = "Pa", surface_;
  std::string vtu_;
  bool all_ = false;
  int load_step_ = 0;
  double relative_ = postproc::printed_precision;
  std::vector<std::string> columns_;
};

}  // namespace

std::unique_ptr<Command> make_compare() { return std::make_unique<Compare>(); }

}  // namespace snug::app
