#include "solver/app/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace snug::app {

namespace {

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

bool same_increment(const solver::Progress& a, const solver::Progress& b) {
  return a.phase == b.phase && a.increment == b.increment && a.attempt == b.attempt;
}

/// Nobody may be listening any more; that costs no solution.
void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

}  // namespace

std::string progress_text(const solver::Progress& p) {
  std::string text =
      fmt::format("{:<12} increment {:>3}{}  s {:.3f}  Newton {:>2}  residual {:.1e}  contact {:>5}  {:.0f} s", p.phase, p.increment,
                  p.attempt > 1 ? fmt::format(", attempt {}", p.attempt) : "", p.load, p.iteration, p.residual, p.contact_nodes, p.elapsed);
  if (p.expected > 0.0) text += fmt::format(" of about {:.0f} s", p.expected);
  return text;
}

bool overdue(const solver::Progress& p) {
  return p.expected > 0.0 && p.elapsed > std::max(noticed, patience * p.expected);
}

std::string overdue_text(const solver::Progress& p) {
  std::string doing = fmt::format("\"{}\", increment {}", p.phase, p.increment);
  if (p.attempt > 1) doing += fmt::format(", attempt {} (those before it did not converge and were cut)", p.attempt);
  return fmt::format("this takes longer than expected: {:.0f} s so far, {:.0f} s were expected; now at {}, Newton {}, residual {:.1e}", p.elapsed,
                     p.expected, doing, p.iteration, p.residual);
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDOUT_FILENO) != 0) {}

void ProgressLine::show(const solver::Progress& progress) {
  if (quiet_) return;
  if (!overdue_ && overdue(progress)) {
    overdue_ = true;
    fmt::print("{}{}\n", open_ ? "\r\033[K" : "", overdue_text(progress));
  }
  if (terminal_) {
    print("\r\033[K" + progress_text(progress).substr(0, terminal_width() - 1));
    open_ = true;
  } else if (any_ && !same_increment(progress, last_)) {
    print(progress_text(last_) + "\n");  // an increment is over when the next begins
  }
  std::fflush(stdout);
  last_ = progress;
  any_ = true;
}

void ProgressLine::finish() {
  if (quiet_ || !any_) return;
  if (!terminal_) print(progress_text(last_) + "\n");
  if (open_) print("\n");
  std::fflush(stdout);
  any_ = open_ = false;
}

}  // namespace snug::app
