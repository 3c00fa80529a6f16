#include "solver/app/project_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/files.hpp"
#include "cases/input/suggestion.hpp"
#include "materials/database/sha256.hpp"
#include "postproc/store.hpp"

namespace snug::app {

namespace fs = std::filesystem;

using materials::RunRecord, materials::RunValue;

namespace {

/// Whether a file has that content.
std::optional<bool> is_same(const fs::path& file, const std::string& hash) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  try {
    return materials::sha256(input::read_file(file)) == hash;
  } catch (const std::exception&) {
    return false;
  }
}

std::string change_text(double value, double first) {
  return first == 0.0 || !std::isfinite(value / first) ? std::string() : fmt::format(" ({:+.1f} %)", 100.0 * (value - first) / std::abs(first));
}

}  // namespace

Whereabouts whereabouts(const RunRecord& run) {
  const auto same = is_same(fs::path(run.place) / postproc::summary_file, run.proof);
  return !same ? Whereabouts::gone : *same ? Whereabouts::as_recorded : Whereabouts::others;
}

std::string text_of(Whereabouts whereabouts) {
  switch (whereabouts) {
    case Whereabouts::as_recorded: return "as recorded";
    case Whereabouts::others: return "others are there now";
    case Whereabouts::gone: break;
  }
  return "no longer there";
}

PressureUnit::PressureUnit(const std::string& asked) : name(asked) {
  materials::UnitBook units;
  const auto unit = units.find(asked), pascal = units.find("Pa");
  if (!unit || unit->name != pascal->name)
    throw input::InputError({"--unit", 0, 0}, "\"" + asked + "\" is no unit of pressure", "write Pa, kPa, gf/cm2 or mmHg");
  factor = unit->factor;
}

std::string shown(const RunValue& value, const PressureUnit& unit) {
  if (!value.number) return value.value;
  if (value.unit == "Pa") return fmt::format("{:.4g}", *value.number / unit.factor);
  return fmt::format("{:.4g}", *value.number);
}

std::vector<std::string> locations_of(const std::vector<RunRecord>& runs) {
  std::vector<std::string> names;
  for (const RunRecord& run : runs)
    for (const RunValue& one : run.results)
      if (one.unit == "Pa" && one.name.find(", largest") == one.name.npos && std::find(names.begin(), names.end(), one.name) == names.end())
        names.push_back(one.name);
  return names;
}

std::vector<Difference> differences(const std::vector<RunRecord>& runs) {
  std::vector<std::string> keys;
  for (const RunRecord& run : runs)
    for (const RunValue& one : run.settings)
      if (!one.name.ends_with(".source") && std::find(keys.begin(), keys.end(), one.name) == keys.end()) keys.push_back(one.name);  // a source follows from the name
  std::vector<Difference> found;
  for (const std::string& key : keys) {
    Difference row{key, {}};
    for (const RunRecord& run : runs) {
      const RunValue* value = run.setting(key);
      row.values.push_back(value ? value->value : "-");
    }
    if (std::any_of(row.values.begin(), row.values.end(), [&](const std::string& one) { return one != row.values.front(); })) found.push_back(std::move(row));
  }
  return found;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  // Bytes that go on with a letter of UTF-8 take no width.
  const auto width = [](const std::string& text) { return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }); };
  std::vector<std::ptrdiff_t> widest;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widest.size()) widest.push_back(0);
      widest[c] = std::max(widest[c], width(row[c]));
    }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(static_cast<std::size_t>(widest[c] - width(row[c])), ' ');
      line += c == 0 ? row[c] + blanks : "  " + blanks + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += "  " + line + "\n";
  }
  return text;
}

std::string minute_of(const std::string& moment) {
  std::string minute = moment.substr(0, 16);
  if (minute.size() == 16) minute[10] = ' ';
  return minute;
}

std::string run_text(const RunRecord& run, const PressureUnit& unit) {
  std::string text = fmt::format("run {} of project {}: {}\n", run.number, run.project, run.title);
  const auto line = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<10} {}\n", name, value);
  };
  line("status", run.status + (run.message.empty() ? "" : ", " + run.message));
  line("note", run.note);
  line("recorded", run.moment + " by " + run.who + fmt::format(", {:.1f} s", run.seconds));
  line("results", run.place + " (" + text_of(whereabouts(run)) + ")");
  line("command", run.command);
  line("case", run.directory + ", hash " + run.case_hash.substr(0, 12));
  if (run.parent) line("derived", fmt::format("from run {}", *run.parent));
  for (const RunValue& file : run.inputs) {
    const auto same = is_same(fs::path(run.directory) / file.name, file.value);
    line("input", fmt::format("{}, {:.0f} bytes, hash {} ({})", file.name, file.number.value_or(0.0), file.value.substr(0, 12),
                              !same ? "no longer there" : *same ? "unchanged" : "changed since"));
  }
  for (const materials::RunMaterial& one : run.materials) line("material", one.part + " = " + one.entity);
  for (const RunValue& one : run.versions) line("version", one.name + " " + one.value);
  std::vector<std::vector<std::string>> rows;
  for (const RunValue& one : run.results) rows.push_back({one.name, shown(one, unit), one.unit == "Pa" ? unit.name : ""});
  return text + aligned(rows);
}

std::string comparison_text(const std::vector<RunRecord>& runs, const PressureUnit& unit) {
  std::vector<std::vector<std::string>> rows{{"run"}, {"status"}};
  for (const RunRecord& run : runs) rows[0].push_back(std::to_string(run.number)), rows[1].push_back(run.status);
  for (const Difference& row : differences(runs)) {
    rows.push_back({row.key});
    rows.back().insert(rows.back().end(), row.values.begin(), row.values.end());
  }
  std::vector<std::string> names;
  for (const RunRecord& run : runs)
    for (const RunValue& one : run.results)
      if (std::find(names.begin(), names.end(), one.name) == names.end()) names.push_back(one.name);
  for (const std::string& name : names) {
    std::vector<std::string> row;
    const RunValue* first = runs.front().result(name);
    for (const RunRecord& run : runs) {
      const RunValue* value = run.result(name);
      if (row.empty()) row.push_back(name + (value && value->unit == "Pa" ? " [" + unit.name + "]" : ""));
      row.push_back(!value ? "-" : shown(*value, unit) + (first && first != value ? change_text(*value->number, *first->number) : ""));
    }
    rows.push_back(std::move(row));
  }
  return aligned(rows);
}

}  // namespace snug::app
