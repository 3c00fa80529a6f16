// Pressures over the values of a sweep, as lines of a drawing.
#include <algorithm>
#include <cmath>

#include "postproc/report/compare_rows.hpp"
#include "postproc/report/line_plot.hpp"
#include "postproc/report/template.hpp"
#include "postproc/report/view.hpp"
#include "postproc/units.hpp"

namespace snug::postproc::report {

namespace {

std::vector<PlotLine> series_of(const Runs& runs) {
  std::vector<PlotLine> all;
  const auto add = [&](const std::string& name, auto value) {
    PlotLine one{name, {}};
    for (const ShownRun& run : runs) one.mmHg.push_back(run.summary.value("status", "") == "converged" ? to_mmHg(value(run)) : std::nan(""));
    if (std::any_of(one.mmHg.begin(), one.mmHg.end(), [](double v) { return std::isfinite(v); })) all.push_back(std::move(one));
  };
  for (const std::string& name : compared_location_names(runs)) add(name, [&](const ShownRun& run) { return location_pressure(run, name); });
  add("whole cover", [](const ShownRun& run) { return value_at(run.summary.value("numbers", Json::object()), "mean_contact_pressure_Pa"); });
  return all;
}

}  // namespace

Json sweep_view(const Runs& runs, const std::vector<double>& values, const std::string& axis) {
  return line_plot(values.size() == runs.size() ? series_of(runs) : std::vector<PlotLine>{}, values, axis);
}

}  // namespace snug::postproc::report
