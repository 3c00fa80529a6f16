#include "materials/database/runs.hpp"

#include <algorithm>
#include <array>

#include "cases/input/suggestion.hpp"
#include "materials/database/store.hpp"

namespace snug::materials {

namespace {

constexpr const char* columns =
    "number, project, title, moment, who, directory, place, proof, case_hash, echo, command, status, message, note, parent, seconds";

RunRecord head_of(const sql::Statement& row) {
  RunRecord run{.number = row.integer(0),
                .project = row.text(1),
                .title = row.text(2),
                .moment = row.text(3),
                .who = row.text(4),
                .directory = row.text(5),
                .place = row.text(6),
                .proof = row.text(7),
                .case_hash = row.text(8),
                .echo = row.text(9),
                .command = row.text(10),
                .status = row.text(11),
                .message = row.text(12),
                .note = row.text(13),
                .seconds = row.number(15)};
  if (!row.is_null(14)) run.parent = row.integer(14);
  return run;
}

const RunValue* find_in(const std::vector<RunValue>& values, const std::string& name) {
  const auto found = std::find_if(values.begin(), values.end(), [&](const RunValue& one) { return one.name == name; });
  return found == values.end() ? nullptr : &*found;
}

/// The lists of a run by the names that the table has for them.
struct Role {
  const char* name;
  std::vector<RunValue> RunRecord::*values;
};
constexpr std::array roles = {Role{"input", &RunRecord::inputs}, Role{"version", &RunRecord::versions},
                              Role{"setting", &RunRecord::settings}, Role{"result", &RunRecord::results}};

input::InputError no_run(std::int64_t number) {
  return {{"library", 0, 0}, "there is no run " + std::to_string(number), "snug project list and snug project show PROJECT tell their numbers"};
}

}  // namespace

const RunValue* RunRecord::result(const std::string& name) const { return find_in(results, name); }
const RunValue* RunRecord::setting(const std::string& name) const { return find_in(settings, name); }

std::int64_t Runs::record(const RunRecord& run, const std::vector<LibraryFile>& files) {
  check_remark("the name of the project", run.project);
  check_remark("the note", run.note);
  sql::Connection& connection = library_.store_->connection;
  sql::Transaction writing(connection);
  for (const LibraryFile& file : files) library_.store_->keep(file);
  sql::Statement add = connection.prepare(
      "INSERT INTO run (project, title, who, directory, place, proof, case_hash, echo, command, status, message, note, parent, seconds) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)");
  add.bind(1, run.project).bind(2, run.title).bind(3, library_.store_->settings.who).bind(4, run.directory).bind(5, run.place).bind(6, run.proof);
  add.bind(7, run.case_hash).bind(8, run.echo).bind(9, run.command).bind(10, run.status).bind_text_or_null(11, run.message);
  add.bind_text_or_null(12, run.note).bind(13, run.parent).bind(14, run.seconds).run();
  const std::int64_t number = connection.last_row();
  sql::Statement value = connection.prepare("INSERT INTO run_value (run, role, place, name, value, unit, number) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  for (const Role& role : roles) {
    int place = 0;
    for (const RunValue& one : run.*role.values)
      value.bind(1, number).bind(2, role.name).bind(3, place++).bind(4, one.name).bind(5, one.value).bind_text_or_null(6, one.unit).bind(7, one.number).run();
  }
  sql::Statement material = connection.prepare("INSERT INTO run_material (run, part, entity, snapshot) VALUES (?1, ?2, ?3, ?4)");
  for (const RunMaterial& one : run.materials) material.bind(1, number).bind(2, one.part).bind(3, one.entity).bind(4, one.snapshot).run();
  writing.commit();
  return number;
}

std::vector<ProjectHead> Runs::projects() const {
  sql::Statement rows = library_.store_->connection.prepare(
      "SELECT project, count(*), sum(status = 'converged'), min(moment), max(moment) FROM run GROUP BY project ORDER BY max(number) DESC");
  std::vector<ProjectHead> projects;
  while (rows.step())
    projects.push_back({.name = rows.text(0), .runs = rows.integer(1), .converged = rows.integer(2), .first = rows.text(3), .last = rows.text(4)});
  return projects;
}

std::vector<RunRecord> Runs::heads(const std::string& project, std::int64_t most) const {
  sql::Statement rows = library_.store_->connection.prepare(std::string("SELECT ") + columns + " FROM run " + (project.empty() ? "" : "WHERE project = ?2 ") +
                                                            "ORDER BY number DESC LIMIT ?1");
  rows.bind(1, most);
  if (!project.empty()) rows.bind(2, project);
  std::vector<RunRecord> runs;
  while (rows.step()) runs.push_back(head_of(rows));
  std::reverse(runs.begin(), runs.end());
  return runs;
}

void Runs::read_values(RunRecord& run) const {
  sql::Statement values = library_.store_->connection.prepare("SELECT role, name, value, unit, number FROM run_value WHERE run = ?1 ORDER BY role, place");
  values.bind(1, run.number);
  while (values.step())
    for (const Role& role : roles)
      if (values.text(0) == role.name) {
        RunValue& one = (run.*role.values).emplace_back(RunValue{.name = values.text(1), .value = values.text(2), .unit = values.text(3)});
        if (!values.is_null(4)) one.number = values.number(4);
      }
  sql::Statement materials = library_.store_->connection.prepare("SELECT part, entity, snapshot FROM run_material WHERE run = ?1 ORDER BY part");
  materials.bind(1, run.number);
  while (materials.step()) run.materials.push_back({.part = materials.text(0), .entity = materials.text(1), .snapshot = materials.text(2)});
}

RunRecord Runs::run(std::int64_t number) const {
  sql::Statement row = library_.store_->connection.prepare(std::string("SELECT ") + columns + " FROM run WHERE number = ?1");
  if (!row.bind(1, number).step()) throw no_run(number);
  RunRecord run = head_of(row);
  read_values(run);
  return run;
}

void Runs::check_project(const std::string& project) const {
  std::vector<std::string> known;
  for (const ProjectHead& head : projects()) known.push_back(head.name);
  if (std::find(known.begin(), known.end(), project) != known.end()) return;
  throw input::InputError({"library", 0, 0}, "no run is recorded of a project \"" + project + "\"",
                          known.empty() ? "snug run records what it computes" : input::did_you_mean(project, known));
}

void Runs::note(std::int64_t number, const std::string& text) {
  check_remark("the note", text);
  run(number);
  library_.store_->connection.prepare("UPDATE run SET note = ?2 WHERE number = ?1").bind(1, number).bind_text_or_null(2, text).run();
}

void Runs::forget(const std::vector<std::int64_t>& numbers) {
  sql::Connection& connection = library_.store_->connection;
  sql::Transaction writing(connection);
  for (const std::int64_t number : numbers) {
    run(number);
    connection.prepare("DELETE FROM run WHERE number = ?1").bind(1, number).run();
  }
  // Files of data, and of data as they were (undo brings them back), stay.
  connection.execute(
      "DELETE FROM file WHERE (name LIKE 'run:%') AND NOT EXISTS (SELECT 1 FROM run WHERE echo = file.hash) AND NOT EXISTS (SELECT 1 FROM run_value WHERE "
      "role = 'input' AND value = file.hash) AND NOT EXISTS (SELECT 1 FROM run_material WHERE snapshot = file.hash) AND NOT EXISTS (SELECT 1 FROM datum WHERE value = file.hash)");
  writing.commit();
}

void Runs::derive(const std::string& directory, std::int64_t from) {
  run(from);
  library_.store_->connection.prepare("INSERT OR REPLACE INTO derived (directory, run) VALUES (?1, ?2)").bind(1, directory).bind(2, from).run();
}

std::optional<std::int64_t> Runs::parent_of(const std::string& directory) const {
  sql::Statement from = library_.store_->connection.prepare("SELECT run FROM derived WHERE directory = ?1");
  if (!from.bind(1, directory).step()) return std::nullopt;
  return from.integer(0);
}

void Runs::decide(const std::string& project, std::int64_t number, const std::string& why) {
  check_project(project);
  check_remark("the reason", why);
  const RunRecord chosen = run(number);
  if (chosen.project != project)
    throw input::InputError({"library", 0, 0}, "run " + std::to_string(number) + " is one of the project \"" + chosen.project + "\"",
                            "choose among the runs that snug project show \"" + project + "\" lists");
  library_.store_->connection.prepare("INSERT OR REPLACE INTO decision (project, run, why, who) VALUES (?1, ?2, ?3, ?4)")
      .bind(1, project)
      .bind(2, number)
      .bind(3, why)
      .bind(4, library_.store_->settings.who)
      .run();
}

std::optional<Decision> Runs::decision(const std::string& project) const {
  sql::Statement row = library_.store_->connection.prepare("SELECT run, why, who, moment FROM decision WHERE project = ?1");
  if (!row.bind(1, project).step()) return std::nullopt;
  return Decision{.run = row.integer(0), .why = row.text(1), .who = row.text(2), .moment = row.text(3)};
}

}  // namespace snug::materials
