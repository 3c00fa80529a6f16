// Located errors. All errors of a case are collected and printed once, each as
// FILE:LINE:COLUMN: error: what was found; what to write instead
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace snug::input {

/// A place in an input file. Line and column count from 1; 0 means "the file as a whole".
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

struct Diagnostic {
  Location where;
  std::string found;   ///< what was found
  std::string remedy;  ///< what to write instead
};

/// "FILE:LINE:COLUMN: error: found; remedy"
std::string to_string(const Diagnostic& diagnostic);
/// The same with "warning": the input is taken as it is, and somebody should look at it.
std::string warning_text(const Diagnostic& diagnostic);

/// Collects errors while a case is read; nothing is thrown until `throw_if_any`.
class Diagnostics {
 public:
  void error(Location where, std::string found, std::string remedy);
  bool any() const { return !errors_.empty(); }
  const std::vector<Diagnostic>& errors() const { return errors_; }
  /// Throws InputError with every error collected so far, in the order of their places, when there is one.
  void throw_if_any() const;

 private:
  std::vector<Diagnostic> errors_;
};

/// The input is wrong (exit status 2). `what()` holds one line per diagnostic.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> errors);
  InputError(Location where, std::string found, std::string remedy);
  const std::vector<Diagnostic>& errors() const { return errors_; }

 private:
  std::vector<Diagnostic> errors_;
};

}  // namespace snug::input
