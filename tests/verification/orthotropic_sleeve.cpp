// A sleeve of orthotropic fabric on a rigid cylinder (reference book 3, extra garment cases).
#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

// The weft goes round: a sleeve of rest radius 44 mm on a rigid cylinder of 55 mm, held at both hems or free to shorten. Free,
// it stands on the kink between taut and wrinkled and so shortens to where it is taut at the least: an error of h^2.
TEST(OrthotropicSleeve, PressesOnARigidCylinderAsTheLawSays) {
  TubeCase tube;
  tube.fabric = "law = 'linear'\nweft = '1027.749229188078 N/m'\nwarp = '308.3247687564234 N/m'\nshear = '50 N/m'\npoisson = 0.3";
  tube.tier = input::Tier::L1;
  const char* source = "closed form, reference book 3";
  const auto solve = [&](bool held, int around, int along) {
    tube.around = around, tube.along = along, tube.length = along * 2.0 * std::numbers::pi * tube.radius / around;
    input::Case c = describe_tube(tube);
    if (!held) c.garments.front().held.pop_back();
    const postproc::RunResult result = tests::solve(c, make_meshes(c));
    EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
    return result;
  };
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v / static_cast<double>(values.size());
    return sum;
  };
  const auto mean_stretch = [](const postproc::RunResult& result) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const auto& values = result.garment.fields[postproc::field::stretch];
    for (const Eigen::Vector2d& v : values) sum += v / static_cast<double>(values.size());
    return sum;
  };
  const postproc::RunResult held = solve(true, 24, 3), free = solve(false, 72, 3);
  const double l1 = mean_stretch(held).y(), l2 = mean_stretch(free).x();
  book("3 orthotropic sleeve, held", "S11, N/m", mean(held.garment.fields[postproc::field::tension_weft]) / l1, 289.05447071, 1e-4, source);
  book("3 orthotropic sleeve, held", "P11, N/m", mean(held.garment.fields[postproc::field::tension_weft]), 361.31808839, 1e-4, source);
  book("3 orthotropic sleeve, held", "S22, N/m", mean(held.garment.fields[postproc::field::tension_warp]) * l1, 26.01490236, 1e-4, source);
  book("3 orthotropic sleeve, held", "contact pressure, Pa", held.numbers.at("mean_contact_pressure_Pa"), 6569.4197888, 1e-4, source);
  book("3 orthotropic sleeve, free", "stretch along the axis", l2, 0.9117291264, 1e-4, source);
  book("3 orthotropic sleeve, free", "P11, N/m", mean(free.garment.fields[postproc::field::tension_weft]) * l2, 351.5625, 1e-4, source);
  book("3 orthotropic sleeve, free", "contact pressure, Pa", free.numbers.at("mean_contact_pressure_Pa"), 7010.9040823, 1e-4, source);
}

}  // namespace
}  // namespace snug::tests
