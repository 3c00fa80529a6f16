// snug score FILE.csv: ratings and comfort of given pressures, no mechanics; --fit: curves and memberships of a trial.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

#include "cases/input/csv.hpp"
#include "postproc/comfort/curve_fit.hpp"
#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/fuzzy_file.hpp"
#include "postproc/comfort/membership_fit.hpp"
#include "postproc/comfort/trial_validation.hpp"
#include "postproc/evaluate.hpp"
#include "postproc/summary.hpp"
#include "solver/app/comfort_pages.hpp"
#include "postproc/evaluation_document.hpp"
#include "solver/app/command.hpp"
#include "solver/app/final_table.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

/// What --fit may be told.
struct FitOptions {
  std::string shape = "linear", out = "fitted", source, patch = "not given", population = "not given";
};

/// The form of FIS files: one term of a location a rule, with the maximum for "or".
postproc::FuzzySystem single_terms(postproc::FuzzySystem system) {
  system.disjunction = "Maximum";
  return system;
}

void fit(const std::string& file, const FitOptions& options, Console& console) {
  input::Diagnostics diagnostics;
  const input::Csv table = input::read_csv(file, diagnostics);
  diagnostics.throw_if_any();
  postproc::SensationCurves curves = postproc::fit_curves(table, options.shape);
  curves.name = fs::path(options.out).filename().string();
  curves.source = options.source.empty() ? "fitted by snug score --fit to " + file : options.source;
  curves.patch = options.patch;
  curves.population = options.population;
  const postproc::MembershipFit memberships = postproc::fit_memberships(table);
  console.print("{}{}", statistics_text(curves), memberships_text(memberships));
  write_named(options.out + ".toml", postproc::curves_toml(curves));
  write_named(options.out + ".fll", postproc::fll_text(memberships.system));
  console.print("  files            {0}.toml (comfort.curves), {0}.fll (comfort.fuzzy)", options.out);
  try {
    write_named(options.out + ".fis", postproc::fis_text(single_terms(memberships.system)));
    console.print(", {}.fis (the same rules, one term of a location a rule)\n", options.out);
  } catch (const std::invalid_argument& fault) {
    console.print("; no FIS file: {}\n", fault.what());
  }
}

/// "1-4,7": the names of garments.
std::set<std::string> garments_of(const std::string& text) {
  std::set<std::string> garments;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    int from = 0, to = 0;
    char end = 0;
    if (std::sscanf(part.c_str(), "%d-%d%c", &from, &to, &end) == 2 && from <= to && to - from < 10000)
      for (int n = from; n <= to; ++n) garments.insert(std::to_string(n));
    else
      garments.insert(part);
  }
  return garments;
}

void validate(const std::string& file, const std::string& shape, const std::string& train, const std::string& test, Console& console) {
  input::Diagnostics diagnostics;
  const input::Csv table = input::read_csv(file, diagnostics);
  diagnostics.throw_if_any();
  const postproc::TrialValidation found = postproc::validate_trial(table, shape, garments_of(train), garments_of(test));
  postproc::Json rows = postproc::Json::array();
  for (const postproc::LocationValidation& one : found.locations)
    rows.push_back({{"location", one.location}, {"ratings", one.tested}, {"rms", one.rms}, {"largest", one.largest}, {"significant", one.significant}});
  console.document() = {{"shape", shape}, {"locations", rows}, {"ratings", found.ratings}, {"rms", found.rms}};
  console.print("curves ({}) of garments {}, ratings of garments {}\n  {:<16} {:>7} {:>8} {:>8}\n", shape, train, test, "location", "ratings", "rms", "largest");
  for (const postproc::LocationValidation& one : found.locations)
    console.print("  {:<16} {:>7} {:>8.4f} {:>8.4f}{}\n", one.location, one.tested, one.rms, one.largest, one.significant ? "" : "  not significant: the mean is told, and is not in the sum");
  console.print("  {:<16} {:>7} {:>8.4f}\n", "all", found.ratings, found.rms);
}

class Score : public Command {
 public:
  std::string name() const override { return "score"; }
  std::string summary() const override { return "ratings and comfort of pressures by location, no mechanics"; }

  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "CSV with location and pressure_Pa, pressure_gf_per_cm2 or pressure_mmHg")
        ->required();
    app.add_option("--curves", curves_, "sensation curves: a shipped set (snug list curves), a TOML or CSV file")
        ->capture_default_str();
    app.add_option("--fuzzy", fuzzy_, "fuzzy system: a shipped one, or a .fll or .fis file");
    app.add_option("--thresholds", thresholds_, "sets of named pressure ranges (snug list curves), once for each");
    app.add_option("--samples", spec_.samples, "draws for the interval of the score; 0: none")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    app.add_option("--seed", spec_.seed, "of the draws")->check(CLI::NonNegativeNumber)->capture_default_str();
    app.add_flag("--fit", fit_,
                 "FILE is a wear trial (location, a pressure, sensation_rating; optional sensation_term, answers): fit "
                 "curves and memberships, write OUT.toml, OUT.fll and OUT.fis");
    CLI::Option* train = app.add_option("--train", train_, "FILE is a wear trial with a column garment: curves of these garments, 1-4 or A,B, …")->type_name("GARMENTS");
    app.add_option("--test", test_, "… are tried on the ratings of these")->type_name("GARMENTS")->needs(train);
    app.add_option("--shape", options_.shape, "--fit, --train: form of the curves")
        ->check(CLI::IsMember({"linear", "piecewise", "logistic"}))
        ->capture_default_str();
    app.add_option("--out", options_.out, "--fit: name of the files written")->capture_default_str();
    app.add_option("--source", options_.source, "--fit: citation to keep in the curves file");
    app.add_option("--patch", options_.patch, "--fit: size of the patch of skin")->capture_default_str();
    app.add_option("--population", options_.population, "--fit: who was asked")->capture_default_str();
  }

  int execute() override {
    if (!train_.empty()) {
      if (test_.empty()) throw input::InputError({"--train", 0, 0}, "no garments are kept for the test", "name them: --test 5-8");
      validate(file_, options_.shape, train_, test_, console());
      return done;
    }
    if (fit_) {
      fit(file_, options_, console());
      return done;
    }
    const auto named = [](const std::string& name, const char* option) {
      input::MaterialEntry asked;
      asked.name = name;
      asked.where.file = option;
      return asked;
    };
    spec_.curves = named(curves_, "--curves");
    spec_.fuzzy = named(fuzzy_, "--fuzzy");
    for (const std::string& set : thresholds_) spec_.thresholds.push_back(named(set, "--thresholds"));
    const postproc::Evaluation evaluation = postproc::score(postproc::read_pressures(file_), spec_);
    console().say(locations_text(evaluation));
    console().document() = postproc::evaluation_document(evaluation);
    return done;
  }

 private:
  std::string file_, curves_ = "wear trial 2002", fuzzy_, train_, test_;
  std::vector<std::string> thresholds_;
  input::ComfortSpec spec_;
  FitOptions options_;
  bool fit_ = false;
};

}  // namespace

std::unique_ptr<Command> make_score() { return std::make_unique<Score>(); }

}  // namespace snug::app
