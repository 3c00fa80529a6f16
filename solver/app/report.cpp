// snug report OUT...: results as a page to look at.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cases/input/diagnostics.hpp"
#include "postproc/report/page.hpp"
#include "postproc/documents.hpp"
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
    app.add_flag("--compare", compare_, "one page that puts the results side by side, compare.html");
    app.add_option("--out", file_, "where the page of --compare goes (compare.html)")->type_name("FILE");
    app.add_flag("--no-pictures", no_pictures_, "leave the pictures from four sides out (they take a few seconds)");
  }

  int execute() override {
    if (compare_) return compare();
    if (!file_.empty())
      throw input::InputError({"--out", 0, 0}, "only the page of --compare has a place of its own",
                              "leave --out out: report.html goes beside the results");
    for (const fs::path out : results_) {
      write_report(out, no_pictures_ ? left_out() : draw_pictures(out));
      console().print("{}\n", (out / "report.html").string());
      console().document()["files"].push_back((out / "report.html").string());
    }
    return done;
  }

 private:
  int compare() const {
    if (results_.size() < 2)
      throw input::InputError({"--compare", 0, 0}, "there is one result to compare", "name two or more");
    const fs::path file = file_.empty() ? "compare.html" : fs::path(file_);
    write_page(postproc::report::comparison_page({results_.begin(), results_.end()}), file);
    console().print("{}\n", file.string());
    console().document()["files"].push_back(file.string());
    return done;
  }

  static postproc::report::Pictures left_out() { return {{}, "they were left out (--no-pictures)."}; }

  std::vector<std::string> results_;
  std::string file_;
  bool compare_ = false;
  bool no_pictures_ = false;
};

}  // namespace

std::unique_ptr<Command> make_report() { return std::make_unique<Report>(); }

}  // namespace snug::app
