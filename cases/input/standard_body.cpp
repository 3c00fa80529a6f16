#include "cases/input/standard_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/input/reader.hpp"
#include "cases/input/suggestion.hpp"

namespace snug::input {

namespace fs = std::filesystem;

namespace {

using Point = std::array<double, 3>;

bool given(const Point& point) { return !std::isnan(point[0]); }

/// m2, to the segment from a to b.
double squared_distance(const Point& x, const Point& a, const Point& b) {
  double along = 0.0, length = 0.0, distance = 0.0;
  for (int k = 0; k < 3; ++k) along += (x[k] - a[k]) * (b[k] - a[k]), length += (b[k] - a[k]) * (b[k] - a[k]);
  const double share = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  for (int k = 0; k < 3; ++k) distance += std::pow(x[k] - a[k] - share * (b[k] - a[k]), 2);
  return distance;
}

/// The cuts of a body as the tree that their `towards` makes of them.
class CutTree {
 public:
  explicit CutTree(const StandardBody& body) : body_(body) {}

  /// The cuts on the way to the pelvis, the nearest first.
  std::vector<std::string> way_of(const std::string& name) const {
    std::vector<std::string> way;
    for (const StandardCut* at = body_.cut(name); at && !at->towards.empty(); at = body_.cut(at->towards)) way.push_back(at->towards);
    return way;
  }

  /// The outer end of the piece of the tree that is nearest to a point.
  const StandardCut& nearest_to(const Point& point) const {
    const auto far = [&](const StandardCut& cut) {
      const StandardCut* inner = body_.cut(cut.towards);
      return squared_distance(point, cut.point, inner ? inner->point : cut.point);
    };
    return *std::min_element(body_.cuts.begin(), body_.cuts.end(), [&](const auto& a, const auto& b) { return far(a) < far(b); });
  }

 private:
  const StandardBody& body_;
};

/// The planes of a case on the tree.
class Orientation {
 public:
  Orientation(const StandardBody& body, const std::vector<NamedCut>& cuts) : body_(body), tree_(body), cuts_(cuts) {}

  /// Of each cut by name: whether its normal points away from the pelvis (else to it). Nothing where the cuts border on no common part, or on two.
  std::optional<std::vector<bool>> outwards() const {
    const std::size_t count = cuts_.size();
    if (count < 2) return std::nullopt;
    const auto inner = nearest_inner();
    if (std::all_of(inner.begin(), inner.end(), [](int n) { return n < 0; })) return std::vector<bool>(count, true);
    for (std::size_t c = 0; c < count; ++c) {
      bool borders = inner[c] < 0;
      for (std::size_t other = 0; other < count; ++other) borders = borders && (other == c || inner[other] == static_cast<int>(c));
      if (!borders) continue;
      std::vector<bool> result(count, true);
      result[c] = false;
      return result;
    }
    return std::nullopt;
  }

 private:
  /// Whether cut `a` lies on the way from `b` to the pelvis.
  bool inside_of(const NamedCut& a, const NamedCut& b) const {
    const std::string first = piece_of(a), second = piece_of(b);
    const std::vector<std::string> way = tree_.way_of(second);
    if (first != second) return std::find(way.begin(), way.end(), first) != way.end();
    return height(a, first) < height(b, first);
  }

  /// The outer end of the piece of the tree that it lies on.
  std::string piece_of(const NamedCut& cut) const { return given(cut.point) ? tree_.nearest_to(cut.point).name : cut.name; }

  /// Along the outward normal of a piece's end.
  double height(const NamedCut& cut, const std::string& piece) const {
    const StandardCut& end = *body_.cut(piece);
    const Point& at = given(cut.point) ? cut.point : end.point;
    double along = 0.0;
    for (int k = 0; k < 3; ++k) along += (at[k] - end.point[k]) * end.normal[k];
    return along;
  }

  /// Of each cut the nearest other one on its way to the pelvis; -1: none.
  std::vector<int> nearest_inner() const {
    std::vector<int> inner(cuts_.size(), -1);
    for (std::size_t b = 0; b < cuts_.size(); ++b)
      for (std::size_t a = 0; a < cuts_.size(); ++a)
        if (a != b && inside_of(cuts_[a], cuts_[b]) && (inner[b] < 0 || inside_of(cuts_[inner[b]], cuts_[a]))) inner[b] = static_cast<int>(a);
    return inner;
  }

