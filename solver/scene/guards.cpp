#include "solver/scene/guards.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "cases/input/choice.hpp"
#include "solver/scene/body_strain.hpp"
#include "solver/scene/laplace.hpp"

namespace snug::solver {

namespace {

using postproc::RunResult;

// A share of the cloth below this is a row of triangles at a hem and no property of the garment.
constexpr double worth_a_word = 0.05;
// Cloth that is this much shorter than taut cloth lies in folds that are seen: waves of amplitude a and length l take up
// (pi a / l)^2, so that it is a wave of 10 mm that stands 0.7 mm up and down.
constexpr double visible_fold = 0.05;
// Stretch may pass the end of the data by the error of a triangle's mean.
constexpr double beyond_end = 1.02;
// Mean pressure and tension times curvature on the worn skin differ by axial tension, hems, an oval section and friction: by at
// most a few hundredths each. Four times all of that together is another mechanism.
constexpr double far_from_laplace = 1.25;
// The same of areas: the garment's own contraction and the slope of the limb are counted, so that a quarter is cloth that went
// elsewhere.
constexpr double far_from_area = 1.25;
// An edge of tissue that is doubled, or a volume that is halved, is beyond every test that a law was fitted to, and not far from a
// cell that turns inside out.
constexpr double largest_stretch = 2.0, smallest_volume_ratio = 0.5;

/// A triangle of the garment as worn.
struct Piece {
  Eigen::Vector3d x;      ///< middle, m
  double area = 0.0;      ///< on the pattern, m2
  const materials::Fabric* fabric = nullptr;
};

double stretch_of(double green_strain) { return std::sqrt(std::max(0.0, 1.0 + 2.0 * green_strain)); }
double green_strain(double stretch) { return 0.5 * (stretch * stretch - 1.0); }

/// Stretch of taut cloth that bears no tension in a direction and has `across` in the other: stiffness E + coupling E' = 0.
double natural_stretch(const materials::TensionCurve& along, double coupling, double across) {
  return stretch_of(-coupling * std::max(0.0, green_strain(across)) / along.at(0.0).stiffness);
}

class Guards {
 public:
  Guards(const Model& model, const Meshes& meshes, RunResult& result)
      : model_(model), meshes_(meshes), result_(result), stretch_(result.garment.fields[postproc::field::stretch]) {
    const auto& garment = result.garment;
    for (std::size_t g = 0; g < garment.parts.size(); ++g)
      for (int i = garment.parts[g].first_triangle; i < garment.parts[g].end_triangle; ++i) {
        const auto& t = garment.triangles[i];
        const std::size_t own = static_cast<std::size_t>(i - garment.parts[g].first_triangle);
        pieces_.push_back({(garment.current[t[0]] + garment.current[t[1]] + garment.current[t[2]]) / 3.0,
                           meshes.garments[g].cut_area(own), &model.garments[g].fabric_of(meshes.garments[g].zone_of(own))});
        area_ += pieces_.back().area;
      }
  }

  void operator()() {
    look_at_data();
    look_at_folds();
    if (!result_.samples.empty()) look_at_contact();
    if (!result_.body.cells.empty()) look_at_body();
  }

 private:
  double& number(const std::string& quantity) { return result_.numbers[quantity]; }

  void warn(postproc::Warning warning) {
    warning.value = number(warning.quantity);
    result_.warnings.push_back(std::move(warning));
  }

  /// "212 mm up, 90 deg (Front thigh)"
  std::string at(const Eigen::Vector3d& x) const {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    if (meshes_.limb.skin) centre = mesh::section_centre(*meshes_.limb.skin, std::clamp(x.z(), meshes_.limb.lower, meshes_.limb.upper));
    std::string limb;
    if (meshes_.form)
      if (const auto section = mesh::limb_at(*meshes_.form, meshes_.form->body.in_body(x))) {
        centre = section->loop.centroid - meshes_.form->body.translation.head<2>();
        limb = input::text_of(section->part) + ", ";
      }
    double angle = std::atan2(x.y() - centre.y(), x.x() - centre.x());
    if (angle < 0.0) angle += 2.0 * std::numbers::pi;
    std::string text = fmt::format("height {:.0f} mm, {}{:.0f} deg", 1e3 * x.z(), limb, angle * 180.0 / std::numbers::pi);
    if (const auto& body = model_.asked.body)
      if (const int location = mesh::location_of(body->locations, angle, x.z()); location >= 0)
        text += " (" + body->locations[location].name + ")";
    return text;
  }

