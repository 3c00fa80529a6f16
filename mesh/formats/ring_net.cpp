#include "mesh/formats/ring_net.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace snug::mesh {

namespace {

using curves::Net;
using input::InputError;

const Named<Net>& chosen(const CurveSet& set, const std::string& file, const std::string& name, const input::Location& where) {
  std::vector<std::string> names;
  for (const Named<Net>& one : set.nets) names.push_back("\"" + one.name + "\"");
  if (set.nets.empty()) throw InputError(where, fmt::format("there is no net in {}", file), "give it one under \"nets\" (docs/curves.md)");
  if (name.empty() && set.nets.size() > 1) throw InputError(where, fmt::format("{} has {} nets", file, set.nets.size()), fmt::format("say which by name: {}", fmt::join(names, ", ")));
  const auto it = std::find_if(set.nets.begin(), set.nets.end(), [&](const Named<Net>& one) { return name.empty() || one.name == name; });
  if (it == set.nets.end()) throw InputError(where, fmt::format("there is no net \"{}\" in {}", name, file), fmt::format("it has {}", fmt::join(names, ", ")));
  return *it;
}

Net transposed(const Net& net) {
  Net result{.rows = net.columns, .columns = net.rows, .rows_closed = net.columns_closed, .columns_closed = net.rows_closed, .points = net.points};
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) result.points.col(j * net.rows + i) = net.points.col(i * net.columns + j);
  return result;
}

Net reordered(const Net& net, bool rows, bool columns) {
  Net result = net;
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j)
      result.points.col(i * net.columns + j) = net.points.col((rows ? net.rows - 1 - i : i) * net.columns + (columns ? net.columns - 1 - j : j));
  return result;
}

double area_of_row(const Net& net, int row) {
  double twice = 0.0;
  for (int j = 0; j < net.columns; ++j) {
    const Eigen::Vector3d a = net_point(net, row, j), b = net_point(net, row, j + 1);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// Rows from below, columns counter-clockwise.
Net upright(Net net, const RingNet& ring) {
  if (net.points.rows() != 3 || net.rows_closed == net.columns_closed)
    throw InputError(ring.where, ring.text + " does not go round the body: it is to be closed in one direction and open in the other",
                     "write \"closed\": [false, true] for rows of points that each go once round");
  if (net.rows_closed) net = transposed(net);
  if (net.columns < 4) throw InputError(ring.where, fmt::format("{} has {} points round the body", ring.text, net.columns), "give it four at least");
  if (net.rows < 2) throw InputError(ring.where, ring.text + " has one row", "give it two at least, one above the other");
  double rise = 0.0, turn = 0.0;
  for (int i = 0; i < net.rows; ++i) turn += area_of_row(net, i);
  for (int j = 0; j < net.columns; ++j) rise += net_point(net, net.rows - 1, j).z() - net_point(net, 0, j).z();
  return reordered(net, rise < 0.0, turn < 0.0);
}

}  // namespace

bool has_net(const CurveSet& set, const std::string& name) {
  return std::any_of(set.nets.begin(), set.nets.end(), [&](const Named<Net>& one) { return one.name == name; });
}

RingNet ring_net(const CurveSet& set, const std::filesystem::path& file, const std::string& name, const input::Location& where) {
  const std::string shown = file.filename().string();
  const Named<Net>& named = chosen(set, shown, name, where);
  RingNet ring{.net = {}, .text = fmt::format("the net {}{}", named.name.empty() ? "" : named.name + " of ", shown), .where = where};
  ring.net = upright(named.shape, ring);
  return ring;
}

Eigen::Vector3d net_point(const Net& net, int row, int column) { return net.points.col(row * net.columns + (column + net.columns) % net.columns); }

Eigen::Vector3d middle_of_row(const Net& net, int row) {
  const Eigen::Vector3d mean = net.points.middleCols(row * net.columns, net.columns).rowwise().mean();
  double twice = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  // of triangles from the mean of the points, by their centroids
  for (int j = 0; j < net.columns; ++j) {
    const Eigen::Vector2d a = (net_point(net, row, j) - mean).head<2>(), b = (net_point(net, row, j + 1) - mean).head<2>();
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice += cross, moment += cross * (a + b) / 3.0;
  }
  if (!(twice > 0.0)) return mean;
  return {mean.x() + moment.x() / twice, mean.y() + moment.y() / twice, mean.z()};
}

void check_rises(const RingNet& ring) {
  const Net& net = ring.net;
  for (int j = 0; j < net.columns; ++j)
    for (int i = 0; i + 1 < net.rows; ++i)
      if (!(net_point(net, i + 1, j).z() > net_point(net, i, j).z()))
        throw InputError(ring.where, fmt::format("{} does not go up everywhere: at {:.0f} mm a point lies below the one of the row before it", ring.text, 1e3 * net_point(net, i, j).z()),
                         "let each row lie above the one before it, in the body's frame (z along the axis)");
}

}  // namespace snug::mesh
