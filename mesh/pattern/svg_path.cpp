#include "mesh/pattern/svg_path.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

/// An elliptic arc by its ends (SVG 1.1, appendix F.6.5); radii that are too small grow until it fits.
Span elliptic_arc(const Vector2d& from, const Vector2d& to, Vector2d radii, double turn, bool large, bool sweep) {
  radii = radii.cwiseAbs();
  if (radii.minCoeff() < 1e-12 || (to - from).norm() < 1e-12) return Line{from, to};
  const Eigen::Rotation2Dd rotation(turn * std::numbers::pi / 180.0);
  const Vector2d half = rotation.inverse() * Vector2d(0.5 * (from - to));
  const double grow = half.cwiseQuotient(radii).squaredNorm();
  if (grow > 1.0) radii *= std::sqrt(grow);
  const Vector2d unit = half.cwiseQuotient(radii);  // on the unit circle the chord is 2 |unit| long
  const double height = std::sqrt(std::max(0.0, 1.0 - unit.squaredNorm())) / std::max(unit.norm(), 1e-300);
  const Vector2d centre = (large == sweep ? -height : height) * Vector2d(unit.y(), -unit.x());
  const Vector2d start = unit - centre, end = -unit - centre;
  const double first = std::atan2(start.y(), start.x()), full = 2.0 * std::numbers::pi;
  double angle = std::atan2(end.y(), end.x()) - first;
  if (sweep && angle < 0.0) angle += full;
  if (!sweep && angle > 0.0) angle -= full;
  return Arc{0.5 * (from + to) + rotation * Vector2d(centre.cwiseProduct(radii)), rotation * Vector2d(radii.x(), 0.0),
             rotation * Vector2d(0.0, radii.y()), first, first + angle};
}

class Parser {
 public:
  explicit Parser(const std::string& data) : data_(data) {}

  std::vector<Curve> parse(std::string& fault) {
    char command = 0;
    for (skip(); at_ < data_.size(); skip()) {
      if (std::isalpha(static_cast<unsigned char>(data_[at_])))
        command = data_[at_++];
      else if (command == 'M')
        command = 'L';
      else if (command == 'm')
        command = 'l';
      else if (command == 0 || command == 'Z' || command == 'z') {
        fault = "path data begins with no command";
        break;
      }
      if (!draw(command)) {
        fault = std::string("the numbers of the command ") + command;
        break;
      }
    }
    finish();
    return std::move(paths_);
  }

 private:
  void skip() {
    while (at_ < data_.size() && std::string_view(" \t\r\n,").find(data_[at_]) != std::string_view::npos) ++at_;
  }

  std::optional<double> number() {
    skip();
    if (at_ < data_.size() && data_[at_] == '+') ++at_;
    double value = 0.0;
    const auto [end, error] = std::from_chars(data_.data() + at_, data_.data() + data_.size(), value);
    if (error != std::errc() || !(std::abs(value) < 1e9)) return std::nullopt;
    at_ = static_cast<std::size_t>(end - data_.data());
    return value;
  }

  /// A flag of an arc is one digit, with or without a space after it.
  std::optional<double> flag() {
    skip();
    if (at_ >= data_.size() || (data_[at_] != '0' && data_[at_] != '1')) return std::nullopt;
    return data_[at_++] - '0';
  }

  std::optional<Vector2d> point(bool relative) {
    const auto x = number(), y = x ? number() : std::nullopt;
    if (!y) return std::nullopt;
    return Vector2d(*x, *y) + (relative ? here_ : Vector2d::Zero());
  }

  void add(const Span& span) {
    if (current_.spans.empty()) start_ = mesh::at(span, 0.0);
    current_.spans.push_back(span);
    here_ = mesh::at(span, 1.0);
  }

  void finish() {
    if (!current_.spans.empty()) paths_.push_back(std::move(current_));
    current_ = {};
  }

  void close() {
    if (!current_.spans.empty() && (here_ - start_).norm() > 1e-9) add(Line{here_, start_});
    finish();
    here_ = start_;
  }

  bool draw(char command) {
    const bool relative = std::islower(static_cast<unsigned char>(command));
    const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
    const Vector2d reflected = 2.0 * here_ - control_;
    const char before = std::exchange(before_, kind);
    switch (kind) {
      case 'Z':
        close();
        return true;
      case 'M':
        return move(relative);
      case 'L':
        return line(point(relative));
      case 'H':
        return straight(relative, 0);
      case 'V':
        return straight(relative, 1);
      case 'C':
        return cubic(point(relative), relative);
      case 'S':
        return cubic(before == 'C' || before == 'S' ? reflected : here_, relative);
      case 'Q':
        return quadratic(point(relative), relative);
      case 'T':
        return quadratic(before == 'Q' || before == 'T' ? reflected : here_, relative);
      case 'A':
        return arc(relative);
      default:
        return false;
    }
  }

  bool move(bool relative) {
    const auto to = point(relative);
    finish();
    if (to) here_ = start_ = *to;
    return to.has_value();
  }
  bool line(const std::optional<Vector2d>& to) {
    if (to) add(Line{here_, *to});
    return to.has_value();
  }
  bool straight(bool relative, int axis) {
    const auto value = number();
    if (!value) return false;
    Vector2d to = here_;
    to[axis] = *value + (relative ? here_[axis] : 0.0);
    return line(to);
  }
  bool cubic(const std::optional<Vector2d>& first, bool relative) {
    const auto second = first ? point(relative) : std::nullopt, to = second ? point(relative) : std::nullopt;
    if (!to) return false;
    control_ = *second;
    add(Cubic{here_, *first, *second, *to});
    return true;
  }
  bool quadratic(const std::optional<Vector2d>& control, bool relative) {
    const auto to = control ? point(relative) : std::nullopt;
    if (!to) return false;
    control_ = *control;
    add(Quadratic{here_, *control, *to});
    return true;
  }
  bool arc(bool relative) {
    const auto radii = point(false);
    const auto turn = radii ? number() : std::nullopt, large = turn ? flag() : std::nullopt,
               sweep = large ? flag() : std::nullopt;
    const auto to = sweep ? point(relative) : std::nullopt;
    if (!to) return false;
    add(elliptic_arc(here_, *to, *radii, *turn, *large != 0.0, *sweep != 0.0));
    return true;
  }

  const std::string& data_;
  std::size_t at_ = 0;
  Vector2d here_ = Vector2d::Zero(), start_ = Vector2d::Zero(), control_ = Vector2d::Zero();
  char before_ = 0;
  Curve current_;
  std::vector<Curve> paths_;
};

}  // namespace

std::vector<Curve> parse_svg_path(const std::string& data, std::string& fault) { return Parser(data).parse(fault); }

}  // namespace snug::mesh
