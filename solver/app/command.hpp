// What every command of the program is.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/app/console.hpp"

namespace CLI {
class App;
}

namespace snug::app {

/// Exit status of the program.
enum Status : int {
  done = 0,
  outside_tolerance = 1,
  input_wrong = 2,
  not_converged = 3,  ///< what converged is kept and said
  internal_fault = 4
};

/// One command: declares its arguments, then executes with what was given.
class Command {
 public:
  virtual ~Command() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;
  /// Adds arguments and options; they are members of the command.
  virtual void declare(CLI::App& app) = 0;
  /// Returns the exit status. Throws input::InputError for wrong input.
  virtual int execute() = 0;
  /// Where it says what it has found; before it executes.
  virtual void speak_to(Console& console) { console_ = &console; }

 protected:
  Console& console() const { return *console_; }

 private:
  Console* console_ = nullptr;  ///< of the program
};

/// Commands below one name, "snug project list": the one that was asked for executes.
class CommandGroup : public Command {
 public:
  CommandGroup(std::string name, std::string summary, std::string footer) : name_(std::move(name)), summary_(std::move(summary)), footer_(std::move(footer)) {}
  std::string name() const override { return name_; }
  std::string summary() const override { return summary_; }
  void declare(CLI::App& app) override;
  int execute() override;
  void speak_to(Console& console) override;

 protected:
  std::vector<std::unique_ptr<Command>> commands_;

 private:
  std::string name_, summary_, footer_;
  std::vector<CLI::App*> parsers_;  ///< owned by the program's parser
};

/// Every command, in the order of the help.
std::vector<std::unique_ptr<Command>> all_commands();

std::unique_ptr<Command> make_run();
std::unique_ptr<Command> make_check();
std::unique_ptr<Command> make_mesh();
std::unique_ptr<Command> make_compare();
std::unique_ptr<Command> make_score();
std::unique_ptr<Command> make_report();
std::unique_ptr<Command> make_animate();
std::unique_ptr<Command> make_study();
std::unique_ptr<Command> make_design();
std::unique_ptr<Command> make_size();
std::unique_ptr<Command> make_convert();
std::unique_ptr<Command> make_pattern();
std::unique_ptr<Command> make_materials();
std::unique_ptr<Command> make_new();
std::unique_ptr<Command> make_explain();
std::unique_ptr<Command> make_list();
std::unique_ptr<Command> make_completion();
std::unique_ptr<Command> make_manual();

}  // namespace snug::app
