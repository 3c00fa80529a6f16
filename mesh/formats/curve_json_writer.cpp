#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "mesh/formats/curve_set.hpp"

namespace snug::mesh {

namespace {

using curves::BForm;
using curves::BSplineCurve;
using curves::BSplineSurface;
using curves::Net;

/// The shortest text that is read back the same; "-0" alone would be read as the whole number 0.
std::string number(double value) { return value == 0.0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value); }

template <class Values>
std::string list(const Values& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
  return "[" + text + "]";
}

std::string points_text(const Eigen::MatrixXd& points, Eigen::Index from, Eigen::Index count) {
  std::string text;
  for (Eigen::Index i = from; i < from + count; ++i)
    text += (text.empty() ? "" : ", ") + list(Eigen::VectorXd(points.col(i)));
  return "[" + text + "]";
}

std::string rows_text(int rows, const auto& row) {
  std::string text;
  for (int i = 0; i < rows; ++i) text += (text.empty() ? "\n      " : ",\n      ") + row(i);
  return "[" + text + "]";
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool all_one(const Eigen::VectorXd& weights) { return (weights.array() == 1.0).all(); }

std::string text_of(const BSplineCurve& c) {
  std::string text = fmt::format("\"degree\": {}, \"knots\": {},\n     \"points\": {}", c.degree, list(c.knots),
                                 points_text(c.points, 0, c.points.cols()));
  if (!all_one(c.weights)) text += ",\n     \"weights\": " + list(c.weights);
  return text;
}

std::string text_of(const BSplineSurface& s) {
  const int m = s.columns();
  std::string text = fmt::format("\"degrees\": [{}, {}], \"knots\": [{}, {}],\n     \"points\": {}", s.degrees[0],
                                 s.degrees[1], list(s.knots[0]), list(s.knots[1]), rows_text(s.rows(), [&](int i) {
                                   return points_text(s.points, static_cast<Eigen::Index>(i) * m, m);
                                 }));
  if (!all_one(s.weights))
    text += ",\n     \"weights\": " + rows_text(s.rows(), [&](int i) {
              return list(Eigen::VectorXd(s.weights.segment(static_cast<Eigen::Index>(i) * m, m)));
            });
  return text;
}

std::string text_of(const Net& n) {
  return fmt::format("\"closed\": [{}, {}],\n     \"points\": {}", n.rows_closed, n.columns_closed,
                     rows_text(n.rows, [&](int i) {
                       return points_text(n.points, static_cast<Eigen::Index>(i) * n.columns, n.columns);
                     }));
}

std::string text_of(const BForm& f) {
  return fmt::format("\"corners\": {}, \"degree\": {},\n     \"points\": {}", f.corners(), f.degree(),
                     points_text(f.coefficients(), 0, f.coefficients().cols()));
}

template <class Kind>
std::string section(const char* key, const std::vector<Named<Kind>>& shapes) {
  if (shapes.empty()) return {};
  std::string text;
  for (const Named<Kind>& one : shapes)
    text += fmt::format("{}\n    {{\"name\": {}, {}}}", text.empty() ? "" : ",", quoted(one.name), text_of(one.shape));
  return fmt::format(",\n  \"{}\": [{}\n  ]", key, text);
}

}  // namespace

std::string curve_json(const CurveSet& set) {
  return "{\n  \"format\": \"snug curves\",\n  \"unit\": \"1 m\"" + section("curves", set.curves) +
         section("surfaces", set.surfaces) + section("nets", set.nets) + section("forms", set.forms) + "\n}\n";
}

}  // namespace snug::mesh
