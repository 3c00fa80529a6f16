// Everything that a run leaves in out/, as a visible list of small recorders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "postproc/csv_writer.hpp"
#include "postproc/evaluate.hpp"
#include "postproc/result.hpp"
#include "postproc/summary.hpp"

namespace snug::postproc {

struct StoredRun;

/// What a recorder looks at.
struct Record {
  const RunResult& run;
  const Evaluation& evaluation;
  const StoredRun& stored;  ///< what store.hpp reads back: its recorders write it as it stands
  CsvStyle csv = CsvStyle::comma;  ///< of the tables for people; history.csv is for programs
};

struct Recorder {
  std::string file;                                            ///< name in out/
  bool (*applies)(const Record&);                              ///< false: the scene has nothing for this file
  void (*write)(const Record&, const std::filesystem::path&);  ///< writes the file at that path
};

/// In the order in which the files are written; summary.json last, so that it stands for a complete set.
const std::vector<Recorder>& recorders();

/// Writes the files of every recorder that applies into `out` (made when missing). Each is written aside and renamed;
/// the file of a recorder that does not apply is removed, so that no result of an earlier scene stays behind. Throws
/// std::runtime_error naming the file that cannot be written.
void write_results(const RunResult& run, const Evaluation& evaluation, const std::filesystem::path& out,
                   const Provenance& provenance = {});
/// The same where `stored` is made already (store.hpp).
void write_results(const RunResult& run, const Evaluation& evaluation, const StoredRun& stored, const std::filesystem::path& out,
                   CsvStyle csv = CsvStyle::comma);

}  // namespace snug::postproc
