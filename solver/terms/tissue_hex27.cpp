#include "solver/terms/tissue_cells.hpp"

namespace snug::solver {

std::unique_ptr<Tissue::Kernel> make_hex27_kernel(const Tissue::Fields& fields, const mesh::BodyMesh& mesh, const std::vector<materials::SolidLaw>& laws) {
  return std::make_unique<CellKernel<27, 27, 4, 0>>(fields, mesh, laws);
}

}  // namespace snug::solver
