// Tables of tests as machines write them: pure columns with units in the head.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/choice.hpp"
#include "cases/input/csv.hpp"

namespace snug::materials {

enum class TestKind { tensile, shear, bending, compression, friction, roughness };
constexpr auto texts_of(TestKind) {
  return std::array{"tensile", "shear", "bending", "compression", "friction", "roughness"};
}

/// Sizes of the specimen, where the columns are forces and extensions; 0 = not known. The remedies say where to give
/// them.
struct Specimen {
  double width = 0.0, gauge_length = 0.0;  ///< m
  std::string width_remedy = {}, gauge_remedy = {};
};

/// A point of a test in the order of time, SI.
struct Sample {
  double x = 0.0, y = 0.0;
  int line = 0;  ///< of the table
};

/// One test of one specimen. x and y are
///   tensile       strain (1), force per width (N/m)
///   shear         angle (rad), force per width (N/m)
///   bending       curvature (1/m), moment per width (N)
///   compression   thickness (m), pressure (Pa)
///   friction      distance (m), coefficient (1)
///   roughness     distance (m), height (m)
struct RawTest {
  TestKind kind = TestKind::tensile;
  std::vector<Sample> samples = {};
  input::Location where = {};  ///< the file
};

/// Reads a table and tells by its columns which test it is. Throws input::InputError with file, line and what to write.
RawTest read_test(const std::filesystem::path& file, const Specimen& specimen);
/// The same of a table that is one of a tensile test.
RawTest tensile_test(const input::Csv& csv, const Specimen& specimen);

}  // namespace snug::materials
