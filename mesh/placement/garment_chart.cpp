#include "mesh/placement/garment_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh {

namespace {

using input::InputError;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double below_crotch = 0.010, above_shoulder = 0.010, above_ankle = 0.010;  // m
constexpr double beside_panel = 0.010;   // m, that the section is wider than the cloth above the armpit
constexpr double into_yoke = 0.080;      // m, over which rows by arc length become rows by distance from the middle
constexpr double width_spacing = 0.005;  // m

}  // namespace

GarmentChart::GarmentChart(const CheckedPattern& checked, const BodySections& sections, const Landmarks& marks,
                           const BodySurface& body, double raise, std::optional<double> lowest)
    : rings_(find_rings(checked)) {
  check_body(marks, body);
  if (rings_.kind == GarmentKind::legs) {
    set_leg_heights(marks, raise, lowest);
    check_legs(marks, body);
  }
  if (rings_.kind == GarmentKind::tube) lift_ = marks.waist - rings_.top;
  if (rings_.kind == GarmentKind::shoulders) lift_ = strap_lift(body, marks);
  lift_ = lowest ? *lowest - rings_.hem : lift_ + raise;
  if (rings_.kind == GarmentKind::shoulders) find_half_widths(checked.pattern);
  rows_ = std::make_unique<SectionRows>(sections, marks, rings_.kind, fork_, [&](double z) {
    return std::max(marks.armpit_half_width, half_width(z) + beside_panel);
  });
}

double GarmentChart::width(int piece, double pattern_height) const {
  const RingPiece& one = rings_.pieces[piece];
  return std::max(one.right.at(pattern_height - one.shift) - one.left.at(pattern_height - one.shift), 0.0);
}

/// Where a point lies among the widths of its track at a height of the pattern.
GarmentChart::OnTrack GarmentChart::on_track(int piece, const Vector2d& p, double pattern_height) const {
  const RingPiece& one = rings_.pieces[piece];
  const double left = one.left.at(pattern_height - one.shift), wide = width(piece, pattern_height);
  const double share = wide > 0.0 ? std::clamp((p.x() - left) / wide, 0.0, 1.0) : 0.5;
  for (const Side side : {Side::right, Side::left}) {
    OnTrack at{side};
    bool here = false;
    for (const TrackPiece& part : rings_.tracks[static_cast<int>(side)]) {
      const double whole = width(part.piece, pattern_height);
      if (part.piece == piece && share >= part.from && share <= part.to) {
        at.along = at.whole + (share - part.from) * whole;
        here = true;
      }
      at.whole += (part.to - part.from) * whole;
    }
    if (here) return at;
  }
  return {Side::right, 0.0, 0.0};
}

/// m, of cloth between a point and the middle of the front, or of the back.
double GarmentChart::from_middle(const RingPiece& piece, const OnTrack& at) const {
  return piece.front == (at.side == Side::left) ? at.along : at.whole - at.along;
}

void GarmentChart::set_leg_heights(const Landmarks& marks, double raise, std::optional<double> lowest) {
  const double lowest_hem = marks.ankle + above_ankle;
  const double laid = marks.crotch - below_crotch + raise;  // of the fork, if it could be anywhere
  fork_ = std::min(laid, marks.crotch - below_crotch);
  const double hem = lowest ? *lowest : std::max(laid + rings_.hem - rings_.fork, std::min(lowest_hem, fork_)),
               top = laid + rings_.top - rings_.fork;
  if (rings_.fork > rings_.hem) below_ = (fork_ - hem) / (rings_.fork - rings_.hem);
  if (rings_.top > rings_.fork) above_ = (top - fork_) / (rings_.top - rings_.fork);
}

void GarmentChart::check_body(const Landmarks& marks, const BodySurface& body) const {
  if (rings_.kind == GarmentKind::legs && !marks.legs)
    throw InputError(body.where, "the garment has two legs and the body has not", "give a body with the upper part of both thighs, or wear one leg (pattern.pieces) on one");
  if (rings_.kind == GarmentKind::shoulders && !marks.arms)
    throw InputError(body.where, "the garment hangs on shoulders and the body has none: its arms, or stumps of them, are nowhere apart from its trunk",
                     "give a body that reaches above the armpits, or wear what is below them (pattern.to_height)");
}

