#include <gtest/gtest.h>

#include <cmath>

#include "cases/input/diagnostics.hpp"
#include "postproc/animation/film.hpp"
#include "postproc/animation/four_point.hpp"
#include "postproc/grid.hpp"
#include "postproc/recorders.hpp"
#include "postproc/report/surfaces.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc::animation {
namespace {

using test::fresh_folder;

Eigen::VectorXd column(double value) { return Eigen::VectorXd::Constant(1, value); }

double apart(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return (b - a).cwiseAbs().maxCoeff(); }

Frames sampled(const std::vector<double>& times, double (*f)(double)) {
  Frames frames;
  for (const double t : times) frames.times.push_back(t), frames.values.push_back(column(f(t)));
  return frames;
}

TEST(FourPoint, HasTheWeightsOfTheBook) {
  // Evenly spaced frames: (-1, 9, 9, -1)/16 inside, (5, 15, -5, 1)/16 at an end (reference book, section 9), read off
  // frames that are zero but for one.
  const double inside[] = {-1, 9, 9, -1}, at_start[] = {5, 15, -5, 1};
  for (int one = 0; one < 4; ++one) {
    Frames frames;
    for (int i = 0; i < 4; ++i) frames.times.push_back(i), frames.values.push_back(column(i == one ? 1.0 : 0.0));
    EXPECT_DOUBLE_EQ(between(frames, 1)[0], inside[one] / 16.0);
    EXPECT_DOUBLE_EQ(between(frames, 0)[0], at_start[one] / 16.0);
    EXPECT_DOUBLE_EQ(between(frames, 2)[0], at_start[3 - one] / 16.0);
  }
  // The open polygon of the book, one step with cubic ends: 0.25 1, 2 2.75, 3.5 2.125, 4.75 0.125.
  Frames polygon{{0, 1, 2, 3, 4}, {}};
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), {1, 2}, {3, 3}, {4, 1}, {6, 0}}) polygon.values.push_back(p);
  const Eigen::Vector2d expected[] = {{0.25, 1}, {2, 2.75}, {3.5, 2.125}, {4.75, 0.125}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((between(polygon, i) - expected[i]).norm(), 1e-15);
}

TEST(FourPoint, ReproducesCubicsAndKeepsTheKeyFrames) {
  // Every frame of a film of a cubic lies on it to 1e-12, also where the key frames are unevenly spaced and at the
  // ends; key frames come out bit by bit.
  const auto cubic = [](double t) { return 1.0 - 2.0 * t + 3.0 * t * t - 1.5 * t * t * t; };
  for (const std::vector<double>& times :
       {std::vector<double>{0, 0.25, 0.5, 0.75, 1}, {0, 0.1, 0.4, 0.5, 0.9, 1.0, 2.0}}) {
    const Frames keys = sampled(times, cubic), film = fill_in(keys, apart, 0.0, 200);
    ASSERT_EQ(film.times.size(), 200u);
    std::size_t found = 0;
    for (std::size_t i = 0; i < film.times.size(); ++i) {
      EXPECT_NEAR(film.values[i][0], cubic(film.times[i]), 1e-12);
      for (std::size_t k = 0; k < times.size(); ++k)
        if (film.times[i] == times[k]) found += film.values[i] == keys.values[k];
      EXPECT_TRUE(i == 0 || film.times[i - 1] < film.times[i]);
    }
    EXPECT_EQ(found, times.size());
  }
}

TEST(FourPoint, FramesStandWhereThingsMove) {
  // A film stops where no gap is wider than the step; frames lie dense where the motion is fast, sparse where it is
  // slow.
  const Frames keys = sampled({0, 1, 2, 3, 4, 5, 6, 7, 8}, [](double t) { return std::pow(t / 8.0, 4); });
  const Frames film = fill_in(keys, apart, 0.02, 1000);
  double widest = 0.0;
  for (std::size_t i = 1; i < film.times.size(); ++i)
    widest = std::max(widest, apart(film.values[i - 1], film.values[i]));
  EXPECT_LE(widest, 0.02);
  EXPECT_LT(film.times.size(), 110u);
  EXPECT_EQ(film.times[1], 1.0);                                   // the first gap is narrow already
  EXPECT_NEAR(film.times[film.times.size() - 2], 7.96875, 0.032);  // the last one is cut five times or more
  EXPECT_THROW(between(keys, 8), std::invalid_argument);
  EXPECT_EQ(fill_in({{0.0}, {column(1)}}, apart, 0.0, 10).times.size(), 1u);
}

TEST(Film, IsWrittenFromTheStatesOfARun) {
  // Three states, displacements t^2: the film's frames follow the parabola (three key frames: a quadratic), the last
  // frame is the result, and pressures are not negative in between.
  const auto out = fresh_folder("film");
  RunResult run = test::run_scene();
  write_results(run, {}, out);
  std::vector<GridStep> body, garment;
  for (const double t : {0.0, 0.5, 1.0}) {
    RunResult state = run;
    for (auto& u : state.body.fields[field::displacement]) u *= t * t;
    for (double& p : state.body.fields[field::contact_pressure]) p *= t == 1.0 ? 1.0 : 0.0;
    body.push_back({t, "body_" + std::to_string(t) + ".vtu"}), garment.push_back({t, "garment_0000.vtu"});
    write_body(state.body, {}, out / body.back().file);
  }
  EXPECT_THROW(make_film(out, out / "animation", {}), input::InputError);  // one state
  write_series(body, out / "body.pvd"), write_series(garment, out / "garment.pvd");
  const Film film = make_film(out, out / "animation", {.step = 0.0, .most = 17});
  EXPECT_EQ(film.keys, 3u);
  EXPECT_EQ(film.frames, 17u);
  const auto steps = read_series(out / "animation/skin.pvd");
  ASSERT_EQ(steps.size(), 17u);
  ASSERT_EQ(read_series(out / "animation/garment.pvd").size(), 17u);
  const report::Skin last = report::read_skin(out / body.back().file, out / "skin.csv");
  std::ofstream all(out / "all.csv");
  all << "node\n";
  for (std::size_t n = 0; n < last.nodes.size(); ++n) all << n + 1 << '\n';
  all.close();
  for (const GridStep& step : steps) {
    const report::Skin frame = report::read_skin(out / "animation" / step.file, out / "all.csv");
    ASSERT_EQ(frame.triangles.size(), last.triangles.size());
    for (std::size_t n = 0; n < last.nodes.size(); ++n) {
      EXPECT_LT((frame.displacement[n] - step.time * step.time * last.displacement[n]).norm(), 1e-12);
      EXPECT_GE(frame.pressure[n], 0.0);
    }
  }
}

}  // namespace
}  // namespace snug::postproc::animation
