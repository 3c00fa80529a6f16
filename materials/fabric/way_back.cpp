// Curves of the way back. They stand apart from tension_curve.cpp, which is compiled as it ever was: its last bits are
// those of every run.
#include <algorithm>

#include "materials/fabric/fabric.hpp"

namespace snug::materials {

TensionCurve TensionCurve::continued_as(const TensionCurve& other) const {
  TensionCurve curve = *this;
  curve.at_end_.stiffness = other.at(end_).stiffness;
  curve.smallest_stiffness_ = std::min(smallest_stiffness_, curve.at_end_.stiffness);
  return curve;
}

}  // namespace snug::materials
