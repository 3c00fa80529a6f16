// Where a command says what it has found: in lines for people, or as one JSON document for programs.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/input/diagnostics.hpp"

namespace snug::app {

/// Lines go to standard output, warnings and errors to standard error. On a terminal they are wrapped to its width; anywhere else a record stays
/// one line, so that grep finds it whole. Under --json nothing is printed on standard output but the document at the end: what the command has put in
/// it (numbers in SI, the unit at the end of the key), "command", "exit_status", "warnings" and "errors". A command that puts nothing in it has its
/// lines there as "text". Warnings and errors still go to standard error as well.
class Console {
 public:
  Console();
  ~Console();

  void answer_in_json() { json_ = true; }
  bool json() const { return json_; }
  /// Of a process that a launcher gives a terminal of its own: the widths of what its output goes on to, 0 for no terminal.
  void take_widths(std::size_t out, std::size_t error) { out_width_ = out, error_width_ = error; }
  std::size_t width() const { return out_width_; }
  std::size_t error_width() const { return error_width_; }
  /// What the document is to hold; keys in their order.
  nlohmann::ordered_json& document();
  /// Another process, which has the same standard output, answers.
  void leave_to_another() { silent_ = true; }

  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    say(fmt::format(format, std::forward<Args>(args)...));
  }
  void say(const std::string& text);
  /// What may be copied into a file, TOML or CSV: its lines are not wrapped.
  void say_as_it_is(const std::string& text);
  /// What is told beside the answer: a note that is neither a warning nor an error.
  void note(const std::string& text);
  void warn(const input::Diagnostic& warning);
  void warn(const std::string& text);
  void error(const input::InputError& error);
  void error(const std::string& text);

  /// Ends what is said: the document, under --json. False where standard output did not take it.
  bool finish(const std::string& command, int status);

 private:
  void to_standard_output(const std::string& text);
  void to_standard_error(const std::string& line) const;

  std::unique_ptr<nlohmann::ordered_json> document_, warnings_, errors_;
  std::string text_;  ///< lines that were not printed
  std::size_t out_width_, error_width_;
  bool json_ = false, silent_ = false;
};

/// Columns of what a stream leads to: of a terminal those that it or the variable COLUMNS says, at most 100 for easy reading; 0 where it is no terminal.
std::size_t width_of(std::FILE* stream);

}  // namespace snug::app
