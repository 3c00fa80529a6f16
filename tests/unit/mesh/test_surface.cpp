#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {
namespace {

class SurfaceFile {
 public:
  explicit SurfaceFile(const std::string& text)
      : path(std::filesystem::temp_directory_path() /
             (std::string("snug-") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".surface")) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~SurfaceFile() { std::filesystem::remove(path); }
  const std::filesystem::path path;
};

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

double volume(const TriangleSurface& surface) {
  double sum = 0.0;
  for (const auto& t : surface.triangles) {
    const auto &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
    sum += (a.x() * (b.y() * c.z() - b.z() * c.y()) + a.y() * (b.z() * c.x() - b.x() * c.z()) +
            a.z() * (b.x() * c.y() - b.y() * c.x())) /
           6.0;
  }
  return sum;
}

void expect_tetrahedron(const std::string& text) {
  const SurfaceFile file(text);
  const TriangleSurface surface = read_surface(file.path);
  EXPECT_EQ(surface.vertices.size(), 4u);
  EXPECT_EQ(surface.triangles.size(), 4u);
  EXPECT_NEAR(volume(surface), 1.0 / 6.0, 1e-7);
  EXPECT_NO_THROW(check_closed(surface, {}));
}

std::string tetrahedron_as_text_stl() {
  const std::array<std::string, 4> corners = {"0 0 0", "1.0 0 0", "0 1e+000 0", "0 0 1"};
  std::string text = "solid t\n";
  for (auto [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    text += "facet normal 0 0 0\n outer loop\n  vertex " + corners[a] + "\n  vertex " + corners[b] + "\n  vertex " +
            corners[c] + "\n endloop\nendfacet\n";
  return text + "endsolid t\n";
}

std::string tetrahedron_as_binary_stl() {
  std::string bytes = "solid, says the head of a binary file too";
  bytes.resize(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{4});
  const std::array<std::array<float, 3>, 4> v = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (auto corners : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    put(std::array<float, 3>{});
    for (int corner : corners) put(v[corner]);
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string tetrahedron_as_ply(const std::string& format) {
  std::string text = "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                     "element face 4\nproperty list uchar int vertex_indices\nelement edge 1\nproperty short a\nend_header\n";
  const bool big = format == "binary_big_endian", ascii = format == "ascii";
  const auto put = [&](auto value) {
    if (ascii) {
      text += std::to_string(value) + ' ';
      return;
    }
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (big) std::reverse(bytes.begin(), bytes.end());
    text += bytes;
  };
  for (const auto& x : {std::array<float, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    for (const float value : x) put(value);
    put(std::uint8_t{200});
  }
  for (const auto& t : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    put(std::uint8_t{3});
    for (const int corner : t) put(corner);
  }
  put(std::int16_t{-7});
  return text;
}

TEST(Surface, PlyIsReadAsTextAndInBothByteOrders) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) expect_tetrahedron(tetrahedron_as_ply(format));
}

TEST(Surface, OffIsReadWithCommentsAndColours) {
  expect_tetrahedron("OFF\n# by hand\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n\n0 0 1 # the top\n3 0 2 1\n3 0 1 3 255 0 0\n3 1 2 3\n3 0 3 2\n");
  expect_tetrahedron("OFF 4 4 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 1\r\n3 0 2 1\r\n3 0 1 3\r\n3 1 2 3\r\n3 0 3 2\r\n");
}

TEST(Surface, FaultsOfPlyAndOffAreSaidWithTheirPlace) {
  const auto error_of = [](const std::string& text) {
    const SurfaceFile file(text);
    try {
      read_surface(file.path);
    } catch (const input::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string ply = tetrahedron_as_ply("binary_little_endian");
  EXPECT_NE(error_of(ply.substr(0, ply.size() - 9)).find("ends before"), std::string::npos);
  EXPECT_NE(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n").find(":4:"), std::string::npos);
  EXPECT_NE(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 a\n").find("\"a\" is no number"), std::string::npos);
  EXPECT_NE(error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find(":6:"), std::string::npos);
  EXPECT_NE(error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n").find("ends before"), std::string::npos);
}

TEST(Surface, TheSameBodyIsReadFromEveryFormat) {
  expect_tetrahedron("# a comment\nmtllib x.mtl\no body\n" + vertices +
                     "vn 0 0 1\nf 1//1 3//1 2//1\nf 1/1 2/1 4/1\n"
                     "f -3 -2 -1\nf 1 4 3\n");
  expect_tetrahedron("begin\r\n" + vertices + faces + "end\r\n");
  expect_tetrahedron(faces + vertices);  // faces may come first
  expect_tetrahedron(tetrahedron_as_text_stl());
  expect_tetrahedron(tetrahedron_as_binary_stl());
}

TEST(Surface, FilesOfOldAndCarelessProgramsAreRead) {
  // Text STL in capitals, lines that go on behind a backslash, bytes behind the last facet of a binary file.
  std::string capitals = tetrahedron_as_text_stl();
  std::transform(capitals.begin(), capitals.end(), capitals.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  for (std::size_t at = 0; (at = capitals.find('\n', at)) != std::string::npos; at += 2) capitals.insert(at, "\r");
  expect_tetrahedron(capitals);
  expect_tetrahedron(vertices + "f 1 \\\n3 2\nf 1 2 4\nf 2 3 \\\r\n 4\nf 1 4 3\n");
  expect_tetrahedron(tetrahedron_as_binary_stl() + std::string("made by a program\0", 18));
}

TEST(Surface, ASeamThatPartsInTheLastDigitIsClosed) {
  // Two sides of an edge 3e-6 apart on a body of 1.7: six digits. A gap of 1e-3 stays one.
  const std::string apart = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1.000003 0 0\nf 1 3 2\nf 1 5 4\nf 5 3 4\nf 1 4 3\n";
  expect_tetrahedron(apart);
  std::string wide = apart;
  wide.replace(wide.find("1.000003"), 8, "1.001");
  const SurfaceFile file(wide);
  EXPECT_THROW(check_closed(read_surface(file.path), {}), input::InputError);
}

TEST(Surface, PolygonsAreFannedAndDuplicatesWelded) {
  const SurfaceFile file(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nv 0.5 0.5 4.53292e-005\nf 1 2 3 4\nf 5 2 6\nf 1 5 2\n");
  const TriangleSurface surface = read_surface(file.path);
  EXPECT_EQ(surface.vertices.size(), 5u);
  EXPECT_EQ(surface.triangles.size(), 3u);  // the last face has two equal corners
}

TEST(Surface, AHoleIsNamedByTheCoordinatesOfAnOpenEdge) {
  const SurfaceFile file(vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\n");
  const TriangleSurface surface = read_surface(file.path);
  try {
    check_closed(surface, {"body.obj"});
    ADD_FAILURE();
  } catch (const input::InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"body.obj", "3 edges", "(0, 0, 0)", "close the hole"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  EXPECT_NO_THROW(check_closed(surface, {}, HeightRange{1.5, 2.0}));
  EXPECT_THROW(check_closed(surface, {}, HeightRange{0.2, 0.4}), input::InputError);
}

TEST(Surface, WrongRecordsAreRefusedWithLineAndColumn) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& parts) {
    const SurfaceFile file(text);
    try {
      read_surface(file.path);
      ADD_FAILURE() << text;
    } catch (const input::InputError& error) {
      for (const auto& part : parts) EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused("v 0 0\n", {":1:1: error", "2 coordinates"});
  refused(vertices + "v 0 x 0\n", {":5:5: error", "\"x\" is no number"});
  refused("v nan 0 0\n", {":1:3: error"});
  refused(vertices + "f 1 2 9\n", {":5:1: error", "vertex 9 of 4"});
  refused(vertices + "f 1 2\n", {":5:1: error", "2 vertices"});
  refused(vertices + "f 0 1 2\n", {":5:3: error"});
  refused("<html>\n", {":1:1: error", "no record"});
  refused("", {"no triangles"});
  refused(tetrahedron_as_binary_stl().substr(0, 240), {"neither text nor a complete binary STL: it announces 4 facets and has room for 3"});
  EXPECT_THROW(read_surface("/nowhere/body.obj"), input::InputError);
  refused("solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", {":6:1: error", "three vertices"});
}

}  // namespace
}  // namespace snug::mesh
