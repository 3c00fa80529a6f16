// Files read whole and written whole. What a path leads to is looked at before it is read, and a write is done when it is
// on the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "cases/input/diagnostics.hpp"

namespace snug::input {

struct FileRules {
  std::string shown_as = {};                                 ///< in messages; the path itself when empty
  std::uintmax_t most = std::uintmax_t{1} << 31;             ///< bytes
  std::string missing = "put it there or correct its name";  ///< the remedy when there is no such file
};

/// The content of a regular file. A pipe or a device is refused and never opened for reading, so that nothing waits for it.
/// Throws InputError at the file: missing, not to be read (with the system's reason), no file, or longer than `most`.
std::string read_file(const std::filesystem::path& path, const FileRules& rules = {});

/// Writes a file aside, brings it to the disk and renames it: under its name there is the earlier content or all of the new
/// one. Throws std::filesystem::filesystem_error with the system's reason when any of this fails, and then leaves nothing behind.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Brings the names in a directory to the disk. Throws std::filesystem::filesystem_error.
void sync_directory(const std::filesystem::path& directory);

}  // namespace snug::input
