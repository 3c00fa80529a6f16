// snug materials list, snug materials show NAME
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "solver/app/command.hpp"
#include "solver/app/material_list.hpp"

namespace snug::app {

namespace {

class Materials : public Command {
 public:
  std::string name() const override { return "materials"; }
  std::string summary() const override { return "the shipped fabrics and tissues: list, show NAME"; }

  void declare(CLI::App& app) override {
    app.require_subcommand(1);
    app.add_subcommand("list", "the names of all entries");
    show_ = app.add_subcommand("show", "values and source of one entry");
    show_->add_option("NAME", entry_, "fabric or tissue")->required();
  }

  int execute() override {
    fmt::print("{}", show_->parsed() ? material_text(entry_) : materials_text());
    return done;
  }

 private:
  CLI::App* show_ = nullptr;  // owned by the program's parser
  std::string entry_;
};

}  // namespace

std::unique_ptr<Command> make_materials() { return std::make_unique<Materials>(); }

}  // namespace snug::app
