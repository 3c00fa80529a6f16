// SPLINE entities of DXF (AutoCAD's "DXF Reference", group codes of SPLINE).
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "mesh/formats/curve_set.hpp"

namespace snug::mesh {

namespace {

using curves::BSplineCurve;
using input::InputError;

/// A group: a code and a value, each on a line of its own.
struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

class Groups {
 public:
  Groups(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  std::optional<Group> next() {
    if (rest_.empty()) return std::nullopt;
    const std::string_view code = trimmed(take_line());
    Group group;
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), group.code);
    if (code.empty() && rest_.empty()) return std::nullopt;
    if (error != std::errc() || end != code.data() + code.size())
      throw InputError(here(), fmt::format("\"{}\" is no group code", std::string(code.substr(0, 40))),
                       "DXF text has a whole number on every other line; binary DXF is not read");
    if (rest_.empty()) throw InputError(here(), "the file ends after a group code", "export it again");
    group.value = trimmed(take_line());
    group.line = line_;
    return group;
  }
  input::Location place(const Group& group) const { return {file_, group.line, 1}; }

  double number(const Group& group) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(group.value.data(), group.value.data() + group.value.size(), value);
    if (error != std::errc() || end != group.value.data() + group.value.size() || !std::isfinite(value))
      throw InputError(place(group), fmt::format("\"{}\" is no number", std::string(group.value.substr(0, 40))),
                       "write a finite number");
    return value;
  }
  int whole(const Group& group) const {
    const double value = number(group);
    if (value != std::floor(value) || std::abs(value) > 1e6)
      throw InputError(place(group),
                       fmt::format("\"{}\" is no whole number of this size", std::string(group.value.substr(0, 40))),
                       "export the file again");
    return static_cast<int>(value);
  }

 private:
  input::Location here() const { return {file_, line_, 1}; }
  std::string_view take_line() {
    const auto end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++line_;
    return line;
  }
  static std::string_view trimmed(std::string_view text) {
    const auto from = text.find_first_not_of(" \t\r");
    return from == std::string_view::npos ? std::string_view()
                                          : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
  }

  std::string_view rest_;
  std::string file_;
  int line_ = 0;
};

double insertion_unit(int code, const input::Location& where) {
  static const std::map<int, double> units = {{0, 1e-3}, {1, 0.0254}, {2, 0.3048}, {4, 1e-3}, {5, 1e-2}, {6, 1.0}};
  const auto found = units.find(code);
  if (found == units.end())
    throw InputError(where, fmt::format("$INSUNITS is {}", code),
                     "export in millimetres (4), centimetres (5), metres (6), inches (1) or feet (2)");
  return found->second;
}

/// One SPLINE while its groups come in.
struct Spline {
  input::Location where;
  std::string layer;
  int degree = 0;
  bool fit_points = false;
  std::vector<double> knots, weights;
  std::vector<Eigen::Vector3d> points;
};

void take(Spline& spline, const Group& group, const Groups& groups) {
  const auto coordinate = [&](int axis) {
    if (spline.points.empty())
      throw InputError(groups.place(group), "a coordinate before the point that it belongs to",
                       "export the file again");
    spline.points.back()[axis] = groups.number(group);
  };
  switch (group.code) {
    case 8:
      spline.layer = group.value;
      break;
    case 71:
      spline.degree = groups.whole(group);
      break;
    case 40:
      spline.knots.push_back(groups.number(group));
      break;
    case 41:
      spline.weights.push_back(groups.number(group));
      break;
    case 10:
      spline.points.emplace_back(groups.number(group), 0.0, 0.0);
      break;
    case 20:
      coordinate(1);
      break;
    case 30:
      coordinate(2);
      break;
    case 11:
      spline.fit_points = true;
      break;
    default:
      break;
  }
}

