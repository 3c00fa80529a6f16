#include "solver/app/regression.hpp"

#include <fmt/format.h>

#include "cases/input/files.hpp"
#include "postproc/field_cells.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

std::optional<postproc::ShellSurface> surface_of(input::StressSurface surface) {
  switch (surface) {
    case input::StressSurface::top: return postproc::ShellSurface::top;
    case input::StressSurface::middle: return postproc::ShellSurface::middle;
    case input::StressSurface::bottom: return postproc::ShellSurface::bottom;
    case input::StressSurface::all: break;
  }
  return std::nullopt;
}

postproc::Matching matching_of(input::NodeMatch match) {
  return match == input::NodeMatch::number        ? postproc::Matching::by_number
         : match == input::NodeMatch::coordinates ? postproc::Matching::by_coordinates
                                                  : postproc::Matching::automatic;
}

/// A listing may hold more than what the case compares with it.
std::vector<std::string> labels_of(const postproc::NodalField& field, postproc::Quantity quantity,
                                   const fs::path& file) {
  std::vector<std::string> labels;
  for (const postproc::NodalColumn& column : field.columns)
    if (postproc::quantity_of(column.label) == quantity) labels.push_back(column.label);
  if (labels.empty())
    throw input::InputError({file.string(), 0, 0}, "it has no column of the quantity that [reference] names it for",
                            "give displacements UX UY UZ USUM as displacement, stresses S1 S2 S3 SINT SEQV as stress");
  return labels;
}

}  // namespace

std::vector<ReferenceTable> read_references(const input::Case& description) {
  std::vector<ReferenceTable> tables;
  if (!description.reference) return tables;
  const input::ReferenceSpec& spec = *description.reference;
  postproc::FieldOptions reading{.length_unit = spec.length_unit,
                                 .stress_unit = spec.stress_unit,
                                 .surface = {},
                                 .load_step = spec.load_step,
                                 .nodes = spec.nodes.value_or(fs::path())};
  const auto add = [&](const char* name, postproc::Quantity quantity, const fs::path& file) -> ReferenceTable& {
    ReferenceTable& table = tables.emplace_back();
    table.quantity = name;
    table.field = postproc::read_field(file, reading);
    table.surface = reading.surface;
    table.options.matching = matching_of(spec.match);
    table.options.columns = labels_of(table.field, quantity, file);
    return table;
  };
  if (const auto& given = spec.displacement)
    add("displacement", postproc::Quantity::displacement, given->file).options.displacement = {given->relative,
                                                                                               given->absolute};
  if (const auto& given = spec.stress) {
    reading.surface = surface_of(given->surface);
    add("stress", postproc::Quantity::stress, given->file).options.stress = {given->relative, given->absolute};
  }
  return tables;
}

std::vector<postproc::Comparison> compare_with(const std::vector<ReferenceTable>& references, postproc::StoredRun& run, const fs::path& folder,
                                               const fs::path& shown_as) {
  std::vector<postproc::Comparison> comparisons;
  if (references.empty()) return comparisons;
  if (!run.body_grid)
    throw input::InputError({shown_as.string(), 0, 0}, "the result has no body to compare with [reference]", "leave [reference] out");
  std::string text;
  for (const ReferenceTable& reference : references) {
    const postproc::NodalField result = postproc::nodal_field(*run.body_grid, shown_as.string(), reference.surface);
    const postproc::Comparison& comparison =
        comparisons.emplace_back(postproc::compare(result, reference.field, reference.options));
    text += postproc::comparison_text(comparison) + '\n';
    if (!comparison.difference.places.empty())
      postproc::write_columns(comparison.difference, folder / ("difference_" + reference.quantity + ".vtu"));
  }
  input::write_file(folder / "comparison.txt", text);
  run.comparison = text;
  return comparisons;
}

std::string verdict_text(const std::vector<postproc::Comparison>& comparisons) {
  std::string text;
  for (const postproc::Comparison& comparison : comparisons) {
    text += fmt::format("  reference          {}: {} nodes {}", comparison.reference, comparison.compared,
                        comparison.matching);
    text += comparison.missing > 0 ? fmt::format("; {} nodes OUTSIDE\n", comparison.missing) : "\n";
    for (const postproc::ColumnComparison& column : comparison.columns)
      text += fmt::format("    {:<6} RMS {:.3g}, maximum {:.3g} {} (tolerance {:.3g})  {}\n", column.label, column.rms,
                          column.maximum, column.unit, column.tolerance, column.within ? "within" : "OUTSIDE");
  }
  return text;
}

}  // namespace snug::app
