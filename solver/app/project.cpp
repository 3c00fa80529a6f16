// snug project: the recorded runs, listed, compared, traced, derived from and shown as a page.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "postproc/report/page.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/library_command.hpp"
#include "solver/app/project_derive.hpp"
#include "solver/app/project_text.hpp"
#include "solver/app/recorded_commands.hpp"
#include "solver/app/report_files.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

using materials::Library, materials::RunRecord, materials::Runs, materials::RunValue;

std::optional<std::int64_t> number_of(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::vector<RunRecord> runs_of(const Runs& runs, const std::string& project) {
  runs.check_project(project);
  std::vector<RunRecord> whole;
  for (const RunRecord& head : runs.heads(project)) whole.push_back(runs.run(head.number));
  return whole;
}

/// The number of a run; a project may be called by a number, too, which counts where there is no such run.
std::optional<std::int64_t> run_meant(const Runs& runs, const std::string& text) {
  const auto number = number_of(text);
  const auto projects = runs.projects();
  const bool is_project = std::any_of(projects.begin(), projects.end(), [&](const auto& one) { return one.name == text; });
  if (!number || !is_project) return number;
  const auto heads = runs.heads();
  return std::any_of(heads.begin(), heads.end(), [&](const RunRecord& one) { return one.number == *number; }) ? number : std::nullopt;
}

std::string decision_text(const materials::Decision& decision) {
  return fmt::format("run {}{}{} ({}, {})", decision.run, decision.why.empty() ? "" : ": ", decision.why, decision.who, minute_of(decision.moment));
}

Json decision_json(const std::optional<materials::Decision>& decision) {
  return decision ? Json{{"run", decision->run}, {"why", decision->why}, {"by", decision->who}, {"moment", decision->moment}} : Json();
}

void declare_unit(CLI::App& app, std::string& unit) { app.add_option("--unit", unit, "of the pressures: Pa, kPa, gf/cm2, mmHg")->capture_default_str(); }

Json runs_json(const std::vector<RunRecord>& runs) {
  Json json = Json::array();
  for (const RunRecord& run : runs) json.push_back(run_json(run, false));
  return json;
}

/// A row a setting, with its value in each run.
Json differences_json(const std::vector<RunRecord>& runs) {
  Json json = Json::array();
  for (const Difference& row : differences(runs)) json.push_back({{"key", row.key}, {"values", row.values}});
  return json;
}

class List : public LibraryCommand {
 public:
  List() : LibraryCommand("list", "the projects of which runs are recorded, the last one first") {}
  void declare(CLI::App&) override {}

 private:
  int act(Library& library) override {
    const Runs runs(library);
    std::vector<std::vector<std::string>> rows{{"project", "runs", "converged", "last", "decision"}};
    Json& projects = console().document()["projects"] = Json::array();
    for (const materials::ProjectHead& head : runs.projects()) {
      const auto decision = runs.decision(head.name);
      projects.push_back({{"project", head.name}, {"runs", head.runs}, {"converged", head.converged}, {"first", head.first}, {"last", head.last}, {"decision", decision_json(decision)}});
      rows.push_back({head.name, std::to_string(head.runs), std::to_string(head.converged), minute_of(head.last), decision ? fmt::format("run {}", decision->run) : ""});
    }
    if (rows.size() == 1) console().note("no run is recorded yet; snug run records what it computes");
    else console().say(aligned(rows));
    return done;
  }
};

class Show : public LibraryCommand {
 public:
  Show() : LibraryCommand("show", "the runs of a project, or everything of one run by its number") {}
  void declare(CLI::App& app) override {
    app.add_option("PROJECT|RUN", what_, "name of a project, or number of a run")->required();
    declare_unit(app, unit_);
  }

 private:
  int act(Library& library) override {
    const Runs runs(library);
    const PressureUnit unit(unit_);
    if (const auto number = run_meant(runs, what_)) {
      console().say(run_text(runs.run(*number), unit));
      console().document() = {{"runs", Json::array({run_json(runs.run(*number), true)})}};
      return done;
    }
    const std::vector<RunRecord> all = runs_of(runs, what_);
    console().document() = {{"project", what_}, {"specification", known_data_json(what_)}, {"runs", runs_json(all)}, {"what_differs", differences_json(all)}, {"decision", decision_json(runs.decision(what_))}};
    console().print("{}", known_data_text(what_));
    const std::vector<std::string> locations = locations_of(all);
    std::vector<std::vector<std::string>> rows{{"run", "recorded", "by", "status", "comfort"}};
    for (const std::string& name : locations) rows[0].push_back(name);
    rows[0].push_back(locations.empty() ? "note" : "[" + unit.name + "]  note");
    for (const RunRecord& run : all) {
      const auto cell = [&](const std::string& name) { return run.result(name) ? shown(*run.result(name), unit) : "-"; };
      rows.push_back({std::to_string(run.number), minute_of(run.moment), run.who, run.status, cell("comfort")});
      for (const std::string& name : locations) rows.back().push_back(cell(name));
      rows.back().push_back(run.note);
    }
    console().print("{}", aligned(rows));
    rows.clear();
    for (const Difference& row : differences(all)) {
      rows.push_back({row.key});
      for (std::size_t r = 0; r < all.size(); ++r) rows.back().push_back(row.values[r]);
    }
    if (!rows.empty()) {
      rows.insert(rows.begin(), {{"what differs"}});
      for (const RunRecord& run : all) rows.front().push_back(fmt::format("run {}", run.number));
      console().print("\n{}", aligned(rows));
    }
    if (const auto decision = runs.decision(what_)) console().print("\n  decided for {}\n", decision_text(*decision));
    return done;
  }
  std::string what_, unit_ = "gf/cm2";
};

class CompareRuns : public LibraryCommand {
 public:
  CompareRuns() : LibraryCommand("compare", "recorded runs side by side: settings that differ, results and their change") {}
  void declare(CLI::App& app) override {
    app.add_option("RUN", numbers_, "numbers; the first is what the others are held against")->required()->expected(2, 1000);
    declare_unit(app, unit_);
  }

 private:
  int act(Library& library) override {
    std::vector<RunRecord> all;
    for (const std::int64_t number : numbers_) all.push_back(Runs(library).run(number));
    console().say(comparison_text(all, PressureUnit(unit_)));
    console().document() = {{"runs", runs_json(all)}, {"what_differs", differences_json(all)}};
    return done;
  }
  std::vector<std::int64_t> numbers_;
  std::string unit_ = "gf/cm2";
};

class Trace : public LibraryCommand {
 public:
  Trace() : LibraryCommand("trace", "where a result comes from: run, inputs, and every value of the library with its source") {}
  void declare(CLI::App& app) override {
    app.add_option("RUN", number_, "its number")->required();
    app.add_option("RESULT", result_, "as snug project show RUN lists it: \"Front thigh\", comfort, …")->required();
    declare_unit(app, unit_);
  }

 private:
  int act(Library& library) override {
    const RunRecord run = Runs(library).run(number_);
    console().say(trace_text(run, result_, library, PressureUnit(unit_)));
    const RunValue& value = *run.result(result_);
    console().document() = {{"result", result_}, {"value", value.number ? Json(*value.number) : Json(value.value)}, {"unit", value.unit}, {"runs", Json::array({run_json(run, true)})}};
    return done;
  }
  std::int64_t number_ = 0;
  std::string result_, unit_ = "gf/cm2";
};

class Derive : public LibraryCommand {
 public:
  Derive() : LibraryCommand("derive", "a new case from a recorded run, with its values and files") {}
  void declare(CLI::App& app) override {
    app.add_option("RUN", number_, "its number")->required();
    app.add_option("DIR", directory_, "directory to make")->required();
    app.add_option("--set", overrides_, "a value that is another one: --set garment.fabric=N88P; may be repeated")->type_name("KEY=VALUE")->allow_extra_args(false);
  }

 private:
  int act(Library& library) override {
    Runs runs(library);
    const fs::path directory = fs::absolute(directory_).lexically_normal();
    derive_case(runs.run(number_), directory_, overrides_, library);
    runs.derive((directory.has_filename() ? directory : directory.parent_path()).string(), number_);
    console().print("{0} is derived from run {1}. Next: snug check {0}, then snug run {0}\n", directory_, number_);
    return done;
  }
  std::int64_t number_ = 0;
  std::string directory_;
  std::vector<std::string> overrides_;
};

class Note : public LibraryCommand {
 public:
  Note() : LibraryCommand("note", "what is to be remembered of a run, in place of an earlier note") {}
  void declare(CLI::App& app) override {
    app.add_option("RUN", number_, "its number")->required();
    app.add_option("TEXT", text_, "the note; \"\" takes it away")->required();
  }

 private:
  int act(Library& library) override {
    Runs(library).note(number_, text_);
    return done;
  }
  std::int64_t number_ = 0;
  std::string text_;
};

class Decide : public LibraryCommand {
 public:
  Decide() : LibraryCommand("decide", "the run that a project goes on with, and why") {}
  void declare(CLI::App& app) override {
    app.add_option("PROJECT", project_, "its name")->required();
    app.add_option("RUN", number_, "number of one of its runs")->required();
    app.add_option("WHY", why_, "the reason");
  }

 private:
  int act(Library& library) override {
    Runs(library).decide(project_, number_, why_);
    return done;
  }
  std::string project_, why_;
  std::int64_t number_ = 0;
};

class Forget : public LibraryCommand {
 public:
  Forget() : LibraryCommand("forget", "takes runs out of the library for good; their files on the disk stay") {}
  void declare(CLI::App& app) override { app.add_option("RUN", numbers_, "numbers")->required()->expected(1, 100000); }

 private:
  int act(Library& library) override {
    Runs(library).forget(numbers_);
    return done;
  }
  std::vector<std::int64_t> numbers_;
};

class Page : public LibraryCommand {
 public:
  Page() : LibraryCommand("page", "a project as one page to look at: specification, variants, maps, decision") {}
  void declare(CLI::App& app) override {
    app.add_option("PROJECT", project_, "its name")->required();
    app.add_option("--out", file_, "where it goes (PROJECT.html)")->type_name("FILE");
    declare_unit(app, unit_);
  }

 private:
  int act(Library& library) override {
    const Runs runs(library);
    const std::vector<RunRecord> all = runs_of(runs, project_);
    const PressureUnit unit(unit_);
    const auto decision = runs.decision(project_);
    postproc::report::ProjectView view{.name = project_, .specification = specification(library)};
    view.headings = {{"Run"}, {"Recorded", true}, {"By", true}, {"Status", true}, {"Comfort"}};
    const std::vector<std::string> locations = locations_of(all);
    for (const std::string& name : locations) view.headings.push_back({name + ", " + unit.name});
    view.headings.push_back({"Note", true});
    int elsewhere = 0;
    for (const RunRecord& run : all) {
      const auto cell = [&](const std::string& name) { return run.result(name) ? shown(*run.result(name), unit) : "–"; };
      postproc::report::ProjectVariant variant{.name = fmt::format("run {}", run.number)};
      variant.cells = {std::to_string(run.number), minute_of(run.moment), run.who, run.status, cell("comfort")};
      for (const std::string& name : locations) variant.cells.push_back(cell(name));
      variant.cells.push_back(run.note);
      if (whereabouts(run) == Whereabouts::as_recorded) variant.results = run.place;
      else ++elsewhere;
      variant.chosen = decision && decision->run == run.number;
      view.variants.push_back(std::move(variant));
    }
    if (decision) view.why = decision->why, view.decided_by = decision->who + ", " + minute_of(decision->moment);
    if (elsewhere > 0)
      view.left_out = fmt::format("Of {} runs the results are no longer at their place, or others are: they stand in the list and not among the maps. snug run --out keeps the results of each.", elsewhere);
    const fs::path file = file_.empty() ? file_name() : fs::path(file_);
    write_page(postproc::report::project_page(view), file);
    console().print("{}\n", file.string());
    console().document() = {{"file", file.string()}, {"project", project_}};
    return done;
  }

  std::vector<postproc::report::ProjectItem> specification(const Library& library) const {
    std::vector<postproc::report::ProjectItem> items;
    const auto entity = library.find(project_);
    if (!entity || entity->kind != materials::Kind::project) return items;
    for (const materials::Datum& datum : entity->data) items.push_back({datum.name, materials::quantity_text(datum), datum.source});
    return items;
  }

  fs::path file_name() const {
    std::string name = project_;
    std::replace(name.begin(), name.end(), '/', '-');
    return name + ".html";
  }
  std::string project_, file_, unit_ = "gf/cm2";
};

class Project : public CommandGroup {
 public:
  Project()
      : CommandGroup("project", "recorded runs: list, compare, trace to the library's data, derive new cases, a page",
                     "snug run records what it computes in the library (SNUG_LIBRARY, else snug/library.db in your data folder); --no-record or SNUG_RECORD=off leaves it out.") {
    commands_.push_back(std::make_unique<List>());
    commands_.push_back(std::make_unique<Show>());
    commands_.push_back(std::make_unique<CompareRuns>());
    commands_.push_back(std::make_unique<Trace>());
    commands_.push_back(std::make_unique<Derive>());
    commands_.push_back(std::make_unique<Note>());
    commands_.push_back(std::make_unique<Decide>());
    commands_.push_back(std::make_unique<Page>());
    commands_.push_back(std::make_unique<Forget>());
  }
};

}  // namespace

std::unique_ptr<Command> make_project() { return std::make_unique<Project>(); }

}  // namespace snug::app
