// snug design DIR: the circumferences of a graduated tube for the pressures that it is made for.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cases/input/files.hpp"
#include "solver/app/cleaner.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/size/cut.hpp"

namespace snug::app {

namespace {

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
               "not within reach after the last round; the circumferences that came nearest are given. snug size looks for one factor on all of them.");
  }

  int execute() override {
    const Cleaner cleaner;
    designed_garment(options_.read(directory_));
    CourseCut cut;
    const FoundCut found = search_cut(directory_, options_, cut, rounds_, 0.01 * within_, cleaner, console());
    if (found.settings.empty()) return found.status;
    const std::string lines = fmt::format("# snug design {}: within {:.1f} % of the pressures\ncircumferences = {}\n", directory_, 100.0 * found.error, found.settings.front().literal);
    console().document()["circumferences_toml"] = found.settings.front().literal;
    console().document()["error"] = found.error;
    if (out_.empty()) console().say_as_it_is("\n" + lines);
    else input::write_file(out_, lines);
    if (found.status != done) return found.status;
    return found.error <= 0.01 * within_ ? done : outside_tolerance;
  }

 private:
  std::string directory_, out_;
  CaseOptions options_;
  int rounds_ = 4;
  double within_ = 2.0;
};

}  // namespace

std::unique_ptr<Command> make_design() { return std::make_unique<Design>(); }

}  // namespace snug::app
