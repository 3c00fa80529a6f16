#include "solver/app/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "cases/input/diagnostics.hpp"
#include "cases/input/suggestion.hpp"
#include "solver/app/command.hpp"
#include "solver/app/console.hpp"
#include "solver/app/manual/command_page.hpp"
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
  commands.push_back(make_completion());
  commands.push_back(make_manual());
  return commands;
}

namespace {

/// Ends what is said; a full disk behind standard output is told, and not by silence.
int said(int status, const std::string& command, Console& console) {
  if (console.finish(command, status)) return status;
  console.error(fmt::format("snug {}: error: standard output cannot be written to; see what it leads to", command));
  return status == done ? internal_fault : status;
}

/// What to do about a path that could not be read or written.
std::string remedy_of(const std::error_code& error) {
  if (error == std::errc::no_space_on_device || error.value() == EDQUOT) return "make room there (df -h tells what there is), or name another place with --out";
  if (error == std::errc::read_only_file_system) return "name another place with --out";
  return "see what this path leads to and who may read and write it";
}

/// Runs a command and says what went wrong.
int execute(Command& command, Console& console) {
  try {
    return command.execute();
  } catch (const input::InputError& error) {
    console.error(error);
    return input_wrong;
  } catch (const std::filesystem::filesystem_error& error) {
    const input::Location where{error.path1().empty() ? command.name() : error.path1().string(), 0, 0};
    console.error(input::InputError(where, error.code().message(), remedy_of(error.code())));
    return input_wrong;
  } catch (const std::bad_alloc&) {
    console.error(fmt::format("snug {}: error: the memory of the machine is used up; take fewer cells (snug check tells what a case needs)", command.name()));
    return input_wrong;
  } catch (const std::exception& error) {
    console.error(fmt::format("snug {}: error: {}; this is a fault of snug or of the machine, not of the input", command.name(), error.what()));
  } catch (...) {
    console.error(fmt::format("snug {}: error: unknown fault; this is a fault of snug, not of the input", command.name()));
  }
  return internal_fault;
}

/// Every command that has none below it answers programs, too.
void add_json(CLI::App& app, bool& json) {
  const std::vector<CLI::App*> below = app.get_subcommands({});
  for (CLI::App* one : below) add_json(*one, json);
  if (below.empty()) app.add_flag("--json", json, "answer with one JSON document on standard output: numbers in SI, warnings and errors in it");
}

/// "materials find", as it was asked for.
std::string path_asked_for(const CLI::App& program) {
  std::string path;
  for (const CLI::App* app = &program; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    path += (path.empty() ? "" : " ") + app->get_name();
  }
  return path;
}

std::string without_value(const std::string& word) { return word.substr(0, word.find('=')); }

/// What a word that nothing expects was likely meant to be: "; did you mean …"; empty where nothing is near. Looked for in the command that the words lead to.
std::string likely(const CLI::App& program, int argc, char** argv) {
  const CLI::App* command = &program;
  std::string path = "snug";
  for (int i = 1; i < argc; ++i) {
    const std::string word = without_value(argv[i]);
    std::vector<std::string> known;
    for (const CLI::App* below : command->get_subcommands({})) known.push_back(below->get_name());
    if (!word.starts_with("-")) {
      if (known.empty()) continue;
      if (std::find(known.begin(), known.end(), word) != known.end()) {
        command = command->get_subcommand(word), path += " " + word;
        continue;
      }
      const std::string near = input::nearest(word, known);
      return near.empty() ? "" : "; did you mean " + path + " " + near + "?";
    }
    known.clear();
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    if (const std::string near = input::nearest(word, known); !near.empty()) return "; did you mean " + near + "?";
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
  program.formatter_fn([](const CLI::App* app, const std::string&, CLI::AppFormatMode) { return help_text(command_page(*app)); });
  bool json = false;
  const auto commands = all_commands();
  for (const auto& command : commands) command->declare(*program.add_subcommand(command->name(), command->summary()));
  add_json(program, json);
  Console console;
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const CLI::App* asked = &program;
    while (!asked->get_subcommands().empty()) asked = asked->get_subcommands().front();
    console.say(asked->help());
    return said(done, "help", console);
  } catch (const CLI::Success& asked) {  // --version
    return program.exit(asked);
  } catch (const CLI::ParseError& error) {
    if (std::find(argv, argv + argc, std::string_view("--json")) != argv + argc) console.answer_in_json();
    const bool no_command = argc > 1 && argv[1][0] != '-' && std::none_of(commands.begin(), commands.end(), [&](const auto& command) { return command->name() == argv[1]; });
    console.error(fmt::format("snug: error: {}{}; snug --help and snug COMMAND --help tell what can be written",
                              no_command ? fmt::format("there is no command \"{}\"", argv[1]) : std::string(error.what()), likely(program, argc, argv)));
    return said(input_wrong, path_asked_for(program), console);
  }
  if (json) console.answer_in_json();
  for (const auto& command : commands) {
    if (!program.got_subcommand(command->name())) continue;
    command->speak_to(console);
    return said(execute(*command, console), path_asked_for(program), console);
  }
  return input_wrong;
}

}  // namespace snug::app
