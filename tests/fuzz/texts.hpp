// Files of texts, for the targets.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace snug::fuzz {

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

inline std::filesystem::path with_ending(std::filesystem::path file, const char* ending) { return file.replace_extension(ending); }

}  // namespace snug::fuzz
