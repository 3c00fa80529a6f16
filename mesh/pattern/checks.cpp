#include "mesh/pattern/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "solver/fem/union_find.hpp"
#include "mesh/pattern/outline_checks.hpp"

namespace snug::mesh {

namespace {

using input::Diagnostic;
using input::Diagnostics;

void check_notches(const Piece& piece, Diagnostics& diagnostics) {
  for (const Notch& notch : piece.notches)
    if (!(notch.share >= 0.0 && notch.share <= 1.0))
      diagnostics.error(notch.where,
                        fmt::format("the notch {} of {} stands off the edge {}, at {:.4g} of its length", notch.name,
                                    piece.name, piece.edges[notch.edge].name, notch.share),
                        "write a share of the edge's length from 0 to 1");
}

void check_fabrics(const Pattern& pattern, Diagnostics& diagnostics) {
  const auto has = [](const Piece& piece) { return piece.fabric.has_value(); };
  if (pattern.fabric || std::none_of(pattern.pieces.begin(), pattern.pieces.end(), has)) return;
  for (const Piece& piece : pattern.pieces)
    if (!has(piece))
      diagnostics.error(piece.where,
                        fmt::format("the piece {} has no fabric, others have one of their own", piece.name),
                        "give it a fabric, or the whole pattern one that holds where a piece says nothing");
}

std::string millimetres(double length) { return fmt::format("{:.1f} mm", 1e3 * length); }

void check_ease(const Pattern& pattern, const Seam& seam, Diagnostics& diagnostics) {
  const double a = length(pattern, seam.a), b = length(pattern, seam.b), found = ease(a, b);
  const std::string sides = fmt::format("{} ({}) and {} ({})", name_of(pattern, seam.a), millimetres(a),
                                        name_of(pattern, seam.b), millimetres(b));
  if (!seam.ease && found > largest_ease)
    diagnostics.error(
        seam.where, fmt::format("the seam {} has an ease of {:.1f} %: {}", seam.name, 100.0 * found, sides),
        fmt::format(
            "let its sides differ by at most {:.0f} %, or write the ease where it is meant (gathers): ease = {:.2f}",
            100.0 * largest_ease, found));
  if (seam.ease && std::abs(found - *seam.ease) > 0.01)
    diagnostics.error(seam.where,
                      fmt::format("the seam {} means an ease of {:.1f} % and has {:.1f} %: {}", seam.name,
                                  100.0 * *seam.ease, 100.0 * found, sides),
                      "correct the sides or the ease");
}

void check_hems(const Pattern& pattern, const Sewing& sewing, Diagnostics& diagnostics) {
  for (const Hem& hem : pattern.hems)
    for (const EdgePart& part : hem.edges)
      for (const Stretch& stretch : sewing.stretches) {
        const bool of_it = stretch.part.piece == part.piece && stretch.part.edge == part.edge;
        const double shared = std::min(stretch.part.to, part.to) - std::max(stretch.part.from, part.from);
        if (!of_it || stretch.seam < 0 || shared < 1e-6) continue;
        diagnostics.error(hem.where,
                          fmt::format("the hem {} names {}, which the seam {} sews", hem.name, name_of(pattern, part),
                                      pattern.seams[stretch.seam].name),
                          "a hem is of edges that stay open");
        break;
      }
}

/// Stretches of a seam between two places that meet: ease may gather in one of them though the whole fits.
void warn_of_stretches(const Pattern& pattern, const Sewing& sewing, std::vector<Diagnostic>& warnings) {
  std::set<int> said;
  for (const Stretch& one : sewing.stretches) {
    if (one.partner < 0) continue;
    const Stretch& other = sewing.stretches[one.partner];
    const Seam& seam = pattern.seams[one.seam];
    const double allowed = std::max(largest_ease, seam.ease.value_or(0.0) + 0.05);
    if (ease(one.length, other.length) <= allowed || std::max(one.length, other.length) < 0.02 ||
        !said.insert(one.seam).second)
      continue;
    warnings.push_back(
        {seam.where,
         fmt::format("in the seam {} the stretch {} ({}) meets {} ({})", seam.name, name_of(pattern, one.part),
                     millimetres(one.length), name_of(pattern, other.part), millimetres(other.length)),
         "see its notches, the order of its edges, and whether a piece is inside out"});
  }
}

/// A side over several pieces goes on where another seam joins them.
void warn_of_chain(const Pattern& pattern, const Sewing& sewing, std::size_t seam, std::vector<Diagnostic>& warnings) {
  fem::UnionFind others(sewing.stretches.size());
  for (const Stretch& s : sewing.stretches)
    if (s.partner >= 0 && s.seam != static_cast<int>(seam)) {
      others.merge(s.begin, sewing.stretches[s.partner].end);
      others.merge(s.end, sewing.stretches[s.partner].begin);
    }
  const auto corner = [&](const EdgePart& part, bool end) {
    for (const Stretch& s : sewing.stretches)
      if (s.part.piece == part.piece && s.part.edge == part.edge &&
          std::abs(end ? s.part.to - part.to : s.part.from - part.from) < 1e-6)
        return others.find(end ? s.end : s.begin);
    return -1;
  };
  for (const EdgeChain* side : {&pattern.seams[seam].a, &pattern.seams[seam].b})
    for (std::size_t n = 1; n < side->size(); ++n) {
      const EdgePart &one = (*side)[n - 1], &next = (*side)[n];
      if (corner(one, true) == corner(next, false)) continue;
      const auto follows = std::find_if(
          side->begin(), side->end(), [&](const EdgePart& other) { return corner(other, false) == corner(one, true); });
      warnings.push_back(
          {pattern.seams[seam].where,
           fmt::format("in the seam {} the edge {} does not end where {} begins, and no other seam joins them{}",
                       pattern.seams[seam].name, name_of(pattern, one), name_of(pattern, next),
                       follows != side->end() ? "; " + name_of(pattern, *follows) + " begins there" : ""),
           "write the edges of a side in their order, each in the direction of its outline"});
    }
}

/// Garments are spheres with open edges. Handles, (2 - open edges - Euler's number) / 2 of them, come from seams that
/// run the wrong way or stand in the wrong order, as like as not.
void warn_of_handles(const Pattern& pattern, const Sewing& sewing, std::vector<Diagnostic>& warnings) {
  fem::UnionFind parts(pattern.pieces.size());
  for (const Stretch& s : sewing.stretches)
    if (s.partner >= 0) parts.merge(s.part.piece, sewing.stretches[s.partner].part.piece);
  std::map<int, int> euler, open;
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p)
    euler[parts.find(static_cast<int>(p))] += 2 - static_cast<int>(pattern.pieces[p].loops.size());
  std::set<int> corners;
  for (std::size_t s = 0; s < sewing.stretches.size(); ++s) {
    const int part = parts.find(sewing.stretches[s].part.piece);
    if (corners.insert(sewing.corners[sewing.stretches[s].begin]).second) ++euler[part];
    if (sewing.stretches[s].partner < static_cast<int>(s)) --euler[part];
  }
  for (const OpenLoop& loop : sewing.open) ++open[parts.find(sewing.stretches[loop.stretches.front()].part.piece)];
  for (const auto& [part, number] : euler) {
    const int handles = (2 - open[part] - number) / 2;
    if (handles < 1) continue;
    const Piece& piece = pattern.pieces[part];
    warnings.push_back(
        {piece.where,
         fmt::format("sewn together, {} and what hangs on it has {} handle{}, which garments have where straps cross",
                     piece.name, handles, handles > 1 ? "s" : ""),
         "see whether a seam runs the wrong way or names its edges in the wrong order"});
  }
}

/// The cloth round one corner of the sewn garment: its angle, and the stretch that begins there.
struct Fan {
  int stretch = 0;
  double angle = 0.0;
  bool open = false;
};

std::vector<Fan> fans(const Pattern& pattern, const Sewing& sewing) {
  std::vector<Fan> result;
  std::vector<bool> seen(sewing.stretches.size(), false);
  for (const OpenLoop& loop : sewing.open)
    for (std::size_t n = 0; n < loop.stretches.size(); ++n) {
      result.push_back({loop.stretches[n], loop.angles[n], true});
      const int before = loop.stretches[(n + loop.stretches.size() - 1) % loop.stretches.size()];
      for (int s = sewing.stretches[before].next; sewing.stretches[s].partner >= 0;
           s = sewing.stretches[sewing.stretches[s].partner].next)
        seen[s] = true;
    }
  for (std::size_t first = 0; first < sewing.stretches.size(); ++first) {
    if (sewing.stretches[first].partner < 0 || seen[first]) continue;
    Fan fan{static_cast<int>(first), 0.0, false};
    for (int s = fan.stretch; !seen[s]; s = sewing.stretches[sewing.stretches[s].partner].next) {
      seen[s] = true;
      fan.angle += cloth_angle(pattern, sewing.stretches[s]);
    }
    result.push_back(fan);
  }
  return result;
}

/// A flat surface has 360 degrees round a point and at most that at an open edge (a slit); an underarm of straight
/// seams may have 570, the end of a band that goes on beyond a skirt 450. More comes from a seam that runs the wrong
/// way, or a piece for the other side of the body, as like as not.
void warn_of_angles(const Pattern& pattern, const Sewing& sewing, std::vector<Diagnostic>& warnings) {
  constexpr double degree = std::numbers::pi / 180.0;
  for (const Fan& fan : fans(pattern, sewing)) {
    if (fan.angle < (fan.open ? 480.0 : 720.0) * degree) continue;
    const EdgePart& part = sewing.stretches[fan.stretch].part;
    warnings.push_back(
        {pattern.pieces[part.piece].edges[part.edge].where,
         fmt::format("where {} begins, {:.0f} degrees of cloth meet {}", name_of(pattern, part), fan.angle / degree,
                     fan.open ? "at an open edge" : "round a point"),
         "see whether the seams there run the right way and no piece is for the other side of the body"});
  }
}

/// Open stretches one after the other between two corners of the sewn border.
struct OpenRun {
  EdgeChain edges;
  double length = 0.0;
};

std::vector<OpenRun> open_runs(const Sewing& sewing, const OpenLoop& loop) {
  constexpr double sharp = 0.75 * std::numbers::pi;  // a hem goes over a seam at some 180 degrees
  const auto begins = [&](std::size_t n) { return loop.angles[n] < sharp; };
  const std::size_t count = loop.stretches.size();
  std::size_t first = 0;
  while (first < count && !begins(first)) ++first;
  std::vector<OpenRun> runs;
  for (std::size_t n = 0; n < count && first < count; ++n) {
    const std::size_t at = (first + n) % count;
    if (begins(at)) runs.emplace_back();
    const Stretch& stretch = sewing.stretches[loop.stretches[at]];
    runs.back().edges.push_back(stretch.part);
    runs.back().length += stretch.length;
  }
  return runs.size() > 1 ? runs : std::vector<OpenRun>{};
}

/// A run over several pieces has a seam in its middle, and what the pattern names a hem is one.
bool is_hem(const Pattern& pattern, const OpenRun& run) {
  const auto of_one_piece = [&](const EdgePart& part) { return part.piece == run.edges.front().piece; };
  const auto named = [&](const EdgePart& part) {
    for (const Hem& hem : pattern.hems)
      for (const EdgePart& one : hem.edges)
        if (one.piece == part.piece && one.edge == part.edge && one.from <= part.from + 1e-6 &&
            one.to >= part.to - 1e-6)
          return true;
    return false;
  };
  return !std::all_of(run.edges.begin(), run.edges.end(), of_one_piece) ||
         std::all_of(run.edges.begin(), run.edges.end(), named);
}

/// Hems run smoothly over seams. Two open runs of one length between sharp corners were meant to be sewn, as like as
/// not.
void warn_of_open(const Pattern& pattern, const Sewing& sewing, std::vector<Diagnostic>& warnings) {
  if (pattern.seams.empty()) return;  // a file of pieces alone
  std::vector<OpenRun> runs;
  for (const OpenLoop& loop : sewing.open)
    for (OpenRun& run : open_runs(sewing, loop))
      if (!is_hem(pattern, run)) runs.push_back(std::move(run));
  std::vector<bool> said(runs.size(), false);
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = i + 1; j < runs.size() && !said[i]; ++j) {
      if (said[j] || runs[i].length < 0.03 || ease(runs[i].length, runs[j].length) > 0.015) continue;
      said[i] = said[j] = true;
      const EdgePart& first = runs[i].edges.front();
      warnings.push_back({pattern.pieces[first.piece].edges[first.edge].where,
                          fmt::format("{} ({}) and {} ({}) stay open between corners and are as long as each other",
                                      name_of(pattern, runs[i].edges), millimetres(runs[i].length),
                                      name_of(pattern, runs[j].edges), millimetres(runs[j].length)),
                          "they look like a seam: name it, or leave it where both are hems"});
    }
}

}  // namespace

