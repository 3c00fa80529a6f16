#include "materials/learning/standard_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace snug::materials {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

StandardScale::StandardScale(const MatrixXd& table) : mean(VectorXd::Zero(table.cols())), deviation(VectorXd::Zero(table.cols())) {
  for (Index c = 0; c < table.cols(); ++c) {
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (Index r = 0; r < table.rows(); ++r)
      if (!std::isnan(table(r, c))) sum += table(r, c), count += 1.0;
    if (count == 0.0) continue;
    mean[c] = sum / count;
    for (Index r = 0; r < table.rows(); ++r)
      if (!std::isnan(table(r, c))) squares += std::pow(table(r, c) - mean[c], 2);
    const double found = count > 1.0 ? std::sqrt(squares / (count - 1.0)) : 0.0;
    deviation[c] = found > 1e-12 * std::abs(mean[c]) ? found : 0.0;  // what is left of equal numbers is round-off
  }
}

MatrixXd StandardScale::scaled(const MatrixXd& table) const {
  MatrixXd scaled = table.rowwise() - mean.transpose();
  for (Index c = 0; c < table.cols(); ++c)
    for (Index r = 0; r < table.rows(); ++r)
      if (!std::isnan(scaled(r, c))) scaled(r, c) = deviation[c] > 0.0 ? scaled(r, c) / deviation[c] : 0.0;
  return scaled;
}

std::vector<Neighbour> neighbours(const MatrixXd& table, Index of) {
  const MatrixXd scaled = StandardScale(table).scaled(table);
  std::vector<Neighbour> found;
  for (Index r = 0; r < table.rows(); ++r) {
    double squares = 0.0;
    int shared = 0, own = 0;
    for (Index c = 0; c < table.cols(); ++c) {
      if (std::isnan(scaled(of, c))) continue;
      ++own;
      if (!std::isnan(scaled(r, c))) squares += std::pow(scaled(r, c) - scaled(of, c), 2), ++shared;
    }
    if (r != of && shared > 0 && 2 * shared >= own) found.push_back({.row = r, .distance = std::sqrt(squares / shared), .shared = shared});
  }
  std::stable_sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  return found;
}

namespace {

/// Rows of the start.
std::vector<Index> start(const MatrixXd& points, int count) {
  VectorXd nearest = points.rowwise().squaredNorm();  // from the mean, which is 0
  std::vector<Index> chosen;
  while (static_cast<int>(chosen.size()) < count) {
    Index farthest = 0;
    const double distance = nearest.maxCoeff(&farthest);
    if (!chosen.empty() && distance <= 0.0) throw std::invalid_argument("more clusters than different rows");
    const VectorXd from = (points.rowwise() - points.row(farthest)).rowwise().squaredNorm();
    nearest = chosen.empty() ? from : VectorXd(nearest.cwiseMin(from));
    chosen.push_back(farthest);
  }
  return chosen;
}

int nearest_centre(const MatrixXd& centres, const Eigen::RowVectorXd& point) {
  Index nearest = 0;
  (centres.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

/// Means of the clusters; one that has lost all of its rows keeps its centre.
void move_centres(const MatrixXd& points, const std::vector<int>& of, MatrixXd& centres) {
  MatrixXd sums = MatrixXd::Zero(centres.rows(), centres.cols());
  VectorXd counts = VectorXd::Zero(centres.rows());
  for (std::size_t r = 0; r < of.size(); ++r) sums.row(of[r]) += points.row(static_cast<Index>(r)), counts[of[r]] += 1.0;
  for (Index k = 0; k < centres.rows(); ++k)
    if (counts[k] > 0.0) centres.row(k) = sums.row(k) / counts[k];
}

}  // namespace

Clusters clusters(const MatrixXd& table, int count) {
  if (count < 1 || count > table.rows()) throw std::invalid_argument("no such number of clusters");
  const StandardScale scale(table);
  const MatrixXd points = scale.scaled(table);
  MatrixXd centres(count, points.cols());
  const std::vector<Index> first = start(points, count);
  for (int k = 0; k < count; ++k) centres.row(k) = points.row(first[static_cast<std::size_t>(k)]);
  Clusters found;
  for (bool changed = true; changed && found.rounds < 1000; ++found.rounds) {
    std::vector<int> of;
    for (Index r = 0; r < points.rows(); ++r) of.push_back(nearest_centre(centres, points.row(r)));
    changed = of != found.of;
    found.of = of;
    move_centres(points, found.of, centres);
  }
  // Numbered by the first row.
  std::vector<int> number(static_cast<std::size_t>(count), -1);
  int next = 0;
  for (int& one : found.of) {
    if (number[static_cast<std::size_t>(one)] < 0) number[static_cast<std::size_t>(one)] = next++;
    one = number[static_cast<std::size_t>(one)];
  }
  found.centres = MatrixXd(next, points.cols());
  double within = 0.0;
  for (Index k = 0; k < count; ++k)
    if (const int own = number[static_cast<std::size_t>(k)]; own >= 0)
      found.centres.row(own) = centres.row(k).cwiseProduct(scale.deviation.transpose()) + scale.mean.transpose();
  const MatrixXd own_scaled = scale.scaled(found.centres);
  for (Index r = 0; r < points.rows(); ++r) within += (points.row(r) - own_scaled.row(found.of[static_cast<std::size_t>(r)])).squaredNorm();
  const double all = points.squaredNorm();
  found.share_between = all > 0.0 ? 1.0 - within / all : 1.0;
  return found;
}

}  // namespace snug::materials
