#include "solver/app/study/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cases/input/expected.hpp"
#include "solver/app/command.hpp"
#include "solver/app/study/child_process.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

double number(const nlohmann::json& from, const char* key) {
  return from.contains(key) && from[key].is_number() ? from[key].get<double>() : not_known;
}

void read_summary(const fs::path& file, StudyRow& row) {
  std::ifstream in(file);
  const nlohmann::json summary = nlohmann::json::parse(in);
  row.status = summary.at("status");
  row.unknowns = number(summary.at("unknowns"), "total");
  row.memory = std::max(row.memory, number(summary, "peak_memory_bytes"));  // of all ranks
  row.increments = number(summary, "increments"), row.iterations = number(summary, "iterations");
  for (const auto& phase : summary.at("phases")) row.phases.push_back({phase.at("name"), phase.at("seconds")});
  row.mean_pressure = number(summary.at("numbers"), "mean_contact_pressure_Pa");
  row.mean_displacement = number(summary.at("numbers"), "mean_skin_radial_displacement_m");
}

std::vector<std::string> command_line(const fs::path& directory, const CaseOptions& options, int ranks, const fs::path& out) {
  std::vector<std::string> words = {fs::read_symlink("/proc/self/exe").string(),
                                    "run",
                                    fs::absolute(directory).string(),
                                    "--quiet",
                                    "--no-report",
                                    "--no-record",
                                    "--out",
                                    fs::absolute(out).string()};
  for (const std::string& word : options.words()) words.push_back(word);
  if (ranks > 0) words.insert(words.end(), {"--ranks", std::to_string(ranks)});
  return words;
}

}  // namespace

StudyRow measure(const fs::path& directory, const CaseOptions& options, int ranks, const fs::path& work) {
  // Not in `work` itself, which the study holds locked: a run locks the folder beside its results to exchange them.
  const fs::path room = work / "runs", out = room / "run";
  fs::create_directories(room);
  const ChildOutcome child = run_child(command_line(directory, options, ranks, out), work);
  if (child.status != done && child.status != not_converged)
    throw std::runtime_error(fmt::format("a run of the study ended with status {}: {}", child.status, child.output));
  StudyRow row;
  row.wall = child.wall, row.user = child.user, row.system = child.system, row.memory = child.memory;
  read_summary(out / "summary.json", row);
  row.map = postproc::read_skin_map(out / "skin.csv");
  row.skin_nodes = static_cast<double>(row.map.nodes.size());
  fs::remove_all(room);
  return row;
}

namespace {

Yardstick exact(const input::ExactAnswer& answer) {
  return {"exact", answer.source, answer.pressure, answer.skin_radial_displacement};
}

Yardstick reference(const input::Case& description) {
  const fs::path file = description.directory / "expected.toml";
  Yardstick yardstick{"reference", {}};
  for (const input::Expected& entry : input::read_expected(file)) {
    if (!entry.value) continue;
    double* target = entry.quantity == "numbers.mean_contact_pressure_Pa"          ? &yardstick.pressure
                     : entry.quantity == "numbers.mean_skin_radial_displacement_m" ? &yardstick.displacement
                                                                                   : nullptr;
    if (!target) continue;
    *target = *entry.value;
    yardstick.source += (yardstick.source.empty() ? "" : "; ") + entry.source;
  }
  if (yardstick.source.empty())
    throw input::InputError({file.string(), 0, 0}, "neither mean pressure nor mean displacement is expected here",
                            "use --against finest, or add numbers.mean_contact_pressure_Pa");
  return yardstick;
}

}  // namespace

Yardstick yardstick_of(const input::Case& description, const std::string& kind) {
  const bool has_exact = description.study && description.study->exact;
  if (kind == "exact" && !has_exact)
    throw input::InputError({(description.directory / "case.toml").string(), 0, 0}, "the case states no exact answer",
                            "add one under [study.exact], or use --against finest");
  if (kind == "reference") return reference(description);
  if (kind != "finest" && has_exact) return exact(*description.study->exact);
  return {"finest", {}};
}

namespace {

const StudyRow* finest_of(const std::vector<StudyRow>& rows) {
  const StudyRow* finest = nullptr;
  for (const StudyRow& row : rows)
    if (row.series == rows.front().series && row.converged() && !row.map.nodes.empty() &&
        (!finest || row.unknowns > finest->unknowns))
      finest = &row;
  return finest;
}

/// How far a value is off, over the value it should have; NaN where there is none or it is zero.
double relative(double value, double should) { return should != 0.0 ? value / should - 1.0 : not_known; }

void compare_with(StudyRow& row, const Yardstick& yardstick, const postproc::Zone& zone, const StudyRow* finest) {
  row.errors = {};
  row.errors.mean_pressure = relative(row.mean_pressure, finest ? finest->mean_pressure : yardstick.pressure);
  row.errors.mean_displacement =
      relative(row.mean_displacement, finest ? finest->mean_displacement : yardstick.displacement);
  if (yardstick.kind == "reference") return;
  const postproc::MapError map = finest ? error_against(row.map, zone, finest->map)
                                        : error_against(row.map, zone, yardstick.pressure, yardstick.displacement);
  row.errors.pressure_rms = map.pressure_rms, row.errors.pressure_max = map.pressure_max;
  row.errors.displacement_rms = map.displacement_rms;
}

}  // namespace

void compare(std::vector<StudyRow>& rows, Yardstick& yardstick, const postproc::Zone& zone) {
  const StudyRow* finest = nullptr;
  if (yardstick.kind == "finest") {
    finest = rows.empty() ? nullptr : finest_of(rows);
    if (!finest) return;
    yardstick.source = fmt::format("the finest run: {}, {}", finest->series, finest->level);
  }
  for (StudyRow& row : rows)
    if (row.converged() && &row != finest && !row.map.nodes.empty()) compare_with(row, yardstick, zone, finest);
}

}  // namespace snug::app
