// Comfort against the reference book (section 8, fuzzy) and table 5.5 of the source.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/input/csv.hpp"
#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/fuzzy.hpp"
#include "postproc/units.hpp"
#include "tests/fuzzy_example.hpp"
#include "tests/verification/book.hpp"

namespace snug::tests {
namespace {

using postproc::bell, postproc::FuzzySystem, postproc::infer, postproc::Integration;

constexpr const char* book_8 = "reference book 8, s11";

TEST(ComfortBook, MembershipsAndFirings) {
  // Bells and both conjunctions have the printed twelve decimals.
  FuzzySystem system = worked_example();
  const auto answer = infer(system, {1.6, 3.0});
  // Digits are printed to 1e-12 absolute; relative to the smallest number, 0.0067, that is 1e-10.
  book("fuzzy, memberships", "p = 1.60: low", answer.memberships[0][0], 0.225429643364, 1e-10, book_8);
  book("fuzzy, memberships", "p = 1.60: mid", answer.memberships[0][1], 0.837877588127, 1e-10, book_8);
  book("fuzzy, memberships", "p = 1.60: high", answer.memberships[0][2], 0.006671879746, 1e-10, book_8);
  book("fuzzy, memberships", "s = 3.0: soft", answer.memberships[1][0], 0.955423749541, 1e-10, book_8);
  book("fuzzy, memberships", "s = 3.0: stiff", answer.memberships[1][1], 0.117239671654, 1e-10, book_8);
  system.conjunction = "AlgebraicProduct";
  const double product[5] = {0.215380835120, 0.026429297369, 0.800528146905, 0.098232493318, 0.006671879746};
  const double minimum[5] = {0.225429643364, 0.117239671654, 0.837877588127, 0.117239671654, 0.006671879746};
  const auto products = infer(system, {1.6, 3.0});
  for (int rule = 0; rule < 5; ++rule) {
    const std::string name = fmt::format("p = 1.6, s = 3, rule {}", rule + 1);
    book("fuzzy, firing by minimum", name, answer.strengths[rule], minimum[rule], 1e-10, book_8);
    book("fuzzy, firing by product", name, products.strengths[rule], product[rule], 1e-10, book_8);
  }
}

/// One line of the book: norms, then centroids for 11, 101 and 1001 points by sums and by trapezoids.
struct Centroids {
  double p, s;
  const char *conjunction, *implication, *aggregation;
  double sums[3], trapezoids[3];
};

constexpr const char *minimum = "Minimum", *product = "AlgebraicProduct", *maximum = "Maximum", *sum = "BoundedSum",
                     *probor = "AlgebraicSum";

const Centroids printed[] = {
    {1.6,
     3,
     minimum,
     minimum,
     maximum,
     {5.172819396295, 5.121482605696, 5.117193425362},
     {5.125704868811, 5.116609548316, 5.116704718393}},
    {1.6,
     3,
     product,
     product,
     maximum,
     {5.215545009699, 5.152649282299, 5.147228571638},
     {5.157859894395, 5.146656712976, 5.146627433622}},
    {1.6,
     3,
     product,
     product,
     sum,
     {5.234026734868, 5.193877535251, 5.189884767589},
     {5.191394900858, 5.189460939880, 5.189441538472}},
    {1.6,
     3,
     minimum,
     minimum,
     probor,
     {5.158575220432, 5.129763471303, 5.126909242348},
     {5.128395927321, 5.126629319771, 5.126594604998}},
    {1.6,
     3,
     product,
     minimum,
     maximum,
     {5.178804538735, 5.125954675585, 5.120958732420},
     {5.125579285720, 5.120454205307, 5.120407117198}},
    {3.2,
     7,
     minimum,
     minimum,
     maximum,
     {2.309700061355, 2.575520898771, 2.603958528192},
     {2.580691139490, 2.606728996810, 2.607123925326}},
    {3.2,
     7,
     product,
     product,
     maximum,
     {1.804262954032, 2.089401062231, 2.119788459632},
     {2.092102331550, 2.122865874742, 2.123185268685}},
    {3.2,
     7,
     product,
     product,
     sum,
     {2.033878724990, 2.304846185114, 2.333668586370},
     {2.313036538620, 2.336659028698, 2.336891795080}},
    {3.2,
     7,
     minimum,
     minimum,
     probor,
     {2.691064148237, 2.929760402331, 2.955203482110},
     {2.939101136650, 2.957699882624, 2.958030695670}},
    {3.2,
     7,
     product,
     minimum,
     maximum,
     {2.312316715207, 2.571599393047, 2.599016670148},
     {2.576214315823, 2.601870038733, 2.602086005994}},
    {0.2,
     9,
     product,
     product,
     sum,
     {4.962977828616, 4.969952336193, 4.970628361467},
     {4.970365492127, 4.970702353354, 4.970703479718}},
    {0.2,
     9,
     minimum,
     minimum,
     probor,
     {4.970028107334, 4.975747545928, 4.976303790399},
     {4.976059535861, 4.976362392499, 4.976365395425}},
};

TEST(ComfortBook, CentroidsWithEveryNorm) {
  // All printed norms and resolutions: 72 centroids to their twelve decimals.
  for (const Centroids& line : printed) {
    FuzzySystem system = worked_example();
    system.conjunction = line.conjunction;
    system.implication = line.implication;
    system.aggregation = line.aggregation;
    const int points[3] = {11, 101, 1001};
    for (int i = 0; i < 3; ++i) {
      system.resolution = points[i];
      const std::string name = fmt::format("p = {}, s = {}: {}, {}, {}; {} points", line.p, line.s, line.conjunction,
                                           line.implication, line.aggregation, points[i]);
      system.integration = Integration::point_sums;
      book("fuzzy, centroid by sums", name, infer(system, {line.p, line.s}).score, line.sums[i], 1e-12, book_8);
      system.integration = Integration::trapezoids;
      book("fuzzy, centroid by trapezoids", name, infer(system, {line.p, line.s}).score, line.trapezoids[i], 1e-12,
           book_8);
    }
  }
}

TEST(ComfortBook, TheMidpointsOfTheProgramConvergeToTheCentroid) {
  // The rule that the program uses, 1001 midpoints, is within 4e-7 of the centroid of 100001 points.
  const FuzzySystem system = worked_example();
  book("fuzzy, centroid by 1001 midpoints", "p = 1.6, s = 3", infer(system, {1.6, 3.0}).score, 5.1167038760, 4e-7,
       book_8);
  book("fuzzy, centroid by 1001 midpoints", "p = 3.2, s = 7", infer(system, {3.2, 7.0}).score, 2.6071268859, 4e-6,
       book_8);
}

TEST(ComfortBook, RatingsOfTable55) {
  // All 64 ratings of the eight significant locations come back within 0.005, the rounding of the print.
  input::MaterialEntry reference;
  reference.name = "wear trial 2002";
  const auto curves = postproc::load_curves(reference);
  input::Diagnostics diagnostics;
  const auto table =
      input::read_csv(std::string(SNUG_SOURCE_DIR) + "/tests/data/wear_trial_pressure_sensation.csv", diagnostics);
  diagnostics.throw_if_any();
  ASSERT_EQ(table.rows.size(), 72u);
  int checked = 0;
  for (const auto& row : table.rows) {
    const auto* curve = curves.find(row.cells[1]);
    ASSERT_NE(curve, nullptr) << row.cells[1];
    if (!curve->significant) continue;
    const double printed_rating = std::stod(row.cells[3]);
    const double rating = postproc::rate(*curve, postproc::from_gf_cm2(std::stod(row.cells[2]))).value;
    book("table 5.5, " + row.cells[1], "rating of garment " + row.cells[0], rating, printed_rating,
         0.005 / printed_rating, "thesis, table 5.5");
    ++checked;
  }
  EXPECT_EQ(checked, 64);
}

}  // namespace
}  // namespace snug::tests
