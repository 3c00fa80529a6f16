#include "solver/app/batch/batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "cases/input/files.hpp"
#include "cases/input/job_spec.hpp"
#include "cases/input/suggestion.hpp"
#include "postproc/documents.hpp"
#include "postproc/report/page.hpp"
#include "postproc/store.hpp"
#include "postproc/tables.hpp"
#include "postproc/units.hpp"
#include "solver/app/batch/variants.hpp"
#include "solver/app/command.hpp"
#include "solver/app/report_files.hpp"
#include "solver/app/result_list.hpp"
#include "solver/app/stop_signals.hpp"
#include "solver/app/study/child_process.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

struct Job {
  std::string name, directory;
  std::vector<std::string> set;
  fs::path out;
  ChildOutcome outcome = {};
  bool started = false;

  /// Its results are there and of this run.
  bool has_results() const { return started && (outcome.status == done || outcome.status == outside_tolerance || outcome.status == not_converged) && fs::exists(out / postproc::summary_file); }
};

std::string last_part(const fs::path& directory) {
  const fs::path whole = fs::absolute(directory).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// The variants that a case is run with; the case itself where it has none.
std::vector<input::StudyVariant> variants_of(const BatchRequest& request, const std::string& directory, const std::vector<input::StudyVariant>& swept) {
  if (!swept.empty()) return swept;
  const std::vector<input::StudyVariant> all = input::read_jobs(directory, request.options.preparation().reading).variants;
  if (request.variants.empty()) return all;
  std::vector<input::StudyVariant> chosen;
  std::vector<std::string> names;
  for (const input::StudyVariant& one : all) names.push_back(one.name);
  for (const std::string& name : request.variants) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw input::InputError({"--variant", 0, 0}, fmt::format("{} has no [[variant]] \"{}\"", directory, name), names.empty() ? "add it, or leave --variant out" : input::did_you_mean(name, names));
    chosen.push_back(all[static_cast<std::size_t>(found - names.begin())]);
  }
  return chosen;
}

std::vector<Job> jobs_of(const BatchRequest& request, const std::vector<input::StudyVariant>& swept) {
  std::vector<Job> jobs;
  std::vector<std::string> cases;
  for (const std::string& directory : request.directories) cases.push_back(last_part(directory));
  const std::vector<std::string> folders = folder_names(cases);
  for (std::size_t d = 0; d < request.directories.size(); ++d) {
    const std::string& directory = request.directories[d];
    const bool alone = request.directories.size() == 1;
    const fs::path own = request.out.empty() ? fs::path(directory) / "out" : alone ? fs::path(request.out) : fs::path(request.out) / folders[d];
    std::vector<input::StudyVariant> variants;
    try {
      variants = variants_of(request, directory, swept);
    } catch (const input::InputError&) {
      if (alone || !request.variants.empty()) throw;  // of several the run itself says what is wrong
    }
    if (variants.empty()) {
      jobs.push_back({folders[d], directory, {}, own});
      continue;
    }
    std::vector<std::string> names;
    for (const input::StudyVariant& one : variants) names.push_back(one.name);
    const std::vector<std::string> of_variants = folder_names(names);
    for (std::size_t v = 0; v < variants.size(); ++v) jobs.push_back({alone ? names[v] : folders[d] + ", " + names[v], directory, variants[v].set, own / of_variants[v]});
  }
  return jobs;
}

std::vector<std::string> command_line(const Job& job, const BatchRequest& request, bool side_by_side) {
  std::vector<std::string> words = {fs::read_symlink("/proc/self/exe").string(), "run", fs::absolute(job.directory).string(), "--quiet", "--out", fs::absolute(job.out).string()};
  for (const std::string& word : request.options.words()) words.push_back(word);
  for (const std::string& set : job.set) words.push_back("--set"), words.push_back(set);
  words.push_back("--set"), words.push_back("variant=[]");  // it is one of them
  words.insert(words.end(), request.words.begin(), request.words.end());
  if (const int ranks = request.ranks > 0 ? request.ranks : side_by_side ? 1 : 0; ranks > 0) words.push_back("--ranks"), words.push_back(std::to_string(ranks));
  return words;
}

