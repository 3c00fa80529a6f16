#include "mesh/pattern/trimming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::mesh {

namespace {

using input::InputError;

constexpr double hair = 1e-7;  // of an edge's length: less is no part of it

/// A part of an edge that stays, and the number that it has then.
struct Kept {
  double from = 0.0, to = 1.0;
  int edge = 0;
};

/// Shares of the length at which a curve passes a height: by samples, then halving.
void crossings(const ArcLength& along, double height, std::vector<double>& shares) {
  constexpr int samples = 128;
  const auto above = [&](double share) { return along.at(share).y() > height; };
  for (int i = 0; i < samples; ++i) {
    double low = static_cast<double>(i) / samples, high = static_cast<double>(i + 1) / samples;
    const bool first = above(low);
    if (first == above(high)) continue;
    while (high - low > 1e-14) {
      const double middle = 0.5 * (low + high);
      (above(middle) == first ? low : high) = middle;
    }
    shares.push_back(0.5 * (low + high));
  }
}

double lowest_point(const Piece& piece) {
  double low = std::numeric_limits<double>::max();
  for (const PieceEdge& edge : piece.edges)
    for (const Eigen::Vector2d& x : flattened(edge.curve, 1e-6)) low = std::min(low, x.y());
  return low;
}

/// Cuts one piece.
class Trim {
 public:
  Trim(const Piece& piece, double from, double to, const input::Location& where)
      : piece_(piece), low_(lowest_point(piece) + from), high_(lowest_point(piece) + to), where_(where), result_(piece), kept_(piece.edges.size()) {
    result_.edges.clear(), result_.loops.clear(), result_.notches.clear();
  }

  /// False where nothing of it is left.
  bool take() {
    for (const Loop& loop : piece_.loops) add(loop);
    if (result_.loops.empty() || &piece_.loops.front() != first_loop_) return false;
    for (const Notch& notch : piece_.notches)
      for (const Kept& part : kept_[notch.edge])
        if (notch.share >= part.from && notch.share <= part.to) {
          result_.notches.push_back(notch);
          result_.notches.back().edge = part.edge, result_.notches.back().share = (notch.share - part.from) / (part.to - part.from);
        }
    return true;
  }

  const Piece& piece() const { return result_; }
  const std::vector<Kept>& kept(int edge) const { return kept_[edge]; }

 private:
  /// Parts of an edge between the heights, as shares of its length.
  std::vector<Kept> inside(const ArcLength& along) const {
    std::vector<double> shares = {0.0, 1.0};
    crossings(along, low_, shares), crossings(along, high_, shares);
    std::sort(shares.begin(), shares.end());
    std::vector<Kept> parts;
    for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
      const double y = along.at(0.5 * (shares[i] + shares[i + 1])).y();
      if (shares[i + 1] - shares[i] < hair || y < low_ || y > high_) continue;
      if (!parts.empty() && shares[i] - parts.back().to < hair) parts.back().to = shares[i + 1];
      else parts.push_back({shares[i], shares[i + 1], 0});
    }
    return parts;
  }

  void add(const Loop& loop) {
    const int begin = static_cast<int>(result_.edges.size());
    for (int e = loop.begin; e < loop.end; ++e) {
      const ArcLength along(piece_.edges[e].curve);
      for (Kept part : inside(along)) {
        const bool whole = part.from < hair && part.to > 1.0 - hair;
        const PieceEdge& edge = piece_.edges[e];
        const Curve curve = whole ? edge.curve : along.between(part.from, part.to);
        close_gap(begin, curve.begin());
        part.edge = static_cast<int>(result_.edges.size());
        kept_[e].push_back(part);
        result_.edges.push_back({kept_[e].size() > 1 ? fmt::format("{} {}", edge.name, kept_[e].size()) : edge.name, curve, edge.where});
      }
    }
    if (static_cast<int>(result_.edges.size()) == begin) return;
    const Eigen::Vector2d first = result_.edges[begin].curve.begin();
    close_gap(begin, first);
    if (result_.loops.empty()) first_loop_ = &loop;
    result_.loops.push_back({begin, static_cast<int>(result_.edges.size()), loop.name});
  }

  /// An edge along the cut from where the last one ended.
  void close_gap(int begin, const Eigen::Vector2d& to) {
    if (static_cast<int>(result_.edges.size()) == begin) return;
    const Eigen::Vector2d from = result_.edges.back().curve.end();
    if ((to - from).norm() < 1e-9) return;
    const bool upper = std::abs(from.y() - high_) < std::abs(from.y() - low_);
    const std::string name = upper ? "upper cut" : "lower cut";
    if (result_.find(name) >= 0 || std::abs(from.y() - to.y()) > 1e-6)
      throw InputError(where_, fmt::format("the piece {} falls into several parts when it is cut at {:.4g} mm over its lowest point", piece_.name,
                                           1e3 * ((upper ? high_ : low_) - lowest_point(piece_))),
                       "cut it where it is in one, or draw the part as a pattern of its own");
    result_.edges.push_back({name, Curve{{Line{from, to}}}, piece_.where});
  }

  const Piece& piece_;
  double low_, high_;
  const input::Location& where_;
  Piece result_;
  std::vector<std::vector<Kept>> kept_;  // of each edge
  const Loop* first_loop_ = nullptr;
};

/// What is left of a side of a seam.
EdgeChain rest(const EdgeChain& chain, const std::vector<Trim>& trims, const std::vector<int>& number) {
  EdgeChain left;
  for (const EdgePart& part : chain) {
    if (number[part.piece] < 0) continue;
    for (const Kept& kept : trims[part.piece].kept(part.edge)) {
      const double from = std::max(part.from, kept.from), to = std::min(part.to, kept.to), length = kept.to - kept.from;
      if (to - from > hair) left.push_back({number[part.piece], kept.edge, (from - kept.from) / length, (to - kept.from) / length});
    }
  }
  return left;
}

}  // namespace

Pattern trimmed(const Pattern& pattern, double from, double to, const input::Location& where) {
  std::vector<Trim> trims;
  trims.reserve(pattern.pieces.size());
  Pattern result = pattern;
  result.pieces.clear(), result.seams.clear(), result.hems.clear();
  std::vector<int> number(pattern.pieces.size(), -1);
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p) {
    Trim& trim = trims.emplace_back(pattern.pieces[p], from, to, where);
    if (trim.take()) number[p] = static_cast<int>(result.pieces.size()), result.pieces.push_back(trim.piece());
  }
  if (result.pieces.empty())
    throw InputError(where, fmt::format("nothing of {} lies from {:.4g} to {:.4g} mm over the lowest point of its pieces", pattern.file, 1e3 * from, 1e3 * to),
                     "see the heights of the pieces: snug pattern FILE");
  for (Seam seam : pattern.seams) {
    seam.a = rest(seam.a, trims, number), seam.b = rest(seam.b, trims, number);
    if (seam.a.empty() != seam.b.empty())
      throw InputError(where, fmt::format("the seam \"{}\" of {} loses one of its sides", seam.name, pattern.file),
                       "cut all pieces where their seams meet; their drawings may begin at different heights");
    if (!seam.a.empty()) result.seams.push_back(seam);
  }
  for (Hem hem : pattern.hems)
    if (hem.edges = rest(hem.edges, trims, number); !hem.edges.empty()) result.hems.push_back(hem);
  return result;
}

}  // namespace snug::mesh
