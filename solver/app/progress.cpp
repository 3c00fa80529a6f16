#include "solver/app/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "solver/app/wrapping.hpp"

namespace snug::app {

namespace {

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

std::string progress_text(const solver::Progress& p, std::size_t width) {
  const std::string attempt = p.attempt > 1 ? fmt::format(", attempt {}", p.attempt) : "", of = p.expected > 0.0 ? fmt::format(" of {:.0f} s", p.expected) : " s";
  std::string text = progress_text(p);
  if (columns_of(text) > width) text = fmt::format("{:<12} increment {:>3}{}  s {:.3f}  Newton {:>2}  residual {:.1e}  {:.0f}{}", p.phase, p.increment, attempt, p.load, p.iteration, p.residual, p.elapsed, of);
  if (columns_of(text) > width) text = fmt::format("{}  increment {}{}  s {:.3f}  Newton {}  residual {:.0e}  {:.0f}{}", p.phase, p.increment, attempt, p.load, p.iteration, p.residual, p.elapsed, of);
  if (columns_of(text) > width) text = fmt::format("{}  increment {}{}  s {:.3f}  {:.0f}{}", p.phase, p.increment, attempt, p.load, p.elapsed, of);
  return text.substr(0, width);
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

ProgressLine::ProgressLine(const Console& console, bool quiet) : width_(console.width()), quiet_(quiet || console.json()) {}

void ProgressLine::show(const solver::Progress& progress) {
  if (quiet_) return;
  if (!overdue_ && overdue(progress)) {
    overdue_ = true;
    print((open_ ? "\r\033[K" : "") + wrapped(overdue_text(progress), width_) + "\n");
    open_ = false;
  }
  if (terminal()) {
    print("\r\033[K" + progress_text(progress, width_ - 1));
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
  if (!terminal()) print(progress_text(last_) + "\n");
  if (open_) print("\n");
  std::fflush(stdout);
  any_ = open_ = false;
}

}  // namespace snug::app
