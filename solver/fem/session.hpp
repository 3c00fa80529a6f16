// What deal.II starts and ends with the program.
#pragma once

#include <memory>

namespace snug::fem {

/// MPI, PETSc, METIS and the threads of deal.II, for the life of the object; one in a program.
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  struct Started;
  std::unique_ptr<Started> started_;
};

}  // namespace snug::fem
