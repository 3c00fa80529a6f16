// How locations and terms are written in fuzzy systems.
#pragma once

#include <string>

namespace snug::postproc {

/// Letters and digits in lower case: "Front waist", "Front_waist" and "Frontwaist" are the same location.
std::string plain_name(const std::string& name);
/// "very_uncomfortable" as "very uncomfortable".
std::string spoken_name(std::string name);

}  // namespace snug::postproc
