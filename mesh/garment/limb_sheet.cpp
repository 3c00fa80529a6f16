#include "mesh/garment/limb_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/garment/girth_curve.hpp"

namespace snug::mesh {

namespace {

/// Catmull-Rom weights of four neighbours at t in [0, 1] between the middle two, and their derivatives.
struct Weights {
  Eigen::Vector4d w, d;
  explicit Weights(double t)
      : w(0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (3.0 * t - 5.0), 0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)),
        d(-0.5 + t * (2.0 - 1.5 * t), t * (4.5 * t - 5.0), 0.5 + t * (4.0 - 4.5 * t), t * (1.5 * t - 1.0)) {}
};

}  // namespace

LimbSheet::LimbSheet(const Limb& limb, const GarmentFit& fit, double lift, double angle) : limb_(limb), lower_(limb.lower) {
  const double size = limb.girth(0.5 * (limb.lower + limb.upper)) / columns, height = limb.upper - limb.lower;
  rows_ = std::clamp(static_cast<int>(std::ceil(height / size)), 16, 512) + 1;
  step_ = height / (rows_ - 1);
  for (int row = 0; row < rows_; ++row) add_row(fit, lift, angle, row);
}

void LimbSheet::add_row(const GarmentFit& fit, double lift, double angle, int row) {
  const double z = height_of(row);
  const GirthCurve curve(limb_, z, fit.girth_at(z), lift, limb_.skin->turn_at_angle(angle, z));
  turn_.emplace_back(), x_.emplace_back();
  double slope = 0.0;
  for (int c = 0; c <= columns; ++c) {
    const double turn = curve.turn_at(static_cast<double>(c) / columns);
    const OutlinePoint p = limb_.skin->derivatives(turn, z);
    const Eigen::Vector3d normal = p.x_t.cross(p.x_z).normalized();
    const Eigen::Vector3d round = p.x_t.normalized();
    slope += (p.x_z - round * round.dot(p.x_z)).norm() / (columns + 1);
    turn_.back().push_back(turn);
    x_.back().push_back(p.x + curve.distance() * normal);
  }
  distance_.push_back(curve.distance());
  if (curve.loose() && z >= fit.lower && z <= fit.upper) farthest_ = std::max(farthest_, curve.distance());
  mean_girth_ += limb_.girth(z) / rows_;
  length_.push_back(row == 0 ? 0.0 : length_.back() + 0.5 * step_ * (slope_.back() + slope));
  slope_.push_back(slope);
}

SheetPoint LimbSheet::near(double share, double height) const {
  const double u = (share - std::floor(share)) * columns, v = std::clamp((height - lower_) / step_, 0.0, rows_ - 1.0);
  const int column = std::min(static_cast<int>(u), columns - 1), row = std::min(static_cast<int>(v), rows_ - 2);
  const Weights across(u - column), along(v - row);
  SheetPoint point{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const auto value = [&](int r, int c) -> Eigen::Vector3d {
    const int wrapped = ((c % columns) + columns) % columns;
    if (r < 0) return 2.0 * x_[0][wrapped] - x_[1][wrapped];  // beyond the ends straight on
    if (r >= rows_) return 2.0 * x_[rows_ - 1][wrapped] - x_[rows_ - 2][wrapped];
    return x_[r][wrapped];
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Eigen::Vector3d x = value(row - 1 + i, column - 1 + j);
      point.x += along.w[i] * across.w[j] * x;
      point.x_round += along.w[i] * across.d[j] * columns * x;
      point.x_up += along.d[i] * across.w[j] / step_ * x;
    }
  return point;
}

Eigen::Vector2d LimbSheet::turn_at(double share, double height) const {
  const double whole = std::floor(share), u = (share - whole) * columns, v = std::clamp((height - lower_) / step_, 0.0, rows_ - 1.0);
  const int column = std::min(static_cast<int>(u), columns - 1), row = std::min(static_cast<int>(v), rows_ - 2);
  const auto turn = [&](int r, int c) {  // a way round is one turn
    if (c < 0) return turn_[r][c + columns] - 1.0;
    if (c > columns) return turn_[r][c - columns] + 1.0;
    return turn_[r][c];
  };
  const Weights across(u - column);
  const auto at_row = [&](int r) {
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) sum += across.w[j] * turn(r, column - 1 + j);
    return sum;
  };
  const double t = v - row;
  return {(1.0 - t) * at_row(row) + t * at_row(row + 1), (1.0 - t) * distance_[row] + t * distance_[row + 1]};
}

Eigen::Vector3d LimbSheet::at(double share, double height) const {
  const Eigen::Vector2d place = turn_at(share, height);
  const double turn = place[0] - std::floor(place[0]);
  return limb_.skin->at(turn, height) + place[1] * outward_normal(*limb_.skin, turn, height);
}

double LimbSheet::length_to(double height) const {
  const double v = std::clamp((height - lower_) / step_, 0.0, rows_ - 1.0);
  const int row = std::min(static_cast<int>(v), rows_ - 2);
  return length_[row] + (v - row) * (length_[row + 1] - length_[row]);
}

double LimbSheet::height_after(double length) const {
  const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, length);
  const auto row = above - length_.begin() - 1;
  return height_of(static_cast<int>(row)) + step_ * (length - length_[row]) / (length_[row + 1] - length_[row]);
}

}  // namespace snug::mesh
