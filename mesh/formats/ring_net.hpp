// A net of points that goes once round an axis: the shape of a garment, or the sections of a limb.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/formats/curve_set.hpp"

namespace snug::mesh {

/// Rows from below, columns counter-clockwise seen from above, closed round an axis along z; m, in the frame of the body.
struct RingNet {
  curves::Net net;
  std::string text;  ///< "the net vest of vest.json"
  input::Location where = {};
};

bool has_net(const CurveSet& set, const std::string& name);

/// The net of that name, or the only one where the name is empty. One whose rows run along the axis or the other way round is turned. Throws
/// input::InputError (at `where`): no such net, not closed in one direction, fewer than two rows or four columns.
RingNet ring_net(const CurveSet& set, const std::filesystem::path& file, const std::string& name, const input::Location& where);

/// Point of a row and a column, which goes on round.
Eigen::Vector3d net_point(const curves::Net& net, int row, int column);

/// Middle of the area that a row goes round, at its mean height.
Eigen::Vector3d middle_of_row(const curves::Net& net, int row);

/// Throws input::InputError where a point does not lie above that of the row before it.
void check_rises(const RingNet& ring);

}  // namespace snug::mesh
