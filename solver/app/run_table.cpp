#include "solver/app/run_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "cases/input/suggestion.hpp"

namespace snug::app {

namespace {

using materials::RunRecord, materials::RunValue;

input::InputError wrong(const std::string& found, const std::string& remedy) { return {{"recorded runs", 0, 0}, found, remedy}; }

/// Runs that may count, and what was left out.
std::vector<RunRecord> counted(materials::Library& library, const RunQuestion& question, std::string& left_out) {
  const materials::Runs runs(library);
  if (!question.project.empty()) runs.check_project(question.project);
  std::vector<RunRecord> found;
  std::set<std::string> cases, tiers, names;
  int not_converged = 0, without = 0, again = 0;
  for (const RunRecord& head : runs.heads(question.project)) {
    if (head.status != "converged") {
      ++not_converged;
      continue;
    }
    RunRecord run = runs.run(head.number);
    const RunValue* tier = run.setting("solver.tier");
    if (!question.tier.empty() && (!tier || tier->value != question.tier)) continue;
    for (const RunValue& one : run.results) names.insert(one.name);
    if (!run.result(question.result)) ++without;
    else if (!cases.insert(run.case_hash).second) ++again;
    else tiers.insert(tier ? tier->value : ""), found.push_back(std::move(run));
  }
  if (found.empty())
    throw wrong("no converged run has a result \"" + question.result + "\"", names.empty() ? "snug run records what it computes" : input::did_you_mean(question.result, {names.begin(), names.end()}));
  if (tiers.size() > 1) throw wrong("the runs are of several tiers", "say which one counts, e.g. --tier " + *tiers.rbegin());
  const auto say = [&](int count, const char* why) {
    if (count > 0) left_out += fmt::format("{}{} {}", left_out.empty() ? "" : ", ", count, why);
  };
  say(not_converged, "not converged"), say(without, "without this result"), say(again, "of a case that was run before");
  return found;
}

/// Keys of garments with numbers that differ between the runs.
std::vector<std::string> differing(const std::vector<RunRecord>& runs) {
  std::map<std::string, std::set<double>> values;
  std::map<std::string, std::size_t> count;
  for (const RunRecord& run : runs)
    for (const RunValue& one : run.settings)
      if (one.number && one.name.starts_with("garment")) values[one.name].insert(*one.number), ++count[one.name];
  std::vector<std::string> keys;
  for (const auto& [key, all] : values)
    if (all.size() > 1 && count[key] == runs.size()) keys.push_back(key);
  return keys;
}

/// The whole key that a user means.
std::string whole_key(const std::string& asked, const std::vector<RunRecord>& runs) {
  std::set<std::string> known, meant;  // known: whole keys and their last parts
  for (const RunRecord& run : runs)
    for (const RunValue& one : run.settings)
      if (one.number) {
        known.insert(one.name), known.insert(one.name.substr(one.name.rfind('.') + 1));
        if (one.name == asked || one.name.ends_with("." + asked)) meant.insert(one.name);
      }
  if (meant.contains(asked)) return asked;
  if (meant.size() == 1) return *meant.begin();
  if (meant.empty()) throw wrong("no run has a number \"" + asked + "\"", input::did_you_mean(asked, {known.begin(), known.end()}));
  throw wrong("\"" + asked + "\" may be " + input::joined({meant.begin(), meant.end()}), "write the whole key");
}

}  // namespace

RunTable run_table(materials::Library& library, const RunQuestion& question) {
  RunTable table;
  std::vector<RunRecord> runs = counted(library, question, table.left_out);
  std::vector<std::string> keys;
  for (const std::string& key : question.keys) keys.push_back(whole_key(key, runs));
  if (keys.empty()) keys = differing(runs);
  if (keys.empty()) throw wrong("no number of the garments differs between the runs", "run variants, or name settings by --on");
  const auto lacks = [&](const RunRecord& run) {
    return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return !run.setting(key) || !run.setting(key)->number; });
  };
  if (const auto without = std::erase_if(runs, lacks); without > 0) table.left_out += fmt::format("{}{} without one of the settings", table.left_out.empty() ? "" : ", ", without);
  if (runs.empty()) throw wrong("no run has all of " + input::joined(keys), "name settings that the same runs have");
  table.properties.resize(static_cast<Eigen::Index>(runs.size()), static_cast<Eigen::Index>(keys.size()));
  table.response.resize(static_cast<Eigen::Index>(runs.size()));
  for (const std::string& key : keys) table.columns.push_back({key, runs.front().setting(key)->unit});
  table.unit = runs.front().result(question.result)->unit;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    table.response[row] = runs[r].result(question.result)->number.value_or(0.0);
    for (std::size_t c = 0; c < keys.size(); ++c) table.properties(row, static_cast<Eigen::Index>(c)) = *runs[r].setting(keys[c])->number;
  }
  return table;
}

}  // namespace snug::app
