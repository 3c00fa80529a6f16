#include "mesh/pattern/read_pattern.hpp"

#include <algorithm>
#include <cctype>

#include "cases/input/files.hpp"
#include "cases/input/paths.hpp"
#include "mesh/pattern/dxf_pattern.hpp"
#include "mesh/pattern/garmentcode.hpp"
#include "mesh/pattern/svg_pattern.hpp"
#include "mesh/pattern/toml_pattern.hpp"

namespace snug::mesh {

namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// The drawing that a pattern of ours names.
Pattern read_drawing(const fs::path& beside, const std::string& shown, const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending != ".dxf" && ending != ".svg")
    throw input::InputError({.file = shown}, "the drawing \"" + name + "\"", "name a .dxf or .svg file");
  input::Diagnostics diagnostics;
  const fs::path folder = beside.has_parent_path() ? beside.parent_path() : fs::path(".");
  const fs::path file = input::resolve_path(name, {.file = shown}, {.directory = folder}, diagnostics);
  diagnostics.throw_if_any();
  return read_pattern(file, (fs::path(shown).parent_path() / name).string());
}

}  // namespace

Pattern read_pattern(const fs::path& file, const std::string& shown_as) {
  const std::string shown = shown_as.empty() ? file.string() : shown_as, ending = ending_of(file);
  const auto text = [&](std::uintmax_t most) { return input::read_file(file, {.shown_as = shown, .most = most}); };
  Pattern pattern;
  if (ending == ".toml")
    pattern = parse_toml_pattern(text(1 << 18), shown,
                                 [&](const std::string& name) { return read_drawing(file, shown, name); });
  else if (ending == ".json")
    pattern = parse_garmentcode(text(1 << 23), shown);
  else if (ending == ".dxf")
    pattern = parse_dxf(text(1 << 24), shown);
  else if (ending == ".svg")
    pattern = parse_svg(text(1 << 24), shown);
  else
    throw input::InputError({.file = shown}, "a pattern with the ending \"" + ending + "\"",
                            "take .toml (ours), .json (GarmentCode), .dxf (AAMA, ASTM) or .svg");
  if (pattern.title.empty()) pattern.title = file.stem().string();
  return pattern;
}

}  // namespace snug::mesh
