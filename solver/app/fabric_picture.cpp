// The picture of snug materials curve.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/pattern/svg_text.hpp"
#include "solver/app/fabric_curves.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace {

using Test = FabricCurve::Test;

constexpr int steps = 80;
constexpr double wide = 430.0, high = 300.0, left = 62.0, top = 46.0, gap = 90.0, foot = 64.0;  // px

/// 1, 2 or 5 times a power of ten, some five of which reach `most`.
double tick_step(double most) {
  const double rough = most / 5.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power) return factor * power;
  return 10.0 * power;
}

/// What stands on one pair of axes.
class Panel {
 public:
  Panel(Test test, std::vector<FabricCurve> curves, double x, double y)
      : curves_(std::move(curves)), x_(x), y_(y), unit_(test == Test::tensile ? 0.01 : std::numbers::pi / 180.0) {
    std::erase_if(curves_, [&](const FabricCurve& curve) { return curve.test != test; });
    label_ = test == Test::tensile ? "elongation, %" : "shear angle, degrees";
    for (const FabricCurve& curve : curves_)
      for (const auto& point : curve.points) {
        most_at_ = std::max(most_at_, point.at / unit_), most_force_ = std::max(most_force_, point.force),
        least_force_ = std::min(least_force_, point.force);
        if (!std::isinf(curve.data_end)) data_end_ = std::max(data_end_, curve.data_end / unit_);
      }
    const double step = tick_step(most_force_ - least_force_);
    most_force_ = step * std::ceil(most_force_ / step), least_force_ = step * std::floor(least_force_ / step);
  }

  std::string svg() const {
    std::string text = range() + axes();
    for (std::size_t c = 0; c < curves_.size(); ++c) text += line(curves_[c]) + legend(curves_[c], static_cast<int>(c));
    return text;
  }

 private:
  double px(double at) const { return x_ + wide * at / most_at_; }
  double py(double force) const { return y_ + high * (most_force_ - force) / (most_force_ - least_force_); }

  /// The part where nothing was measured.
  std::string range() const {
    if (!(data_end_ > 0.0) || data_end_ >= most_at_) return {};
    return fmt::format(
        "<rect class=\"beyond\" x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" fill=\"#eee\"/>\n"
        "<text x=\"{4:.1f}\" y=\"{5:.1f}\" text-anchor=\"middle\" fill=\"#777\">beyond the data</text>\n",
        px(data_end_), y_, px(most_at_) - px(data_end_), high, 0.5 * (px(data_end_) + px(most_at_)), y_ - 6.0);
  }

  std::string axes() const {
    std::string text = fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n", x_, y_,
        wide, high);
    const double at_step = tick_step(most_at_), force_step = tick_step(most_force_ - least_force_);
    for (double at = 0.0; at <= most_at_ * (1.0 + 1e-9); at += at_step)
      text += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}v5\" stroke=\"#444\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\" "
          "text-anchor=\"middle\">{3:g}</text>\n",
          px(at), y_ + high, y_ + high + 19.0, at);
    for (double force = least_force_; force <= most_force_ + 1e-9 * force_step; force += force_step)
      text += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}h-5\" stroke=\"#444\"/><text x=\"{2:.1f}\" y=\"{3:.1f}\" "
          "text-anchor=\"end\">{4:g}</text>\n",
          x_, py(force), x_ - 8.0, py(force) + 4.0, std::abs(force) < 1e-9 * force_step ? 0.0 : force);
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x_ + 0.5 * wide,
                        y_ + high + 38.0, label_);
    return text + fmt::format(
                      "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">force per "
                      "width, N/m</text>\n",
                      x_ - 46.0, y_ + 0.5 * high);
  }

  static std::string colour(const FabricCurve& curve) {
    const bool weft = curve.direction == "weft", back = curve.branch == "unloading";
    return weft ? (back ? "#f0a35a" : "#c2560a") : (back ? "#6aa9e0" : "#0b5394");
  }

  /// Whole inside the data, dashed beyond.
  std::string line(const FabricCurve& curve) const {
    std::array<std::string, 2> paths;
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      const auto& point = curve.points[k];
      std::string& path = paths[point.beyond];
      if (path.empty() && point.beyond && k > 0)
        path = fmt::format("M{:.1f} {:.1f}", px(curve.points[k - 1].at / unit_), py(curve.points[k - 1].force));
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px(point.at / unit_), py(point.force));
    }
    std::string text;
    for (const bool beyond : {false, true})
      if (!paths[beyond].empty())
        text += fmt::format("<path class=\"{}\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
                            beyond ? "curve-beyond" : "curve", paths[beyond], colour(curve),
                            beyond ? " stroke-dasharray=\"6 4\"" : "");
    return text;
  }

  std::string legend(const FabricCurve& curve, int row) const {
    const double y = y_ + 18.0 + 17.0 * row;
    return fmt::format(
        "<path d=\"M{:.1f} {:.1f}h24\" stroke=\"{}\" stroke-width=\"2\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{}{}</text>\n",
        x_ + 12.0, y - 4.0, colour(curve), x_ + 42.0, y, curve.name(),
        std::isinf(curve.data_end) ? " (no range of data)" : "");
  }

  std::vector<FabricCurve> curves_;
  double x_, y_, unit_;
  std::string label_;
  double most_at_ = 1e-12, most_force_ = 1e-12, least_force_ = 0.0, data_end_ = 0.0;
};

}  // namespace

void write_fabric_picture(const std::vector<materials::FabricData>& fabrics, const std::filesystem::path& file) {
  if (file.extension() != ".svg")
    throw input::InputError({file.string(), 0, 0}, "the picture is an SVG file",
                            "end its name in .svg; the numbers are in the table, --csv");
  const double row = top + high + foot, width = 2.0 * (left + wide) + gap,
               height = row * static_cast<double>(fabrics.size()) + 10.0;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  for (std::size_t f = 0; f < fabrics.size(); ++f) {
    const double y = row * static_cast<double>(f);
    const auto curves = fabric_curves(fabrics[f], steps);
    text += fmt::format(
        "<g>\n<desc>{}</desc>\n<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"17\" font-weight=\"bold\">{}</text>\n",
        mesh::xml_text(fabrics[f].loading.source), left, y + 26.0, mesh::xml_text(fabrics[f].loading.name));
    text += Panel(Test::tensile, curves, left, y + top).svg() +
            Panel(Test::shear, curves, 2.0 * left + wide + 30.0, y + top).svg() + "</g>\n";
  }
  write_named(file, text + "</svg>\n");
}

}  // namespace snug::app
