// A garment on many wearers: sizes of it, and who is pressed as is wanted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/garment/garment_fit.hpp"
#include "solver/scene/model.hpp"

namespace snug::solver {

/// A wearer, or a share of all: girths (m) at the places of a target, in their order.
struct Wearer {
  std::vector<double> girths;
  double share = 0.0;  ///< of all; they add up to 1
};

/// Reads a table with a column of girths for each place, called like it ("Ankle [mm]"; of a single place also "girth"), a row a wearer; `share` weighs
/// the rows. Places without a column but the first get the girth of the body times the ratio of the first. Throws input::InputError.
std::vector<Wearer> read_wearers(const std::filesystem::path& file, const std::vector<std::string>& places, const std::vector<double>& body_girths);

/// Wearers whose girth at the first place is normally distributed (mean and standard deviation, m), 400 of equal share; other places in proportion.
std::vector<Wearer> normal_wearers(double mean, double deviation, const std::vector<double>& body_girths);

/// Pressure at a place by the wearer's girth there and the size of the garment, a factor on its girth of the solution: as the law of Laplace changes with
/// both, T(girth / garment) / girth, from what the solution found. Tissue that gives way otherwise on another wearer is not in it.
class WornPressure {
 public:
  WornPressure(const GarmentModel& garment, mesh::FitRow row, bool warp_along, double body_girth, double found);
  double at(double girth, double size) const;           ///< Pa
  double garment_girth(double size) const { return size * row_.girth; }  ///< m
  /// The girth at which it presses so, m; the nearest where it does so at none from 0.9 to 2.9 times the garment's.
  double girth_for(double pressure, double size) const;

 private:
  double law(double girth, double size) const;

  const GarmentModel& garment_;
  mesh::FitRow row_;
  bool warp_along_;
  double factor_;
};

/// A range of pressures that counts as right, Pa.
struct PressureRange {
  double low = 0.0, high = 0.0;
};

/// One size with who wears it: everybody takes the one that comes nearest.
struct SizeRow {
  double size = 1.0;                     ///< factor on the garment's girth of the solution
  double garment_girth = 0.0;            ///< m, at the first place
  double from_girth = 0.0, to_girth = 0.0;  ///< m, wearers that it presses within the range there
  double from_ease = 0.0, to_ease = 0.0;    ///< garment over wearer less 1, of these
  double worn = 0.0, inside = 0.0;       ///< shares of all: who takes it, and who is pressed within every range by it
};

/// So many sizes, cut for the middles of equal parts of the population at the first place, the smallest first. `wanted` (Pa) and `ranges` by place.
std::vector<SizeRow> size_table(const std::vector<Wearer>& wearers, const std::vector<WornPressure>& places, const std::vector<double>& wanted,
                                const std::vector<PressureRange>& ranges, int sizes);

/// The girth (m) at the first place that a share of the wearers is below.
double girth_below(const std::vector<Wearer>& wearers, double share);

}  // namespace snug::solver
