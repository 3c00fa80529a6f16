// snug completion SHELL and snug man: what the program takes, for shells and for man(1).
#include <CLI/CLI.hpp>
#include <algorithm>

#include "cases/input/key_list.hpp"
#include "solver/app/command.hpp"
#include "solver/app/manual/command_page.hpp"

namespace snug::app {

namespace {

/// As --set takes them: of lists of tables those that may stand without brackets.
std::vector<std::string> settable_keys() {
  std::vector<std::string> keys;
  for (const input::KeyRow& row : input::case_keys())
    if (row.kind.find("section") == row.kind.npos && row.key.find("[]") == row.key.npos) keys.push_back(row.key);
  return keys;
}

class Completion : public Command {
 public:
  std::string name() const override { return "completion"; }
  std::string summary() const override { return "a script that completes commands, options and keys in your shell: source <(snug completion bash)"; }
  void declare(CLI::App& app) override {
    program_ = app.get_parent();
    app.add_option("SHELL", shell_, "where it is to complete")->required()->check(CLI::IsMember(input::choices_of<Shell>()));
    app.footer("bash: source <(snug completion bash) in ~/.bashrc; zsh: the same in ~/.zshrc after compinit; fish: snug completion fish | source.\n"
               "An installed snug has all three at their usual places.");
  }
  int execute() override {
    console().say_as_it_is(completion_script(*input::choice_of<Shell>(shell_), command_pages(*program_), settable_keys()));
    return done;
  }

 private:
  const CLI::App* program_ = nullptr;  ///< of the program
  std::string shell_;
};

class Manual : public Command {
 public:
  std::string name() const override { return "man"; }
  std::string summary() const override { return "the manual page: snug man | man -l -"; }
  void declare(CLI::App& app) override { program_ = app.get_parent(); }
  int execute() override {
    console().say_as_it_is(manual_page(command_pages(*program_), SNUG_VERSION));
    return done;
  }

 private:
  const CLI::App* program_ = nullptr;  ///< of the program
};

}  // namespace

std::unique_ptr<Command> make_completion() { return std::make_unique<Completion>(); }
std::unique_ptr<Command> make_manual() { return std::make_unique<Manual>(); }

}  // namespace snug::app
