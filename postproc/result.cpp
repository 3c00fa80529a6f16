#include "postproc/result.hpp"

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

std::ostream& operator<<(std::ostream& out, Status status) { return out << name_of(status); }

}  // namespace snug::postproc
