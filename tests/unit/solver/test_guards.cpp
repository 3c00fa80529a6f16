// Every guard measures what it says, warns beyond its limit, and is silent on a sound result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/scene/body_strain.hpp"
#include "solver/scene/guards.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using postproc::RunResult, postproc::Warning;
using testing::HasSubstr;

TubeCase small() {
  TubeCase tube;
  tube.around = 12, tube.along = 3, tube.through = 1;
  return tube;
}

input::Case frictionless(const TubeCase& tube) {
  input::Case c = describe_tube(tube);
  c.contacts.front().friction = 0.0;
  return c;
}

struct Worn {
  input::Case description;
  solver::Meshes meshes;
  RunResult result;

  explicit Worn(const TubeCase& tube) : description(frictionless(tube)), meshes(make_meshes(description)), result(tests::solve(description, meshes)) {
    EXPECT_EQ(result.status, postproc::Status::converged);
  }
  /// Measures the result anew.
  void look() { result.warnings.clear(), solver::guard(solver::make_model(description, meshes.body), meshes, result); }
  const Warning* warning(const std::string& name) const {
    for (const Warning& w : result.warnings)
      if (w.name == name) return &w;
    return nullptr;
  }
};

// A sleeve of a linear fabric on a tube, whose pressure is exact to 1e-4 elsewhere: no warning, and each measure says what is so:
// strain of the hoop, nothing in folds or slack, all on the skin, area as placed, Laplace's pressure, a body hardly strained.
TEST(Guards, ASoundResultHasNoWarning) {
  const Worn worn(small());
  EXPECT_TRUE(worn.result.warnings.empty()) << worn.result.warnings.front().name << ": " << worn.result.warnings.front().text;
  const auto& n = worn.result.numbers;
  EXPECT_LT(n.at("fabric_largest_strain"), 0.25);  // 0.055 / 0.044 on the rigid skin
  EXPECT_GT(n.at("fabric_largest_strain"), 0.15);
  EXPECT_EQ(n.count("fabric_data_end"), 0u);
  EXPECT_EQ(n.at("gathered_share"), 0.0);
  EXPECT_EQ(n.at("slack_share"), 0.0);
  EXPECT_LT(n.at("off_skin_share"), 0.01);
  EXPECT_NEAR(n.at("contact_area_over_expected"), 1.0, 0.1);
  EXPECT_NEAR(n.at("mean_pressure_over_laplace"), 1.0, 0.02);
  EXPECT_LT(n.at("body_largest_stretch"), 1.5);
  EXPECT_GT(n.at("body_smallest_volume_ratio"), 0.9);
}

// A fabric measured to 20 % that is stretched by 25 % everywhere says so with share, strain, end and remedy; measured to 30 % it
// says nothing.
TEST(Guards, FabricBeyondItsDataIsNamed) {
  for (const double end : {0.2, 0.3}) {
    TubeCase tube = small();
    tube.tier = input::Tier::L1;
    tube.fabric = "law = 'cubic'\nk1 = '1000 N/m'\nk3 = '0 N/m'\nshear = '300 N/m'\ndata_end = " + std::to_string(end);
    const Worn worn(tube);
    EXPECT_NEAR(worn.result.numbers.at("fabric_data_end"), end, 1e-12);
    EXPECT_NEAR(worn.result.numbers.at("fabric_largest_strain"), 0.25, 2e-3);
    const Warning* w = worn.warning("fabric beyond its data");
    if (end > 0.25) {
      EXPECT_EQ(w, nullptr);
      continue;
    }
    ASSERT_NE(w, nullptr);
    EXPECT_EQ(w->quantity, "fabric_beyond_data_share");
    EXPECT_NEAR(w->value, 1.0, 1e-12);
    EXPECT_THAT(w->text, HasSubstr("20.0 %"));
    EXPECT_THAT(w->place, HasSubstr("heights"));
    EXPECT_THAT(w->remedy, HasSubstr("larger size"));
  }
}

// Cloth that is 30 % shorter than taut cloth over half of the sleeve lies in folds there; the contraction of taut cloth by its
// own coupling is none: nu = 0.5 at a hoop stretch of 1.25 contracts it to sqrt(1 - 0.5 (1.25^2 - 1)) = 0.848.
TEST(Guards, GatheredClothIsNamedAndContractionIsNot) {
  TubeCase tube = small();
  tube.tier = input::Tier::L1;
  tube.fabric = "law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '300 N/m'\npoisson = 0.5";
  Worn worn(tube);
  auto& garment = worn.result.garment;
  const double contracted = std::sqrt(1.0 - 0.5 * (1.25 * 1.25 - 1.0));
  auto& stretch = garment.fields[postproc::field::stretch];
  std::fill(stretch.begin(), stretch.end(), Eigen::Vector2d(contracted, 1.25));
  worn.look();
  EXPECT_LT(worn.result.numbers.at("largest_gathering"), 1e-12);
  EXPECT_EQ(worn.warning("gathered cloth"), nullptr);
  double folded = 0.0, area = 0.0;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    const auto& p = garment.pattern;
    const auto& k = garment.triangles[t];
    const Eigen::Vector2d a = p[k[1]] - p[k[0]], b = p[k[2]] - p[k[0]];
    const double part = 0.5 * (a.x() * b.y() - a.y() * b.x());
    area += part;
    if (garment.current[k[0]].z() > 0.03) stretch[t].x() = 0.7 * contracted, folded += part;
  }
  worn.look();
  const Warning* w = worn.warning("gathered cloth");
  ASSERT_NE(w, nullptr);
  EXPECT_NEAR(w->value, folded / area, 1e-12);
  EXPECT_NEAR(worn.result.numbers.at("largest_gathering"), 0.3, 1e-9);
  EXPECT_THAT(w->remedy, HasSubstr("contact.friction"));
}

