// A case from its directory to its result: what the commands call, and a program that uses snug as a library.
#pragma once

#include <filesystem>
#include <vector>

#include "cases/input/job_spec.hpp"
#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/gmsh_file.hpp"
#include "postproc/evaluate.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

struct PrepareOptions {
  input::ReadOptions reading = {};
  mesh::GmshOptions gmsh = {};
  double memory_limit = 0.0;  ///< bytes that the case may take; 0: what the machine has
  std::filesystem::path library =
      {};  ///< file of the engineering database, looked at for materials that do not ship; empty: none
};

/// A case made ready to be solved: read, meshed, its materials looked up.
struct PreparedCase {
  input::Case description;
  input::Jobs jobs;                     ///< what it asks beside its answer
  Model model;
  Meshes meshes;
  std::vector<mesh::QualityRow> quality;
  double memory_limit = 0.0;            ///< bytes that the case may take
  std::vector<input::Diagnostic> warnings;  ///< what in the input is likely to be a slip, or is done otherwise than a file asks for
  std::vector<postproc::Phase> phases;  ///< seconds of reading and meshing
};

/// Reads and meshes a case and looks every material up. Throws input::InputError.
PreparedCase prepare(const std::filesystem::path& directory, const PrepareOptions& options = {});

/// The plan of its scene. Throws input::InputError when the case would take more memory than it may.
Plan plan(const PreparedCase& prepared);

/// Solves it; as solve in solver/scene/run.hpp, and `phases` begins with reading and meshing. A Session has to live.
postproc::RunResult solve(const PreparedCase& prepared, const Observer& observer = {}, const KeptStates& kept = {}, const Stop& stop = {},
                          Journal* journal = nullptr);

/// What the answer means: pressures by location, comfort, what is wanted and found, what sensors would read. Throws input::InputError.
postproc::Evaluation evaluate(const PreparedCase& prepared, const postproc::RunResult& run);

}  // namespace snug::solver
