// The nearest known name for one that is not known.
#pragma once

#include <string>
#include <vector>

namespace snug::input {

/// Edit distance (insertions, deletions, substitutions, swaps of neighbours), case ignored.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `name`, or an empty text when none is near enough to be meant.
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string joined(const std::vector<std::string>& names);

/// Remedy for an unknown name: "did you mean X? known: A, B, C".
std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace snug::input
