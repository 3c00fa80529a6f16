#include "solver/library/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/input/warned_error.hpp"
#include "solver/scene/tools.hpp"

namespace snug::solver {

namespace {

using input::Diagnostic;

constexpr double smallest_part = 2e-3, largest_part = 3.0;  // m: a phantom of a finger, a man
constexpr double impossible = 4.0;                          // times beyond these
constexpr double tight = 0.4, loose = 2.5;                  // garment over girth
constexpr double torn = 0.2, tent = 6.0;
constexpr double stiffest_cloth = 0.01;                     // elongation at the largest force of a test; KES and FAST find 1.5 % and more of woven cloth
constexpr double squeezed = 0.5;                            // of what lies before a tool; limbs are indented by 0.11 to 0.25 in vivo (limb_sites.toml)
constexpr double coarse_cells = 0.5;                        // of a tool's radius

class Checks {
 public:
  Checks(const Model& model, const Meshes& meshes, const std::vector<mesh::GarmentFit>& fits)
      : model_(model), case_(model.asked), meshes_(meshes), fits_(fits) {}

  std::vector<Diagnostic> operator()() {
    if (case_.body && case_.body->kind != input::BodyKind::stations) check_size();
    if (case_.body && case_.body->kind == input::BodyKind::scan && meshes_.limb.bone) check_shape();
    if (meshes_.limb.skin || meshes_.form)
      for (std::size_t g = 0; g < fits_.size(); ++g) check_fit(case_.garments[g], model_.garments[g].fabric, fits_[g]);
    for (const GarmentModel& garment : model_.garments) {
      check_fabric(garment.fabric, garment.spec.fabric.where);
      for (std::size_t z = 0; z < garment.zones.size(); ++z) check_fabric(garment.zones[z], garment.spec.zone[z].fabric.where);
    }
    if (model_.deformable())
      for (const input::ToolSpec& tool : case_.tools) check_tool(tool);
    if (!model_.deformable() && !case_.postures.empty())
      say(false, case_.postures.front().where, fmt::format("the postures are left out: tier {} has a rigid skin, which does not bend", input::text_of(case_.solver.tier)), "take tier L4 for them");
    input::with_warnings(warnings_, [&] { errors_.throw_if_any(); });
    return std::move(warnings_);
  }

 private:
  void say(bool error, const input::Location& where, std::string found, std::string remedy) {
    if (error) errors_.error(where, std::move(found), std::move(remedy));
    else warnings_.push_back({where, std::move(found), std::move(remedy)});
  }

