// snug check DIR...: reads and validates, prints the plan, solves and writes nothing.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/print_plan.hpp"

namespace snug::app {

namespace {

class Check : public Command {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override { return "read, mesh and validate a case; print the plan; solve nothing"; }

  void declare(CLI::App& app) override {
    app.add_option("DIR", directories_, "case directories")->required();
    options_.declare(app);
  }

  int execute() override {
    int status = done;
    for (const std::string& directory : directories_) {
      Json& told = console().document()["cases"].emplace_back(Json{{"directory", directory}, {"right", false}});
      try {
        const PreparedCase prepared = prepare(directory, options_);
        const solver::Plan plan = solver::plan(prepared);
        for (const input::Diagnostic& warning : prepared.warnings) console().warn(warning);
        console().print("{}\n{}\n", plan_text(prepared.description.title, plan), quality_text(prepared));
        told["right"] = true;
        told["title"] = prepared.description.title;
        told["plan"] = plan_json(plan);
        add_meshes(told, prepared);
      } catch (const input::InputError& error) {
        console().error(error);
        status = input_wrong;
      }
    }
    return status;
  }

 private:
  std::vector<std::string> directories_;
  CaseOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_check() { return std::make_unique<Check>(); }

}  // namespace snug::app
