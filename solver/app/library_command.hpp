// What the commands of the library have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "cases/input/suggestion.hpp"
#include "solver/app/library_commands.hpp"

namespace snug::app {

/// "ITEM=VALUE" of a command line; `command` is for the message. Throws input::InputError.
std::pair<std::string, std::string> item_and_value(const std::string& word, const std::string& command);

/// The kind that an option of the command line holds.
inline materials::Kind kind_of(const std::string& name) { return *input::choice_of<materials::Kind>(name); }

/// A command of the library: what it does stands in `act`.
class LibraryCommand : public Command {
 public:
  LibraryCommand(std::string name, std::string summary) : name_(std::move(name)), summary_(std::move(summary)) {}
  std::string name() const override { return name_; }
  std::string summary() const override { return summary_; }
  int execute() override {
    materials::Library library = open_library();
    return act(library);
  }

 protected:
  virtual int act(materials::Library& library) = 0;
  void declare_kind(CLI::App& app, const std::string& option, std::string& kind) const {
    app.add_option(option, kind, input::joined(input::choices_of<materials::Kind>()))
        ->check(CLI::IsMember(input::choices_of<materials::Kind>()));
  }

 private:
  std::string name_, summary_;
};

/// Those that write: add, copy, edit, remove, undo, import, export.
void add_changing_commands(std::vector<std::unique_ptr<Command>>& commands);

}  // namespace snug::app
