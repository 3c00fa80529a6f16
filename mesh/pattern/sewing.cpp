#include "mesh/pattern/sewing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "solver/fem/union_find.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

constexpr double same_share = 1e-7;  // of an edge's length: what is nearer is one place

/// A side of a seam measured along its parts.
class Side {
 public:
  Side(const Pattern& pattern, const EdgeChain& chain, bool from_end) : chain_(chain), from_end_(from_end) {
    for (const EdgePart& part : chain) ends_.push_back(ends_.back() + mesh::length(pattern, part));
    for (double& end : ends_) end /= ends_.back() > 0.0 ? ends_.back() : 1.0;
    length_ = mesh::length(pattern, chain);
  }
  double length() const { return length_; }

  /// Shares of the side at which a part ends and the next begins.
  std::vector<double> corners() const {
    std::vector<double> result;
    for (std::size_t n = 1; n + 1 < ends_.size(); ++n) result.push_back(walked(ends_[n]));
    return result;
  }
  /// Shares of the side at which its notches stand, by name.
  std::map<std::string, double> notches(const Pattern& pattern) const {
    std::map<std::string, double> result;
    for (std::size_t n = 0; n < chain_.size(); ++n)
      for (const Notch& notch : pattern.pieces[chain_[n].piece].notches)
        if (notch.edge == chain_[n].edge && notch.share >= chain_[n].from && notch.share <= chain_[n].to &&
            !notch.name.empty()) {
          const double inside = (notch.share - chain_[n].from) / (chain_[n].to - chain_[n].from);
          result[notch.name] = walked(ends_[n] + inside * (ends_[n + 1] - ends_[n]));
        }
    return result;
  }
  /// The stretch between two shares of the side, which lies on one part.
  EdgePart between(double from, double to) const {
    if (from_end_) std::tie(from, to) = std::pair(1.0 - to, 1.0 - from);
    const auto after = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, 0.5 * (from + to));
    const auto n = static_cast<std::size_t>(after - ends_.begin() - 1);
    EdgePart part = chain_[n];
    part.from = share_on(n, from), part.to = share_on(n, to);
    return part;
  }

 private:
  double walked(double share) const { return from_end_ ? 1.0 - share : share; }
  double share_on(std::size_t n, double share) const {
    const EdgePart& part = chain_[n];
    const double inside = std::clamp((share - ends_[n]) / (ends_[n + 1] - ends_[n]), 0.0, 1.0);
    if (inside < same_share) return part.from;
    if (inside > 1.0 - same_share) return part.to;
    return part.from + inside * (part.to - part.from);
  }

  const EdgeChain& chain_;
  bool from_end_;
  double length_ = 0.0;
  std::vector<double> ends_{0.0};  // shares of the side, in its own direction
};

/// Piecewise linear from one side to the other; `to` 1: from a to b.
double across(const std::vector<Station>& stations, double share, int to) {
  const int from = 1 - to;
  std::size_t n = 1;
  while (n + 1 < stations.size() && stations[n][from] < share) ++n;
  const Station &a = stations[n - 1], &b = stations[n];
  return a[to] + (share - a[from]) / (b[from] - a[from]) * (b[to] - a[to]);
}

/// Both grow from one station to the next; throws where they do not.
void check_order(std::vector<Station>& stations, const Seam& seam) {
  std::sort(stations.begin(), stations.end());
  for (std::size_t n = 1; n < stations.size(); ++n)
    if (!(stations[n][1] > stations[n - 1][1] + 1e-12) || !(stations[n][0] > stations[n - 1][0] + 1e-12))
      throw InputError(
          seam.where,
          "the notches or corners of the seam " + seam.name + " do not come in the same order on both sides",
          "see whether a side runs the other way, or a notch has the name of another");
}

void add_corners(const Side& a, const Side& b, std::vector<Station>& result) {
  const std::vector<Station> anchors = result;
  std::vector<double> of_b = b.corners();
  const double near = std::min(5e-3 / std::max(a.length(), b.length()), 0.02);
  const auto known = [&](double share, int side) {
    return std::any_of(anchors.begin(), anchors.end(),
                       [&](const Station& s) { return std::abs(s[side] - share) < 1e-9; });
  };
  for (const double corner : a.corners()) {
    if (known(corner, 0)) continue;
    double meets = across(anchors, corner, 1);
    const auto nearest = std::min_element(
        of_b.begin(), of_b.end(), [&](double x, double y) { return std::abs(x - meets) < std::abs(y - meets); });
    if (nearest != of_b.end() && std::abs(*nearest - meets) <= near && !known(*nearest, 1)) {
      meets = *nearest;
      of_b.erase(nearest);
    }
    result.push_back({corner, meets});
  }
  for (const double corner : of_b)
    if (!known(corner, 1)) result.push_back({across(anchors, corner, 0), corner});
}

