// A new case from a recorded run.
#include "solver/app/project_derive.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "cases/input/case.hpp"
#include "cases/input/files.hpp"
#include "cases/input/overrides.hpp"
#include "materials/database/sha256.hpp"
#include "solver/app/data_directory.hpp"

namespace snug::app {

namespace fs = std::filesystem;

using materials::RunRecord, materials::RunValue;

namespace {

/// The content that an input had, of the library or, where it was too large for that, of its own place.
std::string content_of(const RunRecord& run, const RunValue& file, const materials::Library& library) {
  constexpr double most_kept = 1 << 20;
  if (file.number.value_or(0.0) <= most_kept) return library.file(file.value).content;
  const fs::path place = fs::path(run.directory) / file.name;
  std::string content = input::read_file(place, {.missing = "it was too large for the library: put it back"});
  if (materials::sha256(content) != file.value)
    throw input::InputError({place.string(), 0, 0}, fmt::format("this is not the file that run {} read", run.number),
                            "put that one back; files of more than 1 MB are not kept in the library");
  return content;
}

bool is_inside(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  return path.is_relative() && !path.empty() && *path.begin() != "..";
}

void fill(const fs::path& folder, const RunRecord& run, const std::vector<std::string>& overrides, const materials::Library& library) {
  input::Diagnostics diagnostics;
  input::Table table = input::table_of(library.file(run.echo).content, {"case.echo.toml", 1, 1});  // a place keeps the order
  input::apply_overrides(table, overrides, diagnostics);
  diagnostics.throw_if_any();
  fs::create_directories(folder);
  for (const RunValue& file : run.inputs) {
    if (file.name == "case.toml" || !is_inside(file.name)) continue;
    fs::create_directories((folder / file.name).parent_path());
    input::write_file(folder / file.name, content_of(run, file, library));
  }
  input::write_file(folder / "case.toml", fmt::format("# Derived from run {} of project {} ({}). Values in SI, materials written out.\n", run.number, run.project, run.moment) +
                                              input::to_toml(table));
}

}  // namespace

void derive_case(const RunRecord& run, const fs::path& directory, const std::vector<std::string>& overrides, const materials::Library& library) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(directory, none)))
    throw input::InputError({directory.string(), 0, 0}, "this is there already", "choose another name; nothing is overwritten");
  const fs::path aside = directory.string() + ".tmp-" + std::to_string(::getpid());
  try {
    fill(aside, run, overrides, library);
    input::read_case(aside, {.overrides = {}, .allow_outside = true, .bodies = bodies_folder()});  // what --set has made wrong is said now
    fs::rename(aside, directory);
  } catch (...) {
    fs::remove_all(aside, none);
    throw;
  }
}

}  // namespace snug::app
