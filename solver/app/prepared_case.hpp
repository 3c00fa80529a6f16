// A case made ready to be solved: read, meshed, its materials looked up, its scene planned.
#pragma once

#include <filesystem>
#include <vector>

#include "cases/input/case.hpp"
#include "mesh/body/body_mesh.hpp"
#include "postproc/result.hpp"
#include "solver/app/case_options.hpp"
#include "solver/scene/run.hpp"

namespace snug::app {

struct PreparedCase {
  input::Case description;
  solver::Model model;
  solver::Meshes meshes;
  std::vector<mesh::QualityRow> quality;
  double memory_limit = 0.0;            ///< bytes that the case may take
  std::vector<postproc::Phase> phases;  ///< seconds of reading and meshing
};

/// Reads and meshes a case and looks every material up. Throws input::InputError.
PreparedCase prepare(const std::filesystem::path& directory, const CaseOptions& options);

}  // namespace snug::app
