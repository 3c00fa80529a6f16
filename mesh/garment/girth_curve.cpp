#include "mesh/garment/girth_curve.hpp"

#include <algorithm>
#include <numbers>

namespace snug::mesh {

namespace {

/// The curve parallel to the skin of a limb at a distance outwards.
class Parallel : public Outline {
 public:
  Parallel(const Outline& skin, double distance) : skin_(skin), distance_(distance) {}
  Eigen::Vector3d at(double turn, double z) const override {
    return skin_.at(turn, z) + distance_ * outward_normal(skin_, turn, z);
  }

 private:
  const Outline& skin_;
  double distance_;
};

}  // namespace

double stand_off(const Limb& limb, double skin_girth, double z, double width, double lift) {
  const double wide = (width - skin_girth) / (2.0 * std::numbers::pi);
  if (wide <= lift + 1e-6 * skin_girth) return lift;  // as wide as the limb but for round-off is not loose
  double hollow = 0.0;  // 1/m
  constexpr int samples = 64;
  for (int i = 0; i < samples; ++i)
    hollow = std::max(hollow, -limb.skin_curvature(static_cast<double>(i) / samples, z).x());
  return std::max(lift, hollow > 0.0 ? std::min(wide, 0.5 / hollow) : wide);
}

GirthCurve::GirthCurve(const Limb& limb, double z, double width, double lift, double start)
    : arc_(std::make_unique<SectionArc>(*limb.skin, z, start)) {
  distance_ = stand_off(limb, arc_->girth(), z, width, lift);
  if (distance_ == lift) return;
  parallel_ = std::make_unique<Parallel>(*limb.skin, distance_);
  arc_ = std::make_unique<SectionArc>(*parallel_, z, start);
}

}  // namespace snug::mesh
