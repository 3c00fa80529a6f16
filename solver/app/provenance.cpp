#include "solver/app/provenance.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <thread>

#include "cases/input/named_files.hpp"
#include "solver/app/hash.hpp"
#include "solver/app/launch.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

std::string hash_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::uint64_t hash = fnv1a({});
  std::string block(1 << 16, '\0');
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    hash = fnv1a({block.data(), static_cast<std::size_t>(file.gcount())}, hash);
  return fmt::format("fnv1a64:{:016x}", hash);
}

std::vector<fs::path> input_files(const input::Case& description) {
  std::vector<fs::path> files = {description.directory / "case.toml"};
  for (const fs::path& file : input::named_files(description)) files.push_back(file);
  if (!description.comfort) return files;
  std::vector<input::MaterialEntry> comfort = description.comfort->thresholds;
  comfort.insert(comfort.begin(), {description.comfort->curves, description.comfort->fuzzy});
  for (const input::MaterialEntry& reference : comfort)
    if (const fs::path file = description.directory / reference.name;
        !reference.name.empty() && fs::is_regular_file(file))
      files.push_back(file);
  return files;
}

/// In the case directory; what ships lies elsewhere on every machine.
std::string shown_name(const fs::path& file, const input::Case& description) {
  if (description.body && description.body->scan && !description.body->scan->standard.empty() && file == description.body->scan->surface)
    return "standard body " + description.body->scan->standard;
  return file.lexically_normal().lexically_relative(description.directory.lexically_normal()).generic_string();
}

/// As typed, for a shell; under mpirun without mpirun.
std::string command_line() {
  std::string text = "snug";
  const std::vector<std::string> words = own_arguments();
  for (std::size_t w = 1; w < words.size(); ++w) {
    const bool bare = words[w].find_first_not_of(
                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                          "-_=./:,+") == std::string::npos;
    text += bare ? " " + words[w] : " '" + words[w] + "'";
  }
  return text;
}

}  // namespace

postproc::Provenance provenance_of(const PreparedCase& prepared) {
  postproc::Provenance provenance;
  provenance.command = command_line();
  provenance.versions = {{"snug", SNUG_VERSION}, {"compiler", __VERSION__}, {"blas", solver::loaded_blas()},
                         {"ranks", std::to_string(solver::this_rank().of)}, {"threads", std::to_string(std::thread::hardware_concurrency())}};
  for (const fs::path& file : input_files(prepared.description))
    provenance.input_hashes[shown_name(file, prepared.description)] = hash_of(file);
  for (const mesh::QualityRow& row : prepared.quality)
    provenance.mesh_quality[row.layer] = {{"cells", row.cells},
                                          {"min_scaled_jacobian", row.min_scaled_jacobian},
                                          {"mean_scaled_jacobian", row.mean_scaled_jacobian},
                                          {"max_aspect", row.max_aspect},
                                          {"volume_m3", row.volume}};
  return provenance;
}

}  // namespace snug::app
