// One value of a case's text changed, everything else (comments, order) left as its author wrote it.
#pragma once

#include <optional>
#include <string>

namespace snug::input {

/// The text with the value at a dotted path, as of --set ("garment.pattern.length", entries of lists by name or number), replaced by a TOML literal
/// ("\"290 mm\"", "0.95", "[ … ]"). A key that is not there is added to its table; a text that stands for a table of one key
/// (pattern = "leg.toml") becomes that table, `text_key` being the key that the text stands for. None where it cannot be done.
std::optional<std::string> with_value(const std::string& text, const std::string& path, const std::string& literal, const std::string& text_key = "file");

}  // namespace snug::input