std::string status_word(const Job& job) {
  switch (job.outcome.status) {
    case done: return "converged";
    case outside_tolerance: return "converged, outside its tolerance";
    case input_wrong: return "wrong input";
    case not_converged: return "not converged";
    default: return job.started ? fmt::format("ended with status {}", job.outcome.status) : "not run";
  }
}

std::string last_lines(const std::string& output) {
  std::string text = output;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.size() > 2000 ? "…" + text.substr(text.size() - 2000) : text;
}

/// ", Ankle class 2 (RAL-GZ 387)", ", calf 97.3 % of its target", ", sensor shin 12.10 mmHg".
std::string judged_text(const postproc::Json& summary) {
  const postproc::Json none = postproc::Json::array();
  std::string text;
  for (const auto& row : summary.value("thresholds", none))
    if (const std::string verdict = row.value("verdict", ""); !verdict.empty()) text += fmt::format(", {} {} ({})", row.value("location", ""), verdict, row.value("set", ""));
  for (const auto& row : summary.value("targets", none)) text += fmt::format(", {} {:.1f} % of its target", row.value("name", ""), 100.0 * row.value("found_over_wanted", 0.0));
  for (const auto& row : summary.value("sensors", none)) text += fmt::format(", sensor {} {:.2f} mmHg", row.value("name", ""), row.value("reading_mmHg", 0.0));
  return text;
}

/// "Ankle 18.20, Calf 12.95 mmHg, Ankle class 2 (RAL-GZ 387)"
std::string pressures_text(const postproc::Json& summary) {
  std::string text;
  for (const auto& row : summary.value("locations", postproc::Json::array()))
    if (row.value("coverage", 0.0) > 0.0) text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", row.value("location", ""), row.value("mean_pressure_mmHg", 0.0));
  if (text.empty() && summary.at("numbers").contains("mean_contact_pressure_Pa"))
    return fmt::format("{:.2f} mmHg in the mean", postproc::to_mmHg(summary.at("numbers").at("mean_contact_pressure_Pa").get<double>()));
  return text.empty() ? text : text + " mmHg";
}

std::string results_text(const fs::path& out) {
  const postproc::Json summary = postproc::Json::parse(input::read_file(out / postproc::summary_file));
  const std::string pressures = pressures_text(summary), judged = judged_text(summary);
  return pressures.empty() && !judged.empty() ? judged.substr(2) : pressures + judged;
}

std::string ended_text(const Job& job) {
  std::string text = fmt::format("{}: {}, {:.1f} s", job.name, status_word(job), job.outcome.wall);
  if (job.has_results()) text += fmt::format("; {} → {}", results_text(job.out), job.out.string());
  if (const std::string said = last_lines(job.outcome.output); !said.empty()) text += "\n  " + [&] {
    std::string indented;
    for (const char c : said) indented += c == '\n' ? std::string("\n  ") : std::string(1, c);
    return indented;
  }();
  return text + "\n";
}

postproc::Json jobs_json(const std::vector<Job>& jobs) {
  postproc::Json json = postproc::Json::array();
  for (const Job& job : jobs) {
    json.push_back({{"name", job.name}, {"directory", job.directory}, {"set", job.set}, {"exit_status", job.started ? postproc::Json(job.outcome.status) : postproc::Json()}, {"said", last_lines(job.outcome.output)},
                    {"out", job.out.string()}, {"summary", nullptr}});
    if (job.has_results()) json.back()["summary"] = postproc::Json::parse(input::read_file(job.out / postproc::summary_file));
  }
  return json;
}

/// Runs them, some at a time, in their order.
void run_jobs(std::vector<Job>& jobs, const BatchRequest& request, int at_once, Console& console) {
  std::atomic<std::size_t> next = 0;
  std::mutex speaking;
  const auto work = [&] {
    for (std::size_t j; StopSignals::received() == 0 && (j = next++) < jobs.size();) {
      Job& job = jobs[j];
      job.started = true;
      job.outcome = run_child(command_line(job, request, at_once > 1), fs::current_path());
      const std::scoped_lock lock(speaking);
      const bool fine = job.outcome.status == done;
      if (!fine) console.error(ended_text(job));
      else if (!request.quiet) console.say(ended_text(job));
    }
  };
  std::vector<std::thread> workers;
  for (int w = 0; w < at_once; ++w) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
}

