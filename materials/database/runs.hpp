// What was computed of what: runs with their inputs, settings and results, in the file of the library.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "materials/database/library.hpp"

namespace snug::materials {

/// One value of a run. Settings: key of the case ("garment.fabric.WT"), as case.echo.toml has it, in SI. Results: what it
/// is ("Front thigh"), in SI. Inputs: name of a file in the case directory and the SHA-256 of its content. Versions: of
/// what computed.
struct RunValue {
  std::string name, value, unit = {};
  std::optional<double> number = {};
  bool operator==(const RunValue&) const = default;
};

/// An entity of the library that a part of the case named, as it was at that time.
struct RunMaterial {
  std::string part;      ///< "garment.fabric"
  std::string entity;    ///< its ID
  std::string snapshot;  ///< hash of its text (snapshot.hpp), a file of the library
};

struct RunRecord {
  std::int64_t number = 0;  ///< given when it is recorded
  std::string project, title;
  std::string moment = {};  ///< UTC, given when it is recorded
  std::string who = {};     ///< given when it is recorded
  std::string directory;    ///< of the case, absolute
  std::string place;        ///< of the results, absolute
  std::string proof;        ///< SHA-256 of summary.json there: others may have taken its place since
  std::string case_hash;    ///< of all that decides the numbers: the echo and the files that it names
  std::string echo;         ///< hash of case.echo.toml, a file of the library
  std::string command, status, message, note;
  std::optional<std::int64_t> parent = {};  ///< the run that the case was derived from
  double seconds = 0.0;
  std::vector<RunValue> inputs = {}, versions = {}, settings = {}, results = {};
  std::vector<RunMaterial> materials = {};

  /// The one of that name, or nullptr.
  const RunValue* result(const std::string& name) const;
  const RunValue* setting(const std::string& name) const;
};

struct ProjectHead {
  std::string name;
  std::int64_t runs = 0, converged = 0;
  std::string first, last;  ///< moments
};

/// Which of its runs a project goes on with.
struct Decision {
  std::int64_t run = 0;
  std::string why, who, moment;
};

/// The runs that a library knows. Throws what Library throws. Nothing here is undone by Library::undo.
class Runs {
 public:
  explicit Runs(Library& library) : library_(library) {}

  /// Keeps the run and the files that it refers to, all or nothing; gives its number.
  std::int64_t record(const RunRecord& run, const std::vector<LibraryFile>& files);

  /// By their last run, the newest first.
  std::vector<ProjectHead> projects() const;
  /// Of a project, or of all; without their values; the oldest first, at most the newest `most`.
  std::vector<RunRecord> heads(const std::string& project = {}, std::int64_t most = 1'000'000) const;
  /// With everything. Throws input::InputError where there is none of that number.
  RunRecord run(std::int64_t number) const;
  /// The names of projects with runs. Throws input::InputError with the nearest where `project` is none of them.
  void check_project(const std::string& project) const;

  void note(std::int64_t number, const std::string& text);
  /// Takes runs out of the library; their files on the disk stay. Texts that no run and no datum needs any more go, too.
  void forget(const std::vector<std::int64_t>& numbers);
  /// Runs of that case directory, from now on, come from this one.
  void derive(const std::string& directory, std::int64_t from);
  /// The run that the case of that directory was derived from.
  std::optional<std::int64_t> parent_of(const std::string& directory) const;
  void decide(const std::string& project, std::int64_t run, const std::string& why);
  std::optional<Decision> decision(const std::string& project) const;

 private:
  void read_values(RunRecord& run) const;
  Library& library_;
};

}  // namespace snug::materials
