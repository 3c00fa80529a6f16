#include "cases/input/paths.hpp"

#include <algorithm>
#include <vector>

#include "cases/input/suggestion.hpp"

namespace snug::input {

namespace fs = std::filesystem;

namespace {

/// Compares real places, so that a symbolic link does not lead out of the directory unseen.
bool leaves(const fs::path& file, const fs::path& directory) {
  std::error_code failed;  // a name too long, links in a circle: such a path leads nowhere
  const fs::path real = fs::weakly_canonical(fs::absolute(file), failed);  // absolute: of a name that is not there it would stay relative
  if (failed) return false;
  const fs::path relative = real.lexically_relative(fs::weakly_canonical(directory, failed));
  if (failed) return false;
  return relative.empty() || *relative.begin() == "..";
}

std::vector<std::string> names_beside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(file.parent_path(), ignored))
    names.push_back(entry.path().filename().string());
  return names;
}

/// What to write in place of a path with backslashes; empty where it has none.
std::string remedy_of_windows(std::string text, const fs::path& directory) {
  if (text.find('\\') == text.npos) return {};
  std::replace(text.begin(), text.end(), '\\', '/');
  std::error_code failed;
  const bool has_drive = text.size() > 1 && text[1] == ':';
  if (!has_drive && fs::is_regular_file(directory / text, failed)) return "write \"" + text + "\"";
  return "copy the file into the case directory and name it from there with /: \"" + text.substr(text.rfind('/') + 1) + "\"";
}

}  // namespace

fs::path resolve_path(const std::string& text, const Location& where, const ReadRules& rules,
                      Diagnostics& diagnostics) {
  const fs::path given(text);
  const fs::path file = (rules.directory / given).lexically_normal();
  if (!rules.allow_outside && (given.is_absolute() || leaves(file, rules.directory))) {
    diagnostics.error(where, "\"" + text + "\" is outside the case directory",
                      "copy the file into the case directory and name it from there, or give --allow-outside");
    return {};
  }
  std::error_code failed;
  if (fs::is_regular_file(file, failed)) return file;
  if (const std::string remedy = remedy_of_windows(text, rules.directory); !remedy.empty()) {
    diagnostics.error(where, "\"" + text + "\" is a path of Windows", remedy);
    return {};
  }
  const std::string near = nearest(file.filename().string(), names_beside(file));
  diagnostics.error(where, "there is no file \"" + text + "\" in the case directory",
                    near.empty() ? "put the file there or correct its name"
                                 : "did you mean \"" + (given.parent_path() / near).string() + "\"?");
  return {};
}

}  // namespace snug::input
