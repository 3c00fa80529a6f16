// snug's mark on a directory of results: the list of the files that snug wrote there. Only those are ever replaced.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace snug::app {

/// Paths relative to the directory, with '/'.
using ResultList = std::set<std::string>;

inline const char* const result_mark = ".snug-results";

/// The list of a directory; none where the directory does not carry the mark. `complete` (may be null): whether all of its
/// results had been written.
std::optional<ResultList> read_result_list(const std::filesystem::path& directory, bool* complete = nullptr);
void write_result_list(const std::filesystem::path& directory, const ResultList& files, bool complete);

/// Everything in a directory that is no directory itself, the mark left out.
ResultList files_below(const std::filesystem::path& directory);

/// Before a command adds `files` to results: throws input::InputError when one of them is there and is not snug's.
void check_may_add(const std::filesystem::path& directory, const ResultList& files);
/// Adds files to the list of a directory that carries the mark; nothing where it carries none.
void add_to_result_list(const std::filesystem::path& directory, const ResultList& files);

}  // namespace snug::app
