#include "solver/terms/tissue_cells.hpp"

namespace snug::solver {

std::unique_ptr<Tissue::Kernel> make_tet10_kernel(const Tissue::Fields& fields, const mesh::BodyMesh& mesh, const std::vector<materials::SolidLaw>& laws) {
  return std::make_unique<CellKernel<10, 14, 0, 4>>(fields, mesh, laws);
}

}  // namespace snug::solver
