#include "mesh/placement/placed_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double millimetres = 400.0;  // of the picture, a metre

/// Blue below 1, red above, white at it.
std::string colour(double stretch) {
  const double below = std::clamp((1.0 - stretch) / 0.2, 0.0, 1.0), above = std::clamp((stretch - 1.0) / 0.4, 0.0, 1.0);
  const auto level = [](double share) { return static_cast<int>(std::lround(255.0 * (1.0 - 0.85 * share))); };
  return fmt::format("#{:02x}{:02x}{:02x}", level(below), level(std::max(below, above)), level(above));
}

/// One view along y; `front`: -1 from the front, 1 from behind, which is x's direction in the picture.
class View {
 public:
  View(double direction, double middle, double height) : direction_(direction), middle_(middle), height_(height) {}

  Vector2d on_paper(const Vector3d& p) const {
    return {middle_ + millimetres * direction_ * p.x(), 20.0 + millimetres * (height_ - p.z())};
  }
  /// Larger: nearer to who looks.
  double depth(const Vector3d& p) const { return -direction_ * p.y(); }

 private:
  double direction_, middle_, height_;
};

std::string body_lines(const DressForm& form, const View& view) {
  std::string text = "<path fill=\"none\" stroke=\"#999\" stroke-width=\"0.2\" d=\"";
  for (double z = 0.01; z < form.body.stature; z += 0.02)
    for (const SectionLoop& loop : form.sections.at(z)) {
      const auto [left, right] = std::minmax_element(
          loop.points.begin(), loop.points.end(), [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
      const Vector2d a = view.on_paper({left->x(), 0.0, z}), b = view.on_paper({right->x(), 0.0, z});
      text += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
    }
  return text + "\"/>\n";
}

/// What looks at the viewer, far triangles first.
std::string cloth(const PlacedGarment& placed, const View& view) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < placed.cloth.nodes.size(); ++t) {
    const auto& n = placed.cloth.nodes[t];
    const Vector3d &a = placed.places[n[0]], &b = placed.places[n[1]], &c = placed.places[n[2]];
    const Vector3d normal = (b - a).cross(c - a);
    if (view.depth(normal) > 0.0) order.emplace_back(view.depth(a + b + c), t);
  }
  std::sort(order.begin(), order.end());
  std::string text;
  for (const auto& [depth, t] : order) {
    text +=
        fmt::format("<path fill=\"{0}\" stroke=\"#555\" stroke-width=\"0.05\" d=\"M", colour(placed.stretches[t][0]));
    for (const int node : placed.cloth.nodes[t]) {
      const Vector2d p = view.on_paper(placed.places[node]);
      text += fmt::format("{:.2f} {:.2f} ", p.x(), p.y());
    }
    text += "z\"/>\n";
  }
  return text;
}

}  // namespace

std::string placed_svg(const PlacedGarment& placed, const DressForm& form) {
  double half = 0.0;
  for (const Vector3d& vertex : form.body.surface.vertices) half = std::max(half, std::abs(vertex.x()));
  const double wide = millimetres * half + 10.0, high = millimetres * form.body.stature + 40.0;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}mm\" height=\"{1:.0f}mm\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n",
      4.0 * wide, high);
  for (const View& view : {View(-1.0, wide, form.body.stature), View(1.0, 3.0 * wide, form.body.stature)})
    text += body_lines(form, view) + cloth(placed, view);
  return text + "</svg>\n";
}

}  // namespace snug::mesh
