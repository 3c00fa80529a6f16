#include "mesh/pattern/read_pattern.hpp"

#include <algorithm>
#include <cctype>

#include "cases/input/files.hpp"
#include "mesh/pattern/garmentcode.hpp"
#include "mesh/pattern/toml_pattern.hpp"

namespace snug::mesh {

Pattern read_pattern(const std::filesystem::path& file, const std::string& shown_as) {
  const std::string shown = shown_as.empty() ? file.string() : shown_as;
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto text = [&](std::uintmax_t most) { return input::read_file(file, {.shown_as = shown, .most = most}); };
  Pattern pattern;
  if (ending == ".toml") pattern = parse_toml_pattern(text(1 << 18), shown);
  else if (ending == ".json") pattern = parse_garmentcode(text(1 << 23), shown);
  else throw input::InputError({.file = shown}, "a pattern with the ending \"" + ending + "\"", "take .toml (ours) or .json (GarmentCode)");
  if (pattern.title.empty()) pattern.title = file.stem().string();
  return pattern;
}

}  // namespace snug::mesh
