// snug study DIR: error against run time over meshes, elements and tiers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "solver/app/cleaner.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/output_directory.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/print_plan.hpp"
#include "solver/app/study/child_process.hpp"
#include "solver/app/study/ladder.hpp"
#include "solver/app/study/measure.hpp"
#include "solver/app/study/study_files.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

class Study : public Command {
 public:
  std::string name() const override { return "study"; }
  std::string summary() const override { return "error against run time over meshes, elements and tiers"; }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directory_, "case directory")->required();
    options_.declare(app);
    app.add_option("--factors", factors_, "cells per length over those of the case: --factors 0.5,1,2")->delimiter(',');
    app.add_option("--levels", levels_, "how many meshes of the ladder, from the coarsest on");
    app.add_option("--vary", vary_, "a series for each value: --vary solver.tier=L1,L4; may be repeated")
        ->type_name("KEY=A,B")
        ->allow_extra_args(false);
    app.add_option("--ranks", ranks_, "every series for each number of processes: --ranks 1,2 (left out: as many as a run takes by itself)")
        ->delimiter(',')
        ->check(CLI::Range(1, 4096));
    app.add_option("--against", against_,
                   "exact: the answer under [study]; reference: expected.toml; finest: the "
                   "finest run (left out: exact where there is one)")
        ->check(CLI::IsMember({"exact", "reference", "finest"}));
    app.add_option("--beside", beside_, "rows measured elsewhere, in the columns of study.csv, for table and plot")
        ->type_name("FILE.csv");
    app.add_option("--limit", limit_, "seconds; a series ends before a run expected to take longer");
    app.add_option("--out", out_, "where the results go (study/ in the case directory)")->type_name("DIR");
  }

  int execute() override {
    const input::Case description = options_.read(directory_);
    const auto ladder = ladder_of(description), series = series_of(description);
    Yardstick yardstick = yardstick_of(description, against_);
    const std::vector<StudyRow> beside = beside_.empty() ? std::vector<StudyRow>{} : read_study_csv(beside_);
    OutputDirectory out(out_.empty() ? fs::path(directory_) / "study" : fs::path(out_));
    const Cleaner cleaner;
    cleaner.repair(out.target());
    const fs::path work = out.aside();
    std::vector<StudyRow> rows;
    for (const auto& one : series)
      for (const int ranks : ranks_.empty() ? std::vector<int>{0} : ranks_) walk(one, ranks, ladder, work, rows);
    if (rows.empty())
      throw input::InputError({"--limit", 0, 0}, "every run is expected to take longer", "give more seconds");
    compare(rows, yardstick, zone_of(description));
    rows.insert(rows.end(), beside.begin(), beside.end());
    write(rows, description, yardstick, work);
    out.commit();
    console().document() = {{"out", out.target().string()}, {"against", yardstick.kind}, {"source", yardstick.source}, {"rows", rows_document(rows)}, {"notes", notes_}};
    console().print("files in {}: study.md, study.csv, study.gp\n", out.target().string());
    return std::any_of(rows.begin(), rows.end(), [](const StudyRow& r) { return r.converged(); }) ? done
                                                                                                  : not_converged;
  }

 private:
  std::vector<input::StudyVariant> ladder_of(const input::Case& description) const {
    for (const double factor : factors_)
      if (!(factor > 0.0))
        throw input::InputError({"--factors", 0, 0}, fmt::format("{:g} is no factor", factor),
                                "write positive numbers");
    std::vector<input::StudyVariant> ladder;
    if (factors_.empty() && description.study && !description.study->levels.empty())
      ladder = description.study->levels;
    else
      for (const double factor : factors_.empty() ? std::vector<double>{0.5, 0.71, 1.0, 1.41, 2.0} : factors_)
        ladder.push_back(scaled(description, factor));
    if (levels_ < 0 || levels_ > static_cast<int>(ladder.size()))
      throw input::InputError({"--levels", 0, 0}, fmt::format("the ladder has {} meshes", ladder.size()),
                              fmt::format("write a number from 1 to {}, or more --factors", ladder.size()));
    if (levels_ > 0) ladder.resize(static_cast<std::size_t>(levels_));
    return ladder;
  }

  std::vector<input::StudyVariant> series_of(const input::Case& description) const {
    if (!vary_.empty()) return varied(vary_);
    if (description.study && !description.study->series.empty()) return description.study->series;
    return default_series(description);
  }

  static postproc::Zone zone_of(const input::Case& description) {
    postproc::Zone zone;
    if (!description.study || !description.study->zone) return zone;
    zone.from = description.study->zone->from_height.value_or(zone.from);
    zone.to = description.study->zone->to_height.value_or(zone.to);
    return zone;
  }

  /// Runs one series up the ladder until a run would take too long.
  void walk(const input::StudyVariant& series, int ranks, const std::vector<input::StudyVariant>& ladder, const fs::path& work,
            std::vector<StudyRow>& rows) {
    const std::string name = ranks > 0 ? fmt::format("{}, {} rank{}", series.name, ranks, ranks > 1 ? "s" : "") : series.name;
    std::vector<TimedRun> earlier;
    for (const input::StudyVariant& level : ladder) {
      CaseOptions options = options_;
      options.overrides.insert(options.overrides.end(), series.set.begin(), series.set.end());
      options.overrides.insert(options.overrides.end(), level.set.begin(), level.set.end());
      const PreparedCase prepared = prepare(directory_, options);
      const solver::Plan plan = solver::plan(prepared.model, prepared.meshes);
      long unknowns = 1;  // tier L0 has none
      for (const auto& [part, count] : plan.unknowns) unknowns += count;
      const double expected = earlier.empty() ? plan.seconds : expected_seconds(earlier, unknowns);
      const std::string what = fmt::format("{}, {}: {} unknowns, about {} expected", name, level.name,
                                           unknowns - 1, duration_text(expected));
      if (expected > limit_) {
        notes_.push_back(fmt::format("not run: {}, more than --limit {:g}", what, limit_));
        return console().print("{}\n", notes_.back());
      }
      console().print("{}\n", what);
      rows.push_back(measure(directory_, options, ranks, work));
      StudyRow& row = rows.back();
      row.series = name, row.level = level.name;
      row.settings = fmt::format("{}", fmt::join(options.overrides, " "));
      earlier.push_back({unknowns, row.wall});
      console().print("  {}: {:.2f} s, {:.2f} s of processor, {}, mean pressure {:.6g} Pa\n", row.status, row.wall,
          row.user + row.system, memory_text(row.memory), row.mean_pressure);
    }
  }

  /// NaN, what is not known, becomes null.
  static Json rows_document(const std::vector<StudyRow>& rows) {
    Json json = Json::array();
    for (const StudyRow& row : rows)
      json.push_back({{"series", row.series}, {"level", row.level}, {"settings", row.settings}, {"status", row.status}, {"unknowns", row.unknowns}, {"iterations", row.iterations},
                      {"wall_s", row.wall}, {"processor_s", row.user + row.system}, {"memory_bytes", row.memory}, {"mean_pressure_Pa", row.mean_pressure},
                      {"error_of_mean_pressure", row.errors.mean_pressure}, {"error_of_pressure_rms", row.errors.pressure_rms}, {"error_of_pressure_max", row.errors.pressure_max},
                      {"error_of_displacement_rms", row.errors.displacement_rms}});
    return json;
  }

  void write(const std::vector<StudyRow>& rows, const input::Case& description, const Yardstick& yardstick,
             const fs::path& folder) const {
    StudyHead head{description.title, fmt::format("snug study {}", directory_),
                   fmt::format("the {} answer ({})", yardstick.kind, yardstick.source), notes_};
    if (yardstick.kind == "finest") head.against = yardstick.source;
    write_study_csv(rows, folder / "study.csv");
    write_study_table(rows, head, folder / "study.md");
    write_study_plot(rows, description.title, folder / "study.gp");
    const ChildOutcome drawn = run_child({"gnuplot", "study.gp"}, folder);
    if (drawn.status != 0) fs::remove(folder / "study.svg");  // no half a picture
    if (drawn.status == 127)
      console().warn("snug study: warning: gnuplot is not there, so that study.svg is not drawn; scripts/setup installs it (gnuplot-nox), then run gnuplot study.gp beside the tables");
    else if (drawn.status != 0)
      console().warn(fmt::format("snug study: warning: gnuplot failed on study.gp: {}", drawn.output));
  }

  std::string directory_, against_, beside_, out_;
  CaseOptions options_;
  std::vector<double> factors_;
  std::vector<int> ranks_;
  std::vector<std::string> vary_, notes_;
  int levels_ = 0;
  double limit_ = 300.0;
};

}  // namespace

std::unique_ptr<Command> make_study() { return std::make_unique<Study>(); }

}  // namespace snug::app