  /// Heights of the pieces that `is`, and the place of the one where `amount` is largest.
  template <class Is, class Amount>
  std::string place(Is is, Amount amount) const {
    double low = std::numeric_limits<double>::max(), high = -low;
    std::size_t most = 0;
    for (std::size_t t = 0; t < pieces_.size(); ++t) {
      if (amount(t) > amount(most)) most = t;
      if (is(t)) low = std::min(low, pieces_[t].x.z()), high = std::max(high, pieces_[t].x.z());
    }
    return fmt::format("heights {:.0f} to {:.0f} mm, most at {}", 1e3 * low, 1e3 * high, at(pieces_[most].x));
  }

  template <class Is>
  double share(Is is) const {
    double sum = 0.0;
    for (std::size_t t = 0; t < pieces_.size(); ++t)
      if (is(t)) sum += pieces_[t].area;
    return sum / area_;
  }

  /// The end of a fabric's data as a strain, of the direction whose data end first.
  static double data_end(const materials::Fabric& fabric) {
    return stretch_of(std::min(fabric.warp.data_end(), fabric.weft.data_end())) - 1.0;
  }

  void look_at_data() {
    const auto strain_over_end = [&](std::size_t t) {
      const materials::Fabric& fabric = *pieces_[t].fabric;
      return std::max((stretch_[t].x() - 1.0) / (stretch_of(fabric.warp.data_end()) - 1.0),
                      (stretch_[t].y() - 1.0) / (stretch_of(fabric.weft.data_end()) - 1.0));
    };
    const auto strain = [&](std::size_t t) { return stretch_[t].maxCoeff() - 1.0; };
    const auto beyond = [&](std::size_t t) { return strain_over_end(t) > beyond_end; };
    double largest = 0.0;
    for (std::size_t t = 0; t < pieces_.size(); ++t) largest = std::max(largest, strain(t));
    number("fabric_largest_strain") = largest;
    std::vector<materials::Fabric> fabrics;
    for (const GarmentModel& garment : model_.garments)
      for (const materials::Fabric& one : garment.fabrics()) fabrics.push_back(one);
    const auto weakest = std::min_element(fabrics.begin(), fabrics.end(), [](const auto& a, const auto& b) { return data_end(a) < data_end(b); });
    const double end = data_end(*weakest);
    if (!std::isfinite(end)) return;
    number("fabric_data_end") = end;
    const double found = number("fabric_beyond_data_share") = share(beyond);
    if (found <= worth_a_word) return;
    const std::string& fabric = weakest->name;
    warn({.name = "fabric beyond its data",
          .text = fmt::format("{:.0f} % of the cloth is stretched beyond the {:.1f} % to which {} is measured, by up to {:.1f} %; there its curve "
                              "is continued straight",
                              100.0 * found, 100.0 * end, fabric.empty() ? "the fabric" : fabric, 100.0 * largest),
          .place = place(beyond, strain_over_end),
          .remedy = "choose a larger size, or a fabric whose data reach that far",
          .quantity = "fabric_beyond_data_share",
          .limit = worth_a_word});
  }

  /// 1 - stretch over that of taut cloth, in the direction in which it is largest.
  double gathering(std::size_t t) const {
    const double warp = stretch_[t].x(), weft = stretch_[t].y();
    const materials::Fabric& fabric = *pieces_[t].fabric;
    return std::max({0.0, 1.0 - warp / natural_stretch(fabric.warp, fabric.coupling, weft),
                     1.0 - weft / natural_stretch(fabric.weft, fabric.coupling, warp)});
  }

  void look_at_folds() {
    const auto amount = [&](std::size_t t) { return gathering(t); };
    const auto folded = [&](std::size_t t) { return gathering(t) > visible_fold; };
    double& largest = number("largest_gathering") = 0.0;
    for (std::size_t t = 0; t < pieces_.size(); ++t) largest = std::max(largest, gathering(t));
    const std::vector<double>& wrinkled = result_.garment.fields[postproc::field::wrinkled];
    number("slack_share") = share([&](std::size_t t) { return wrinkled[t] == 2.0; });
    const double found = number("gathered_share") = share(folded);
    if (found <= worth_a_word) return;
    warn({.name = "gathered cloth",
          .text = fmt::format("{:.0f} % of the cloth lies in folds, up to {:.0f} % shorter than taut cloth; a membrane shortens at no cost, so that where "
                              "folds form and what they press with is not known",
                              100.0 * found, 100.0 * largest),
          .place = place(folded, amount),
          .remedy = remedy_of_folds(),
          .quantity = "gathered_share",
          .limit = worth_a_word});
  }

  std::string remedy_of_folds() const {
    if (!model_.has_friction()) return "give contact.friction (textiles on dry skin: 0.2 to 0.6) or hold both edges; without either nothing keeps the cloth spread";
    return "choose a garment that is no longer and no wider than what it covers";
  }

