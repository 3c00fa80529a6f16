// The typed content of a case directory: plain structs, every value in SI, every error already reported.
#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "cases/input/material_reference.hpp"

namespace snug::input {

/// One layer of the body, listed from the inside out.
struct LayerSpec {
  std::string name;
  MaterialReference material;
  std::optional<double> thickness;    ///< m; one solid layer may leave it out and takes the rest
  std::string form = "solid";         ///< rigid | solid | membrane (skin: membrane by default)
  int cells = 2;                      ///< hexahedra through the layer (solid)
  Location where;
};

/// A named patch of skin: sector of angle round the axis and range of height. Angle 0 = side (+x), 90 deg = front (+y).
struct LocationSpec {
  std::string name;                   ///< key of the sensation curve, e.g. "Front thigh"
  double from_angle = 0.0, to_angle = 0.0;              ///< rad
  std::optional<double> from_height, to_height;         ///< m
};

/// Bone outline for scans: an ellipse that follows the limb's centre line.
struct BoneSpec {
  double girth = 0.0;                 ///< m
  double width_to_depth = 1.0;
  std::array<double, 2> offset = {0.0, 0.0};            ///< m, from the section's centroid (x, y)
};

/// A plane that cuts a scanned surface (point and outward normal in the frame of the body, metres).
struct CutPlane {
  std::array<double, 3> point = {0, 0, 0};
  std::array<double, 3> normal = {0, 0, 1};
};

struct ScanSpec {
  std::filesystem::path surface;      ///< OBJ, STL or v/f text
  double unit = 1.0;                  ///< metres per file unit
  std::string up = "z", front = "y";  ///< file axes that become +z and +y ("y", "-z", ...)
  CutPlane lower, upper;              ///< in the file's frame, in metres
  double smoothing_radius = 0.0;      ///< m; 0 = two cell widths
  BoneSpec bone;
};

struct BodySpec {
  std::string kind = "stations";      ///< stations | scan
  std::filesystem::path stations;     ///< CSV
  std::optional<ScanSpec> scan;
  std::vector<LayerSpec> layers;
  std::vector<LocationSpec> locations;
  int cells_around = 24, cells_along = 12;
  std::string ends = "sliding";       ///< cut planes: sliding (no axial displacement) | free | fixed
  Location where;
};

struct PatternSpec {
  std::string kind = "tube";
  double flat_circumference = 0.0;    ///< m
  double length = 0.0;                ///< m
};

struct HeldEdge {
  std::string edge;                   ///< upper | lower
  std::string held = "axis";          ///< axis: no displacement along the body's axis | all
};

struct GarmentSpec {
  PatternSpec pattern;
  MaterialReference fabric;
  std::string warp = "along";         ///< along | around the body's axis
  double position = 0.0;              ///< m; height of the lower edge as placed
  double cell_size = 0.0;             ///< m; 0 = the skin's mean cell size
  std::vector<HeldEdge> held;
  Location where;
};

struct ContactSpec {
  std::string basis = "hat";          ///< hat | dual: test functions of the weighted gap
};

struct ComfortSpec {
  MaterialReference curves;           ///< "wear trial 2002" or a CSV file of the case
};

/// Follower pressure on the skin (no garment needed).
struct LoadSpec {
  double skin_pressure = 0.0;         ///< Pa
};

struct SolverSpec {
  std::string tier = "L4";            ///< L0 | L1 | L4
};

/// A case directory, read.
struct Case {
  std::string title;
  std::filesystem::path directory;
  std::optional<BodySpec> body;
  std::optional<GarmentSpec> garment;
  std::optional<ContactSpec> contact;
  std::optional<ComfortSpec> comfort;
  std::optional<LoadSpec> load;
  SolverSpec solver;
};

struct ReadOptions {
  std::vector<std::string> overrides;  ///< "section.key=value", as of --set
  bool allow_outside = false;
};

/// Reads DIR/case.toml. Throws InputError with every error of the case together.
Case read_case(const std::filesystem::path& directory, const ReadOptions& options = {});

}  // namespace snug::input
