// Garments over one another: what the skin feels and what passes between them, against closed forms and the radial equation.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/radial_limb.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

using std::numbers::pi;

/// A sleeve as cut: rest radius (m), stiffness (N/m), heights between which it is placed (m), garment cell (m; 0: the usual).
struct Cut {
  double radius, stiffness, lower, upper, cell = 0.0;
};

std::string linear(double k) { return fmt::format("law = 'linear'\nwarp = '{0} N/m'\nweft = '{0} N/m'\nshear = '{1} N/m'\npoisson = 0", k, 0.3 * k); }

/// Sleeves "inner" and "outer" on the tube, held at both edges along the axis, without friction.
input::Case dressed(const TubeCase& tube, const Cut& inner, const Cut& outer) {
  input::Case c = describe_tube(tube);
  c.garments.push_back(c.garments.front());
  const auto cut = [&](int g, const char* name, const Cut& as) {
    input::GarmentSpec& garment = c.garments[g];
    garment.name = name, garment.cell_size = as.cell, garment.fabric.table = input::table_of(linear(as.stiffness));
    garment.pattern.flat_circumference = 2.0 * pi * as.radius;
    garment.position = as.lower, garment.pattern.length = as.upper - as.lower;
  };
  cut(0, "inner", inner), cut(1, "outer", outer);
  return c;
}

/// Pressure of a sleeve that keeps its length on radius r: T/r with T = k E l, E = (l^2 - 1)/2, l = r over its rest radius.
double pressure(const Cut& cut, double r) {
  const double l = r / cut.radius;
  return cut.stiffness * 0.5 * (l * l - 1.0) * l / r;
}

const postproc::SurfaceContact& row(const postproc::RunResult& result, const std::string& name) {
  for (const auto& contact : result.surface_contacts)
    if (contact.name == name) return contact;
  throw std::runtime_error("no contact " + name);
}

postproc::RunResult worn(const input::Case& c) {
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  EXPECT_LE(result.balance.force_error.norm(), 1e-9 * result.balance.contact_force);
  return result;
}

TubeCase rigid_tube() {
  TubeCase tube;
  tube.tier = input::Tier::L1, tube.around = 24, tube.along = 6;
  return tube;
}

// Membranes have no thickness: both lie at the skin's radius, the outer one bears on the inner, and the skin feels both.
TEST(Layers, TwoSleevesOnARigidCylinderPressTheSkinTogetherAndTheInnerOneWithTheOuter) {
  const TubeCase tube = rigid_tube();
  const Cut inner = {0.044, 1000.0, 0.0, tube.length}, outer = {0.050, 700.0, 0.0, tube.length, 0.0061};
  const postproc::RunResult result = worn(dressed(tube, inner, outer));
  const double p1 = pressure(inner, tube.radius), p2 = pressure(outer, tube.radius);
  book("two sleeves, rigid cylinder", "pressure on the skin, Pa", result.numbers.at("mean_contact_pressure_Pa"), p1 + p2, 1e-4, "T1/r + T2/r");
  book("two sleeves, rigid cylinder", "pressure between, Pa", row(result, "outer on inner").mean_pressure(), p2, 1e-4, "T2/r");
  EXPECT_EQ(row(result, "outer on skin").force, 0.0);
  EXPECT_NEAR(row(result, "inner on skin").force, (p1 + p2) * 2.0 * pi * tube.radius * tube.length, 1e-3 * (p1 + p2) * 2.0 * pi * tube.radius * tube.length);
  // each garment's own field: what bears on its inner side
  const auto& field = result.garment.fields[postproc::field::contact_pressure];
  for (const auto& part : result.garment.parts) {
    double sum = 0.0;
    for (int n = part.first_node; n < part.end_node; ++n) sum += field[n] / (part.end_node - part.first_node);
    EXPECT_NEAR(sum, part.name == "inner" ? p1 + p2 : p2, 1e-2 * p1) << part.name;
  }
}

