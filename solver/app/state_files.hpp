// States of the load path as files, for ParaView and for films.
#pragma once

#include <filesystem>
#include <vector>

#include "postproc/grid.hpp"

namespace snug::app {

/// Writes states/body_0000.vtu … into a directory of results and names them in body.pvd and garment.pvd.
class StateFiles {
 public:
  /// `way` as solver::KeptStates counts it.
  void write(double way, const postproc::RunResult& state, const std::filesystem::path& out);

  /// After the results are written: the last state is the result itself, whose files stand already.
  void list(const std::filesystem::path& out);

 private:
  std::vector<postproc::GridStep> body_, garment_;
};

}  // namespace snug::app