/// A stretch that a seam sews, before it has a number.
struct Sewn {
  EdgePart part;
  int seam = 0, interval = 0;
};

using ByEdge = std::map<std::pair<int, int>, std::vector<Sewn>>;

ByEdge sewn_stretches(const Pattern& pattern) {
  ByEdge result;
  int interval = 0;
  for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
    const Seam& seam = pattern.seams[s];
    const Side a(pattern, seam.a, false), b(pattern, seam.b, true);
    const std::vector<Station> places = stations(pattern, seam);
    for (std::size_t n = 1; n < places.size(); ++n, ++interval)
      for (const EdgePart& part :
           {a.between(places[n - 1][0], places[n][0]), b.between(places[n - 1][1], places[n][1])})
        result[{part.piece, part.edge}].push_back({part, static_cast<int>(s), interval});
  }
  for (auto& [edge, sewn] : result)
    std::sort(sewn.begin(), sewn.end(), [](const Sewn& x, const Sewn& y) { return x.part.from < y.part.from; });
  return result;
}

void refuse_twice(const Pattern& pattern, const std::vector<Sewn>& sewn) {
  for (std::size_t n = 1; n < sewn.size(); ++n) {
    if (sewn[n].part.from >= sewn[n - 1].part.to - same_share) continue;
    const Seam &one = pattern.seams[sewn[n - 1].seam], &other = pattern.seams[sewn[n].seam];
    throw InputError(
        other.where,
        fmt::format("{} is sewn twice, by the seams {} and {}", name_of(pattern, sewn[n].part), one.name, other.name),
        "a stretch of an edge belongs to one seam; write a part of it, \"front.side[0..0.4]\", where only a part is "
        "sewn");
  }
}

/// Builds the stretches of the border piece by piece.
class Border {
 public:
  explicit Border(const Pattern& pattern) : pattern_(pattern), sewn_(sewn_stretches(pattern)) {
    for (const Hem& hem : pattern.hems)
      for (const EdgePart& part : hem.edges) {
        breaks_[{part.piece, part.edge}].insert(part.from);
        breaks_[{part.piece, part.edge}].insert(part.to);
      }
    for (std::size_t p = 0; p < pattern.pieces.size(); ++p)
      for (const Loop& loop : pattern.pieces[p].loops) add_loop(static_cast<int>(p), loop);
  }
  std::vector<Stretch> take() {
    for (const auto& [interval, pair] : pairs_) {
      stretches_[pair[0]].partner = pair[1];
      stretches_[pair[1]].partner = pair[0];
    }
    return std::move(stretches_);
  }

 private:
  void add_loop(int piece, const Loop& loop) {
    const auto first = static_cast<int>(stretches_.size());
    for (int e = loop.begin; e < loop.end; ++e) add_edge(piece, e);
    const auto last = static_cast<int>(stretches_.size());
    for (int s = first; s < last; ++s) {
      stretches_[s].next = s + 1 < last ? s + 1 : first;
      stretches_[s].begin = s, stretches_[s].end = stretches_[s].next;
    }
  }

  void add_edge(int piece, int edge) {
    const double length = ArcLength(pattern_.pieces[piece].edges[edge].curve).length();
    const std::vector<Sewn>& sewn = sewn_[{piece, edge}];
    refuse_twice(pattern_, sewn);
    double at = 0.0;
    for (const Sewn& one : sewn) {
      add_open({piece, edge, at, one.part.from}, length);
      pairs_[one.interval].push_back(static_cast<int>(stretches_.size()));
      add({piece, edge, one.part.from, one.part.to}, length, one.seam);
      at = one.part.to;
    }
    add_open({piece, edge, at, 1.0}, length);
  }

  /// What no seam takes, in parts where a hem begins or ends in it.
  void add_open(EdgePart part, double length) {
    if (part.to - part.from <= same_share) return;
    for (const double at : breaks_[{part.piece, part.edge}]) {
      if (at <= part.from + same_share || at >= part.to - same_share) continue;
      add({part.piece, part.edge, part.from, at}, length, -1);
      part.from = at;
    }
    add(part, length, -1);
  }

  void add(const EdgePart& part, double length, int seam) {
    Stretch stretch;
    stretch.part = part, stretch.seam = seam, stretch.length = (part.to - part.from) * length;
    stretches_.push_back(stretch);
  }

  const Pattern& pattern_;
  ByEdge sewn_;
  std::map<std::pair<int, int>, std::set<double>> breaks_;
  std::map<int, std::vector<int>> pairs_;
  std::vector<Stretch> stretches_;
};

