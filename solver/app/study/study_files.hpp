// What a study leaves: study.csv, study.md, and study.gp, from which gnuplot draws study.svg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/app/study/study_row.hpp"

namespace snug::app {

/// What stands above the table.
struct StudyHead {
  std::string title, command;      ///< of the case; as typed
  std::string against;             ///< "the exact answer (source)"
  std::vector<std::string> notes;  ///< runs that were not made, and why
};

/// A row a run; numbers that are not known stay empty. Times in s, memory in MB (1e6 bytes), errors relative.
void write_study_csv(const std::vector<StudyRow>& rows, const std::filesystem::path& file);

/// Rows that were measured elsewhere, in the columns of study.csv; `series` and `level` are needed. Throws InputError.
std::vector<StudyRow> read_study_csv(const std::filesystem::path& file);

void write_study_table(const std::vector<StudyRow>& rows, const StudyHead& head, const std::filesystem::path& file);

/// A script for gnuplot that draws study.svg beside it from study.csv: errors over time, memory and unknowns, log-log.
void write_study_plot(const std::vector<StudyRow>& rows, const std::string& title, const std::filesystem::path& file);

}  // namespace snug::app
