// Names of APDL commands, and which of them say nothing about the model of one static step.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace snug::mesh {

/// Ansys tells commands by their first four letters, but those that begin with / or *.
std::string short_name(std::string_view name);
/// Solution controls, output, titles, pictures, and what CDWRITE says of its session.
bool says_nothing(const std::string& short_name);
/// Commands that set loads which are not read, with what they would do; zeros are none.
std::optional<std::string> load_of_command(const std::string& short_name);

}  // namespace snug::mesh