postproc::report::Comparison comparison_of(const std::vector<Job>& jobs, const std::vector<Sweep>& sweeps) {
  postproc::report::Comparison comparison;
  const bool one_key = sweeps.size() == 1 && sweeps.front().values.size() == jobs.size();
  if (one_key) comparison.title = fmt::format("{}: {}", sweeps.front().key, fmt::join(sweeps.front().values, " · "));
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const Job& job = jobs[j];
    if (!job.has_results()) {
      comparison.missing.push_back({job.name, status_word(job) + (job.outcome.output.empty() ? "" : ": " + last_lines(job.outcome.output))});
      continue;
    }
    comparison.runs.push_back({job.out, one_key ? sweeps.front().values[j] : job.name});
    if (sweeps.size() == 1 && !sweeps.front().numbers.empty()) comparison.values.push_back(sweeps.front().numbers[j % sweeps.front().numbers.size()]);
  }
  if (sweeps.size() == 1) comparison.axis = sweeps.front().key + (sweeps.front().unit.empty() ? "" : " [" + sweeps.front().unit + "]");
  return comparison;
}

/// One of ours where it was not there or nothing is in it, so that a later run may put its results there.
void make_folder(const fs::path& folder) {
  fs::create_directories(folder);
  if (fs::is_empty(folder)) write_result_list(folder, {}, true);
}

fs::path page_folder(const BatchRequest& request) {
  if (!request.out.empty()) return request.out;
  return request.directories.size() == 1 ? fs::path(request.directories.front()) / "out" : fs::path(".");
}

void write_pages(const std::vector<Job>& jobs, const BatchRequest& request, const std::vector<Sweep>& sweeps, Console& console) {
  const postproc::report::Comparison comparison = comparison_of(jobs, sweeps);
  if (comparison.runs.empty()) return;
  const fs::path folder = page_folder(request);
  make_folder(folder);
  write_page(postproc::report::comparison_page(comparison), folder / "compare.html");
  console.document()["page"] = (folder / "compare.html").string();
  if (!request.quiet) console.print("side by side: {}\n", (folder / "compare.html").string());
  if (sweeps.empty()) return;
  write_page(postproc::report::comparison_table(comparison, request.csv), folder / "sweep.csv");
  console.document()["table"] = (folder / "sweep.csv").string();
  if (!request.quiet) console.print("as a table: {}\n", (folder / "sweep.csv").string());
}

}  // namespace

bool BatchRequest::varies() const {
  if (!sweeps.empty() || !variants.empty()) return true;
  const auto has_variants = [&](const std::string& directory) {
    try {
      return !input::read_jobs(directory, options.preparation().reading).variants.empty();
    } catch (const input::InputError&) {
      return false;  // the run tells all that is wrong
    }
  };
  return std::any_of(directories.begin(), directories.end(), has_variants);
}

int run_batch(const BatchRequest& request, Console& console) {
  std::vector<Sweep> sweeps;
  for (const std::string& text : request.sweeps) sweeps.push_back(sweep_of(text));
  if (!sweeps.empty() && !request.variants.empty()) throw input::InputError({"--variant", 0, 0}, "a sweep and variants are asked for", "leave one out");
  std::vector<Job> jobs = jobs_of(request, sweeps.empty() ? std::vector<input::StudyVariant>{} : combinations(sweeps));
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / std::max(1, request.ranks));
  for (const Job& job : jobs) make_folder(fs::absolute(job.out).parent_path());
  const int at_once = std::clamp(request.jobs > 0 ? request.jobs : cores, 1, static_cast<int>(jobs.size()));
  ::setenv("OPENBLAS_NUM_THREADS", std::to_string(std::max(1, cores / at_once)).c_str(), 0);
  if (!request.quiet) console.print("{} run{}, {} at a time\n", jobs.size(), jobs.size() == 1 ? "" : "s", at_once);
  const StopSignals signals(false);
  run_jobs(jobs, request, at_once, console);
  console.document()["runs"] = jobs_json(jobs);
  if (request.page) write_pages(jobs, request, sweeps, console);
  int status = done;
  for (const Job& job : jobs) status = std::max(status, job.started ? job.outcome.status : 0);
  return StopSignals::received() ? 128 + StopSignals::received() : status;
}

}  // namespace snug::app
