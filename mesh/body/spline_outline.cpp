#include "mesh/body/spline_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/curves/interpolation.hpp"
#include "mesh/curves/root.hpp"
#include "mesh/formats/ring_net.hpp"

namespace snug::mesh {

namespace {

using curves::Net;

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Turns of the columns, each the mean over the rows of the angle from the row's middle, from column to column less than half a turn.
std::vector<double> turns_of(const Net& net, const std::string& text, const input::Location& where) {
  std::vector<double> turns(net.columns, 0.0);
  for (int i = 0; i < net.rows; ++i) {
    const Eigen::Vector3d centre = middle_of_row(net, i);
    double before = 0.0, first = 0.0;
    for (int j = 0; j <= net.columns; ++j) {
      const Eigen::Vector3d from = net.points.col(i * net.columns + j % net.columns) - centre;
      const double angle = std::atan2(from.y(), from.x()) / full_turn;
      // The first one of a row near that of the first row, every other near the one before it.
      const double near = j > 0 ? before : i > 0 ? turns[0] / i : angle;
      const double turn = angle + std::round(near - angle);
      if (j > 0 && !(turn > before))
        throw input::InputError(where, fmt::format("the points of {} do not go round one after the other in the section at {:.0f} mm (point {} of {})", text, 1e3 * centre.z(), j + 1, net.columns),
                                "list them in the order in which they lie round the limb, each once; a section that its own middle does not see whole is none of a limb");
      if (j == 0) first = turn;
      if (j == net.columns && std::abs(turn - first - 1.0) > 1e-9)
        throw input::InputError(where, fmt::format("the section of {} at {:.0f} mm goes {:.0f} times round its middle", text, 1e3 * centre.z(), turn - first), "list its points once round");
      if (j < net.columns) turns[j] += turn;
      before = turn;
    }
  }
  for (double& turn : turns) turn /= net.rows;
  return turns;
}

std::vector<double> distinct(const std::vector<double>& knots) {
  std::vector<double> inner(knots.begin() + 3, knots.end() - 3);
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  return inner;
}

std::size_t span(const std::vector<double>& ends, double at) {
  const auto after = std::upper_bound(ends.begin() + 1, ends.end() - 1, at);
  return static_cast<std::size_t>(after - ends.begin()) - 1;
}

}  // namespace

SplineOutline::SplineOutline(const Net& sections, const std::string& text, const input::Location& where) {
  const std::vector<double> turns = turns_of(sections, text, where);
  std::vector<double> heights;
  for (int i = 0; i < sections.rows; ++i) heights.push_back(middle_of_row(sections, i).z());
  const double beyond = 4.0 * (heights.back() - heights.front());  // no garment goes further
  const curves::BSplineSurface surface = curves::surface_through(sections, heights, turns, 1.0, beyond);
  rows_ = distinct(surface.knots[0]);
  columns_ = distinct(surface.knots[1]);
  patches_ = surface.patches();
  check_rise(sections, text, where);
}

void SplineOutline::check_rise(const Net& sections, const std::string& text, const input::Location& where) const {
  constexpr int rows = 200, turns = 90;
  const double low = middle_of_row(sections, 0).z(), high = middle_of_row(sections, sections.rows - 1).z();
  for (int j = 0; j < turns; ++j)
    for (int i = 0; i <= rows; ++i) {
      const double u = low + (high - low) * i / rows, v = round(static_cast<double>(j) / turns);
      if (patch(u, v).derivatives(u, v).x_u.z() > 0.0) continue;
      throw input::InputError(where, fmt::format("{} does not go up everywhere: at {:.0f} mm the surface through its points turns down", text, 1e3 * patch(u, v).point(u, v).z()),
                              "let the sections lie level, or nearly so: each cuts the limb's axis (z)");
    }
}

double SplineOutline::round(double turn) const { return turn - std::floor(turn - columns_.front()); }

const curves::WSurface& SplineOutline::patch(double u, double v) const { return patches_[span(rows_, u) * (columns_.size() - 1) + span(columns_, v)]; }

double SplineOutline::height_parameter(double turn, double z) const {
  // Of level sections u is the height itself, since a spline keeps straight lines; else by Newton's method, in the bracket that is known.
  double low = rows_.front(), high = rows_.back(), u = std::clamp(z, low, high);
  for (int i = 0; i < 60; ++i) {
    const curves::SurfacePoint s = patch(u, turn).derivatives(u, turn);
    const double off = s.x.z() - z;
    if (std::abs(off) <= 4e-16 * (std::abs(z) + std::abs(rows_.back() - rows_.front()))) break;
    (off > 0.0 ? high : low) = u;
    const double next = u - off / s.x_u.z();
    u = next > low && next < high ? next : 0.5 * (low + high);
    if (high - low <= 1e-16) break;
  }
  return u;
}

Eigen::Vector3d SplineOutline::at(double turn, double z) const {
  const double v = round(turn), u = height_parameter(v, z);
  Eigen::Vector3d x = patch(u, v).point(u, v);
  x.z() = z;  // to the last bit: borders of locations lie at heights of nodes
  return x;
}

OutlinePoint SplineOutline::derivatives(double turn, double z) const {
  const double v = round(turn), u = height_parameter(v, z);
  const curves::SurfacePoint s = patch(u, v).derivatives(u, v);
  // u(turn, z) from z(u, turn) = z: the implicit function and its derivatives.
  const double u_z = 1.0 / s.x_u.z(), u_t = -s.x_v.z() * u_z;
  const double u_zz = -s.x_uu.z() * u_z * u_z * u_z;
  const double u_tz = -(s.x_uv.z() * u_z + s.x_uu.z() * u_t * u_z) * u_z;
  const double u_tt = -(s.x_vv.z() + 2.0 * s.x_uv.z() * u_t + s.x_uu.z() * u_t * u_t) * u_z;
  return {.x = {s.x.x(), s.x.y(), z},
          .x_t = s.x_v + s.x_u * u_t,
          .x_z = s.x_u * u_z,
          .x_tt = s.x_vv + 2.0 * s.x_uv * u_t + s.x_uu * u_t * u_t + s.x_u * u_tt,
          .x_tz = s.x_uv * u_z + s.x_uu * u_t * u_z + s.x_u * u_tz,
          .x_zz = s.x_uu * u_z * u_z + s.x_u * u_zz};
}

double SplineOutline::turn_at_angle(double angle, double z) const {
  const Eigen::Vector2d centre = section_centre(*this, z);
  const double wanted = angle / full_turn;
  const auto off = [&](double turn) {  // in turns
    const Eigen::Vector2d from = at(turn, z).head<2>() - centre;
    const double found = std::atan2(from.y(), from.x()) / full_turn;
    return found - wanted - std::round(found - wanted);
  };
  // Angles rise with the turn; half a turn to either side holds the place.
  const double here = off(wanted);
  curves::Sample low{wanted, here}, high = low;
  for (double step = 0.02; low.value > 0.0 && step < 0.5; step *= 2.0) low = {wanted - step, off(wanted - step)};
  for (double step = 0.02; high.value < 0.0 && step < 0.5; step *= 2.0) high = {wanted + step, off(wanted + step)};
  constexpr double small = 1e-15;
  return std::abs(here) <= small ? wanted : curves::bracketed_root(off, low, high, small, 0.0);
}

}  // namespace snug::mesh
