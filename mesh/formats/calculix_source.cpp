#include "mesh/formats/calculix_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/files.hpp"

namespace snug::mesh {

namespace fs = std::filesystem;

namespace {

constexpr int most_files = 200;
constexpr std::size_t deepest = 20;

bool is_within(const fs::path& path, const fs::path& root) {
  const auto [end, rest] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return end == root.end() || (std::next(end) == root.end() && end->empty());
}

}  // namespace

InpSource::InpSource(const std::string& text, const std::string& file, IncludeRules rules) : rules_(std::move(rules)) {
  open_.push_back({LineSource(text), &kept_.emplace_back(file), rules_.folder, 0});
}

bool InpSource::raw(std::string_view& line) {
  while (true) {
    if (open_.back().lines.next(line)) {
      open_.back().line = open_.back().lines.number();
      return true;
    }
    if (open_.size() == 1) return false;
    open_.pop_back();
  }
}

bool InpSource::next(std::string_view& line) {
  while (raw(line)) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with("**")) continue;
    if (!text.starts_with("*") || !text.ends_with(",")) return true;
    std::string joined(text);
    const int number = open_.back().line;
    const std::size_t depth = open_.size();
    for (std::string_view more; joined.ends_with(",") && raw(more) && !trimmed(more).starts_with("*");) joined += trimmed(more);
    if (open_.size() == depth) open_.back().line = number;
    line = kept_.emplace_back(std::move(joined));
    return true;
  }
  return false;
}

void InpSource::include(const std::string& name, const input::Location& where, input::Diagnostics& diagnostics) {
  const std::string found = fmt::format("the file \"{}\" is included", name);
  if (rules_.root.empty()) return diagnostics.error(where, found, "put its lines here");
  if (++included_ > most_files || open_.size() > deepest)
    return diagnostics.error(where, found + ", and files include each other without end", "take the circle out");
  std::error_code fault;
  const fs::path path = fs::weakly_canonical(open_.back().folder / name, fault), root = fs::weakly_canonical(rules_.root, fault);
  if (fs::path(name).is_absolute() || fault || !is_within(path, root))
    return diagnostics.error(where, found + ", which is outside the folder of the case", "copy it into the folder and name it from there");
  if (!fs::is_regular_file(path, fault)) return diagnostics.error(where, found + ", which is not there", "put it beside the file that names it");
  try {
    const std::string& text = kept_.emplace_back(input::read_file(path));
    open_.push_back({LineSource(text), &kept_.emplace_back((open_.back().folder / name).lexically_normal().string()), path.parent_path(), 0});
  } catch (const input::InputError& error) {
    for (const input::Diagnostic& one : error.errors()) diagnostics.error(where, found + ": " + one.found, one.remedy);
  }
}

}  // namespace snug::mesh
