// The bone where nothing is said of it.
#pragma once

#include <string>

namespace snug::mesh {

/// This share of the skin's girth. Of the limbs that ship the thigh's is a sixth, the calf's a third to a half (two bones); a bone twice as
/// thick changes pressures by what the tissue between is stiffer.
constexpr double usual_bone = 0.25;

/// What to do about it; `what` is the column or net to add.
inline std::string usual_bone_remedy(const std::string& what) {
  return "add the " + what + " where the bone is known (a thigh has about 17 %, an upper arm 25 %, a calf or forearm with two bones 33 %)";
}

}  // namespace snug::mesh
