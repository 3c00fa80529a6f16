// How wide a garment is by height, against the body that it goes round.
#pragma once

#include <string>
#include <vector>

#include "mesh/body/limb.hpp"

namespace snug::mesh {

struct FitRow {
  double height = 0.0;  ///< m
  double girth = 0.0;   ///< m, of the garment as cut; where it does not go all the way round, what it would be if it did
  double cover = 1.0;   ///< share of the way round that it goes
  double body = 0.0;    ///< m, taped girth of the limb there; of LimbFit alone
  std::vector<double> zones = {};  ///< shares of its girth that are in each of the garment's zones; the rest is of its own fabric
};

/// How wide a garment is round one limb of a body that branches.
struct LimbFit {
  std::string limb;           ///< "trunk", "right leg", "left leg"
  std::vector<FitRow> rows;   ///< from below

  /// Some of them at even distances, as many as asked for or all.
  std::vector<FitRow> some_rows(int count) const;
};

/// A garment as it was placed, by height. One row stands for a garment that is as wide everywhere.
struct GarmentFit {
  std::vector<FitRow> rows;          ///< from below
  double lower = 0.0, upper = 0.0;   ///< m, heights of its lowest and highest point as placed
  bool warp_along = true;            ///< the warp runs along the body's axis rather than round it
  std::vector<LimbFit> limbs = {};   ///< on a body that branches; `rows` is empty then
  std::string placing = {};          ///< how it was put on, with its figures

  /// Between the rows linearly, beyond them as at the ends.
  double girth_at(double height) const { return at(height).girth; }
  double cover_at(double height) const { return at(height).cover; }
  FitRow at(double height) const;
  double length() const { return upper - lower; }
};

/// What counts of a garment over its cover: means over rows of equal height, each as much as it covers.
struct MeanFit {
  double body_girth = 0.0, garment_girth = 0.0;  ///< m
  double stretch = 0.0;                          ///< of the mean girths, body over garment
  double area = 0.0;                             ///< m2, girth of the body times the height that is covered
};
MeanFit mean_fit(const GarmentFit& fit, const Limb& limb);
/// The same of a garment on a body that branches, over the rows of all limbs at which it goes all the way round; its area is not known.
MeanFit mean_fit(const GarmentFit& fit);

}  // namespace snug::mesh
