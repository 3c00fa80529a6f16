// snug new NAME --like CASE: a commented starter case.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "cases/input/diagnostics.hpp"
#include "cases/input/suggestion.hpp"
#include "solver/app/case_copy.hpp"
#include "solver/app/command.hpp"
#include "solver/app/shipped_cases.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// The directory to copy: a shipped case by name, or any case directory by its path.
fs::path model_directory(const std::string& like) {
  const std::vector<std::string> names = shipped_cases();
  if (std::find(names.begin(), names.end(), like) != names.end()) return shipped_cases_folder() / like;
  for (const std::string& name : names)  // the last part of the name serves, too
    if (fs::path(name).filename() == like) return shipped_cases_folder() / name;
  if (fs::is_regular_file(fs::path(like) / "case.toml")) return like;
  throw input::InputError({"--like", 0, 0}, "there is no case \"" + like + "\"", input::did_you_mean(like, names));
}

class New : public Command {
 public:
  std::string name() const override { return "new"; }
  std::string summary() const override { return "a commented starter case, copied from a shipped one"; }

  void declare(CLI::App& app) override {
    app.add_option("NAME", directory_, "directory to make")->required();
    app.add_option("--like", like_, "the case to copy (snug list names them)")
        ->type_name("CASE")
        ->capture_default_str();
  }

  int execute() override {
    const fs::path from = model_directory(like_);
    copy_case(from, directory_);
    console().print("{} is a copy of {}. Next: edit {}/case.toml, then snug check {}\n", directory_, like_, directory_,
               directory_);
    return done;
  }

 private:
  std::string directory_, like_ = "thigh-sleeve";
};

}  // namespace

std::unique_ptr<Command> make_new() { return std::make_unique<New>(); }

}  // namespace snug::app