Named<BSplineCurve> curve_of(const Spline& spline, double unit) {
  if (spline.points.empty() && spline.fit_points)
    throw InputError(spline.where, "a SPLINE with fit points only", "export it with control points");
  const auto count = static_cast<Eigen::Index>(spline.points.size());
  BSplineCurve curve{spline.degree, spline.knots, Eigen::MatrixXd(3, count), Eigen::VectorXd::Ones(count)};
  for (Eigen::Index i = 0; i < count; ++i) curve.points.col(i) = unit * spline.points[i];
  if (!spline.weights.empty())
    curve.weights =
        Eigen::Map<const Eigen::VectorXd>(spline.weights.data(), static_cast<Eigen::Index>(spline.weights.size()));
  if (const std::string fault = curve.fault(); !fault.empty())
    throw InputError(spline.where, "a SPLINE that is no curve: " + fault, "export it again");
  if ((curve.points.row(2).array() == 0.0).all()) curve.points = curve.points.topRows(2).eval();  // flat
  return {spline.layer == "0" ? std::string() : spline.layer, std::move(curve)};
}

std::string told(const std::map<std::string, int>& kinds) {
  std::string text;
  for (const auto& [kind, count] : kinds) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text;
}

std::string layer_of(const std::string& name) {
  std::string layer = name.empty() ? "0" : name;
  for (char& c : layer)  // what a layer's name may not hold
    if (static_cast<unsigned char>(c) < 0x20 || std::string_view("<>/\\\":;?*|,=`").find(c) != std::string_view::npos)
      c = '_';
  return layer;
}

}  // namespace

CurveSet parse_dxf_splines(const std::string& text, const std::string& shown_as, std::string& left_out) {
  Groups groups(text, shown_as);
  CurveSet set;
  std::map<std::string, int> others;
  std::optional<Spline> spline;
  double unit = 1e-3;
  bool entities = false, unit_next = false, section_next = false;
  const auto close = [&] {
    if (spline) set.curves.push_back(curve_of(*spline, unit));
    spline.reset();
  };
  while (const auto group = groups.next()) {
    if (group->code == 0) {
      close();
      section_next = group->value == "SECTION";
      if (group->value == "ENDSEC") entities = false;
      if (!entities) continue;
      if (group->value == "SPLINE")
        spline.emplace().where = groups.place(*group);
      else
        ++others[std::string(group->value.substr(0, 40))];
    } else if (group->code == 2 && section_next) {
      entities = group->value == "ENTITIES", section_next = false;
    } else if (group->code == 9) {
      unit_next = group->value == "$INSUNITS";
    } else if (group->code == 70 && unit_next) {
      unit = insertion_unit(groups.whole(*group), groups.place(*group)), unit_next = false;
    } else if (spline) {
      take(*spline, *group, groups);
    }
  }
  close();
  left_out = told(others);
  if (set.empty())
    throw InputError({shown_as, 0, 0},
                     others.empty() ? "no entities" : "no SPLINE among the entities (" + left_out + ")",
                     "export curves as SPLINE into the section ENTITIES");
  return set;
}

std::string dxf_splines(const CurveSet& set) {
  std::string text =
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1012\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  for (const auto& [name, curve] : set.curves) {
    const bool rational = !(curve.weights.array() == curve.weights[0]).all(), flat = curve.points.rows() == 2;
    text += fmt::format("0\nSPLINE\n8\n{}\n100\nAcDbEntity\n100\nAcDbSpline\n70\n{}\n71\n{}\n72\n{}\n73\n{}\n74\n0\n",
                        layer_of(name), (rational ? 4 : 0) + (flat ? 8 : 0), curve.degree, curve.knots.size(),
                        curve.points.cols());
    for (const double knot : curve.knots) text += fmt::format("40\n{}\n", knot);
    for (Eigen::Index i = 0; rational && i < curve.weights.size(); ++i)
      text += fmt::format("41\n{}\n", curve.weights[i]);
    for (Eigen::Index i = 0; i < curve.points.cols(); ++i)
      text += fmt::format("10\n{}\n20\n{}\n30\n{}\n", 1e3 * curve.points(0, i), 1e3 * curve.points(1, i),
                          flat ? 0.0 : 1e3 * curve.points(2, i));
  }
  return text + "0\nENDSEC\n0\nEOF\n";
}

}  // namespace snug::mesh