/// Within bounds a leg is laid shorter or longer than it is; cloth that is too long gathers in folds when it is let go.
void GarmentChart::check_legs(const Landmarks& marks, const BodySurface& body) const {
  constexpr double shortest = 0.65, longest = 1.3;
  if (below_ >= shortest && below_ <= longest) return;
  const double leg = rings_.fork - rings_.hem;
  throw InputError(body.where,
                   fmt::format("the legs of the garment are {:.0f} mm long from fork to hem and would be laid on {:.0f} mm: the crotch is at {:.0f} mm, {} at {:.0f} mm over the "
                               "lowest point of the body",
                               1e3 * leg, 1e3 * below_ * leg, 1e3 * marks.crotch, body.is_cut() ? "the legs begin" : "the ankles", 1e3 * marks.ankle),
                   below_ < shortest ? "wear a part of the legs (pattern.from_height), shorten them (pattern.length_scale), or lower the hem (position)"
                                     : "lengthen them (pattern.length_scale), or raise the hem (position)");
}

double GarmentChart::height(double pattern_height) const {
  if (rings_.kind != GarmentKind::legs) return pattern_height + lift_;
  return fork_ + (pattern_height < rings_.fork ? below_ : above_) * (pattern_height - rings_.fork);
}

/// By which the seams on top of the shoulders lie a little above the body.
double GarmentChart::strap_lift(const BodySurface& body, const Landmarks& marks) const {
  double sum = 0.0;
  for (const Strap& strap : rings_.straps) {
    const RingPiece& piece = rings_.pieces[strap.piece];
    const double out = from_middle(piece, on_track(strap.piece, strap.middle, rings_.yoke));
    const double top = std::max(shoulder_top(body, marks, out), shoulder_top(body, marks, -out));
    sum += top + above_shoulder - (strap.middle.y() + piece.shift);
  }
  return sum / static_cast<double>(rings_.straps.size());
}

/// How far the cloth reaches from the middle at each height, by its borders.
void GarmentChart::find_half_widths(const Pattern& pattern) {
  half_widths_.assign(static_cast<std::size_t>((rings_.top - rings_.hem) / width_spacing) + 2, 0.0);
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p)
    for (const PieceEdge& edge : pattern.pieces[p].edges) {
      const ArcLength along(edge.curve);
      const int steps = static_cast<int>(along.length() / width_spacing) + 1;
      for (int n = 0; n <= steps; ++n) {
        const Vector2d q = along.at(static_cast<double>(n) / steps);
        const double at = q.y() + rings_.pieces[p].shift;
        const double out = from_middle(rings_.pieces[p], on_track(static_cast<int>(p), q, std::min(at, rings_.yoke)));
        const auto row = static_cast<std::size_t>(std::max(0.0, (at - rings_.hem) / width_spacing));
        for (const std::size_t near : {row, row + 1})
          if (near < half_widths_.size()) half_widths_[near] = std::max(half_widths_[near], out);
      }
    }
}

double GarmentChart::half_width(double z) const {
  const double row = (z - lift_ - rings_.hem) / width_spacing;
  if (!(row >= 0.0) || half_widths_.empty()) return 0.0;
  const auto n = static_cast<std::size_t>(row);
  return n < half_widths_.size() ? half_widths_[n] : 0.0;
}

int GarmentChart::leg_side(int piece, const Vector2d& p) const {
  const double pattern_height = p.y() + rings_.pieces[piece].shift;
  if (rings_.kind != GarmentKind::legs || pattern_height >= rings_.fork) return 0;
  return on_track(piece, p, pattern_height).side == Side::right ? 1 : -1;
}

Vector3d GarmentChart::place(int piece, const Vector2d& p) const {
  const double pattern_height = p.y() + rings_.pieces[piece].shift;
  const bool yoke = rings_.kind == GarmentKind::shoulders && pattern_height > rings_.yoke;
  const OnTrack at = on_track(piece, p, yoke ? rings_.yoke : pattern_height);
  const double z = height(pattern_height), share = at.whole > 0.0 ? at.along / at.whole : 0.0;
  const Vector3d round = rows_->at(at.side, z, share);
  if (!yoke) return round;
  const RingPiece& one = rings_.pieces[piece];
  const double out = from_middle(one, at), into = std::min(1.0, (pattern_height - rings_.yoke) / into_yoke);
  Vector3d beside = rows_->beside(at.side, one.front, z, out);
  beside.x() = sign_of(at.side) * out;
  return (1.0 - into) * round + into * beside;
}

}  // namespace snug::mesh
