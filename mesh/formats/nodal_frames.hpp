// Nodes whose supports and forces act along axes of their own.
#pragma once

#include <Eigen/Core>

#include <map>
#include <string>

#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// The axes of nodes, as columns in the global frame.
using NodalFrames = std::map<int, Eigen::Matrix3d>;

/// Axes turned by THXY about z, then by THYZ about the new x, then by THZX about the new y (degrees), each from the first letter
/// to the second (Ansys command reference, N).
Eigen::Matrix3d frame_of_angles(double thxy, double thyz, double thzx);

/// A frame by two points (Abaqus and CalculiX, *TRANSFORM): Cartesian, a on the local x axis and b in the local xy plane; cylindrical, both on
/// the axis, x outwards from it.
struct FrameByPoints {
  Eigen::Vector3d a, b;
  bool cylindrical = false;

  bool is_one() const;
  /// At a node; the global one on the axis of a cylindrical frame.
  Eigen::Matrix3d at(const Eigen::Vector3d& node) const;
};

/// Turns supports and forces, which are given along the axes of their nodes, into the global frame. A support along an axis that
/// is none of the global ones becomes an oblique one unless the node is held along all three; of rotations it is reported.
/// Frames of nodes at which nothing acts say nothing.
void turn_into_global(Model& model, const NodalFrames& frames, const std::string& file, input::Diagnostics& diagnostics);

}  // namespace snug::mesh
