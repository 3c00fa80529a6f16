// Fuzzy systems as files: FLL (fuzzylite's own language) and FIS (the table of the toolbox that the source used).
#pragma once

#include <filesystem>
#include <string>

#include "cases/input/diagnostics.hpp"
#include "postproc/comfort/fuzzy.hpp"

namespace snug::postproc {

enum class FuzzyFormat { fll, fis };

/// The format by the file's ending, .fll or .fis. Throws InputError at `where` for another one.
FuzzyFormat fuzzy_format(const std::filesystem::path& file, const input::Location& where = {});

/// Reads a system with one output, one rule block and the centroid. FIS has no place for the resolution of the
/// centroid: it becomes 1001 midpoints. Throws InputError that names `shown_as` and, where it is known, the line.
FuzzySystem read_fuzzy_text(const std::string& text, FuzzyFormat format, const std::string& shown_as);
FuzzySystem read_fuzzy(const std::filesystem::path& file, const input::Location& where = {});

/// Text that reads back to the same system (numbers in their shortest exact form).
std::string fll_text(const FuzzySystem& system);

/// A FIS rule holds one term an input and one of "and", "or". Rules with more are split into their alternatives, which
/// is exact when "or" and the aggregation are the maximum, "and" is the minimum and the implication is monotone.
/// Throws std::invalid_argument when the system has such rules and other norms, or more than 4096 alternatives.
std::string fis_text(const FuzzySystem& system);

void write_fuzzy(const FuzzySystem& system, const std::filesystem::path& file);

}  // namespace snug::postproc
