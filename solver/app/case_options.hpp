// Options that every command with a case has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "solver/library/prepared_case.hpp"

namespace CLI {
class App;
}

namespace snug::app {

struct CaseOptions {
  std::vector<std::string> overrides;
  std::string tier;
  bool allow_outside = false;
  bool allow_scripts = false;   ///< a mesh script may do what gmsh lets it do
  double memory = 0.0;          ///< GB that the case may take; 0: what the machine has, and 1 GB for gmsh's reading
  double mesh_seconds = 300.0;  ///< for gmsh to read and mesh a file

  void declare(CLI::App& app);
  /// What reading and meshing are to heed.
  solver::PrepareOptions preparation() const;
  /// The options as words of a command line, for another process.
  std::vector<std::string> words() const;
  /// Reads the case with the options applied. Throws input::InputError.
  input::Case read(const std::filesystem::path& directory) const;
};

}  // namespace snug::app
