// snug report OUT...: results as a page to look at.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "postproc/report/page.hpp"
#include "solver/app/command.hpp"
#include "solver/app/report_files.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

class Report : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override { return "write report.html of results: maps, tables, comfort, a view to turn"; }

  void declare(CLI::App& app) override {
    app.add_option("OUT", results_, "directories that runs wrote")->required();
    app.add_flag("--no-pictures", no_pictures_, "leave the pictures from four sides out (they take a few seconds)");
  }

  int execute() override {
    for (const fs::path out : results_) {
      write_report(out, no_pictures_ ? left_out() : draw_pictures(out));
      fmt::print("{}\n", (out / "report.html").string());
    }
    return done;
  }

 private:
  static postproc::report::Pictures left_out() { return {{}, "they were left out (--no-pictures)."}; }

  std::vector<std::string> results_;
  bool no_pictures_ = false;
};

}  // namespace

std::unique_ptr<Command> make_report() { return std::make_unique<Report>(); }

}  // namespace snug::app
