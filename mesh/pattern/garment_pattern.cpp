#include "mesh/pattern/garment_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cases/input/suggestion.hpp"
#include "cases/input/text.hpp"

namespace snug::mesh {

namespace {

using input::Diagnostics;
using input::Location;

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const auto end = text.find(separator, begin);
    parts.push_back(input::trimmed_copy(text.substr(begin, end == std::string::npos ? end : end - begin)));
    if (end == std::string::npos) return parts;
    begin = end + separator.size();
  }
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "[0..0.4]" or "[0..knee]", up to a notch, at the end of a name; takes it off.
std::string take_range(std::string& name) {
  const auto open = name.find('[');
  if (open == std::string::npos) return {};
  const std::string range = name.substr(open);
  name = input::trimmed_copy(name.substr(0, open));
  return range;
}

/// False: the range is there and is none.
bool set_range(const std::string& range, const Piece& piece, EdgePart& part) {
  if (range.empty()) return true;
  if (range.back() != ']') return false;
  const auto ends = split(range.substr(1, range.size() - 2), "..");
  const auto share = [&](const std::string& end) {
    for (const Notch& notch : piece.notches)
      if (notch.edge == part.edge && notch.name == end && !end.empty()) return std::optional(notch.share);
    return number(end);
  };
  const auto from = share(ends.front()), to = share(ends.back());
  if (ends.size() != 2 || !from || !to || !(*from >= 0.0) || !(*to <= 1.0) || !(*from < *to)) return false;
  part.from = *from, part.to = *to;
  return true;
}

template <class Named>
std::vector<std::string> names(const std::vector<Named>& all) {
  std::vector<std::string> result;
  for (const Named& one : all) result.push_back(one.name);
  return result;
}

std::optional<EdgePart> edge_part(std::string name, const Pattern& pattern, const Location& where,
                                  Diagnostics& diagnostics) {
  EdgePart part;
  const std::string whole = name, range = take_range(name);
  const auto dot = name.find('.');
  if (dot == std::string::npos) {
    diagnostics.error(where, "\"" + whole + "\" names no edge",
                      "write piece and edge with a dot between them: \"front.side\"");
    return std::nullopt;
  }
  const std::string piece = name.substr(0, dot), edge = name.substr(dot + 1);
  part.piece = pattern.find(piece);
  if (part.piece < 0) {
    diagnostics.error(where, "there is no piece \"" + piece + "\"", input::did_you_mean(piece, names(pattern.pieces)));
    return std::nullopt;
  }
  part.edge = pattern.pieces[part.piece].find(edge);
  if (part.edge < 0) {
    diagnostics.error(where, "the piece " + piece + " has no edge \"" + edge + "\"",
                      input::did_you_mean(edge, names(pattern.pieces[part.piece].edges)));
    return std::nullopt;
  }
  if (!set_range(range, pattern.pieces[part.piece], part)) {
    diagnostics.error(where, "\"" + whole + "\" names no part of an edge",
                      "write shares of its length from 0 to 1, or notches that stand on it: \"front.side[0..0.4]\", "
                      "\"front.side[knee..1]\"");
    return std::nullopt;
  }
  return part;
}

}  // namespace

int Pattern::find(const std::string& piece) const {
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (pieces[p].name == piece) return static_cast<int>(p);
  return -1;
}

std::string piece_name(std::string wanted, const Pattern& pattern) {
  for (char& c : wanted)
    if (std::string_view(".[]+\"\n").find(c) != std::string_view::npos) c = '_';
  std::string name = wanted;
  for (int number = 2; pattern.find(name) >= 0; ++number) name = fmt::format("{} {}", wanted, number);
  return name;
}

std::string name_of(const Pattern& pattern, const EdgePart& part) {
  const Piece& piece = pattern.pieces[part.piece];
  const std::string name = piece.name + "." + piece.edges[part.edge].name;
  return part.from == 0.0 && part.to == 1.0 ? name : fmt::format("{}[{:.4g}..{:.4g}]", name, part.from, part.to);
}

std::string name_of(const Pattern& pattern, const EdgeChain& chain) {
  std::string text;
  for (const EdgePart& part : chain) text += (text.empty() ? "" : " + ") + name_of(pattern, part);
  return text;
}

EdgeChain edge_chain(const std::string& text, const Pattern& pattern, const Location& where, Diagnostics& diagnostics) {
  EdgeChain chain;
  for (const std::string& name : split(text, "+")) {
    const auto part = edge_part(name, pattern, where, diagnostics);
    if (!part) return {};
    chain.push_back(*part);
  }
  return chain;
}

double length(const Pattern& pattern, const EdgePart& part) {
  return (part.to - part.from) * ArcLength(pattern.pieces[part.piece].edges[part.edge].curve).length();
}

double length(const Pattern& pattern, const EdgeChain& chain) {
  double sum = 0.0;
  for (const EdgePart& part : chain) sum += length(pattern, part);
  return sum;
}

double ease(double one_side, double other_side) {
  const double shorter = std::min(one_side, other_side);
  return shorter > 0.0 ? std::max(one_side, other_side) / shorter - 1.0 : 0.0;
}

Pattern selected(const Pattern& pattern, const std::vector<std::string>& pieces, const Location& where) {
  std::vector<std::string> known;
  for (const Piece& piece : pattern.pieces) known.push_back(piece.name);
  Diagnostics diagnostics;
  Pattern result = pattern;
  result.pieces.clear(), result.seams.clear(), result.hems.clear();
  std::vector<int> number(pattern.pieces.size(), -1);
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p)
    if (std::find(pieces.begin(), pieces.end(), known[p]) != pieces.end())
      number[p] = static_cast<int>(result.pieces.size()), result.pieces.push_back(pattern.pieces[p]);
  for (const std::string& name : pieces)
    if (pattern.find(name) < 0) diagnostics.error(where, fmt::format("\"{}\" is no piece of {}", name, pattern.file), input::did_you_mean(name, known));
  diagnostics.throw_if_any();
  const auto renumbered = [&](EdgeChain chain) -> std::optional<EdgeChain> {
    for (EdgePart& part : chain)
      if ((part.piece = number[part.piece]) < 0) return std::nullopt;
    return chain;
  };
  for (Seam seam : pattern.seams)
    if (const auto a = renumbered(seam.a), b = renumbered(seam.b); a && b) seam.a = *a, seam.b = *b, result.seams.push_back(seam);
  for (Hem hem : pattern.hems)
    if (const auto edges = renumbered(hem.edges)) hem.edges = *edges, result.hems.push_back(hem);
  return result;
}

Pattern graded(const Pattern& pattern, double girth, double length) {
  Pattern result = pattern;
  for (Piece& piece : result.pieces) {
    piece = scaled(piece, girth, length);
    if (piece.place)
      piece.place->translation = piece.place->translation.cwiseProduct(Eigen::Vector3d(girth, length, girth));
  }
  return result;
}

}  // namespace snug::mesh
