#include "cases/input/standard_morph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cases/input/standard_body.hpp"
#include "cases/input/suggestion.hpp"

namespace snug::input {

namespace {

using Point = std::array<double, 3>;

constexpr double thinnest = 0.65, thickest = 1.7;       // girth over the body's own
constexpr double shortest = 0.8, tallest = 1.3;         // stature over the body's own

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double distance(const Point& a, const Point& b) { return std::sqrt(dot(difference(a, b), difference(a, b))); }
double mixed(double a, double b, double share) { return a + share * (b - a); }

bool of_one_side(const std::string& name) { return name.ends_with(" left") || name.ends_with(" right"); }

/// Other words for the same place.
std::string usual_name(const std::string& name) {
  if (name == "hip" || name == "hips") return "seat";
  if (name == "bust") return "chest";
  if (name == "upper arm") return "arm";
  return name;
}

/// A factor at a place along a chain.
struct Knot {
  double at = 0.0, factor = 1.0;
};

/// Linear between the knots, the same beyond the last; 1 without any. The knots are in order.
double factor_at(const std::vector<Knot>& knots, double at) {
  if (knots.empty()) return 1.0;
  if (at <= knots.front().at) return knots.front().factor;
  for (std::size_t k = 1; k < knots.size(); ++k)
    if (at <= knots[k].at) return mixed(knots[k - 1].factor, knots[k].factor, (at - knots[k - 1].at) / (knots[k].at - knots[k - 1].at));
  return knots.back().factor;
}

class Morpher {
 public:
  Morpher(const StandardBody& body, double stature) : body_(body) {
    morph_.stature = stature;
    const auto add = [&](const std::string& name, const Point& point, const Point& normal, double girth, const std::string& towards) {
      BodyRing ring{name, {point[0], point[1], stature * point[2]}, {normal[0], normal[1], normal[2] / stature}, 1.0, {}, girth, {}, false};
      const double length = std::sqrt(dot(ring.normal, ring.normal));
      for (double& n : ring.normal) n /= length;
      morph_.rings.push_back(ring), towards_.push_back(towards);
    };
    for (const StandardCut& cut : body.cuts) add(cut.name, cut.point, cut.normal, cut.girth, cut.towards);
    for (const Landmark& landmark : body.landmarks)
      if (landmark.girth && !find(landmark.name)) add(landmark.name, landmark.at, {0.0, 0.0, 1.0}, *landmark.girth, "");
  }

  void ask(const GirthSpec& girth, Diagnostics& diagnostics) {
    const std::string name = usual_name(girth.at);
    bool known = false;
    for (BodyRing& ring : morph_.rings)
      if (ring.name == name || ring.name == name + " left" || ring.name == name + " right") known = true, ask(girth, ring, diagnostics);
    if (!known) diagnostics.error(girth.where, fmt::format("the standard body has no girth \"{}\"", girth.at), did_you_mean(girth.at, names()));
  }

  BodyMorph made() {
    follow_trunk();
    for (std::size_t n = 0; n < morph_.rings.size(); ++n)
      if (of_one_side(morph_.rings[n].name) && !of_one_side(parent(n)->name)) follow_limb(n);
    for (BodyRing& ring : morph_.rings) {
      if (of_one_side(ring.name)) ring.shift[0] = std::copysign(outwards(ring), ring.point[0]);
      ring.end = std::none_of(towards_.begin(), towards_.end(), [&](const std::string& to) { return to == ring.name; }) && (of_one_side(ring.name) || ring.name == highest()->name);
    }
    return morph_;
  }

 private:
  BodyRing* find(const std::string& name) {
    const auto found = std::find_if(morph_.rings.begin(), morph_.rings.end(), [&](const BodyRing& ring) { return ring.name == name; });
    return found == morph_.rings.end() ? nullptr : &*found;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const BodyRing& ring : morph_.rings) all.push_back(ring.name);
    return all;
  }