  const StandardBody& body_;
  CutTree tree_;
  const std::vector<NamedCut>& cuts_;
};

std::vector<std::string> names_of(const std::vector<StandardCut>& cuts) {
  std::vector<std::string> names;
  for (const StandardCut& cut : cuts) names.push_back(cut.name);
  return names;
}

/// A cut that is given by its name alone gets its point; its normal once all are known.
void place_cuts(ScanSpec& scan, const StandardBody& body, Diagnostics& diagnostics) {
  bool known = true;
  for (const NamedCut& cut : scan.cuts)
    if (!given(cut.point) && !body.cut(cut.name)) {
      known = false;
      diagnostics.error(cut.where, fmt::format("the standard body \"{}\" has no cut \"{}\"", scan.standard, cut.name),
                        did_you_mean(cut.name, names_of(body.cuts)) + "; or give it a point and a normal of its own");
    }
  if (!known) return;
  const auto outwards = Orientation(body, scan.cuts).outwards();
  bool said = false;
  for (std::size_t c = 0; c < scan.cuts.size(); ++c) {
    NamedCut& cut = scan.cuts[c];
    const StandardCut* standard = given(cut.point) ? nullptr : body.cut(cut.name);
    if (!standard) continue;
    cut.point = standard->point;
    if (given(cut.normal)) continue;
    if (!outwards && !said)
      diagnostics.error(cut.where, scan.cuts.size() < 2 ? fmt::format("the cut \"{}\" leaves two parts", cut.name) : "the cuts do not border on one part of the body",
                        "name all the cuts of the part that is wanted, or say which side is cut off: { name = \"" + cut.name + "\", normal = [0, 0, 1] }");
    said = said || !outwards;
    const double sign = !outwards || (*outwards)[c] ? 1.0 : -1.0;
    for (int k = 0; k < 3; ++k) cut.normal[k] = sign * standard->normal[k];
  }
}

/// The surface comes with its unit and axes; the same ones may stand there.
void check_contradictions(const ScanSpec& scan, const Table& table, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& key, const std::string& remedy) {
    diagnostics.error(table.where_is(key), fmt::format("{} is given, and the standard body \"{}\" comes with its own", key, scan.standard), remedy);
  };
  if (table.find("surface")) refuse("surface", "leave surface out, or standard");
  if (scan.unit && *scan.unit != 1.0) refuse("unit", "leave it out: points of cuts are in the frame of the body, in any unit of length");
  if (scan.up != FileAxis::z) refuse("up", "leave it out: z points up");
  if (scan.front != FileAxis::y) refuse("front", "leave it out: y points to the front");
}

void take_locations(const StandardBody& standard, BodySpec& body) {
  body.locations = standard.locations;
  for (LocationSpec& location : body.locations) location.where_there = true, location.where = body.where;
}

/// Cuts by name go with the body, as its locations do with its skin (mesh/body/scan_surface); points that the case gives stay where it wants them.
void reshape(const StandardBody& standard, const Table& table, BodySpec& body, Diagnostics& diagnostics) {
  ScanSpec& scan = *body.scan;
  scan.morph = body_morph(standard, scan.girths, scan.stature, table.table("scan")->where, diagnostics);
  const auto is_its_own = [&](const NamedCut& cut) {
    const StandardCut* own = standard.cut(cut.name);
    return own && own->point == cut.point;
  };
  for (NamedCut& cut : scan.cuts)
    if (is_its_own(cut))
      for (const BodyRing& ring : scan.morph->rings)
        if (ring.name == cut.name)
          for (int k = 0; k < 3; ++k) {
            const double sign = cut.normal[k] * ring.normal[k] < 0.0 ? -1.0 : 1.0;
            cut.point[k] = ring.point[k] + ring.shift[k];
            cut.normal[k] = std::abs(std::abs(cut.normal[k]) - std::abs(standard.cut(cut.name)->normal[k])) < 1e-12 ? sign * ring.normal[k] : cut.normal[k];
          }
}

}  // namespace

const StandardCut* StandardBody::cut(const std::string& name) const {
  const auto found = std::find_if(cuts.begin(), cuts.end(), [&](const StandardCut& one) { return one.name == name; });
  return found == cuts.end() ? nullptr : &*found;
}

std::vector<std::string> standard_bodies(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

StandardBody read_standard_body(const fs::path& folder, const std::string& name) {
  Diagnostics diagnostics;
  const Table table = parse_file(folder / (name + ".toml"), diagnostics);
  diagnostics.throw_if_any();
  StandardBody body = read<StandardBody>(table, diagnostics, {.directory = folder});
  diagnostics.throw_if_any();
  return body;
}

void use_standard_body(BodySpec& body, const Table& table, const fs::path& folder, Diagnostics& diagnostics) {
  const Table* scan_table = table.table("scan");
  if (!body.scan || !scan_table) return;
  if (body.scan->standard.empty()) {
    for (const char* key : {"stature", "girth"})
      if (scan_table->find(key)) diagnostics.error(scan_table->where_is(key), fmt::format("{} is asked of a scan, which has its own", key), "name a standard body: standard = \"woman\"");
    return;
  }
  ScanSpec& scan = *body.scan;
  const std::vector<std::string> names = standard_bodies(folder);
  if (std::find(names.begin(), names.end(), scan.standard) == names.end())
    return diagnostics.error(scan_table->where_is("standard"), fmt::format("there is no standard body \"{}\"", scan.standard),
                             names.empty() ? "their folder (share/snug/bodies) is not beside the program: install snug as a whole" : did_you_mean(scan.standard, names));
  check_contradictions(scan, *scan_table, diagnostics);
  const StandardBody standard = read_standard_body(folder, scan.standard);
  scan.surface = standard.surface;
  scan.unit = 1.0;
  if (scan.cuts.empty() && !scan_table->find("lower") && !scan_table->find("upper"))
    return diagnostics.error(scan_table->where, "no cut says which part of the standard body is meant",
                             fmt::format("name those that border on it, e.g. cut = [\"waist\", \"ankle left\", \"ankle right\"]; known: {}", joined(names_of(standard.cuts))));
  place_cuts(scan, standard, diagnostics);
  if (!table.find("locations")) take_locations(standard, body);
  if (scan.stature || !scan.girths.empty()) reshape(standard, table, body, diagnostics);
}

}  // namespace snug::input
