#include "cases/input/echo.hpp"

#include <fmt/format.h>

#include <cmath>

namespace snug::input {

std::optional<Value> Echo::value_of(const Field& field, double member) const {
  if (std::isnan(member)) return std::nullopt;
  if (field.unit.empty()) return value_without_place(member);
  return value_without_place(
      fmt::format("{} {}", member, field.unit));  // shortest text that reads back to the same number
}

std::optional<Value> Echo::value_of(const Field&, int member) const {
  return value_without_place(static_cast<long long>(member));
}

std::optional<Value> Echo::value_of(const Field&, bool member) const { return value_without_place(member); }

std::optional<Value> Echo::value_of(const Field&, const std::string& member) const {
  if (member.empty()) return std::nullopt;
  return value_without_place(member);
}

std::optional<Value> Echo::value_of(const Field&, const std::filesystem::path& member) const {
  if (member.empty()) return std::nullopt;
  const auto relative = directory_.empty() ? member : member.lexically_relative(directory_);
  const bool inside = !relative.empty() && *relative.begin() != "..";
  return value_without_place((inside ? relative : std::filesystem::absolute(member)).generic_string());
}

std::optional<Value> Echo::value_of(const Field& field, const MaterialEntry& member) const {
  if (write_out_)
    if (std::optional<Table> written = write_out_(field, member)) return value_without_place(std::move(*written));
  if (!member.name.empty()) return value_without_place(member.name);
  if (!member.is_inline()) return std::nullopt;
  return value_without_place(member.table);
}

std::string echo_text(const Case& description, const WriteOut& write_out) {
  Case shown = description;
  if (shown.body && shown.body->scan && !shown.body->scan->standard.empty()) shown.body->scan->surface.clear();  // comes with the standard body
  return "# The values used, in SI, with defaults filled in.\n" +
         to_toml(to_table(shown, description.directory.lexically_normal(), write_out));
}

}  // namespace snug::input
