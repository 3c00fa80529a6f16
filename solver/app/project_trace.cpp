// From a result down to the data that its case read.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/input/suggestion.hpp"
#include "materials/database/named.hpp"
#include "materials/database/snapshot.hpp"
#include "solver/app/project_text.hpp"

namespace snug::app {

using materials::Datum, materials::Entity, materials::RunMaterial, materials::RunRecord, materials::RunValue;

namespace {

std::string as_printed(const Datum& datum) {
  return datum.type == materials::DatumType::equation ? datum.value + (datum.unit.empty() ? "" : " [" + datum.unit + "]") : materials::quantity_text(datum);
}

/// What the library says today of a datum that a run read; empty: the same.
std::string today(const Datum& then, const std::optional<Entity>& now) {
  if (!now) return "the library no longer has the entity";
  const Datum* datum = now->find(then.name);
  if (!datum) return "the library no longer has it";
  return as_printed(*datum) == as_printed(then) && datum->source == then.source ? "" : "today " + as_printed(*datum) + (datum->source.empty() ? "" : ", " + datum->source);
}

/// Where a datum comes from: its own source, else that of all data of its entity.
std::string source_of(const Datum& datum, const Entity& entity) {
  const Datum* common = entity.find("source");
  return datum.source.empty() && common ? common->value : datum.source;
}

std::string material_rows(const RunRecord& run, const RunMaterial& named, const materials::Library& library) {
  const Entity entity = materials::from_snapshot(library.file(named.snapshot).content);
  const auto now = library.find(named.entity);
  std::string text = fmt::format("  {} = {} of the library\n", named.part, named.entity);
  std::vector<std::vector<std::string>> rows;
  const std::string prefix = named.part + ".";
  for (const RunValue& used : run.settings) {
    if (!used.name.starts_with(prefix)) continue;
    const std::string item = used.name.substr(prefix.size());
    if (item == "name" || item == "source" || item.starts_with("assumptions")) continue;
    const Datum* datum = entity.find(item);
    rows.push_back({"  " + item, used.value, datum ? as_printed(*datum) : "not of the entity: the law's own, or follows from the others",
                    datum && item != "law" ? source_of(*datum, entity) : "", datum ? today(*datum, now) : ""});
  }
  // Texts to the left.
  std::vector<std::size_t> widest(5, 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widest[c] = std::max(widest[c], row[c].size());
  for (const auto& row : rows) {
    std::string line = "  ";
    for (std::size_t c = 0; c < row.size(); ++c) line += row[c] + std::string(widest[c] - row[c].size() + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// Numbers of the case itself that decide about garments and contact; those under a named material stand there.
std::string case_rows(const RunRecord& run) {
  std::string text;
  for (const RunValue& one : run.settings) {
    const bool named = std::any_of(run.materials.begin(), run.materials.end(), [&](const RunMaterial& m) { return one.name.starts_with(m.part + "."); });
    const bool of_material = one.name.find(".material.") != one.name.npos || one.name.find(".fabric.") != one.name.npos;
    if (named || !(one.name.starts_with("garment") || one.name.starts_with("contact") || of_material)) continue;
    text += fmt::format("    {} = {}\n", one.name, one.value);
  }
  return text.empty() ? text : "  of the case\n" + text;
}

}  // namespace

std::string trace_text(const RunRecord& run, const std::string& result, const materials::Library& library, const PressureUnit& unit) {
  const RunValue* value = run.result(result);
  if (!value) {
    std::vector<std::string> known;
    for (const RunValue& one : run.results) known.push_back(one.name);
    throw input::InputError({"snug project trace", 0, 0}, fmt::format("run {} has no result \"{}\"", run.number, result),
                            known.empty() ? "nothing converged in it" : input::did_you_mean(result, known));
  }
  std::string text = fmt::format("{} = {}{}\n", result, value->value + (value->unit.empty() ? "" : " " + value->unit),
                                 value->unit == "Pa" && unit.name != "Pa" ? " = " + shown(*value, unit) + " " + unit.name : "");
  text += fmt::format("  run {} of project {}, {} by {}: {}\n", run.number, run.project, run.moment, run.who, run.status);
  text += fmt::format("  results {} ({})\n", run.place, text_of(whereabouts(run)));
  for (const RunValue& one : run.versions)
    if (one.name == "snug") text += "  computed by snug " + one.value + "\n";
  text += fmt::format("  case {}, hash {}\n", run.directory, run.case_hash);
  for (const RunValue& file : run.inputs) text += fmt::format("  input {}, hash {}\n", file.name, file.value);
  for (const RunMaterial& named : run.materials) text += material_rows(run, named, library);
  return text + case_rows(run);
}

}  // namespace snug::app
