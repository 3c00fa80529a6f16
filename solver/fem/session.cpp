#include "solver/fem/session.hpp"

#include <deal.II/base/mpi.h>

namespace snug::fem {

struct Session::Started {
  dealii::Utilities::MPI::MPI_InitFinalize mpi;
};

Session::Session(int& argc, char**& argv)
    : started_(new Started{dealii::Utilities::MPI::MPI_InitFinalize(argc, argv, dealii::numbers::invalid_unsigned_int)}) {}
Session::~Session() = default;

}  // namespace snug::fem