  /// Stations tell rows and columns themselves (mesh/body/stations); scans and meshes have one unit.
  void check_size() {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (const Eigen::Vector3d& x : meshes_.body.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const double size = (high - low).maxCoeff();
    if (meshes_.body.nodes.empty() || (size >= smallest_part && size <= largest_part)) return;
    const double unit = case_.body->kind == input::BodyKind::scan ? case_.body->scan->unit.value_or(1.0) : case_.body->unit;
    std::string remedy = "look at its unit";
    if (case_.body->kind == input::BodyKind::scan && !case_.body->scan->unit) remedy = "give the unit of the file, e.g. unit = \"1 um\" in [body.scan]";
    else for (const auto& [name, other] : {std::pair{"1 mm", 1e-3}, std::pair{"1 cm", 1e-2}, std::pair{"1 m", 1.0}})
      if (const double then = size / unit * other; then > 0.02 && then < largest_part && other != unit) {
        remedy = fmt::format("does the file count in {}? unit = \"{}\" would make it {:.4g} mm", name + 2, name, 1e3 * then);
        break;
      }
    say(size > impossible * largest_part || size < smallest_part / impossible, case_.body->where, fmt::format("the body is {:.4g} m long", size), remedy);
  }

  /// A limb is longer than wide; one that lies along another axis was cut across.
  void check_shape() {
    const mesh::Limb& limb = meshes_.limb;
    const auto rows = mesh::girth_table(limb, 9);
    double slender = 0.0;
    for (const auto& row : rows) slender = std::max({slender, row.width / row.depth, row.depth / row.width});
    const double across = std::max(rows[4].width, rows[4].depth), along = limb.upper - limb.lower;
    const bool flat = slender > 1.6 && across > 1.5 * along, unlike = limb.residual.max > 0.1 * std::min(rows[4].width, rows[4].depth);
    if (!flat && !unlike) return;
    say(false, case_.body->where,
        fmt::format("the sections of the scan are {:.0f} mm by {:.0f} mm over a length of {:.0f} mm, and the smooth skin is up to {:.0f} mm beside it", 1e3 * rows[4].width,
                    1e3 * rows[4].depth, 1e3 * along, 1e3 * limb.residual.max),
        "is the limb cut along instead of across? programs of clothes and animation write files with up = \"y\"");
  }

  void check_fit(const input::GarmentSpec& garment, const materials::Fabric& fabric, const mesh::GarmentFit& fit) {
    const mesh::MeanFit mean = meshes_.form ? mesh::mean_fit(fit) : mesh::mean_fit(fit, meshes_.limb);
    if (!(mean.body_girth > 0.0)) return;
    const double cut = mean.garment_girth, girth = mean.body_girth;
    if (!(cut > 0.0) || !(fit.length() > 0.0)) return;
    const double ratio = cut / girth;
    const std::string key = garment.pattern.sewn() ? "the pattern's unit" : "flat_circumference";
    if (ratio >= tight && ratio <= loose) return check_range(garment, fabric, 1.0 / ratio - 1.0);
    const auto close = [&](double factor) { return ratio * factor > 0.45 && ratio * factor < 1.3; };
    std::string remedy = ratio < 1.0 ? "no fabric stretches so far: look at " + key + " and the girths" : "look at " + key + " and the girths";
    for (const auto& [factor, text] : {std::pair{10.0, "mm written for cm, or a digit too few"}, std::pair{0.1, "cm written for mm, or a digit too many"},
                                       std::pair{25.4, "mm written for inches"}, std::pair{2.0 * std::numbers::pi, "the radius instead of the circumference"},
                                       std::pair{std::numbers::pi, "the diameter instead of the circumference"}, std::pair{1.0 / std::numbers::pi, "pi too much"}})
      if (close(factor)) {
        remedy = fmt::format("{}? {:.4g} mm would be {:.0f} % of the girth", text, 1e3 * cut * factor, 100.0 * ratio * factor);
        break;
      }
    say(ratio < torn || ratio > tent, garment.where,
        fmt::format("{} is {:.4g} mm round as cut on a girth of {:.4g} mm, {:.0f} % {}", garment.name.empty() ? "the garment" : garment.name, 1e3 * cut, 1e3 * girth,
                    100.0 * std::abs(ratio - 1.0), ratio < 1.0 ? "smaller" : "larger"),
        remedy);
  }

  /// Gauze has 20 g/m2, neoprene of a diver 2 kg/m2 and 5 mm; rubber thread pulls with 10 N/m, sailcloth with 1 MN/m.
  void check_fabric(const materials::Fabric& fabric, const input::Location& where) {
    const auto look = [&](const char* what, double value, double low, double high, double show, const char* unit) {
      if (value == 0.0 || (value >= low && value <= high)) return;
      say(false, where, fmt::format("the {} of the fabric is {:.4g} {}", what, value * show, unit), "look at its unit");
    };
    look("weight", fabric.areal_density, 5e-3, 5.0, 1e3, "g/m2");
    look("thickness", fabric.thickness, 2e-5, 0.02, 1e3, "mm");
    look("stiffness", fabric.stiffness(), 1.0, 3e6, 1.0, "N/m");
    look("shear stiffness", fabric.shear, 0.1, 1e6, 1.0, "N/m");
    if (const double end = std::min(end_of_data(fabric.warp), end_of_data(fabric.weft)); end < stiffest_cloth)
      say(false, where, fmt::format("the curve of the fabric ends at an elongation of {:.3g} %", 100.0 * end),
          fmt::format("if a share was written for a percentage, write \"{:.3g} %\" (in the head of a table [1] instead of [%])", 1e4 * end));
  }

  static double end_of_data(const materials::TensionCurve& curve) { return std::sqrt(1.0 + 2.0 * curve.data_end()) - 1.0; }

  /// Tiers with a garment that is solved measure it afterwards (scene/guards); the law of Laplace goes on along the curve's end.
  void check_range(const input::GarmentSpec& garment, const materials::Fabric& fabric, double strain) {
    if (case_.solver.tier != input::Tier::L0 || garment.pattern.sewn()) return;
    const double end = end_of_data(garment.warp == input::WarpDirection::around ? fabric.warp : fabric.weft);
    if (strain > 1.02 * end)
      say(false, garment.where, fmt::format("the cloth is stretched by {:.0f} % in the mean, beyond the {:.3g} % up to which there are data of {}; there its curve is continued straight",
                                            100.0 * strain, 100.0 * end, fabric.name.empty() ? "the fabric" : fabric.name),
          "choose a larger size, or a fabric whose data reach that far");
  }

  void check_tool(const input::ToolSpec& tool) {
    const PlacedTool placed = place_tool(meshes_.body, tool);
    if (const double edge = placed.surface.mean_edge; edge > coarse_cells * tool.radius)
      say(false, tool.where, fmt::format("cells below \"{}\" are {:.3g} mm long, and its radius is {:.3g} mm: the surface slips round it between them", tool.name, 1e3 * edge, 1e3 * tool.radius),
          "refine the mesh there to an eighth of the radius, or the edge's rounding");
    const double before_it = way_to_what_is_held(meshes_.body, case_.support, placed) - placed.first_touch, depth = tool.travel - placed.first_touch;
    if (depth <= squeezed * before_it) return;
    const bool through = depth >= before_it;
    const std::string goes = fmt::format("\"{}\" goes {:.4g} mm deep into the body, which is {:.4g} mm thick there in front of what is held", tool.name, 1e3 * depth, 1e3 * before_it);
    say(through, tool.where, goes + (through ? "" : fmt::format(": {:.0f} % of it", 100.0 * depth / before_it)),
        fmt::format("let it travel {} {:.4g} mm{}", through ? "less than" : "up to", 1e3 * (placed.first_touch + squeezed * before_it),
                    through ? "" : ", or expect that it stops on its way: limbs are pressed by 11 to 25 % of their tissue where they are measured"));
  }

  const Model& model_;
  const input::Case& case_;
  const Meshes& meshes_;
  const std::vector<mesh::GarmentFit>& fits_;
  input::Diagnostics errors_;
  std::vector<Diagnostic> warnings_;
};

}  // namespace

std::vector<Diagnostic> implausible(const Model& model, const Meshes& meshes, const std::vector<mesh::GarmentFit>& fits) {
  return Checks(model, meshes, fits)();
}

}  // namespace snug::solver
