// snug run DIR...: mesh, solve, post-process, report.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstdio>
#include <optional>
#include <thread>

#include "cases/input/choice.hpp"
#include "cases/input/echo.hpp"
#include "cases/input/files.hpp"
#include "postproc/recorders.hpp"
#include "postproc/store.hpp"
#include "solver/algebra/communicator.hpp"
#include "solver/app/batch/batch.hpp"
#include "solver/app/checkpoint.hpp"
#include "solver/app/cleaner.hpp"
#include "solver/app/command.hpp"
#include "solver/app/final_table.hpp"
#include "solver/app/launch.hpp"
#include "solver/app/output_directory.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/print_plan.hpp"
#include "solver/app/progress.hpp"
#include "solver/app/provenance.hpp"
#include "solver/app/recording.hpp"
#include "solver/app/regression.hpp"
#include "solver/app/report_files.hpp"
#include "solver/app/solver_session.hpp"
#include "solver/app/state_files.hpp"
#include "solver/app/stop_signals.hpp"
#include "solver/library/size_estimate.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

void warn_of_slow_blas(Console& console) {
  if (solver::loaded_blas() == "reference")
    console.warn("snug: warning: the reference BLAS is loaded, which solves about four times slower; scripts/setup installs OpenBLAS (libopenblas0-pthread)");
}

/// Writes the results and gives what was written.
postproc::StoredRun write_all(const postproc::RunResult& run, const postproc::Evaluation& evaluation, const PreparedCase& prepared,
                              OutputDirectory& out, postproc::CsvStyle csv) {
  postproc::StoredRun stored = postproc::stored_run(run, evaluation, provenance_of(prepared), out.target());
  postproc::write_results(run, evaluation, stored, out.aside(), csv);
  stored.echo = solver::echo_text(prepared.model) + input::echo_text(prepared.jobs);
  input::write_file(out.aside() / "case.echo.toml", stored.echo);
  return stored;
}

/// The files of any run; what is there under one of these names and is not snug's is said before the solve.
ResultList names_of_results() {
  ResultList names = {"case.echo.toml"};
  for (const postproc::Recorder& recorder : postproc::recorders()) names.insert(recorder.file);
  return names;
}

int status_of(const postproc::RunResult& run, const fs::path& directory, Console& console) {
  if (run.status == postproc::Status::converged) return done;
  console.error(fmt::format("{}: error: {}; {}", (directory / "case.toml").string(),
                            run.status == postproc::Status::partial ? "the solution stopped on its way, what converged is kept" : "nothing converged",
                            run.message.empty() ? "see history.csv" : run.message));
  return not_converged;
}

