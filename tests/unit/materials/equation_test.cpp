// Expressions of the data: values, dimensions, what is refused. Curves between measured points.
#include <gmock/gmock.h>

#include <cmath>

#include "materials/database/curve.hpp"
#include "materials/database/equation.hpp"
#include "materials/database/unit_book.hpp"

namespace snug::testing {
namespace {

using materials::Curve, materials::Dimension, materials::Equation, materials::UnitBook;
using ::testing::ElementsAre, ::testing::HasSubstr;

const input::Location here{"test", 1, 1};

double value(const std::string& text) {
  return Equation::parse(text, here).value([](const std::string& symbol) {
    return symbol == "a" ? 3.0 : symbol == "S'_v" ? 10.0 : 5.0;
  });
}
std::string dimension(const std::string& text) {
  try {
    return Equation::parse(text, here)
        .dimension([](const std::string& symbol) {
          return symbol == "E"     ? Dimension("Pa")
                 : symbol == "h"   ? Dimension("m")
                 : symbol == "w"   ? Dimension("kg/m2")
                 : symbol == "t"   ? Dimension("s")
                 : symbol == "phi" ? Dimension("rad")
                                   : Dimension();
        })
        .text();
  } catch (const input::InputError& error) {
    return error.what();
  }
}
std::string equation_error(const std::string& text) {
  try {
    Equation::parse(text, here);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Equation, PrecedenceIsThatOfSchool) {
  EXPECT_EQ(value("1 + 2*3"), 7.0);
  EXPECT_EQ(value("(1 + 2)*3"), 9.0);
  EXPECT_EQ(value("2 - 3 - 4"), -5.0);
  EXPECT_EQ(value("8/4/2"), 1.0);
  EXPECT_EQ(value("2^3^2"), 512.0);
  EXPECT_EQ(value("-2^2"), -4.0);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("a*S'_v - b"), 25.0);
  EXPECT_EQ(value("max(a, b) + min(a, b)"), 8.0);
  EXPECT_EQ(value("abs(-1.5e1) + +2"), 17.0);
  EXPECT_DOUBLE_EQ(value("log(exp(a))"), 3.0);
  EXPECT_DOUBLE_EQ(value("sin(pi/6) + cos(pi/3) + tan(pi/4)"), 2.0);
  EXPECT_EQ(value("sqrt(a*a)"), 3.0);
  EXPECT_TRUE(std::isnan(value("sqrt(-1)")));
  EXPECT_THAT(Equation::parse("a + b*a + pi", here).symbols(), ElementsAre("a", "b"));
}

TEST(Equation, DimensionsAreThoseOfTheProducts) {
  UnitBook units;
  const auto same = [&](const std::string& text, const std::string& unit) {
    const Dimension found = Equation::parse(text, here).dimension([](const std::string& symbol) {
      return symbol == "E" ? Dimension("Pa") : symbol == "h" ? Dimension("m") : Dimension("kg/m2");
    });
    return found.same_as(Dimension(units.find(unit)->name));
  };
  EXPECT_TRUE(same("E*h", "N/m"));
  EXPECT_TRUE(same("E*h", "gf/cm"));
  EXPECT_TRUE(same("E*h^3/12", "N m"));
  EXPECT_TRUE(same("sqrt(E*h/w)", "m/s"));
  EXPECT_TRUE(same("w/h", "kg/m3"));
  EXPECT_TRUE(same("(E/w)^0.5*h^-0.5", "1/(m s) m")) << "half powers that come out whole";
  EXPECT_FALSE(same("E*h", "N")) << "a product that lacks a length";
  EXPECT_FALSE(same("h", "1/m")) << "a reciprocal is another dimension";
  EXPECT_FALSE(same("1/h", "m"));
}

TEST(Equation, UnlikeThingsAreNotAdded) {
  EXPECT_EQ(dimension("E*h + h*E"), "Pa m");
  EXPECT_THAT(dimension("E + h"), HasSubstr("Pa and m are added or compared"));
  EXPECT_THAT(dimension("max(E, 1)"), HasSubstr("added or compared"));
  EXPECT_THAT(dimension("exp(h)"), HasSubstr("exponential or logarithm of the dimension m"));
  EXPECT_THAT(dimension("sin(h)"), HasSubstr("takes an angle"));
  EXPECT_EQ(dimension("sin(phi)"), "a plain number");
  EXPECT_THAT(dimension("2^h"), HasSubstr("exponent of the dimension m"));
  EXPECT_THAT(dimension("h^c"), HasSubstr("a power that is not written as a number"));
  EXPECT_EQ(dimension("c^c"), "a plain number");
}

TEST(Equation, WhatIsNoEquationIsRefusedWithItsPlace) {
  EXPECT_THAT(equation_error("1 +"), HasSubstr("it ends where a number or a symbol should stand"));
  EXPECT_THAT(equation_error("(1"), HasSubstr("a ) is missing"));
  EXPECT_THAT(equation_error("1 2"), HasSubstr("character 3: \"2\" where the equation should end"));
  EXPECT_THAT(equation_error("a = 1"), HasSubstr("where the equation should end"));
  EXPECT_THAT(equation_error("1e999"), HasSubstr("no finite number"));
  EXPECT_THAT(equation_error("C*(T)*"), HasSubstr("it ends"));
  EXPECT_THAT(equation_error("f(1)"), HasSubstr("no function f"));
  EXPECT_THAT(equation_error("min(1)"), HasSubstr("a , is missing"));
  EXPECT_THAT(equation_error(""), HasSubstr("it ends"));
  EXPECT_THAT(equation_error("a;b"), HasSubstr("where the equation should end"));
  EXPECT_THAT(equation_error(std::string(2001, '1')), HasSubstr("an equation of 2001 characters"));
  EXPECT_THAT(equation_error(std::string(1000, '(')), HasSubstr("nested more than 50 deep"));
  std::string many = "1";
  for (int n = 0; n < 600; ++n) many += "+a";
  EXPECT_THAT(equation_error(many), HasSubstr("more than 500 numbers and symbols"));
}

TEST(UnitBook, UnitsComeToTheirCoherentOnes) {
  // kgf = 9.80665 N by definition; the degree is pi/180.
  UnitBook units;
  EXPECT_DOUBLE_EQ(units.find("gf/cm")->factor, 0.980665);
  EXPECT_EQ(units.find("gf/cm")->name, "N/m");
  EXPECT_DOUBLE_EQ(units.find("kgf/m2")->factor, 9.80665);
  EXPECT_EQ(units.find("kgf/m2")->name, "Pa");
  EXPECT_EQ(units.find("1/cm")->name, "1/m");
  EXPECT_DOUBLE_EQ(units.find("1/cm")->factor, 100.0);
  EXPECT_EQ(units.find("mm")->name, "m");
  EXPECT_EQ(units.find("%")->factor, 0.01);
  EXPECT_EQ(units.find("")->name, "");
  EXPECT_EQ(units.find("W/(m2 K)")->factor, 1.0);
  EXPECT_DOUBLE_EQ(units.find("g cm3/s4")->factor, 1e-9) << "what has no name of its own is made of base units";
  EXPECT_FALSE(units.find("degC")) << "a scale with a zero of its own";
  EXPECT_FALSE(units.find("furlongs of cloth"));
  EXPECT_FALSE(units.find("% Cotton"));
  EXPECT_FALSE(units.find(std::string(100'000, 'm')));
}

TEST(Curve, GoesThroughItsPointsAndIsMonotoneBetween) {
  UnitBook units;
  const Curve curve = Curve::parse("# a step\nx [mm],force [N]\n0,0\n1,0\n2,10\n3,10\n10,11\n", "c.csv", units);
  EXPECT_EQ(curve.at(0.002), 10.0);
  double last = -1.0;
  for (double x = 0.0; x <= 0.01; x += 1e-5) {
    EXPECT_GE(curve.at(x), last);
    EXPECT_GE(curve.at(x), 0.0);
    EXPECT_LE(curve.at(x), 11.0);
    last = curve.at(x);
  }
  EXPECT_NEAR(curve.at(0.0005), 0.0, 1e-12) << "flat where the points are: a cubic spline would swing below";
  EXPECT_TRUE(std::isnan(curve.at(0.011)));
  EXPECT_TRUE(std::isnan(curve.at(-1e-9)));
  const Curve line = Curve::parse("x,y\n0,1\n2,5\n", "c.csv", units);
  EXPECT_DOUBLE_EQ(line.at(1.0), 3.0);
}

TEST(Curve, WhatIsNoCurveIsRefusedWithItsLine) {
  UnitBook units;
  const auto error = [&](const std::string& text) {
    try {
      Curve::parse(text, "c.csv", units);
    } catch (const input::InputError& fault) {
      return std::string(fault.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error("x,y\n0,0\n0,1\n"), HasSubstr("c.csv:3:1: error: the x 0 does not increase"));
  EXPECT_THAT(error("x,y\n0,nan\n1,1\n"), HasSubstr("c.csv:2:1: error: \"nan\" is no finite number"));
  EXPECT_THAT(error("x,y\n0,1\n"), HasSubstr("less than two points"));
  EXPECT_THAT(error("x,y\n0,1,2\n"), HasSubstr("not two cells"));
  EXPECT_THAT(error("x [foo],y\n0,1\n"), HasSubstr("no unit that is one"));
  EXPECT_THAT(error(""), HasSubstr("less than two points"));
}

}  // namespace
}  // namespace snug::testing