void check_names(const Pattern& pattern, Diagnostics& diagnostics) {
  std::set<std::string> pieces;
  for (const Piece& piece : pattern.pieces) {
    if (!pieces.insert(piece.name).second)
      diagnostics.error(piece.where, "a second piece has the name " + piece.name, "give it a name of its own");
    std::set<std::string> edges;
    for (const PieceEdge& edge : piece.edges)
      if (!edges.insert(edge.name).second)
        diagnostics.error(edge.where, fmt::format("a second edge of {} has the name {}", piece.name, edge.name),
                          "give it a name of its own");
  }
}

void check_pieces(const Pattern& pattern) {
  Diagnostics diagnostics;
  if (pattern.pieces.empty())
    diagnostics.error({.file = pattern.file}, "the pattern has no piece", "give it at least one");
  check_names(pattern, diagnostics);
  check_fabrics(pattern, diagnostics);
  for (const Piece& piece : pattern.pieces) {
    check_outline(piece, diagnostics);
    check_notches(piece, diagnostics);
  }
  diagnostics.throw_if_any();
}

std::vector<Diagnostic> check_seams(const Pattern& pattern, const Sewing& sewing) {
  Diagnostics diagnostics;
  for (const Seam& seam : pattern.seams) check_ease(pattern, seam, diagnostics);
  check_hems(pattern, sewing, diagnostics);
  diagnostics.throw_if_any();
  std::vector<Diagnostic> warnings;
  warn_of_stretches(pattern, sewing, warnings);
  for (std::size_t s = 0; s < pattern.seams.size(); ++s)
    if (pattern.seams[s].a.size() + pattern.seams[s].b.size() > 2) warn_of_chain(pattern, sewing, s, warnings);
  warn_of_handles(pattern, sewing, warnings);
  warn_of_angles(pattern, sewing, warnings);
  warn_of_open(pattern, sewing, warnings);
  return warnings;
}

CheckedPattern checked(Pattern pattern) {
  check_pieces(pattern);
  CheckedPattern result{std::move(pattern), {}, {}};
  result.sewing = sew(result.pattern);
  result.warnings = check_seams(result.pattern, result.sewing);
  return result;
}

}  // namespace snug::mesh
