// A file at a place that the user named.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "cases/input/files.hpp"

namespace snug::app {

/// Writes it whole. Throws input::InputError with the reason where that cannot be done: another place can be named.
inline void write_named(const std::filesystem::path& file, const std::string& text) {
  try {
    input::write_file(file, text);
  } catch (const std::runtime_error& error) {
    throw input::InputError({file.string(), 0, 0}, error.what(), "name a place that can be written to");
  }
}

}  // namespace snug::app
