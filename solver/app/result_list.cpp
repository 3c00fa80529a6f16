#include "solver/app/result_list.hpp"

#include <sstream>

#include "cases/input/files.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

const std::string head = "# Written by snug. The next run replaces the files listed here and keeps everything else in this folder.\n";
const std::string whole = "# complete\n", started = "# not complete\n";

/// A name with a line end in it cannot stand in a list of lines, and none of snug's has one.
bool fits_a_line(const std::string& name) { return name.find('\n') == std::string::npos; }

}  // namespace

std::optional<ResultList> read_result_list(const fs::path& directory, bool* complete) {
  if (!fs::is_regular_file(directory / result_mark)) return std::nullopt;
  const std::string text = input::read_file(directory / result_mark, {.most = std::uintmax_t{1} << 24});
  if (!text.starts_with(head)) return std::nullopt;
  if (complete) *complete = text.compare(head.size(), whole.size(), whole) == 0;
  ResultList files;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const fs::path file = fs::path(line).lexically_normal();
    const bool inside = !line.empty() && !file.is_absolute() && *file.begin() != "..";
    if (inside && line[0] != '#') files.insert(file.generic_string());
  }
  return files;
}

void write_result_list(const fs::path& directory, const ResultList& files, bool complete) {
  std::string text = head + (complete ? whole : started);
  for (const std::string& file : files)
    if (fits_a_line(file)) text += file + "\n";
  input::write_file(directory / result_mark, text);
}

ResultList files_below(const fs::path& directory) {
  ResultList files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (!entry.is_directory() || entry.is_symlink()) files.insert(entry.path().lexically_relative(directory).generic_string());
  files.erase(result_mark);
  return files;
}

void check_may_add(const fs::path& directory, const ResultList& files) {
  const auto ours = read_result_list(directory);
  if (!ours) return;
  for (const std::string& file : files)
    if (fs::exists(fs::symlink_status(directory / file)) && !ours->count(file))
      throw input::InputError({(directory / file).string(), 0, 0}, "this file is there already and is not snug's", "move it elsewhere");
}

void add_to_result_list(const fs::path& directory, const ResultList& files) {
  bool complete = false;
  auto ours = read_result_list(directory, &complete);
  if (!ours) return;
  ours->insert(files.begin(), files.end());
  write_result_list(directory, *ours, complete);
}

}  // namespace snug::app
