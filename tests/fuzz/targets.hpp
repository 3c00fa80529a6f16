// The readers of files that users hand in, as targets of fuzzers. No reader may crash, throw anything but InputError, or take
// longer than five seconds (of a machine that others use too) for a text of at most 64 kB.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace snug::fuzz {

constexpr std::size_t longest = 65536;

/// A reader of a file, texts to begin with, and pieces that matter to its format.
struct Target {
  std::string name;
  /// Reads the text; where the reader wants a file, writes it there first. Lets pass what the reader throws.
  std::function<void(const std::filesystem::path&, const std::string&)> read;
  std::vector<std::string> seeds, pieces;
};

std::vector<Target> targets();
/// Those of garments and of the tests of fabrics, which are among them.
std::vector<Target> garment_targets();
/// Those of the engineering database, which are among them, too.
std::vector<Target> library_targets();

/// Reads a text as a user would have it read: true unless something other than input::InputError was thrown (then `what`
/// says it), or an InputError without a place.
bool takes(const Target& target, const std::filesystem::path& file, const std::string& text, std::string& what);

}  // namespace snug::fuzz
