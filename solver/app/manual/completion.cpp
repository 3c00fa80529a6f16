#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "solver/app/manual/command_page.hpp"

namespace snug::app {

namespace {

/// Between single quotes of a shell.
std::string shell_text(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Words without blanks: others would come apart where the shells split a list.
std::string list_of(const std::vector<std::string>& words) {
  std::vector<std::string> whole;
  std::copy_if(words.begin(), words.end(), std::back_inserter(whole), [](const std::string& word) { return word.find(' ') == word.npos; });
  return fmt::format("{}", fmt::join(whole, " "));
}

const char* kind_of(Words words) {
  switch (words) {
    case Words::folder: return "folder";
    case Words::file: return "file";
    case Words::key: return "key";
    case Words::key_and_value: return "setting";
    default: return "nothing";
  }
}

/// What bash and zsh do alike: $at is the command, $prev the word before the one that is written. Sets $kind, $list and $opts.
std::string table(const std::vector<CommandPage>& pages, const std::vector<std::string>& keys) {
  std::string next, values, words;
  for (const CommandPage& page : pages) {
    for (const std::string& below : page.below) next += fmt::format("      {}) at={} ;;\n", shell_text(page.path + ":" + below), shell_text(page.path.empty() ? below : page.path + " " + below));
    std::vector<std::string> names;
    for (const OptionPage& option : page.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
      if (option.type.empty()) continue;
      for (const std::string& name : option.names)
        values += option.choices.empty() ? fmt::format("    {}) kind={} ;;\n", shell_text(page.path + ":" + name), kind_of(option.words))
                                         : fmt::format("    {}) kind=list list={} ;;\n", shell_text(page.path + ":" + name), shell_text(list_of(option.choices)));
    }
    std::string plain = "nothing", list;
    if (!page.below.empty()) plain = "list", list = list_of(page.below);
    else if (!page.arguments.empty()) {
      plain = page.arguments.front().choices.empty() ? kind_of(page.arguments.front().words) : "list";
      list = list_of(page.arguments.front().choices);
    }
    words += fmt::format("    {}) opts={} kind={} list={} ;;\n", shell_text(page.path), shell_text(list_of(names)), plain, shell_text(list));
  }
  return fmt::format("_snug_keys={}\n\n# The command that a word leads to from another.\n_snug_step() {{\n  case \"$at:$1\" in\n{}  esac\n}}\n\n"
                     "# What may stand here: kind, and list or opts.\n_snug_here() {{\n  kind= list= opts=\n  case \"$at:$prev\" in\n{}  esac\n  [ -n \"$kind\" ] && return\n  case \"$at\" in\n{}  esac\n}}\n",
                     shell_text(list_of(keys)), next, values, words);
}

constexpr const char* bash_tail = R"sh(
_snug() {
  local cur prev at="" kind list opts i
  COMPREPLY=()
  cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
  [[ $cur == "=" ]] && cur=""
  [[ $prev == "=" ]] && prev=${COMP_WORDS[COMP_CWORD-2]}
  for ((i = 1; i < COMP_CWORD; ++i)); do _snug_step "${COMP_WORDS[i]}"; done
  _snug_here
  if [[ $cur == -* && -n $opts ]]; then kind=list list=$opts; fi
  case $kind in
    list) COMPREPLY=($(compgen -W "$list" -- "$cur")) ;;
    key) COMPREPLY=($(compgen -W "$_snug_keys" -- "$cur")) ;;
    setting) compopt -o nospace 2> /dev/null; COMPREPLY=($(compgen -W "$_snug_keys" -S = -- "$cur")) ;;
    folder) compopt -o filenames 2> /dev/null; local IFS=$'\n'; COMPREPLY=($(compgen -d -- "$cur")) ;;
    file) compopt -o filenames 2> /dev/null; local IFS=$'\n'; COMPREPLY=($(compgen -f -- "$cur")) ;;
  esac
}
complete -F _snug snug
)sh";

constexpr const char* zsh_tail = R"sh(
_snug() {
  local prev=${words[CURRENT-1]} at="" kind list opts i
  for ((i = 2; i < CURRENT; ++i)); do _snug_step "${words[i]}"; done
  _snug_here
  if [[ $PREFIX == -* && -n $opts ]]; then kind=list list=$opts; fi
  case $kind in
    list) compadd -- ${=list} ;;
    key) compadd -- ${=_snug_keys} ;;
    setting) compadd -S = -- ${=_snug_keys} ;;
    folder) _files -/ ;;
    file) _files ;;
  esac
}
if [ "$funcstack[1]" = "_snug" ]; then _snug "$@"; else compdef _snug snug; fi
)sh";

std::string fish_script(const std::vector<CommandPage>& pages, const std::vector<std::string>& keys) {
  std::string text = fmt::format("set -g __snug_keys {}\n\nfunction __snug_at\n  set -l path ''\n  for word in (commandline -opc)[2..-1]\n    switch \"$path:$word\"\n", list_of(keys));
  for (const CommandPage& page : pages)
    for (const std::string& below : page.below) text += fmt::format("      case {}\n        set path {}\n", shell_text(page.path + ":" + below), shell_text(page.path.empty() ? below : page.path + " " + below));
  text += "    end\n  end\n  test \"$path\" = \"$argv[1]\"\nend\n\ncomplete -c snug -f\n";
  const auto values = [](const OptionPage& option) -> std::string {
    switch (option.words) {
      case Words::folder: return " -xa '(__fish_complete_directories)'";
      case Words::file: return " -rF";
      case Words::key: return " -xa '$__snug_keys'";
      case Words::key_and_value: return " -xa '$__snug_keys='";
      case Words::choice: return " -xa " + shell_text(list_of(option.choices));
      default: return option.type.empty() ? "" : " -x";
    }
  };
  for (const CommandPage& page : pages) {
    const std::string here = "complete -c snug -n " + shell_text("__snug_at " + shell_text(page.path));
    for (std::size_t n = 0; n < page.below.size(); ++n) text += here + " -a " + page.below[n] + " -d " + shell_text(page.summaries_below[n]) + "\n";
    for (const OptionPage& option : page.options) {
      std::string names;
      for (const std::string& name : option.names) names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      text += here + names + values(option) + " -d " + shell_text(option.meaning) + "\n";
    }
    if (page.below.empty() && !page.arguments.empty())
      if (const std::string value = values(page.arguments.front()); value != " -x") text += here + (value == " -rF" ? std::string(" -F") : " -a" + value.substr(4)) + "\n";
  }
  return text;
}

}  // namespace

std::string completion_script(Shell shell, const std::vector<CommandPage>& pages, const std::vector<std::string>& keys) {
  const std::string head = "# Made by snug completion: the commands and options of this program, the keys of its cases.\n";
  if (shell == Shell::fish) return head + fish_script(pages, keys);
  return (shell == Shell::zsh ? "#compdef snug\n" : "") + head + table(pages, keys) + (shell == Shell::zsh ? zsh_tail : bash_tail);
}

}  // namespace snug::app