  /// m2 of cloth that bears on the skin or on other cloth; the latter with its hems, which are no strips of the skin.
  double touching(bool beside_hems) const {
    double area = 0.0;
    for (const auto& contact : result_.surface_contacts)
      if (is_garment(contact.slave) && contact.master != "skin") area += contact.area;
    for (const auto& sample : result_.samples)
      if (sample.touching && !(beside_hems && sample.hem >= 0)) area += sample.area;
    return area;
  }

  /// Area of the cloth as worn beside the hems: of all triangles less what the strips hold.
  double worn_area_beside_hems() const {
    constexpr std::array<std::array<int, 3>, 4> parts = {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
    const auto& x = result_.garment.current;
    double area = 0.0;
    for (const auto& t : result_.garment.triangles)
      for (const auto& [a, b, c] : parts)
        area += 0.5 * Eigen::Vector3d(x[t[b]] - x[t[a]]).cross(Eigen::Vector3d(x[t[c]] - x[t[a]])).norm();
    for (const auto& sample : result_.samples)
      if (sample.hem >= 0) area -= sample.area;
    return area;
  }

  void look_at_contact() {
    const double worn = worn_area_beside_hems();
    const double off = number("off_skin_share") = worn > 0.0 ? std::clamp(1.0 - touching(true) / worn, 0.0, 1.0) : 0.0;
    if (off > worth_a_word)
      warn({.name = "cloth off the skin",
            .text = fmt::format("{:.0f} % of the cloth beside the hems bears nothing; means are over the rest", 100.0 * off),
            .place = place_off(),
            .remedy = "look where it stands off (contact_pressure in garment.pvd); a smaller size touches more, and a body with hollows is bridged",
            .quantity = "off_skin_share",
            .limit = worth_a_word});
    if (!meshes_.limb.skin || !result_.movement.empty()) return;  // these know the limb as it stood when the garment was put on
    look_at_area(off > worth_a_word);
    look_at_laplace();
  }

  bool is_garment(const std::string& name) const {
    return std::any_of(model_.garments.begin(), model_.garments.end(), [&](const auto& garment) { return garment.spec.name == name; });
  }

  std::string place_off() const {
    const std::vector<double>& pressure = result_.garment.fields[postproc::field::contact_pressure];
    const auto bare = [&](std::size_t t) {
      const auto& nodes = result_.garment.triangles[t];
      return std::all_of(nodes.begin(), nodes.end(), [&](int n) { return pressure[n] <= 0.0; });
    };
    return place(bare, [&](std::size_t t) { return bare(t) ? 1.0 : 0.0; });
  }

  /// Of a garment of several fabrics the mean over its cloth.
  double mean_natural_stretch(int g, bool warp_along, double stretch) const {
    const GarmentModel& garment = model_.garments[g];
    const auto of = [&](const materials::Fabric& fabric) { return natural_stretch(warp_along ? fabric.warp : fabric.weft, fabric.coupling, stretch); };
    if (garment.zones.empty()) return of(garment.fabric);
    const mesh::GarmentMesh& mesh = meshes_.garments[g];
    double sum = 0.0, area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += mesh.cut_area(t) * of(garment.fabric_of(mesh.zone_of(t))), area += mesh.cut_area(t);
    return sum / area;
  }

  /// Between the placed garments' area and the same with the contraction that stretch round the limb brings along.
  void look_at_area(bool said) {
    double placed = 0.0, contracted = 0.0;
    for (std::size_t g = 0; g < model_.garments.size(); ++g) {
      const mesh::GarmentFit& fit = meshes_.garments[g].fit;
      const mesh::MeanFit mean = mesh::mean_fit(fit, meshes_.limb);
      placed += mean.area;
      contracted += mean.area * mean_natural_stretch(static_cast<int>(g), fit.warp_along, mean.stretch);
    }
    const double contraction = contracted / placed;
    const double found = number("contact_area_over_expected") = touching(false) / placed;
    if (said || (found > contraction / far_from_area && found < far_from_area)) return;
    warn({.name = "contact area",
          .text = fmt::format("the garment touches {:.0f} cm2 of skin{}, {:.2f} of the {:.0f} cm2 that it covers as placed", 1e4 * touching(false), result_.garment.parts.size() > 1 && !result_.surface_contacts.empty() ? " and cloth" : "", found,
                              1e4 * placed),
          .place = "",
          .remedy = "see where it has gone (garment.pvd): it may have slid, gathered or come off; hold an edge or give contact.friction",
          .quantity = "contact_area_over_expected",
          .limit = found < 1.0 ? contraction / far_from_area : far_from_area});
  }

  /// The share by which the covered skin has come nearer to the middle of its section.
  double give() const {
    double inward = 0.0, radius = 0.0;
    const auto& body = result_.body;
    const auto& coverage = body.fields[postproc::field::coverage];
    const auto& displacement = body.fields[postproc::field::displacement];
    for (std::size_t n = 0; n < body.nodes.size(); ++n) {
      if (coverage[n] <= 0.5) continue;
      const Eigen::Vector2d arm = body.nodes[n].head<2>() - mesh::section_centre(*meshes_.limb.skin, body.nodes[n].z());
      radius += arm.norm(), inward -= arm.normalized().dot(displacement[n].head<2>());
    }
    return radius > 0.0 ? std::clamp(inward / radius, -0.5, 0.9) : 0.0;
  }

  void look_at_laplace() {
    const auto mean = result_.numbers.find("mean_contact_pressure_Pa");
    const double given = give(), expected = laplace_pressure(model_.garments, meshes_, given).mean;
    if (mean == result_.numbers.end() || !(expected > 0.0)) return;
    const double found = number("mean_pressure_over_laplace") = mean->second / expected;
    if (found < far_from_laplace && found > 1.0 / far_from_laplace) return;
    warn({.name = "pressure far from Laplace's",
          .text = fmt::format("the mean pressure of {:.0f} Pa is {:.2f} times tension times curvature, {:.0f} Pa on the skin as it has given way ({:.1f} % of its radius)",
                              mean->second, found, expected, 100.0 * given),
          .place = "",
          .remedy = found > 1.0 ? "cloth that gathers or hangs on an edge presses more than its stretch round the body: look at gathered cloth and reactions"
                                : "a garment that is not tight everywhere, or a state short of the full load, presses less: look at cloth off the skin and the status",
          .quantity = "mean_pressure_over_laplace",
          .limit = found > 1.0 ? far_from_laplace : 1.0 / far_from_laplace});
  }

  void look_at_body() {
    const BodyStrain strain = body_strain(meshes_.body, result_.body.fields[postproc::field::displacement]);
    number("body_largest_stretch") = strain.largest_stretch, number("body_smallest_volume_ratio") = strain.smallest_volume_ratio;
    const std::string remedy = "choose a larger size, or a finer mesh there; no test of a tissue reaches so far";
    if (strain.largest_stretch > largest_stretch)
      warn({.name = "stretched tissue",
            .text = fmt::format("a cell of the body is stretched to {:.2f} times its length", strain.largest_stretch),
            .place = at(strain.stretched_at), .remedy = remedy, .quantity = "body_largest_stretch", .limit = largest_stretch});
    if (strain.smallest_volume_ratio < smallest_volume_ratio)
      warn({.name = "squeezed tissue",
            .text = fmt::format("a cell of the body has {:.2f} of its volume", strain.smallest_volume_ratio),
            .place = at(strain.squeezed_at), .remedy = remedy, .quantity = "body_smallest_volume_ratio", .limit = smallest_volume_ratio});
  }

  const Model& model_;
  const Meshes& meshes_;
  RunResult& result_;
  const std::vector<Eigen::Vector2d>& stretch_;  ///< of the triangles, along warp and weft
  std::vector<Piece> pieces_;
  double area_ = 0.0;
};

}  // namespace

void guard(const Model& model, const Meshes& meshes, RunResult& result) {
  if (!model.garments.empty() && !result.garment.triangles.empty()) Guards(model, meshes, result)();
}

std::vector<std::string> what_to_try(const Model& model, const Meshes& meshes, const RunResult& result) {
  std::vector<std::string> list;
  if (result.status == postproc::Status::converged) return list;
  const bool contact = model.contact_of(0) != nullptr;
  if (contact && !model.has_friction())
    list.push_back("give contact.friction (textiles on dry skin: 0.2 to 0.6): without it cloth slides and gathers at no cost");
  if (contact && model.slides_freely())
    list.push_back("hold an edge that something really holds: garment.held = [{ edge = \"upper\", held = \"axis\" }]");
  const auto stretch = result.numbers.find("fabric_largest_strain");
  if (stretch != result.numbers.end() && stretch->second > 0.5)
    list.push_back(fmt::format("choose a larger size: the cloth is stretched by {:.0f} % already in this state", 100.0 * stretch->second));
  if (std::any_of(model.garments.begin(), model.garments.end(),
                  [&](const auto& garment) { return garment.spec.cell_size > 0.5 * meshes.body.mean_skin_cell; }))
    list.push_back("leave garment.cell_size out: cloth coarser than the skin's nodes lets the skin buckle between its own");
  if (result.truth.deformable) list.push_back("look at the garment on the rigid skin first (solver.tier = \"L1\"), then at a stiffer or thicker tissue");
  return list;
}

}  // namespace snug::solver
