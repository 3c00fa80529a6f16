#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "mesh/body/fourier_outline.hpp"
#include "mesh/body/sections.hpp"
#include "mesh/body/smoothing.hpp"
#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

using std::numbers::pi;
using Surface = std::function<Eigen::Vector3d(double turn, double height)>;

/// Writes closed tubes (with caps) as OBJ with y up and z to the front: x = side, as the body's frame turned.
class ScanFile {
 public:
  explicit ScanFile(const std::vector<Surface>& tubes, double scale = 1.0, bool capped = true)
      : path(std::filesystem::temp_directory_path() /
             (std::string("snug-") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".obj")) {
    std::ofstream file(path);
    file.precision(12);
    int base = 1;
    for (const auto& tube : tubes) base += write_tube(file, tube, base, scale, capped);
  }
  ~ScanFile() { std::filesystem::remove(path); }

  /// A scan body between heights 0.1 and 0.3 m.
  input::BodySpec spec() const {
    input::BodySpec spec = layered_spec();
    spec.kind = input::BodyKind::scan;
    spec.scan.emplace();
    spec.scan->surface = path;
    spec.scan->up = input::FileAxis::y;
    spec.scan->front = input::FileAxis::z;
    spec.scan->lower = input::CutPlane{{0, 0.1, 0}, {0, -1, 0}};
    spec.scan->upper = input::CutPlane{{0, 0.3, 0}, {0, 1, 0}};
    spec.scan->smoothing_radius = 0.01;
    spec.scan->bone = input::BoneSpec{.girth = 0.09};
    return spec;
  }
  const std::filesystem::path path;

 private:
  static constexpr int around = 120, along = 81;

  static int write_tube(std::ofstream& file, const Surface& tube, int base, double scale, bool capped) {
    const auto vertex = [&](const Eigen::Vector3d& x) {  // body (side, front, up) -> file (-side, up, front)
      file << "v " << -x.x() / scale << ' ' << x.z() / scale << ' ' << x.y() / scale << '\n';
    };
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < around; ++i) vertex(tube(i / double(around), 0.4 * j / (along - 1)));
    vertex({tube(0, 0).x() - 0.01, tube(0.25, 0).y() - 0.01, 0.0});
    vertex({tube(0, 0.4).x() - 0.01, tube(0.25, 0.4).y() - 0.01, 0.4});
    const auto node = [&](int i, int j) { return base + j * around + i % around; };
    for (int i = 0; i < around; ++i) {
      for (int j = 0; j + 1 < along; ++j)
        file << "f " << node(i, j) << ' ' << node(i + 1, j) << ' ' << node(i + 1, j + 1) << ' ' << node(i, j + 1)
             << '\n';
      if (!capped) continue;
      file << "f " << node(i + 1, 0) << ' ' << node(i, 0) << ' ' << base + around * along << '\n';
      file << "f " << node(i, along - 1) << ' ' << node(i + 1, along - 1) << ' ' << base + around * along + 1 << '\n';
    }
    return around * along + 2;
  }
};

Surface round_tube(double radius, double x = 0.0, double y = 0.0) {
  return [=](double turn, double z) {
    return Eigen::Vector3d(x + radius * std::cos(2 * pi * turn), y + radius * std::sin(2 * pi * turn), z);
  };
}

