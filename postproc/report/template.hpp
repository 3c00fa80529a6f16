// Mustache templates filled with JSON.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace snug::postproc::report {

/// {{name}} is escaped for HTML, {{{name}}} is not; {{#name}} repeats for an array, and is shown for what is neither
/// null, false nor empty; {{^name}} the reverse; {{> name}} is one of the parts. Throws std::logic_error for a template
/// that cannot be parsed.
std::string fill(std::string_view text, const nlohmann::ordered_json& values,
                 const std::map<std::string, std::string_view>& parts = {});

}  // namespace snug::postproc::report
