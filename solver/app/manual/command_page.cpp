#include "solver/app/manual/command_page.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "cases/input/suggestion.hpp"

namespace snug::app {

namespace {

/// "TEXT:{a,b}" of the parser, what it calls a type with its checks, in parts.
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t begin = type.find('{'), end = type.rfind('}');
  if (begin == type.npos || end == type.npos) return choices;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string one; std::getline(list, one, ',');) choices.push_back(one);
  return choices;
}

Words words_of(const OptionPage& option, const std::string& name) {
  if (option.type.empty()) return Words::none;
  if (!option.choices.empty()) return Words::choice;
  if (name == "KEY") return Words::key;
  if (name.starts_with("KEY=")) return Words::key_and_value;
  for (const char* folder : {"DIR", "CASE", "OUT"})
    if (name == folder) return Words::folder;
  for (const char* file : {"FILE", "RESULT", "REFERENCE"})
    if (name.starts_with(file)) return Words::file;
  return Words::text;
}

/// The range of a number is told by the parser's check: "FLOAT:FLOAT in [0 - 1]".
std::string range_in(const std::string& type) {
  const std::size_t begin = type.find(" in [");
  if (begin == type.npos) return {};
  const std::string range = type.substr(begin + 5, type.rfind(']') - begin - 5);
  return range.find("e+") == range.npos ? range : "";
}

OptionPage option_page(const CLI::Option& option) {
  OptionPage page{.names = {}, .type = {}, .meaning = option.get_description(), .default_value = option.get_default_str(), .choices = {}, .required = option.get_required(),
                  .many = option.get_expected_max() >= CLI::detail::expected_max_vector_size};
  const bool positional = option.nonpositional() == false;
  if (positional) page.names = {option.get_name(true, false)};
  for (const std::string& name : option.get_snames()) page.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) page.names.push_back("--" + name);
  if (option.get_type_size() == 0) return page;
  const std::string type = option.get_type_name();
  page.choices = choices_in(type);
  page.type = positional ? page.names.front() : type.substr(0, type.find(':'));
  if (page.type == "TEXT" && !page.choices.empty()) page.type = "WORD";
  if (page.type == "INT" || page.type == "UINT" || page.type == "FLOAT") page.type = "NUMBER";
  if (!positional && type.find("KEY=FROM:TO:N") == 0) page.type = "KEY=FROM:TO:N";
  if (option.get_expected_min() > 1 && !positional)
    for (int n = 1; n < std::min(option.get_expected_min(), 4); ++n) page.type += " NUMBER";
  page.words = words_of(page, page.type);
  if (const std::string range = range_in(type); !range.empty()) page.meaning += fmt::format(" [{}]", range);
  return page;
}

std::string path_of(const CLI::App& app) {
  const CLI::App* above = app.get_parent();
  if (!above) return {};
  const std::string path = path_of(*above);
  return (path.empty() ? "" : path + " ") + app.get_name();
}

void add_pages(const CLI::App& app, std::vector<CommandPage>& pages) {
  pages.push_back(command_page(app));
  for (const CLI::App* below : app.get_subcommands({})) add_pages(*below, pages);
}

/// Name and meaning beside each other, or below where the name is long.
std::string row(const std::string& name, const std::string& meaning) {
  constexpr std::size_t column = 28;
  return name.size() <= column ? fmt::format("  {:<28}  {}\n", name, meaning) : fmt::format("  {}\n{:32}{}\n", name, "", meaning);
}

}  // namespace

CommandPage command_page(const CLI::App& app) {
  CommandPage page{.path = path_of(app), .summary = app.get_description(), .footer = app.get_footer(), .arguments = {}, .options = {}, .below = {}, .summaries_below = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // of the program's own processes
    const OptionPage one = option_page(*option);
    (option->nonpositional() ? page.options : page.arguments).push_back(one);
  }
  for (const CLI::App* below : app.get_subcommands({})) page.below.push_back(below->get_name()), page.summaries_below.push_back(below->get_description());
  return page;
}

std::vector<CommandPage> command_pages(const CLI::App& program) {
  std::vector<CommandPage> pages;
  add_pages(program, pages);
  return pages;
}

std::string written(const OptionPage& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + name;
  if (!option.names.front().starts_with('-')) return text + (option.many ? "..." : "");
  return option.type.empty() ? text : text + " " + option.type + (option.many ? "..." : "");
}

std::string told(const OptionPage& option) {
  std::string facts;
  const auto add = [&](const std::string& fact) { facts += (facts.empty() ? "" : "; ") + fact; };
  if (!option.choices.empty()) add(input::joined(option.choices));
  if (!option.default_value.empty() && option.default_value != "[]") add("default " + option.default_value);
  if (option.required && option.names.front().starts_with('-')) add("required");
  return option.meaning + (facts.empty() ? "" : (option.meaning.empty() ? "(" : " (") + facts + ")");
}

std::string usage(const CommandPage& page) {
  std::string text = "snug" + (page.path.empty() ? "" : " " + page.path);
  if (!page.options.empty()) text += " [OPTIONS]";
  for (const OptionPage& argument : page.arguments) text += argument.required ? " " + written(argument) : " [" + written(argument) + "]";
  return page.below.empty() ? text : text + " COMMAND";
}

std::string help_text(const CommandPage& page) {
  std::string text = page.summary + "\nUsage: " + usage(page) + "\n";
  if (!page.arguments.empty()) text += "\nArguments:\n";
  for (const OptionPage& one : page.arguments) text += row(written(one), told(one));
  if (!page.options.empty()) text += "\nOptions:\n";
  for (const OptionPage& one : page.options) text += row(written(one), told(one));
  if (!page.below.empty()) text += "\nCommands:\n";
  for (std::size_t n = 0; n < page.below.size(); ++n) text += row(page.below[n], page.summaries_below[n]);
  return page.footer.empty() ? text : text + "\n" + page.footer + "\n";
}

}  // namespace snug::app
