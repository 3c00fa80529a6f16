// The skin unrolled into the plane: angle round the body against height along it.
#pragma once

#include <string>
#include <vector>

#include "postproc/report/region.hpp"
#include "postproc/report/scale.hpp"

namespace snug::postproc::report {

/// A mark on an axis of the map, pixels.
struct MapTick {
  double at = 0.0;
  std::string text;
};

/// A location on the map.
struct MapPatch {
  std::string name, path;   ///< path: its outline
  double x = 0.0, y = 0.0;  ///< middle, pixels
  double label_y = 0.0;     ///< where its name stands, pixels: the middle, or above or below it where another name stands there
};

/// Gives each name a place of its own, as near to the middle of its location as those before it leave it.
void set_labels_apart(std::vector<MapPatch>& patches);

/// The map in pixels; y grows downwards. Its scale along the height is that of the mean girth, so that shapes keep
/// their proportions there.
struct UnrolledMap {
  double width = 0.0, height = 0.0;
  std::string skin;                                        ///< path of all the skin
  std::vector<std::pair<std::string, std::string>> bands;  ///< colour and path of pressure at or above each level
  std::string edge;                                        ///< path of the covered skin
  std::vector<MapPatch> patches;
  std::vector<MapTick> across, along;
  std::string across_name, along_name;      ///< "angle round the body", "height [mm]"
  bool unrolled = true;                     ///< false: the skin is no tube, the map looks at it from its normal
  double largest_x = 0.0, largest_y = 0.0;  ///< where the pressure beside the hems is largest, pixels
  std::string largest_place;                ///< "at 45°, height 210 mm"
};

/// Angles count from +x (0 deg, a limb's outer side) over +y (90 deg, front) round z at the centre of the skin at each
/// height; the cut runs where it divides the fewest locations. A body along another axis is turned to it first.
UnrolledMap unroll(const Skin& skin, const PressureScale& scale, double width);

}  // namespace snug::postproc::report
