// Lines over a common axis as a drawing: pressures over a sweep or a movement.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "postproc/documents.hpp"

namespace snug::postproc::report {

struct PlotLine {
  std::string name;
  std::vector<double> mmHg;  ///< one a place on the axis; NaN: not known
};
struct PlotMark {
  double at;
  std::string text;
};

/// What lines.mustache is filled with; null where there are no two places or nothing above zero. `marks`: of the axis; empty: round numbers. `told`: what stands at each place.
Json line_plot(const std::vector<PlotLine>& lines, const std::vector<double>& values, const std::string& axis, std::vector<PlotMark> marks = {}, const std::vector<std::string>& told = {});

}  // namespace snug::postproc::report
