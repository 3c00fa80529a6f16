#include "postproc/result.hpp"

#include <limits>
#include <ostream>

namespace snug::postproc {

const char* name_of(Status status) {
  switch (status) {
    case Status::failed: return "failed";
    case Status::partial: return "partial";
    case Status::converged: return "converged";
  }
  return "";
}

double ToolResult::stiffness() const {
  return !history.empty() && end().depth > 0.0 ? end().force / end().depth : std::numeric_limits<double>::quiet_NaN();
}

double ToolResult::slope() const {
  if (history.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const ToolRow& before = history[history.size() - 2];
  return (end().force - before.force) / (end().travel - before.travel);
}

std::ostream& operator<<(std::ostream& out, Status status) { return out << name_of(status); }

}  // namespace snug::postproc
