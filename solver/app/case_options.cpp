#include "solver/app/case_options.hpp"

#include <CLI/CLI.hpp>

#include "solver/app/data_directory.hpp"
#include "solver/app/library_file.hpp"

namespace snug::app {

void CaseOptions::declare(CLI::App& app) {
  app.add_option("--set", overrides, "replace a value of case.toml: --set garment.position=\"70 mm\"; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--tier", tier, "L0: tension times curvature; L1: rigid skin; L4: nonlinear body; particle: the shape in which cloth hangs")->type_name("TIER");
  app.add_flag("--allow-outside", allow_outside, "admit input files outside the case directory");
  app.add_flag("--allow-scripts", allow_scripts,
               "let a mesh script (.geo) run programs and read and write files: only for files that you trust as your own");
  app.add_option("--memory", memory, "GB that the case may take (what the machine has; gmsh 1 GB to read or mesh a file)")
      ->check(CLI::Range(0.1, 1e6));
  app.add_option("--mesh-seconds", mesh_seconds, "seconds for gmsh to read or mesh a file")->check(CLI::Range(1.0, 1e6))->capture_default_str();
}

solver::PrepareOptions CaseOptions::preparation() const {
  solver::PrepareOptions options;
  options.reading = {.overrides = overrides, .allow_outside = allow_outside, .bodies = bodies_folder()};
  if (!tier.empty()) options.reading.overrides.push_back("solver.tier=" + tier);
  options.library = library_file();
  options.gmsh.allow_scripts = allow_scripts;
  options.gmsh.limits.seconds = mesh_seconds;
  if (memory > 0.0) options.memory_limit = options.gmsh.limits.memory = 1e9 * memory;
  return options;
}

std::vector<std::string> CaseOptions::words() const {
  std::vector<std::string> words;
  for (const std::string& set : overrides) words.push_back("--set"), words.push_back(set);
  if (!tier.empty()) words.push_back("--tier=" + tier);
  if (allow_outside) words.push_back("--allow-outside");
  if (allow_scripts) words.push_back("--allow-scripts");
  if (memory > 0.0) words.push_back("--memory=" + std::to_string(memory));
  words.push_back("--mesh-seconds=" + std::to_string(mesh_seconds));
  return words;
}

input::Case CaseOptions::read(const std::filesystem::path& directory) const {
  return input::read_case(directory, preparation().reading);
}

}  // namespace snug::app