  static void ask(const GirthSpec& girth, BodyRing& ring, Diagnostics& diagnostics) {
    const double factor = girth.length / ring.was;
    if (ring.asked)
      return diagnostics.error(girth.where, fmt::format("the girth of \"{}\" is asked twice", ring.name), "leave one of them out");
    if (factor < thinnest || factor > thickest)
      return diagnostics.error(girth.where, fmt::format("{} is {:.0f} mm round and {:.0f} mm are asked: that far apart it is another body", ring.name, 1e3 * ring.was, 1e3 * girth.length),
                               fmt::format("check number and unit; {:.0f} to {:.0f} mm can be made", std::ceil(1e3 * thinnest * ring.was), std::floor(1e3 * thickest * ring.was)));
    ring.asked = girth.length, ring.factor = factor;
  }

  BodyRing* extreme(bool high) {
    BodyRing* found = nullptr;
    for (BodyRing& ring : morph_.rings)
      if (!of_one_side(ring.name) && (!found || (ring.point[2] > found->point[2]) == high)) found = &ring;
    return found;
  }
  BodyRing* highest() { return extreme(true); }
  BodyRing* lowest() { return extreme(false); }

  /// The next ring on the way to the trunk; of thighs its lowest.
  BodyRing* parent(std::size_t ring) {
    BodyRing* next = find(towards_[ring]);
    return next ? next : lowest();
  }

  void follow_trunk() {
    std::vector<Knot> knots;
    for (const BodyRing& ring : morph_.rings)
      if (!of_one_side(ring.name) && ring.asked) knots.push_back({ring.point[2], ring.factor});
    std::sort(knots.begin(), knots.end(), [](const Knot& a, const Knot& b) { return a.at < b.at; });
    for (BodyRing& ring : morph_.rings)
      if (!of_one_side(ring.name)) ring.factor = factor_at(knots, ring.point[2]);
  }

  /// The rings of a limb from the trunk outwards, `first` the nearest.
  void follow_limb(std::size_t first) {
    std::vector<std::pair<BodyRing*, double>> chain{{parent(first), 0.0}, {&morph_.rings[first], 0.0}};
    for (bool more = true; more;) {
      more = false;
      for (std::size_t n = 0; n < morph_.rings.size() && !more; ++n)
        if (towards_[n] == chain.back().first->name) chain.emplace_back(&morph_.rings[n], 0.0), more = true;
    }
    for (std::size_t n = 1; n < chain.size(); ++n) chain[n].second = chain[n - 1].second + distance(chain[n].first->point, chain[n - 1].first->point);
    std::vector<Knot> knots{{0.0, chain.front().first->factor}};
    for (std::size_t n = 1; n < chain.size(); ++n)
      if (chain[n].first->asked) knots.push_back({chain[n].second, chain[n].first->factor});
    for (std::size_t n = 1; n < chain.size(); ++n) {
      chain[n].first->factor = factor_at(knots, chain[n].second);
      roots_[chain[n].first->name] = {chain[0].first, chain[1].first};
    }
  }

  /// m, by which a limb's ring goes away from the middle.
  double outwards(const BodyRing& ring) {
    const auto [trunk, first] = roots_.at(ring.name);
    const bool leg = trunk == lowest();
    return ((leg ? std::max(trunk->factor, first->factor) : trunk->factor) - 1.0) * std::abs(first->point[0]);
  }

  const StandardBody& body_;
  BodyMorph morph_;
  std::vector<std::string> towards_;
  std::map<std::string, std::pair<BodyRing*, BodyRing*>> roots_;  // of a limb's rings: the trunk's ring it hangs on, and its own first
};

void check_stature(const StandardBody& body, double stature, const Location& where, Diagnostics& diagnostics) {
  if (stature >= shortest * body.stature && stature <= tallest * body.stature) return;
  diagnostics.error(where, fmt::format("a stature of {:.0f} mm is asked of a body of {:.0f} mm", 1e3 * stature, 1e3 * body.stature),
                    fmt::format("check number and unit; {:.0f} to {:.0f} mm can be made", 1e3 * shortest * body.stature, 1e3 * tallest * body.stature));
}

}  // namespace

BodyMorph body_morph(const StandardBody& body, const std::vector<GirthSpec>& girths, std::optional<double> stature, const Location& where, Diagnostics& diagnostics) {
  if (stature) check_stature(body, *stature, where, diagnostics);
  Morpher morpher(body, stature.value_or(body.stature) / body.stature);
  for (const GirthSpec& girth : girths) morpher.ask(girth, diagnostics);
  return morpher.made();
}

}  // namespace snug::input
