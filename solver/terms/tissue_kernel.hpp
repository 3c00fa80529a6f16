// What Tissue asks of its cells; one source a kind of cell makes them (tissue_cells.hpp), since each takes the compiler long.
#pragma once

#include <memory>
#include <vector>

#include "solver/terms/tissue.hpp"

namespace snug::solver {

class Tissue::Kernel {
 public:
  virtual ~Kernel() = default;
  virtual double energy(const State& state) const = 0;
  virtual bool assemble(const State& state, bool tangent, Sink& sink) const = 0;
  virtual double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const = 0;
  virtual void recover(const State& state, Eigen::VectorXd& step) const = 0;
  virtual double volume_error(const State& state) const = 0;
  virtual Eigen::Matrix<double, 6, Eigen::Dynamic> nodal_stress(const State& state, int cell) const = 0;
  ElementEntries entries;
};

std::unique_ptr<Tissue::Kernel> make_hex27_kernel(const Tissue::Fields& fields, const mesh::BodyMesh& mesh, const std::vector<materials::SolidLaw>& laws);
std::unique_ptr<Tissue::Kernel> make_hex8_kernel(const Tissue::Fields& fields, const mesh::BodyMesh& mesh, const std::vector<materials::SolidLaw>& laws);
std::unique_ptr<Tissue::Kernel> make_tet10_kernel(const Tissue::Fields& fields, const mesh::BodyMesh& mesh, const std::vector<materials::SolidLaw>& laws);

}  // namespace snug::solver