class Run : public Command {
 public:
  std::string name() const override { return "run"; }
  std::string summary() const override { return "mesh, solve, post-process and report a case"; }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directories_, "case directories")->required();
    options_.declare(app);
    app.add_option("--out", out_, "where the results go (out/ in the case directory)")->type_name("DIR");
    app.add_option("--ranks", ranks_, "processes that share the work: snug starts itself again under mpirun (1, of a large body 2)")
        ->check(CLI::Range(1, 4096));
    app.add_flag("--pictures", pictures_, "also draw the body from four sides for report.html (takes a few seconds)");
    app.add_flag("--no-report", no_report_, "leave report.html out");
    app.add_option("--states", states_,
                   "keep the states of the load path, each stage in so many steps at least, for "
                   "`snug animate` (the path is then walked instead of jumped: slower)")
        ->check(CLI::Range(1, 1000));
    app.add_option("--csv", csv_, "cells of skin.csv, locations.csv, comfort.csv, tool.csv and sweep.csv are separated by: comma; semicolon, with decimal commas; tab (comma)")
        ->type_name("SEPARATOR")
        ->check(CLI::IsMember(input::choices_of<postproc::CsvStyle>()));
    app.add_flag("--resume", resume_, "go on from where a run was stopped or killed, by the checkpoint out.checkpoint beside its results");
    recording_.declare(app);
    app.add_option("--checkpoint", interval_, "seconds between checkpoints, and before the first, so that short runs write none (60)")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.0, 1e9));
    app.add_flag("--quiet", quiet_, "say nothing but errors and warnings");
    app.add_option("--variant", variants_, "only the [[variant]] of this name; may be repeated (left out: all that the case has)")->type_name("NAME")->allow_extra_args(false);
    app.add_option("--sweep", sweeps_, "a run for each value: \"garment.position=40 mm:80 mm:5\", or KEY=A,B,C; repeated: every combination")
        ->type_name("KEY=FROM:TO:N")
        ->allow_extra_args(false);
    app.add_option("--jobs", jobs_, "of several runs so many at a time (as many as there are cores)")->check(CLI::Range(1, 1024));
    app.add_option("--rank-status", status_file_)->group("");  // of the launcher of ranks, whose own terminal the ranks do not see
    app.add_option("--rank-terminal", rank_widths_)->group("")->delimiter(',')->expected(2);
    app.footer("Ctrl-C, SIGTERM: the running step is given up, what converged is written as partial, exit status 130 or 143; a second one\n"
               "ends at once and leaves the earlier results. A run of over a minute can be gone on from with --resume; its answer is the same.");
  }

  int execute() override {
    if (resume_ && states_ > 0)
      throw input::InputError({"--resume", 0, 0}, "--states keeps the states of the whole path", "run from the beginning, or leave --states out");
    const BatchRequest batch = batch_request();
    if (const solver::Launcher launcher = solver::launcher(); launcher.there && launcher.processes != 1) {
      if (batch.varies())
        throw input::InputError({"snug run", 0, 0}, "a launcher has started several processes for several runs", "start one run at a time with mpirun or srun, or leave the launcher out");
      cleaner_.emplace();
      return run_as_rank(launcher);
    }
    if (batch.several()) return run_batch(batch, console());
    cleaner_.emplace();
    if (const int ranks = ranks_ > 0 ? ranks_ : chosen_ranks(); ranks > 1) {
      for (const std::string& directory : directories_) options_.read(directory);  // what is wrong is said once
      return launch_ranks(ranks, *cleaner_, console());
    }
    const StopSignals signals(false);
    return run_all();
  }

 private:
  /// Options of every run of several.
  BatchRequest batch_request() const {
    BatchRequest request{.directories = directories_, .options = options_, .out = out_, .sweeps = sweeps_, .variants = variants_, .words = {}, .ranks = ranks_, .jobs = jobs_, .quiet = quiet_, .page = !no_report_, .csv = csv_style().value_or(postproc::CsvStyle::comma)};
    const auto pass = [&](bool given, std::initializer_list<std::string> words) {
      if (given) request.words.insert(request.words.end(), words);
    };
    pass(pictures_, {"--pictures"}), pass(no_report_, {"--no-report"});
    pass(!csv_.empty(), {"--csv", csv_}), pass(states_ > 0, {"--states", std::to_string(states_)}), pass(resume_, {"--resume"}), pass(interval_ != 60.0, {"--checkpoint", std::to_string(interval_)});
    return request;
  }

  /// What --csv asks for.
  std::optional<postproc::CsvStyle> csv_style() const { return input::choice_of<postproc::CsvStyle>(csv_); }

  int chosen_ranks() const {
    return mpirun_is_there() ? solver::usual_ranks(options_.read(directories_.front()), std::thread::hardware_concurrency(), solver::memory_of_machine()) : 1;
  }

  int run_all() {
    int status = done;
    for (const std::string& directory : directories_) {
      status = std::max(status, run_or_say(directory));
      if (stopped()) break;
    }
    if (writes_) report_status(status_file_, status);
    return status;
  }

  /// One rank of several. An error on one rank ends all: the others would wait for it for ever.
  int run_as_rank(const solver::Launcher& launcher) {
    end_with_parent();
    const StopSignals signals(true);
    if (!session_) session_ = std::make_unique<SolverSession>();
    StopSignals::take(true);
    if (launcher.processes > 1 && solver::this_rank().of == 1)
      throw input::InputError({"snug run", 0, 0}, fmt::format("a launcher has started {} processes, and MPI does not know it: each would compute the whole", launcher.processes),
                              "start them with Open MPI's mpirun, or with srun --mpi=pmix");
    writes_ = solver::this_rank().number == 0;
    quiet_ = quiet_ || !writes_;
    if (!writes_) console().leave_to_another();
    if (launcher.processes > 1) console().take_widths(rank_widths_[0], rank_widths_[1]);
    try {
      return run_all();
    } catch (const std::exception& error) {
      fmt::print(stderr, "snug run, rank {}: error: {}; this is a fault of snug or of the machine, not of the input\n",
                 solver::this_rank().number, error.what());
    } catch (...) {
      fmt::print(stderr, "snug run, rank {}: error: unknown fault\n", solver::this_rank().number);
    }
    std::fflush(stderr);
    end_all(internal_fault);
  }

  /// A wrong case among several does not keep the others from running.
  int run_or_say(const fs::path& directory) {
    try {
      return run_one(directory);
    } catch (const input::InputError& error) {
      if (writes_) console().error(error);
      if (solver::this_rank().of == 1) return input_wrong;
      if (!writes_) ::sleep(2);  // rank 0 has the word, if it found the same
      end_all(input_wrong);
    }
  }

  [[noreturn]] void end_all(int status) const {
    if (writes_) report_status(status_file_, status), console().finish(name(), status);
    solver::end_all_ranks(status);
  }

  /// The user asked for an end; alike on all ranks, because each decides from it what it does next.
  static bool stopped() { return !solver::on_all_ranks(StopSignals::received() == 0); }
  static int signal() { return StopSignals::received() == 0 ? SIGTERM : StopSignals::received(); }

  int given_up(const fs::path& directory, const char* before) const {
    if (writes_) console().error(fmt::format("{}: error: stopped by you ({}) before {}; nothing is written", directory.string(), StopSignals::name(signal()), before));
    return 128 + signal();
  }

  int run_one(const fs::path& directory) {
    const fs::path target = out_.empty() ? directory / "out" : fs::path(out_);
    OutputDirectory out(target);
    if (writes_) cleaner_->repair(target);
    PreparedCase prepared = prepare(directory, options_);
    const std::vector<ReferenceTable> references =
        read_references(prepared.description);  // wrong ones before the solve
    const solver::Plan plan = solver::plan(prepared);
    if (writes_)
      for (const input::Diagnostic& warning : prepared.warnings) console().warn(warning);
    if (writes_) make_room(out);
    if (stopped()) return given_up(directory, "the solution began");
    if (!session_) {
      scratch_ = prepare_for_mpi(*cleaner_);
      session_ = std::make_unique<SolverSession>();
      StopSignals::take(false);  // PETSc has taken some of them
    }
    if (writes_) warn_of_slow_blas(console());
    say(plan_text(prepared.description.title, plan) + "\n");
    std::optional<Recording> recording;
    if (writes_) recording.emplace(prepared, options_, recording_);
    StateFiles states;
    gave_up_ = false;
    Checkpoint checkpoint(target, interval_);
    Unfinished unfinished = recall(checkpoint, prepared);
    solver::Journal& journal = unfinished.journal;
    unfinished.csv = csv_style().value_or(unfinished.csv);
    if (writes_ && states_ == 0)
      journal.on_change([&](const solver::Journal& now) { checkpoint.keep(now, unfinished.csv, prepared, out.aside()); });
    postproc::RunResult run = solve(prepared, states, out, states_ == 0 ? &journal : nullptr);
    if (!writes_) return run.status == postproc::Status::converged ? done : not_converged;
    const bool nothing = run.status == postproc::Status::failed && (!gave_up_ || run.increments == 0);
    if (nothing && gave_up_) return given_up(directory, "a step had converged");  // the earlier results are worth more
    if (run.status != postproc::Status::converged && gave_up_) {
      run.status = postproc::Status::partial;
      run.message = fmt::format("stopped by you ({})", StopSignals::name(signal()));
    }
    // Nothing converged: the pressures mean nothing.
    const auto evaluation = nothing
                                ? postproc::Evaluation{}
                                : solver::evaluate(prepared, run);
    postproc::StoredRun stored = write_all(run, evaluation, prepared, out, unfinished.csv);
    states.list(out.aside());
    const int regression = nothing ? done : regress(references, stored, out);
    if (!no_report_) report(stored, out);
    out.commit();
    if (!gave_up_) checkpoint.remove();
    say(final_text(run, evaluation, out.target()) + verdict_ + recording->finish(stored, out.target()));
    if (gave_up_ && checkpoint.there()) say(fmt::format("  to go on            the same command with --resume (from {})\n", checkpoint.file().string()));
    console().document()["runs"].push_back({{"directory", directory.string()}, {"out", out.target().string()}, {"summary", stored.summary}});
    const int status = std::max(status_of(run, directory, console()), regression);
    return run.status != postproc::Status::converged && gave_up_ ? 128 + signal() : status;
  }

  /// What an earlier run has reached, if it is to be gone on from.
  Unfinished recall(const Checkpoint& checkpoint, const PreparedCase& prepared) const {
    if (resume_ && checkpoint.there()) return checkpoint.read(prepared);
    if (resume_) say(fmt::format("there is no {}: from the beginning\n", checkpoint.file().string()));
    if (!resume_ && checkpoint.there())
      say(fmt::format("{} is of a run that has not ended; --resume would go on from there, this run begins anew\n", checkpoint.file().string()));
    return {};
  }

  /// What cannot be written is said before the solve, not after it.
  void make_room(OutputDirectory& out) const {
    ResultList names = names_of_results();
    if (!no_report_) names.insert("report.html");
    check_may_add(out.target(), names);
    out.aside();
  }

  /// A page that cannot be made does not cost the results.
  void report(const postproc::StoredRun& stored, OutputDirectory& out) const {
    try {
      write_report(stored, out.aside(), pictures_
                                            ? draw_pictures(out.aside())
                                            : postproc::report::Pictures{{}, "`snug report` draws them in a few seconds."});
    } catch (const std::exception& error) {
      console().warn(fmt::format("snug: warning: report.html is missing: {}", error.what()));
    }
  }

  /// Status of the comparison with the case's own tables. What is wrong with it does not cost the results.
  int regress(const std::vector<ReferenceTable>& references, postproc::StoredRun& stored, OutputDirectory& out) {
    verdict_.clear();
    try {
      const auto comparisons = compare_with(references, stored, out.aside(), out.target());
      verdict_ = verdict_text(comparisons);
      const bool within = std::all_of(comparisons.begin(), comparisons.end(), [](const auto& c) { return c.within(); });
      if (!within && quiet_) console().error(verdict_);
      return within ? done : outside_tolerance;
    } catch (const input::InputError& error) {
      console().error(error);
      return input_wrong;
    }
  }

  postproc::RunResult solve(const PreparedCase& prepared, StateFiles& states, OutputDirectory& out, solver::Journal* journal) {
    ProgressLine line(console(), quiet_);
    const solver::KeptStates kept{states_, [&](double way, const postproc::RunResult& state) {
                                    if (writes_) states.write(way, state, out.aside());
                                  }};
    return solver::solve(
        prepared, [&](const solver::Progress& progress) { line.show(progress); }, kept,
        [this] { return gave_up_ = gave_up_ || stopped(); }, journal);
  }

  void say(const std::string& text) const {
    if (!quiet_) console().say(text);
  }

  std::vector<std::string> directories_;
  CaseOptions options_;
  RecordingOptions recording_;
  std::string out_, csv_, status_file_;
  std::vector<std::string> variants_, sweeps_;
  std::vector<std::size_t> rank_widths_ = {0, 0};  ///< of standard output and error, 0: no terminal
  int ranks_ = 0, states_ = 0, jobs_ = 0;  // no ranks given: 0
  double interval_ = 60.0;
  bool quiet_ = false, pictures_ = false, no_report_ = false, resume_ = false;
  bool writes_ = true;   ///< rank 0
  bool gave_up_ = false;  ///< the solution, because the user asked for it
  std::string verdict_;  ///< of the last comparison
  std::optional<Cleaner> cleaner_;
  std::unique_ptr<Scratch> scratch_;
  std::unique_ptr<SolverSession> session_;
};

}  // namespace

std::unique_ptr<Command> make_run() { return std::make_unique<Run>(); }

}  // namespace snug::app
