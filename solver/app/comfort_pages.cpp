#include "solver/app/comfort_pages.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/input/suggestion.hpp"
#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/pressure_table.hpp"
#include "postproc/documents.hpp"
#include "postproc/units.hpp"

namespace snug::app {

namespace {

using postproc::pascal_per_gf_cm2, postproc::to_gf_cm2, postproc::to_mmHg;

/// "-" for what is not known.
std::string known(const std::string& format, double value) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

struct Numbers {
  const postproc::SensationCurve& curve;

  std::string operator()(const postproc::Line& line) const {
    return fmt::format("{:.5f} (+- {}) per gf/cm2, at none {:.4f} (+- {})", line.slope * pascal_per_gf_cm2,
                       known("{:.5f}", curve.slope_error * pascal_per_gf_cm2), line.intercept,
                       known("{:.4f}", curve.intercept_error));
  }
  std::string operator()(const postproc::Polyline& line) const {
    std::string text;
    for (std::size_t i = 0; i < line.pressures.size(); ++i)
      text += fmt::format("{}{:.3f} at {:.3f} gf/cm2", i ? ", " : "", line.ratings[i], to_gf_cm2(line.pressures[i]));
    return text;
  }
  std::string operator()(const postproc::Logistic& curve) const {
    return fmt::format("{:.3f} to {:.3f}, middle {:.3f} gf/cm2, width {:.3f} gf/cm2", curve.lowest, curve.highest,
                       to_gf_cm2(curve.middle), to_gf_cm2(curve.width));
  }
};

std::string band_text(const postproc::PressureBand& band) {
  const std::string where = band.location.empty() ? "anywhere" : band.location;
  const std::string name = band.name + ":";
  if (std::isinf(band.high))
    return fmt::format("  {:<16} {:<44} from {:.4g} gf/cm2, {:.4g} mmHg\n", where, name, to_gf_cm2(band.low),
                       to_mmHg(band.low));
  return fmt::format("  {:<16} {:<44} {:.4g} to {:.4g} gf/cm2, {:.4g} to {:.4g} mmHg\n", where, name,
                     to_gf_cm2(band.low), to_gf_cm2(band.high), to_mmHg(band.low), to_mmHg(band.high));
}

std::string content_of(const postproc::SensationCurves& set) {
  std::vector<std::string> names;
  for (const auto& curve : set.curves) names.push_back(curve.location);
  if (!names.empty()) return fmt::format("curves: {}", input::joined(names));
  for (const auto& band : set.bands) {
    const std::string name = band.location.empty() ? band.name : band.location + ": " + band.name;
    names.push_back(name);
  }
  return fmt::format("thresholds: {}", input::joined(names));
}

std::string page(const postproc::SensationCurves& set) {
  std::string text = fmt::format("\"{}\"\n  source      {}\n  patch       {}\n  population  {}\n", set.name, set.source,
                                 set.patch, set.population);
  for (const std::string& note : set.notes) text += fmt::format("  note        {}\n", note);
  if (!set.curves.empty()) text += statistics_text(set);
  for (const postproc::PressureBand& band : set.bands) text += band_text(band);
  return text;
}

}  // namespace

std::string curves_text() {
  std::string text;
  for (const postproc::SensationCurves& set : postproc::shipped_curves())
    text += fmt::format("  {:<28} {}\n", '"' + set.name + '"', content_of(set));
  text += "fuzzy systems\n";
  for (const std::string& name : postproc::fuzzy_names()) text += fmt::format("  \"{}\"\n", name);
  return text;
}

postproc::Json curves_json() {
  postproc::Json sets = postproc::Json::array();
  for (const postproc::SensationCurves& set : postproc::shipped_curves()) {
    postproc::Json curves = postproc::Json::array(), ranges = postproc::Json::array();
    for (const auto& curve : set.curves) curves.push_back({{"location", curve.location}, {"from_Pa", curve.low}, {"to_Pa", curve.high}});
    for (const auto& band : set.bands) ranges.push_back({{"location", band.location}, {"name", band.name}, {"from_Pa", band.low}, {"to_Pa", std::isinf(band.high) ? postproc::Json() : postproc::Json(band.high)}});
    sets.push_back({{"name", set.name}, {"source", set.source}, {"patch", set.patch}, {"population", set.population}, {"curves", curves}, {"thresholds", ranges}});
  }
  return {{"sets", sets}, {"fuzzy_systems", postproc::fuzzy_names()}};
}

std::string curves_page(const std::string& name) {
  for (const postproc::SensationCurves& set : postproc::shipped_curves())
    if (postproc::same_name(set.name, name)) return page(set);
  return {};
}

std::string statistics_text(const postproc::SensationCurves& curves) {
  std::string text = fmt::format("  {:<16} {:>3} {:>15} {:>8} {:>9} {:>9} {:>9}  {}\n", "location", "n",
                                 "range [gf/cm2]", "R2", "std error", "largest", "p", "rating");
  for (const postproc::SensationCurve& curve : curves.curves) {
    text += fmt::format("  {:<16} {:>3} {:>15} {:>8} {:>9} {:>9} {:>9}  {}: {}\n", curve.location, curve.points,
                        fmt::format("{:.2f} - {:.2f}", to_gf_cm2(curve.low), to_gf_cm2(curve.high)),
                        known("{:.4f}", curve.r_squared), known("{:.4f}", curve.scatter),
                        known("{:.4f}", curve.largest_residual), known("{:.2g}", curve.p_value),
                        postproc::shape_name(curve.shape), std::visit(Numbers{curve}, curve.shape));
    if (!curve.significant)
      text += fmt::format("  {:<16}     not significant: the mean rating {:.3f} (+- {}) is used instead\n", "",
                          curve.mean_rating, known("{:.3f}", curve.mean_scatter));
  }
  return text;
}

std::string memberships_text(const postproc::MembershipFit& fit) {
  if (fit.variables.empty())
    return "  memberships: the table has no column sensation_term, the shipped ones are kept\n";
  std::string text =
      fmt::format("  {:<16} {:<24} {:>8} {:>18} {:>18}\n", "location", "word", "answers", "half width", "slope");
  for (const postproc::FittedVariable& variable : fit.variables) {
    for (const postproc::FittedTerm& term : variable.terms) {
      const auto change = [&](double before, double after) {
        return term.fitted ? fmt::format("{:.4g} -> {:.4g}", before, after) : fmt::format("{:.4g} kept", before);
      };
      text += fmt::format("  {:<16} {:<24} {:>8} {:>18} {:>18}\n", variable.location, term.name, term.answers,
                          change(term.width_before, term.width), change(term.slope_before, term.slope));
    }
    text += fmt::format("  {:<16} shares are met within {:.3f} (root mean square)\n", variable.location,
                        variable.deviation);
  }
  return text;
}

}  // namespace snug::app