std::string error_of(const input::BodySpec& spec) {
  try {
    make_limb(spec);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_error(const input::BodySpec& spec, const std::string& part) {
  EXPECT_NE(error_of(spec).find(part), std::string::npos) << error_of(spec) << "\nlacks: " << part;
}

TEST(Scan, ACylinderComesBackWithItsRadiusItsPlaceAndItsCurvature) {
  const ScanFile file({round_tube(0.05, 0.02, -0.01)});
  const Limb limb = make_limb(file.spec());
  EXPECT_DOUBLE_EQ(limb.lower, 0.1);
  EXPECT_DOUBLE_EQ(limb.upper, 0.3);
  EXPECT_NEAR(limb.girth(0.2) / (2 * pi * 0.05), 1.0, 1e-3);  // the file's facets are chords
  for (double turn : {0.0, 0.3, 0.77}) {
    EXPECT_NEAR(limb.skin_curvature(turn, 0.21)[0] * 0.05, 1.0, 2e-3);
    EXPECT_NEAR(limb.skin_curvature(turn, 0.21)[1] * 0.05, 0.0, 1e-6);
  }
  EXPECT_LT((limb.skin->at(0, 0.2) - Eigen::Vector3d(0.07, -0.01, 0.2)).norm(), 1e-4);
  EXPECT_LT((limb.skin->at(0.25, 0.2) - Eigen::Vector3d(0.02, 0.04, 0.2)).norm(), 1e-4);
  EXPECT_LT(limb.residual.max, 5e-5);
  EXPECT_DOUBLE_EQ(limb.residual.smoothing_radius, 0.01);
}

TEST(Scan, UnitsAreOfNoConsequence) {
  const ScanFile file({round_tube(0.05)}, 1e-3);  // a file in millimetres
  input::BodySpec spec = file.spec();
  spec.scan->unit = 1e-3;
  EXPECT_NEAR(make_limb(spec).girth(0.2) / (2 * pi * 0.05), 1.0, 1e-3);
}

TEST(Scan, AnEllipticConeKeepsItsShapeUnderSmoothing) {
  const auto cone = [](double turn, double z) {
    const double scale = 1.0 + 0.5 * z;
    return Eigen::Vector3d(0.06 * scale * std::cos(2 * pi * turn), 0.045 * scale * std::sin(2 * pi * turn), z);
  };
  const Limb limb = make_limb(ScanFile({cone}).spec());
  const Ellipse truth{0, 0.066, 0.0495, 0, 0};
  const double girth = straight_limb(truth, truth, 0, 1).girth(0.2);
  EXPECT_NEAR(limb.girth(0.2) / girth, 1.0, 1e-3);
  EXPECT_LT(limb.residual.rms, 1e-4);
  const auto table = girth_table(limb, 3);
  EXPECT_NEAR(table[1].width, 0.132, 2e-4);
  EXPECT_NEAR(table[1].depth, 0.099, 2e-4);
}

TEST(Scan, NoiseOfHalfAMillimetreIsFilteredOutOfTheCurvature) {
  const auto noisy = [](double turn, double z) {
    const double noise = 5e-4 * std::sin(1e4 * std::sin(37 * turn + 1) + 3e3 * std::cos(91 * z));  // without pattern
    return round_tube(0.05 + noise)(turn, z);
  };
  const ScanFile file({noisy});
  input::BodySpec spec = file.spec();
  spec.scan->smoothing_radius = 0.03;
  const Limb limb = make_limb(spec);
  EXPECT_GT(limb.residual.rms, 1e-4);
  EXPECT_LT(limb.residual.max, 1e-3);
  for (double turn = 0; turn < 1; turn += 0.05) EXPECT_NEAR(limb.skin_curvature(turn, 0.2)[0] * 0.05, 1.0, 0.06);
}

TEST(Scan, TheLegNearestToTheCutPlanesPointIsTaken) {
  const ScanFile file({round_tube(0.05, 0.08), round_tube(0.04, -0.08)});
  input::BodySpec spec = file.spec();
  spec.scan->lower->point = {-0.1, 0.1, 0};  // file x is the body's -x
  spec.scan->upper->point = {-0.1, 0.3, 0};
  EXPECT_NEAR(make_limb(spec).girth(0.2) / (2 * pi * 0.05), 1.0, 1e-3);
  spec.scan->lower->point[0] = spec.scan->upper->point[0] = 0.1;
  EXPECT_NEAR(make_limb(spec).girth(0.2) / (2 * pi * 0.04), 1.0, 1e-3);
  spec.scan->lower->point[0] = -0.1;
  expect_error(spec, "different parts");
}

TEST(Scan, TheBodyMeshOfAScanIsSoundAndGarmentsFitIt) {
  const ScanFile file({round_tube(0.05, 0.02, -0.01)});
  const Limb limb = make_limb(file.spec());
  const BodyMesh mesh = make_body_mesh(file.spec(), limb);
  for (const auto& row : quality(mesh)) EXPECT_GT(row.min_scaled_jacobian, 0.9);
  const double bone = 0.09 / (2 * pi);
  EXPECT_NEAR((quality(mesh)[0].volume + quality(mesh)[1].volume) / (pi * 0.2 * (0.0025 - bone * bone)), 1.0, 2e-3);
  EXPECT_NO_THROW(make_tube_mesh(tube_spec(0.28, 0.1, 0.15), limb, 0.02));
}

TEST(Scan, WrongScansAreRefusedWithARemedy) {
  const ScanFile file({round_tube(0.05)});
  const auto with = [&](auto change) {
    input::BodySpec spec = file.spec();
    change(*spec.scan);
    return spec;
  };
  expect_error(with([](auto& s) { s.front = input::FileAxis::minus_y; }), "lie along one axis");
  expect_error(with([](auto& s) { s.lower->normal = {1, 1, 0}; }), "tilted by 45 degrees");
  expect_error(with([](auto& s) { s.upper->point[1] = 0.05; }), "not above the lower one");
  expect_error(with([](auto& s) { s.upper->point[1] = 0.5; }), "ends or joins");
  expect_error(with([](auto& s) { s.lower->point[1] = -0.5; }), "misses the surface");
  expect_error(with([](auto& s) { s.unit = 0; }), "unit");
  expect_error(with([](auto& s) { s.bone->girth = 0; }), "bone has a girth of 0");
  expect_error(with([](auto& s) { s.bone->girth = 0.4; }), "bone is outside the skin at height");
  expect_error(with([](auto& s) { s.surface = "/nowhere.obj"; }), "no such file");
}

TEST(Scan, AHoleBetweenTheCutPlanesIsRefusedAndOneBeyondThemIsNot) {
  const ScanFile open({round_tube(0.05)}, 1.0, false);  // no caps at 0 and 0.4 m
  EXPECT_EQ(error_of(open.spec()), "no error");
  input::BodySpec spec = open.spec();
  spec.scan->upper->point[1] = 0.4;
  expect_error(spec, "not closed");
}

TEST(Scan, AUnitThatIsLeftOutIsTheOneInWhichTheCutsLieInTheSurface) {
  // A piece of a limb, 400 mm long, counted in mm, cm, m and inches: its cuts are 0.1 and 0.3 m up, and its radius comes back as 50 mm. By its
  // size alone the one in mm (400) could be told, one of 40 in inches (15.7) not.
  for (const double unit : {1e-3, 1e-2, 1.0, 0.0254}) {
    const ScanFile file({round_tube(0.05)}, unit);
    input::BodySpec spec = file.spec();
    spec.scan->unit.reset();
    ASSERT_EQ(error_of(spec), "no error") << unit;
    EXPECT_NEAR(make_limb(spec).girth(0.2), 2 * pi * 0.05, 2e-4) << unit;
  }
  // A forearm of 200 units is 200 mm and no body of 2 m.
  const ScanFile arm({round_tube(0.05)}, 2e-3);
  input::BodySpec spec = arm.spec();
  spec.scan->unit.reset();
  spec.scan->lower->point[1] = 0.05, spec.scan->upper->point[1] = 0.15;
  ASSERT_EQ(error_of(spec), "no error");
  EXPECT_NEAR(make_limb(spec).girth(0.1), 2 * pi * 0.025, 2e-4);
}

TEST(Scan, AFaceThatIsMissingIsFilledAndOneThatIsThereTwiceGoes) {
  // Between the cuts, where they were refused; each is said with its place.
  for (const bool twice : {false, true}) {
    const ScanFile file({round_tube(0.05)});
    std::ifstream in(file.spec().scan->surface);
    std::string text, line, changed;
    for (int faces = 0; std::getline(in, line);) {
      const bool chosen = line.starts_with("f ") && ++faces == 60;
      for (int n = chosen ? (twice ? 2 : 0) : 1; n > 0; --n) changed += line + "\n";
    }
    in.close();
    std::ofstream(file.spec().scan->surface) << changed;
    ASSERT_EQ(error_of(file.spec()), "no error");
    const Limb limb = make_limb(file.spec());
    EXPECT_NEAR(limb.girth(0.2), 2 * pi * 0.05, 5e-4);
    std::string said;
    for (const input::Diagnostic& remark : limb.remarks) said += remark.found + "\n";
    EXPECT_NE(said.find(twice ? "given twice" : "filled"), std::string::npos) << said;
  }
}

TEST(Scan, LegsThatMergeBetweenThePlanesAreRefusedWithTheHeight) {
  // A tube that jumps from thigh to hips at 0.2 m.
  const auto hips = [](double turn, double z) {
    return Eigen::Vector3d((z < 0.2 ? 0.05 : 0.12) * std::cos(2 * pi * turn), 0.05 * std::sin(2 * pi * turn), z);
  };
  const ScanFile file({hips});
  expect_error(file.spec(), "joins another part of the body at height");
}

TEST(Sections, RaysThroughTheCornersOfASectionMeetIt) {
  constexpr int rays = 1024;
  for (const int corners : {8, 64, 256})
    for (int place = 0; place < 50; ++place) {
      const Eigen::Vector2d from(0.013 * place, -0.007 * place);
      SectionLoop loop;
      for (int n = 0; n < corners; ++n) {
        const double angle = 2.0 * pi * n / corners;
        loop.points.push_back(from + 0.05 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }
      const Eigen::VectorXd radii = ray_radii(loop, from, rays);
      EXPECT_NEAR(radii.minCoeff(), 0.05 * std::cos(pi / corners), 1e-12) << corners << " corners round " << from.transpose();
      EXPECT_NEAR(radii[rays / 8], 0.05, 1e-12);
    }
}

TEST(FourierOutline, DerivativesAgreeWithDifferences) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(9, 6);
  values.row(2).setConstant(0.05);
  for (int n = 0; n < 6; ++n)
    for (int row : {0, 1, 4, 5, 8}) values(row, n) = 0.002 * std::sin(row + n);
  const FourierOutline outline(VectorSpline(0.1, 0.04, values));
  const OutlinePoint exact = outline.derivatives(0.3, 0.2), near = outline.Outline::derivatives(0.3, 0.2);
  EXPECT_LT((exact.x - near.x).norm(), 1e-15);
  EXPECT_LT((exact.x_t - near.x_t).norm(), 1e-8);
  EXPECT_LT((exact.x_z - near.x_z).norm(), 1e-8);
  EXPECT_LT((exact.x_tt - near.x_tt).norm(), 1e-6);
  EXPECT_LT((exact.x_tz - near.x_tz).norm(), 1e-6);
  EXPECT_LT((exact.x_zz - near.x_zz).norm(), 1e-6);
}

TEST(VectorSpline, IsTheNaturalCubicSplineOfTheStations) {
  const std::vector<double> z = {0.1, 0.14, 0.18, 0.22, 0.26}, v = {1, 3, 2, 5, 4};
  Eigen::MatrixXd values(1, 5);
  values << 1, 3, 2, 5, 4;
  const VectorSpline ours(0.1, 0.04, values);
  const Spline gsl(z, v);
  for (double at : {0.05, 0.1, 0.123, 0.18, 0.25, 0.26, 0.3})
    for (int order = 0; order < 3; ++order)
      EXPECT_NEAR(ours.derivatives(at)(0, order), gsl.derivatives(at)[order], 1e-9 * std::pow(100, order)) << at;
}

TEST(Smoothing, StraightLinesPassUnchangedUpToTheEnds) {
  Eigen::MatrixXd values(2, 30);
  for (int n = 0; n < 30; ++n) values.col(n) << 2.0, 1.0 + 0.3 * n;
  EXPECT_LT((smooth_along(values, 0.01, 0.05) - values).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((smooth_along(values, 0.01, 1e-5) - values).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_DOUBLE_EQ(gaussian_pass(0.0, 0.1), 1.0);
  EXPECT_LT(gaussian_pass(100.0, 0.1), 1e-10);
}

}  // namespace
}  // namespace snug::mesh
