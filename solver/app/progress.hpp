// What a run says while it solves.
#pragma once

#include <string>

#include "solver/app/console.hpp"
#include "solver/scene/run.hpp"

namespace snug::app {

/// "body  increment 4  s 0.550  Newton 3  residual 2.1e-04  contact 812  12 s of about 40 s"; after an increment that failed
/// "increment 4, attempt 2".
std::string progress_text(const solver::Progress& progress);
/// The same in at most `width` columns: what matters least is left out first, the contact, then the padding, the residual, the iteration.
std::string progress_text(const solver::Progress& progress, std::size_t width);

/// What is said once when a run takes over `patience` times its forecast, and longer than anybody looks away for: that it does,
/// and what it is doing.
constexpr double patience = 3.0, noticed = 10.0;  // times; s
bool overdue(const solver::Progress& progress);
std::string overdue_text(const solver::Progress& progress);

/// On a terminal one line that is rewritten; otherwise a plain line for each increment and each attempt at it, without any code of a terminal.
class ProgressLine {
 public:
  /// Says nothing where the user wants quiet or a document.
  ProgressLine(const Console& console, bool quiet);
  ~ProgressLine() { finish(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const solver::Progress& progress);
  /// Ends the line, so that the next output begins on its own.
  void finish();

 private:
  bool terminal() const { return width_ > 0; }

  std::size_t width_;        ///< of the terminal; 0: there is none
  bool quiet_;
  bool open_ = false;  ///< a line is on the terminal without its end
  solver::Progress last_;
  bool any_ = false, overdue_ = false;
};

}  // namespace snug::app
