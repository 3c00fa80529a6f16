// snug materials curve FABRIC: the tensile and shear curves of fabrics as a table and as a picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/fabric/fabric_data.hpp"

namespace snug::app {

/// The fabrics that `name` means: one of what ships or of the library, those of the garments of a case (its directory
/// or case.toml), or those of a .toml file of entities. Throws input::InputError.
std::vector<materials::FabricData> fabrics_to_draw(const std::string& name);

/// A curve of a fabric, point by point.
struct FabricCurve {
  enum class Test { tensile, shear } test;
  std::string direction, branch;  ///< "warp"; "loading"
  struct Point {
    double at, force;  ///< strain (1) or angle (rad), N/m
    bool beyond;       ///< the data
  };
  std::vector<Point> points;
  double data_end;  ///< strain or angle; infinite where the law has no range

  std::string name() const {
    return (test == Test::tensile ? "tensile " : "shear ") + direction + (direction.empty() ? "" : " ") + branch;
  }
};

/// With `steps` intervals up to the end of the data and a quarter as many beyond; unloading ends where it began.
std::vector<FabricCurve> fabric_curves(const materials::FabricData& fabric, int steps);

/// CSV, a row a point.
std::string fabric_table(const std::vector<materials::FabricData>& fabrics, int steps);

/// SVG: tensile curves on the left, shear on the right, a row a fabric; dashed beyond the data. Throws
/// input::InputError.
void write_fabric_picture(const std::vector<materials::FabricData>& fabrics, const std::filesystem::path& file);

}  // namespace snug::app
