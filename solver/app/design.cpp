// snug design DIR: the circumferences of a graduated tube for the pressures that it is made for.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cases/input/files.hpp"
#include "postproc/units.hpp"
#include "solver/app/command.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/progress.hpp"
#include "solver/app/solver_session.hpp"
#include "solver/library/graduated.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

/// "[{ height = \"0 mm\", girth = \"180.2 mm\" }, …]", to a tenth of a millimetre.
std::string toml_of(const std::vector<input::GirthRow>& rows, const char* between) {
  std::string text = "[";
  for (const input::GirthRow& row : rows)
    text += fmt::format("{}{{ height = \"{:.1f} mm\", girth = \"{:.1f} mm\" }}", &row == &rows.front() ? (*between == '\n' ? between : "") : fmt::format(",{}", between),
                        1e3 * row.height, 1e3 * row.girth);
  return text + (*between == '\n' ? ",\n]" : "]");
}

/// The only garment that is made for pressures. Throws input::InputError where there is none, or several.
int designed_garment(const input::Case& description) {
  int found = -1;
  const std::string file = (description.directory / "case.toml").string();
  for (std::size_t g = 0; g < description.garments.size(); ++g) {
    if (description.garments[g].pattern.pressures.empty()) continue;
    if (found >= 0) throw input::InputError({file, 0, 0}, "two garments are made for pressures", "design one after the other: leave the pressures of the other out");
    found = static_cast<int>(g);
  }
  if (found < 0)
    throw input::InputError({file, 0, 0}, "no garment says what pressures it is made for",
                            "write pattern = { kind = \"graduated\", length = \"300 mm\", pressures = [{ height = \"0 mm\", pressure = \"20 mmHg\" }, …] }");
  return found;
}

class Design : public Command {
 public:
  std::string name() const override { return "design"; }
  std::string summary() const override { return "circumferences of a graduated tube for the pressures that it is made for"; }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directory_, "case with a graduated tube and its pressures")->required();
    options_.declare(app);
    app.add_option("--rounds", rounds_, "solutions at most; each corrects the circumferences of the one before")->check(CLI::Range(1, 20))->capture_default_str();
    app.add_option("--within", within_, "percent of the wanted pressures that is near enough")->check(CLI::Range(0.1, 50.0))->capture_default_str();
    app.add_option("--out", out_, "file for the circumferences, as lines for case.toml (else they are printed)")->type_name("FILE");
    app.footer("Begins with the circumferences of the case, or where it has none with those of the law of Laplace. Exit status 1 where the pressures are\n"
               "not within reach after the last round; the circumferences that came nearest are given.");
  }

  int execute() override {
    cleaner_.emplace();
    double least = std::numeric_limits<double>::max();
    std::vector<input::GirthRow> best;
    CaseOptions options = options_;
    for (int round = 1; round <= rounds_ && least > 0.01 * within_; ++round) {
      const PreparedCase prepared = prepare(directory_, options);
      const int garment = designed_garment(prepared.description);
      start_solver();
      const postproc::RunResult run = solve(prepared);
      if (run.status != postproc::Status::converged) {
        fmt::print(stderr, "{}: error: round {} does not converge: {}\n", (fs::path(directory_) / "case.toml").string(), round, run.message);
        return not_converged;
      }
      const double error = run.numbers.at("largest_error_of_profile");
      fmt::print("{}", round_text(round, error, run));
      if (error < least) least = error, best = prepared.model.garments[garment].spec.pattern.circumferences;
      options.overrides = options_.overrides;
      options.overrides.push_back(key(prepared.description, garment) + "=" + toml_of(solver::corrected_girths(prepared.model, garment, prepared.meshes, run), " "));
    }
    const std::string lines = fmt::format("# snug design {}: within {:.1f} % of the pressures\ncircumferences = {}\n", directory_, 100.0 * least, toml_of(best, "\n  "));
    if (out_.empty()) fmt::print("\n{}", lines);
    else input::write_file(out_, lines);
    return least <= 0.01 * within_ ? done : outside_tolerance;
  }

 private:
  static std::string key(const input::Case& description, int garment) {
    return "garment." + (description.garments.size() > 1 ? description.garments[garment].name + "." : std::string()) + "pattern.circumferences";
  }

  static std::string round_text(int round, double error, const postproc::RunResult& run) {
    std::string text = fmt::format("round {}: within {:.1f} %\n  {:>10} {:>10} {:>10} {:>8}\n", round, 100.0 * error, "up [mm]", "wanted Pa", "found Pa", "mmHg");
    for (const postproc::ProfileRow& row : run.profile)
      text += fmt::format("  {:>10.4g} {:>10.0f} {:>10.0f} {:>8.2f}\n", 1e3 * row.height, row.wanted, row.found, postproc::to_mmHg(row.found));
    return text;
  }

  void start_solver() {
    if (session_) return;
    scratch_ = prepare_for_mpi(*cleaner_);
    session_ = std::make_unique<SolverSession>();
  }

  static postproc::RunResult solve(const PreparedCase& prepared) {
    ProgressLine line(false);
    return solver::solve(prepared, [&](const solver::Progress& progress) { line.show(progress); });
  }

  std::string directory_, out_;
  CaseOptions options_;
  int rounds_ = 4;
  double within_ = 2.0;
  std::optional<Cleaner> cleaner_;
  std::unique_ptr<Scratch> scratch_;
  std::unique_ptr<SolverSession> session_;
};

}  // namespace

std::unique_ptr<Command> make_design() { return std::make_unique<Design>(); }

}  // namespace snug::app
