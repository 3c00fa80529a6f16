#include "postproc/report/scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace snug::postproc::report {

double round_step(double range, int parts) {
  const double least = range / parts, power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 2.5, 5.0})
    if (step * power >= least * (1.0 - 1e-9)) return step * power;
  return 10.0 * power;
}

std::vector<double> ticks(double from, double to, int parts) {
  if (!(to > from)) return {from};
  const double step = round_step(to - from, parts), slack = 1e-9 * step;
  std::vector<double> result;
  for (double k = std::ceil((from - slack) / step); k * step <= to + slack; ++k) result.push_back(k * step + 0.0);
  return result;
}

std::string power_of_ten(int power) {
  static const char* const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = power < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(power))) text += raised[digit - '0'];
  return text;
}

namespace {

/// A true minus sign and a narrow space between thousands.
std::string dressed(std::string text) {
  const std::size_t first = text[0] == '-' ? 1 : 0;
  for (std::size_t at = std::min(text.find_first_of(".e"), text.size()); at > first + 3;) text.insert(at -= 3, " ");
  return first == 1 ? fmt::format("−{}", text.substr(1)) : text;
}

}  // namespace

std::string plain(double value) { return std::isfinite(value) ? dressed(fmt::format("{:.9g}", value + 0.0)) : "–"; }

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const int power = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  if (power < -3 || power > 6)
    return dressed(fmt::format("{:.{}f}", value / std::pow(10.0, power), std::max(0, digits - 2))) + " × " +
           power_of_ten(power);
  return dressed(fmt::format("{:.{}f}", value, std::clamp(digits - 1 - power, 0, 9)));
}

const std::vector<int>& colour_stops() {
  static const std::vector<int> stops = {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                         0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
  return stops;
}

std::string colour(double t) {
  const auto& stops = colour_stops();
  const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  int mixed = 0;
  for (const int shift : {16, 8, 0}) {
    const int a = stops[i] >> shift & 255, b = stops[i + 1] >> shift & 255;
    mixed |= static_cast<int>(std::lround(a + (b - a) * (at - static_cast<double>(i)))) << shift;
  }
  return fmt::format("#{:06x}", mixed);
}

namespace {

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::max(0.0, *std::max_element(values.begin(), values.end()));
}

}  // namespace

const std::vector<double>& pressure_beside(const Skin& skin) { return skin.beside.empty() ? skin.pressure : skin.beside; }

double largest(const Skin& skin) { return largest_of(skin.pressure); }

double largest_inside(const Skin& skin) {
  double result = 0.0;
  const std::vector<double>& pressure = pressure_beside(skin);
  for (std::size_t n = 0; n < pressure.size(); ++n)
    if (skin.coverage[n] > 0.95) result = std::max(result, pressure[n]);
  return result > 0.0 ? result : largest(skin);
}

PressureScale pressure_scale(const std::vector<const Skin*>& skins) {
  double inside = 0.0;
  for (const Skin* skin : skins) inside = std::max(inside, largest_inside(*skin));
  PressureScale scale;
  if (!(inside > 0.0)) return scale;
  const double step = round_step(inside, 10);
  scale.bands = std::max(1, static_cast<int>(std::ceil(inside / step * (1.0 - 1e-9))));
  scale.top = step * scale.bands;
  if (scale.top > 2000.0) scale.unit = "kPa", scale.factor = 1e3;
  return scale;
}

}  // namespace snug::postproc::report
