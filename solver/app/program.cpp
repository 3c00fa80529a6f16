#include "solver/app/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "cases/input/diagnostics.hpp"
#include "cases/input/suggestion.hpp"
#include "solver/app/command.hpp"
#include "solver/app/recorded_commands.hpp"

namespace snug::app {

std::vector<std::unique_ptr<Command>> all_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(make_run());
  commands.push_back(make_check());
  commands.push_back(make_mesh());
  commands.push_back(make_compare());
  commands.push_back(make_score());
  commands.push_back(make_report());
  commands.push_back(make_animate());
  commands.push_back(make_study());
  commands.push_back(make_design());
  commands.push_back(make_size());
  commands.push_back(make_convert());
  commands.push_back(make_pattern());
  commands.push_back(make_materials());
  commands.push_back(make_project());
  commands.push_back(make_library());
  commands.push_back(make_new());
  commands.push_back(make_explain());
  commands.push_back(make_list());
  return commands;
}

namespace {

/// What was said may stand in a buffer until now: a full disk behind standard output is told, and not by silence.
int said(int status, const Command& command) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  fmt::print(stderr, "snug {}: error: standard output cannot be written to; see what it leads to\n", command.name());
  return status == done ? internal_fault : status;
}

/// Runs a command and says what went wrong.
int execute(Command& command) {
  try {
    return command.execute();
  } catch (const input::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return input_wrong;
  } catch (const std::filesystem::filesystem_error& error) {
    const input::Location where{error.path1().empty() ? command.name() : error.path1().string(), 0, 0};
    fmt::print(stderr, "{}\n", input::to_string({where, error.code().message(), "see what this path leads to and who may read and write it"}));
    return input_wrong;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "snug {}: error: the memory of the machine is used up; take fewer cells (snug check tells what a case needs)\n", command.name());
    return input_wrong;
  } catch (const std::exception& error) {
    fmt::print(stderr, "snug {}: error: {}; this is a fault of snug or of the machine, not of the input\n",
               command.name(), error.what());
  } catch (...) {
    fmt::print(stderr, "snug {}: error: unknown fault; this is a fault of snug, not of the input\n", command.name());
  }
  return internal_fault;
}

std::string without_value(const std::string& word) { return word.substr(0, word.find('=')); }

/// What a word that nothing expects was likely meant to be: "; did you mean …"; empty where nothing is near.
std::string likely(const CLI::App& program, int argc, char** argv) {
  std::vector<std::string> commands;
  for (const CLI::App* command : program.get_subcommands({})) commands.push_back(command->get_name());
  const std::string first = argc > 1 ? argv[1] : "";
  const auto command = std::find(commands.begin(), commands.end(), first);
  if (command == commands.end()) {
    const std::string near = first.empty() || first[0] == '-' ? "" : input::nearest(first, commands);
    return near.empty() ? "" : "; did you mean snug " + near + "?";
  }
  std::vector<std::string> options;
  for (const CLI::Option* option : program.get_subcommand(first)->get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = without_value(argv[i]);
    if (!word.starts_with("--") || std::find(options.begin(), options.end(), word) != options.end()) continue;
    if (const std::string near = input::nearest(word, options); !near.empty()) return "; did you mean " + near + "?";
  }
  return "";
}

}  // namespace

int run_program(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit of the shell is a write that fails, not the program's end
  CLI::App program("snug predicts what a garment does to the body that wears it.", "snug");
  program.set_version_flag("--version", "snug " SNUG_VERSION);
  program.require_subcommand(1);
  program.footer("Exit status: 0 done, 1 outside a tolerance, 2 wrong input, 3 no convergence, 4 internal fault, 130 or 143 stopped by you.");
  const auto commands = all_commands();
  for (const auto& command : commands) command->declare(*program.add_subcommand(command->name(), command->summary()));
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    const bool no_command = argc > 1 && argv[1][0] != '-' && std::none_of(commands.begin(), commands.end(), [&](const auto& command) { return command->name() == argv[1]; });
    fmt::print(stderr, "snug: error: {}{}; snug --help and snug COMMAND --help tell what can be written\n",
               no_command ? fmt::format("there is no command \"{}\"", argv[1]) : std::string(error.what()), likely(program, argc, argv));
    return input_wrong;
  }
  for (const auto& command : commands)
    if (program.got_subcommand(command->name())) return said(execute(*command), *command);
  return input_wrong;
}

}  // namespace snug::app
