#include "mesh/garment/garment_fit.hpp"

#include <algorithm>

namespace snug::mesh {

FitRow GarmentFit::at(double height) const {
  if (rows.empty()) return {};
  const auto above = std::find_if(rows.begin(), rows.end(), [&](const FitRow& row) { return row.height > height; });
  const auto as_there = [&](FitRow row) { return row.height = height, row; };
  if (above == rows.begin()) return as_there(rows.front());
  if (above == rows.end()) return as_there(rows.back());
  const FitRow &a = *(above - 1), &b = *above;
  const double t = (height - a.height) / (b.height - a.height);
  FitRow row{.height = height, .girth = a.girth + t * (b.girth - a.girth), .cover = a.cover + t * (b.cover - a.cover), .zones = a.zones};
  for (std::size_t z = 0; z < row.zones.size(); ++z) row.zones[z] += t * (b.zones[z] - a.zones[z]);
  return row;
}

std::vector<FitRow> LimbFit::some_rows(int count) const {
  const int all = static_cast<int>(rows.size());
  if (all <= count) return rows;
  std::vector<FitRow> some;
  for (int n = 0; n < count; ++n) some.push_back(rows[(2 * n + 1) * all / (2 * count)]);
  return some;
}

MeanFit mean_fit(const GarmentFit& fit, const Limb& limb) {
  constexpr int rows = 32;
  MeanFit mean;
  double share = 0.0;
  for (int i = 0; i < rows; ++i) {
    const double z = fit.lower + fit.length() * (i + 0.5) / rows;
    const FitRow row = fit.at(z);
    const double girth = limb.girth(z);
    share += row.cover, mean.body_girth += row.cover * girth, mean.garment_girth += row.cover * row.girth;
  }
  if (!(share > 0.0)) return mean;
  mean.area = mean.body_girth * fit.length() / rows;
  mean.body_girth /= share, mean.garment_girth /= share;
  mean.stretch = mean.garment_girth > 0.0 ? mean.body_girth / mean.garment_girth : 0.0;
  return mean;
}

MeanFit mean_fit(const GarmentFit& fit) {
  constexpr double all_round = 0.999;
  MeanFit mean;
  int count = 0;
  for (const LimbFit& limb : fit.limbs)
    for (const FitRow& row : limb.rows)
      if (row.cover > all_round) ++count, mean.body_girth += row.body, mean.garment_girth += row.girth;
  if (count == 0) return mean;
  mean.body_girth /= count, mean.garment_girth /= count;
  mean.stretch = mean.garment_girth > 0.0 ? mean.body_girth / mean.garment_girth : 0.0;
  return mean;
}

}  // namespace snug::mesh
