// What of a DXF file concerns pattern pieces.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::mesh {

/// A polyline or a line; `bulges` of the segments after each point: the tangent of a quarter of the arc's angle.
struct DxfPath {
  std::string layer;
  std::vector<Eigen::Vector2d> points;
  std::vector<double> bulges;
  bool closed = false;
  int line = 0;  ///< of the file, about where it ends
};

struct DxfMark {
  std::string layer;
  Eigen::Vector2d place;
  int line = 0;
};

struct DxfBlock {
  std::string name;
  int line = 0;
  std::vector<DxfPath> paths;
  std::vector<DxfMark> points;
  std::vector<std::string> texts;
};

struct DxfFile {
  std::vector<DxfBlock> blocks;    ///< those with a name of their own
  std::vector<std::string> texts;  ///< outside of blocks
  int insert_units = 0;            ///< $INSUNITS; 0: not said
  int scaled_insert = 0;           ///< line of an insert that is scaled; 0: none
};

/// Reads with dxflib. Coordinates in units of the file. Throws input::InputError when it is no DXF text.
DxfFile read_dxf(const std::string& text, const std::string& shown_as);

}  // namespace snug::mesh
