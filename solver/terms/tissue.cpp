#include "solver/terms/tissue.hpp"

#include <algorithm>

#include "solver/terms/tissue_kernel.hpp"

namespace snug::solver {

namespace {

std::unique_ptr<Tissue::Kernel> make_kernel(const Tissue::Fields& fields, const mesh::BodyMesh& mesh,
                                            const std::vector<materials::SolidLaw>& laws) {
  switch (mesh.kind) {
    case mesh::CellKind::hex27: return make_hex27_kernel(fields, mesh, laws);
    case mesh::CellKind::hex8: return make_hex8_kernel(fields, mesh, laws);
    case mesh::CellKind::tet10: return make_tet10_kernel(fields, mesh, laws);
  }
  return nullptr;
}

}  // namespace

Tissue::Tissue(std::string name, const Fields& fields, const mesh::BodyMesh& mesh, std::vector<materials::SolidLaw> laws)
    : name_(std::move(name)), positions_(fields.positions), laws_(std::move(laws)), kernel_(make_kernel(fields, mesh, laws_)) {}
Tissue::~Tissue() = default;

const ElementEntries& Tissue::entries(const State&) const { return kernel_->entries; }
double Tissue::energy(const State& state) const { return kernel_->energy(state); }
bool Tissue::assemble(const State& state, Tangent tangent, Sink& sink) const {
  return kernel_->assemble(state, wanted(tangent), sink);
}
double Tissue::step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const {
  return kernel_->step_bound(state, direction, limit);
}
void Tissue::recover(const State& state, Eigen::VectorXd& step) const { kernel_->recover(state, step); }
void Tissue::measure(const State& state, Measure& measure) const {
  measure.volume_error = std::max(measure.volume_error, kernel_->volume_error(state));
}

void Tissue::publish(const State& state, PublishedFields& fields) const {
  std::vector<postproc::Stress> stress(positions_.count, postproc::Stress::Zero());
  std::vector<int> count(stress.size(), 0);
  for (int cell = 0; cell < kernel_->entries.elements(); ++cell) {
    const auto of_cell = nodal_stress(state, cell);
    for (Eigen::Index a = 0; a < of_cell.cols(); ++a) {  // positions come first among the entries of a cell
      const int node = (kernel_->entries.of(cell)[3 * a] - positions_.first) / 3;
      stress[node] += of_cell.col(a);
      ++count[node];
    }
  }
  for (std::size_t node = 0; node < count.size(); ++node)
    if (count[node] > 0) stress[node] /= count[node];
  add_stress(fields[positions_.name], std::move(stress));
}

Eigen::Matrix<double, 6, Eigen::Dynamic> Tissue::nodal_stress(const State& state, int cell) const {
  return kernel_->nodal_stress(state, cell);
}

}  // namespace snug::solver
