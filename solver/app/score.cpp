// snug score FILE.csv: ratings and comfort of given pressures, no mechanics.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "postproc/evaluate.hpp"
#include "postproc/summary.hpp"
#include "solver/app/command.hpp"
#include "solver/app/final_table.hpp"

namespace snug::app {

namespace {

class Score : public Command {
 public:
  std::string name() const override { return "score"; }
  std::string summary() const override { return "ratings and comfort of pressures by location, no mechanics"; }

  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "CSV with location and pressure_Pa, pressure_gf_per_cm2 or pressure_mmHg")
        ->required();
    app.add_option("--curves", curves_, "sensation curves: \"wear trial 2002\" or a CSV file")->capture_default_str();
    app.add_flag("--json", json_, "print JSON");
  }

  int execute() override {
    input::ComfortSpec comfort;
    comfort.curves.name = curves_;
    comfort.curves.where.file = "--curves";
    const postproc::Evaluation evaluation = postproc::score(postproc::read_pressures(file_), comfort);
    fmt::print("{}", json_ ? postproc::evaluation_json(evaluation) + "\n" : locations_text(evaluation));
    return done;
  }

 private:
  std::string file_, curves_ = "wear trial 2002";
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_score() { return std::make_unique<Score>(); }

}  // namespace snug::app
