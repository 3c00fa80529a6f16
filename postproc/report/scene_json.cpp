// Geometry for the three-dimensional view of the page.
#include <cstdint>
#include <cstring>

#include "postproc/report/base64.hpp"
#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

/// 32-bit values as they lie in memory: little-endian on every machine that snug is built for.
template <class Value>
std::string packed(const std::vector<Value>& values) {
  static_assert(sizeof(Value) == 4);
  std::vector<std::uint8_t> bytes(4 * values.size());
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return base64(bytes);
}

std::string reals(const std::vector<double>& values) {
  return packed(std::vector<float>(values.begin(), values.end()));
}
std::string integers(const std::vector<int>& values) {
  return packed(std::vector<std::int32_t>(values.begin(), values.end()));
}

std::string vectors(const std::vector<Eigen::Vector3d>& values) {
  std::vector<float> flat;
  for (const Eigen::Vector3d& v : values)
    for (int c = 0; c < 3; ++c) flat.push_back(static_cast<float>(v[c]));
  return packed(flat);
}

std::string corners(const std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> flat;
  for (const Triangle& triangle : triangles) flat.insert(flat.end(), triangle.begin(), triangle.end());
  return packed(flat);
}

}  // namespace

std::string scene_json(const ShownRun& run, const PressureScale& scale) {
  Json json = {{"colours", colour_stops()}, {"top", scale.top}, {"unit", scale.unit}, {"factor", scale.factor}};
  json["shape_only"] = !knows_pressure(run);
  if (run.skin)
    json["skin"] = {{"numbers", integers(run.skin->numbers)},          {"nodes", vectors(run.skin->nodes)},
                    {"displacement", vectors(run.skin->displacement)}, {"pressure", reals(run.skin->pressure)},
                    {"location", integers(run.skin->location)},        {"locations", run.skin->locations},
                    {"triangles", corners(run.skin->triangles)}};
  if (run.garment)
    json["garment"] = {{"nodes", vectors(run.garment->nodes)},
                       {"triangles", corners(run.garment->triangles)},
                       {"warp", reals(run.garment->tension_warp)},
                       {"weft", reals(run.garment->tension_weft)},
                       {"wrinkled", reals(run.garment->wrinkled)}};
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  // Inside <script> a browser looks for </script and <!--, which changes what ends it; JSON may write < as its number.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace snug::postproc::report
