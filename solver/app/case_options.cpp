#include "solver/app/case_options.hpp"

#include <CLI/CLI.hpp>

namespace snug::app {

void CaseOptions::declare(CLI::App& app) {
  app.add_option("--set", overrides, "replace a value of case.toml: --set garment.position=\"70 mm\"; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--tier", tier, "L0: tension times curvature; L1: rigid skin; L4: nonlinear body")->type_name("TIER");
  app.add_flag("--allow-outside", allow_outside, "admit input files outside the case directory");
}

input::Case CaseOptions::read(const std::filesystem::path& directory) const {
  input::ReadOptions options{.overrides = overrides, .allow_outside = allow_outside};
  if (!tier.empty()) options.overrides.push_back("solver.tier=" + tier);
  return input::read_case(directory, options);
}

}  // namespace snug::app