// A third of the points that stop bearing are a third of the cloth off the skin.
TEST(Guards, ClothOffTheSkinIsNamed) {
  Worn worn(small());
  for (auto& sample : worn.result.samples)
    if (std::atan2(sample.at.y(), sample.at.x()) > std::numbers::pi / 3.0) sample.touching = false, sample.force = 0.0;
  worn.look();
  const Warning* w = worn.warning("cloth off the skin");
  ASSERT_NE(w, nullptr);
  EXPECT_NEAR(w->value, 1.0 / 3.0, 0.02);
}

// A mean pressure of 1.5 times tension times curvature is far from it, one of 0.6 times too; the contact area of a garment that
// has drawn together to half is named where the cloth does touch.
TEST(Guards, PressureAndAreaFarFromWhatGarmentAndLimbSayAreNamed) {
  Worn worn(small());
  const double mean = worn.result.numbers.at("mean_contact_pressure_Pa");
  for (const double factor : {1.5, 0.6}) {
    worn.result.numbers["mean_contact_pressure_Pa"] = factor * mean;
    worn.look();
    const Warning* w = worn.warning("pressure far from Laplace's");
    ASSERT_NE(w, nullptr) << factor;
    EXPECT_NEAR(w->value, factor, 0.03 * factor);
  }
  for (auto& sample : worn.result.samples) sample.area *= 0.5;
  for (auto& x : worn.result.garment.current) x *= std::sqrt(0.5);
  worn.look();
  const Warning* w = worn.warning("contact area");
  ASSERT_NE(w, nullptr);
  EXPECT_NEAR(w->value, 0.5, 0.05);
}

// Strain of the cells is that of the displacements: a homogeneous field has its own stretch and volume in every cell, and one
// beyond the limits is named.
TEST(Guards, StrainOfTheBodyIsMeasuredAndNamed) {
  Worn worn(small());
  const Eigen::Matrix3d F = Eigen::Vector3d(2.5, 0.5, 0.3).asDiagonal();
  for (std::size_t n = 0; n < worn.meshes.body.nodes.size(); ++n)
    worn.result.body.fields[postproc::field::displacement][n] = F * worn.meshes.body.nodes[n] - worn.meshes.body.nodes[n];
  const solver::BodyStrain strain = solver::body_strain(worn.meshes.body, worn.result.body.fields[postproc::field::displacement]);
  EXPECT_NEAR(strain.largest_stretch, 2.5, 1e-9);
  EXPECT_NEAR(strain.smallest_volume_ratio, 2.5 * 0.5 * 0.3, 1e-9);
  worn.look();
  EXPECT_NE(worn.warning("stretched tissue"), nullptr);
  EXPECT_NE(worn.warning("squeezed tissue"), nullptr);
}

// What to try follows from the case: friction where there is none, an edge where none is held, and nothing for an answer.
TEST(Guards, WhatToTryFollowsFromTheCase) {
  input::Case c = frictionless(small());
  const solver::Meshes meshes = make_meshes(c);
  RunResult result;
  result.status = postproc::Status::converged;
  EXPECT_TRUE(solver::what_to_try(solver::make_model(c, meshes.body), meshes, result).empty());
  result.status = postproc::Status::partial, result.truth.stage = "rigid skin";
  EXPECT_THAT(solver::what_to_try(solver::make_model(c, meshes.body), meshes, result), testing::ElementsAre(HasSubstr("contact.friction")));
  c.garments.front().held.clear(), c.contacts.front().friction = 0.3;
  EXPECT_THAT(solver::what_to_try(solver::make_model(c, meshes.body), meshes, result), testing::ElementsAre(HasSubstr("garment.held")));
  c.garments.front().cell_size = 1.0;
  EXPECT_THAT(solver::what_to_try(solver::make_model(c, meshes.body), meshes, result), testing::Contains(HasSubstr("cell_size")));
}

// The state of an answer is that of its last stage, in full.
TEST(Guards, TheStateOfAnAnswerIsItself) {
  const Worn worn(small());
  EXPECT_EQ(worn.result.truth.stage, "body");
  EXPECT_EQ(worn.result.truth.fraction, 1.0);
  EXPECT_EQ(worn.result.truth.stiffening, 1.0);
  EXPECT_TRUE(worn.result.remedies.empty());
}

}  // namespace
}  // namespace snug::tests