bool covers(const EdgeChain& chain, const EdgePart& stretch) {
  return std::any_of(chain.begin(), chain.end(), [&](const EdgePart& part) {
    return part.piece == stretch.piece && part.edge == stretch.edge && part.from <= stretch.from + same_share &&
           part.to >= stretch.to - same_share;
  });
}

/// Of the hem that has all of the loop, else of the hole, else of its edges where they share a name, else none.
std::string given_name(const Pattern& pattern, const Sewing& sewing, const OpenLoop& loop) {
  const auto whole = [&](const Hem& hem) {
    return std::all_of(loop.stretches.begin(), loop.stretches.end(),
                       [&](int s) { return covers(hem.edges, sewing.stretches[s].part); });
  };
  const auto hem = std::find_if(pattern.hems.begin(), pattern.hems.end(), whole);
  if (hem != pattern.hems.end()) return hem->name;
  const EdgePart& part = sewing.stretches[loop.stretches.front()].part;
  const Loop& border = pattern.pieces[part.piece].loop_of(part.edge);
  const auto of_hole = [&](int s) {
    const EdgePart& one = sewing.stretches[s].part;
    return one.piece == part.piece && &pattern.pieces[one.piece].loop_of(one.edge) == &border;
  };
  if (!border.name.empty() && std::all_of(loop.stretches.begin(), loop.stretches.end(), of_hole)) return border.name;
  const auto edge = [&](int s) {
    return pattern.pieces[sewing.stretches[s].part.piece].edges[sewing.stretches[s].part.edge].name;
  };
  const std::string first = edge(loop.stretches.front());
  return std::all_of(loop.stretches.begin(), loop.stretches.end(), [&](int s) { return edge(s) == first; })
             ? first
             : std::string();
}

void name_loops(const Pattern& pattern, Sewing& sewing) {
  std::map<std::string, int> count;
  for (OpenLoop& loop : sewing.open) {
    const std::string name = given_name(pattern, sewing, loop);
    const int number = ++count[name];
    loop.name = name.empty() ? fmt::format("edge {}", number) : number == 1 ? name : fmt::format("{} {}", name, number);
  }
}

void find_open(const Pattern& pattern, Sewing& sewing) {
  std::vector<bool> seen(sewing.stretches.size(), false);
  for (std::size_t first = 0; first < sewing.stretches.size(); ++first) {
    if (sewing.stretches[first].partner >= 0 || seen[first]) continue;
    OpenLoop loop;
    for (int s = static_cast<int>(first); !seen[s];) {
      seen[s] = true;
      loop.stretches.push_back(s);
      double angle = 0.0;
      s = next_open(pattern, sewing, s, angle);
      loop.angles.push_back(angle);
    }
    std::rotate(loop.angles.rbegin(), loop.angles.rbegin() + 1, loop.angles.rend());  // from ends to beginnings
    sewing.open.push_back(loop);
  }
  name_loops(pattern, sewing);
}

}  // namespace

std::vector<Station> stations(const Pattern& pattern, const Seam& seam) {
  const Side a(pattern, seam.a, false), b(pattern, seam.b, true);
  std::vector<Station> result{{0.0, 0.0}, {1.0, 1.0}};
  const auto of_b = b.notches(pattern);
  for (const auto& [name, share] : a.notches(pattern)) {
    const auto meets = of_b.find(name);
    const bool inside = share > 1e-9 && share < 1.0 - 1e-9;
    if (inside && meets != of_b.end()) result.push_back({share, meets->second});
  }
  check_order(result, seam);
  add_corners(a, b, result);
  check_order(result, seam);
  return result;
}

double cloth_angle(const Pattern& pattern, const Stretch& stretch) {
  return stretch.part.from > 0.0 ? std::numbers::pi
                                 : corner_angle(pattern.pieces[stretch.part.piece], stretch.part.edge);
}

int next_open(const Pattern& pattern, const Sewing& sewing, int stretch, double& angle) {
  for (int s = sewing.stretches[stretch].next;; s = sewing.stretches[sewing.stretches[s].partner].next) {
    angle += cloth_angle(pattern, sewing.stretches[s]);
    if (sewing.stretches[s].partner < 0) return s;
  }
}

Sewing sew(const Pattern& pattern) {
  Sewing sewing;
  sewing.stretches = Border(pattern).take();
  fem::UnionFind corners(sewing.stretches.size());
  for (const Stretch& stretch : sewing.stretches)
    if (stretch.partner >= 0) {
      corners.merge(stretch.begin, sewing.stretches[stretch.partner].end);
      corners.merge(stretch.end, sewing.stretches[stretch.partner].begin);
    }
  sewing.corners = corners.representatives();
  find_open(pattern, sewing);
  return sewing;
}

}  // namespace snug::mesh
