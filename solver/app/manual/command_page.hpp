// What the commands of the program take, as values: made of the parser's own tree, so that help, completion and manual cannot differ from it.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace snug::app {

/// What stands in the place of a value.
enum class Words { none, text, folder, file, key, key_and_value, choice };

struct OptionPage {
  std::vector<std::string> names;    ///< "-h", "--help"; of a positional its name
  std::string type;                  ///< "KEY=VALUE"; empty: a flag
  std::string meaning;
  std::string default_value;
  std::vector<std::string> choices;  ///< the admissible texts, where they are few
  Words words = Words::none;
  bool required = false, many = false;
};

struct CommandPage {
  std::string path;  ///< "materials find"; empty: the program
  std::string summary, footer;
  std::vector<OptionPage> arguments, options;
  std::vector<std::string> below;  ///< its commands
  std::vector<std::string> summaries_below;
};

/// One command. `app` may be the program itself.
CommandPage command_page(const CLI::App& app);
/// The program, its commands and theirs, each before those below it.
std::vector<CommandPage> command_pages(const CLI::App& program);

/// "--set KEY=VALUE", "DIR..."
std::string written(const OptionPage& option);
/// Meaning with choices and default.
std::string told(const OptionPage& option);
/// "snug run [OPTIONS] DIR..."
std::string usage(const CommandPage& page);

/// The text of --help.
std::string help_text(const CommandPage& page);
/// A manual page for man(1), of the version.
std::string manual_page(const std::vector<CommandPage>& pages, const std::string& version);

enum class Shell { bash, zsh, fish };
constexpr auto texts_of(Shell) { return std::array{"bash", "zsh", "fish"}; }
/// A script that completes commands, options, choices, keys of case.toml (--set KEY=, explain KEY) and paths.
std::string completion_script(Shell shell, const std::vector<CommandPage>& pages, const std::vector<std::string>& keys);

}  // namespace snug::app
