// What a found cut means for a population: sizes, their girths, and who is pressed as is wanted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "postproc/comfort/sensation.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/size/cut.hpp"
#include "solver/library/population.hpp"

namespace snug::app {

/// What is asked about a population.
struct PopulationQuestion {
  std::string girths;       ///< file of girths
  std::string distribution; ///< "220 mm +- 15 mm", at the first place
  std::string classes;      ///< set of named ranges; empty: those of the case's [comfort] that speak of the place
  int sizes = 3;
  double inside = 0.1;      ///< share of the wanted pressure that is right where no class holds it

  bool asked() const { return !girths.empty() || !distribution.empty(); }
};

struct PopulationAnswer {
  std::string text;  ///< for the terminal
  std::string csv;   ///< sizes.csv
  Json document = {};  ///< for --json
};

/// Sizes for a population after a cut was found. Throws input::InputError where girths, distribution or classes cannot be read.
PopulationAnswer population_answer(const PopulationQuestion& question, const FoundCut& found, int garment);

/// What of it can be wrong is found before anything is solved. Throws input::InputError.
void check_population(const PopulationQuestion& question, const PreparedCase& prepared, int garment);

}  // namespace snug::app