// The outer one overhangs both edges of the inner: there it presses the skin itself.
TEST(Layers, WhereTheOuterOverhangsItPressesTheSkin) {
  const TubeCase tube = rigid_tube();
  const Cut inner = {0.044, 1000.0, 0.017, 0.043, 0.005}, outer = {0.050, 700.0, 0.0, tube.length, 0.0061};
  const postproc::RunResult result = worn(dressed(tube, inner, outer));
  const double p1 = pressure(inner, tube.radius), p2 = pressure(outer, tube.radius), round = 2.0 * pi * tube.radius;
  book("sleeve over a band, rigid cylinder", "pressure between, Pa", row(result, "outer on inner").mean_pressure(), p2, 1e-3, "T2/r");
  book("sleeve over a band, rigid cylinder", "pressure of the outer on the skin, Pa", row(result, "outer on skin").mean_pressure(), p2, 1e-3, "T2/r");
  book("sleeve over a band, rigid cylinder", "area of the outer on the inner, m2", row(result, "outer on inner").area, round * 0.026, 1e-2, "2 pi r times the band's length");
  book("sleeve over a band, rigid cylinder", "force on the skin, N", row(result, "inner on skin").force + row(result, "outer on skin").force,
       round * (p1 * 0.026 + p2 * tube.length), 1e-3, "membrane: sum of both");
}

// A band over a long sleeve, inside its edges.
TEST(Layers, AStiffBandOverALongSleevePressesThroughIt) {
  const TubeCase tube = rigid_tube();
  const Cut inner = {0.050, 500.0, 0.0, tube.length, 0.004}, outer = {0.048, 3000.0, 0.021, 0.041, 0.004};
  const postproc::RunResult result = worn(dressed(tube, inner, outer));
  const double p1 = pressure(inner, tube.radius), p2 = pressure(outer, tube.radius), round = 2.0 * pi * tube.radius;
  book("band over a sleeve, rigid cylinder", "pressure between, Pa", row(result, "outer on inner").mean_pressure(), p2, 1e-3, "T2/r");
  book("band over a sleeve, rigid cylinder", "force on the skin, N", row(result, "inner on skin").force, round * (p1 * tube.length + p2 * 0.020), 1e-3,
       "membrane: sum of both");
  EXPECT_EQ(row(result, "outer on skin").force, 0.0);
}

TEST(Layers, TwoSleevesOnASoftTubeMeetTheRadialEquationWithTheSumOfBothLaws) {
  TubeCase tube;
  tube.length = 0.030, tube.around = 24, tube.along = 2;
  const Cut inner = {0.044, 600.0, 0.0, tube.length}, outer = {0.050, 900.0, 0.0, tube.length, 0.0055};
  const RadialAnswer exact = solve_limb({{tube.bone, tube.radius, 1e4, 0.49}}, Volumetric::barrier, [&](double r) { return pressure(inner, r) + pressure(outer, r); });
  const postproc::RunResult result = worn(dressed(tube, inner, outer));
  book("two sleeves, soft tube", "pressure on the skin, Pa", result.numbers.at("mean_contact_pressure_Pa"), exact.pressure, 1e-4, "radial equation");
  book("two sleeves, soft tube", "displacement of the skin, m", result.numbers.at("mean_skin_radial_displacement_m"), exact.displacement, 1e-4, "radial equation");
  book("two sleeves, soft tube", "pressure between, Pa", row(result, "outer on inner").mean_pressure(), pressure(outer, tube.radius + exact.displacement), 1e-4,
       "T2/r at the radius of the radial equation");
}

// Cut alike and meshed alike, so that all their nodes lie on one another, two sleeves are one of twice the stiffness.
TEST(Layers, TwoLikeSleevesAreOneOfTwiceTheStiffness) {
  const TubeCase tube = rigid_tube();
  const Cut cut = {0.044, 500.0, 0.0, tube.length};
  input::Case twice = describe_tube(tube);
  twice.garments.front().fabric.table = input::table_of(linear(1000.0));
  const postproc::RunResult two = worn(dressed(tube, cut, cut)), one = worn(twice);
  EXPECT_NEAR(two.numbers.at("mean_contact_pressure_Pa"), one.numbers.at("mean_contact_pressure_Pa"), 1e-7 * one.numbers.at("mean_contact_pressure_Pa"));
  const auto &of_two = two.body.fields[postproc::field::contact_pressure], &of_one = one.body.fields[postproc::field::contact_pressure];
  const double p = 2.0 * pressure(cut, tube.radius);
  for (std::size_t n = 0; n < of_one.size(); ++n) EXPECT_NEAR(of_two[n], of_one[n], 2e-3 * p);
}

}  // namespace
}  // namespace snug::tests
