#include <CLI/CLI.hpp>

#include "solver/app/command.hpp"

namespace snug::app {

void CommandGroup::declare(CLI::App& app) {
  app.require_subcommand(1);
  for (const auto& command : commands_) {
    parsers_.push_back(app.add_subcommand(command->name(), command->summary()));
    command->declare(*parsers_.back());
  }
  app.footer(footer_);
}

int CommandGroup::execute() {
  for (std::size_t n = 0; n < commands_.size(); ++n)
    if (parsers_[n]->parsed()) return commands_[n]->execute();
  return input_wrong;
}

void CommandGroup::speak_to(Console& console) {
  Command::speak_to(console);
  for (const auto& command : commands_) command->speak_to(console);
}

}  // namespace snug::app
