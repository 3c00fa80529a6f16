#include "mesh/curves/four_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mesh/curves/binomial.hpp"

namespace snug::mesh::curves {

namespace {

/// The point before the first one of `points`, which are given from the end inwards: their polynomial at -1.
Eigen::VectorXd beyond(const Eigen::MatrixXd& points) {
  const int count = static_cast<int>(points.cols());
  Eigen::VectorXd point = Eigen::VectorXd::Zero(points.rows());
  for (int k = 0; k < count; ++k) point += (k % 2 == 0 ? 1.0 : -1.0) * binomial(count, k + 1) * points.col(k);
  return point;
}

}  // namespace

Eigen::MatrixXd subdivided(const Eigen::MatrixXd& points, bool closed, double tension) {
  const int count = static_cast<int>(points.cols()), intervals = closed ? count : count - 1;
  if (count < (closed ? 3 : 2))
    throw std::invalid_argument(fmt::format("{} points; a curve has two, a closed one three at least", count));
  Eigen::MatrixXd long_row(points.rows(), count + 3);  // one point before, two after
  long_row.middleCols(1, count) = points;
  if (closed) {
    long_row.col(0) = points.col(count - 1);
    long_row.rightCols(2) = points.leftCols(2);
  } else {
    const int inward = std::min(count, 4);
    long_row.col(0) = beyond(points.leftCols(inward));
    long_row.col(count + 1) = beyond(points.rightCols(inward).rowwise().reverse());
  }
  Eigen::MatrixXd fine(points.rows(), count + intervals);
  for (int i = 0; i < count; ++i) fine.col(2 * i) = points.col(i);
  for (int i = 0; i < intervals; ++i)
    fine.col(2 * i + 1) = (0.5 + tension) * (long_row.col(i + 1) + long_row.col(i + 2)) -
                          tension * (long_row.col(i) + long_row.col(i + 3));
  return fine;
}

Net subdivided(const Net& net, double tension) {
  if (net.points.cols() != static_cast<Eigen::Index>(net.rows) * net.columns)
    throw std::invalid_argument(
        fmt::format("{} points are no net of {} by {}", net.points.cols(), net.rows, net.columns));
  // A row of the net with its points one below the other is one point of a curve through the rows.
  const Eigen::Index dimension = net.points.rows();
  Net fine = net;
  const Eigen::MatrixXd rows =
      subdivided(net.points.reshaped(dimension * net.columns, net.rows), net.rows_closed, tension);
  fine.rows = static_cast<int>(rows.cols());
  const Eigen::MatrixXd between = rows.reshaped(dimension, static_cast<Eigen::Index>(fine.rows) * net.columns);
  fine.columns = net.columns_closed ? 2 * net.columns : 2 * net.columns - 1;
  fine.points.resize(dimension, static_cast<Eigen::Index>(fine.rows) * fine.columns);
  for (int i = 0; i < fine.rows; ++i)
    fine.points.middleCols(static_cast<Eigen::Index>(i) * fine.columns, fine.columns) = subdivided(
        between.middleCols(static_cast<Eigen::Index>(i) * net.columns, net.columns), net.columns_closed, tension);
  return fine;
}

}  // namespace snug::mesh::curves
