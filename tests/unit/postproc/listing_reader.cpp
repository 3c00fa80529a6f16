#include "postproc/listing_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>

#include "postproc/comparison.hpp"
#include "postproc/listing_numbers.hpp"
#include "postproc/tables.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc {
namespace {

using Row = std::vector<double>;

std::vector<ListingTable> shipped_listing(const std::string& name) {
  return read_listing(std::filesystem::path(SNUG_SOURCE_DIR) / "tests/data/listings" / name);
}

std::vector<ListingTable> parse(const std::string& text, input::Diagnostics& diagnostics) {
  return parse_listing(text, "some.lis", diagnostics);
}

Row row_of(const ListingTable& table, std::size_t row) {
  Row values;
  for (std::size_t c = 0; c < table.labels.size(); ++c) values.push_back(table.value(row, c));
  return values;
}

/// Every number in a text that runs together.
Row numbers_in(std::string_view text) {
  Row numbers;
  while (!text.empty()) {
    const ListingNumber number = scan_number(text);
    if (number.length == 0) {
      text.remove_prefix(1);
      continue;
    }
    for (int f = 0; f < number.fields; ++f) numbers.push_back(number.value);
    text.remove_prefix(number.length);
  }
  return numbers;
}

TEST(ListingNumbers, FieldsThatTouchAreToldApart) {
  // A number ends where the next one begins, with two- and three-digit exponents, without E, and in fixed form.
  EXPECT_EQ(numbers_in("-0.15152E-11-0.23058E-04"), (Row{-0.15152e-11, -0.23058e-4}));
  EXPECT_EQ(numbers_in("-0.15152E-011-0.23058E-004  0.0000"), (Row{-0.15152e-11, -0.23058e-4, 0}));
  EXPECT_EQ(numbers_in("-0.32500E+060.70000E-100"), (Row{-0.325e6, 0.7e-100}));
  EXPECT_EQ(numbers_in("-0.15152-101-0.23058E-04 0.0000"), (Row{-0.15152e-101, -0.23058e-4, 0}));
  EXPECT_EQ(numbers_in("0.74140D+007-99999.-1.5000"), (Row{0.7414e7, -99999, -1.5}));
  EXPECT_EQ(numbers_in("-123.45-123.45"), (Row{-123.45, -123.45}));
  EXPECT_EQ(numbers_in("0.10000E+400 -0.10000E-400"), (Row{INFINITY, 0}));
}

TEST(ListingNumbers, AnOverflownFieldIsNoNumber) {
  // Stars give NaN, one a field of 12 or 13 characters; NaN and Infinity are what snug's own listings print.
  EXPECT_EQ(numbers_in("************").size(), 1u);
  EXPECT_EQ(numbers_in("**************************").size(), 2u);
  EXPECT_EQ(numbers_in("************************").size(), 2u);
  EXPECT_TRUE(std::isnan(numbers_in("************")[0]));
  EXPECT_TRUE(std::isnan(numbers_in("NaN")[0]));
  EXPECT_EQ(numbers_in("-Infinity"), (Row{-INFINITY}));
}

TEST(ListingReader, ReportsAndTablesOfAbaqusAndDataFramesAreListings) {
  // A field output report, its table with the instance and frame before the node, and a data frame whose index has no name: the same rows.
  const auto read = [](const std::string& text, const char* ending) {
    const auto file = std::filesystem::temp_directory_path() / ("snug-listing-" + std::to_string(::getpid()) + ending);
    std::ofstream(file) << text;
    const auto tables = read_listing(file);
    std::filesystem::remove(file);
    return tables.at(0);
  };
  const std::string rule(60, '-');
  const std::string report = "***\nField Output Report, written Mon Nov 30 10:00:00 2026\n\nSource 1\n---------\n\n   Frame: Increment     1: Step Time =    1.000\n\n"
                             "            Node            U.U1            U.U2\n           Label           @Loc 1           @Loc 1\n" + rule +
                             "\n               3    -2.500000E-01     0.\n              14     1.00000E+00     1.2E-03\n\n\n  Minimum    -2.500000E-01     0.\n      At Node              3    3\n";
  for (const ListingTable& table : {read(report, ".rpt"), read("Frame,Instance Name,Node Label,U-U1,U-U2\nIncrement 1,PART-1-1,3,-0.25,0\nIncrement 1,PART-1-1,14,1,0.0012\n", ".csv"),
                                    read(",UX,UY\n3,-0.25,0\n14,1,0.0012\n", ".csv"), read("node;disp_x;disp_y\n3;-0,25;0\n14;1;0,0012\n", ".csv")}) {
    EXPECT_EQ(table.labels, (std::vector<std::string>{"UX", "UY"}));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[1].node, 14);
    EXPECT_EQ(row_of(table, 0), (Row{-0.25, 0.0}));
    EXPECT_EQ(row_of(table, 1), (Row{1.0, 0.0012}));
  }
  EXPECT_THROW(read("Frame,Node Label,U-U1\nIncrement 1,3,1\nIncrement 2,3,2\n", ".csv"), input::InputError);
  EXPECT_THROW(read(report + report.substr(report.find("            Node")), ".rpt"), input::InputError);
}

TEST(ListingReader, AShellsDisplacementsParseCompletely) {
  // Shape of the thesis' first listing (section 4.4.3; the digits are made up): tabs, four rows, rows left out, and the
  // maximum absolute values.
  const auto tables = shipped_listing("shell_displacement.lis");
  ASSERT_EQ(tables.size(), 1u);
  const ListingTable& table = tables[0];
  EXPECT_EQ(table.kind, "NODAL DEGREE OF FREEDOM");
  EXPECT_EQ(table.labels, (std::vector<std::string>{"UX", "UY", "UZ", "USUM"}));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0].node, 6617);
  EXPECT_EQ(row_of(table, 0), (Row{0.44167e-2, 0.31106e-3, 0.94038e-3, 0.95421e-2}));
  EXPECT_EQ(row_of(table, 1), (Row{0.53044e-3, 0.42445e-3, 0.29568e-3, 0.42374e-2}));
  EXPECT_EQ(row_of(table, 2), (Row{-0.28404e-2, 0.58366e-3, -0.56723e-3, 0.54010e-2}));
  EXPECT_EQ(table.rows[3].node, 2088);
  EXPECT_EQ(row_of(table, 3), (Row{0, 0, 0, 0}));
  EXPECT_TRUE(table.rows_left_out);
  ASSERT_EQ(table.extrema.size(), 1u);
  EXPECT_EQ(table.extrema[0].title, "MAXIMUM ABSOLUTE");
  EXPECT_EQ(table.extrema[0].nodes, (std::vector<int>{6617, 522, 6617, 6617}));
  EXPECT_EQ(table.extrema[0].values, (Row{0.44167e-2, -0.84887e-3, 0.94038e-3, 0.95421e-2}));
}

TEST(ListingReader, AShellsStressesParseCompletely) {
  // Shape of the thesis' second listing (section 4.4.3; the digits are made up): columns run together, SEQV wraps to the
  // next line (once across what the page break left), a VALUE line wraps, and the shell's surface is named.
  const auto tables = shipped_listing("shell_stress.lis");
  ASSERT_EQ(tables.size(), 1u);
  const ListingTable& table = tables[0];
  EXPECT_EQ(table.labels, (std::vector<std::string>{"S1", "S2", "S3", "SINT", "SEQV"}));
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0].surface, ShellSurface::top);
  EXPECT_EQ(row_of(table, 0), (Row{0.47425e-13, -0.79583e-6, -0.61034e-5, 0.61034e-5, 0.41524e-5}));
  EXPECT_EQ(row_of(table, 1), (Row{0.80051e-5, 0.55054e-7, -0.62691e-5, 0.59374e-5, 0.34692e-5}));
  EXPECT_EQ(table.rows[2].node, 4204);
  EXPECT_EQ(row_of(table, 2), (Row{0.69050e-11, -0.82554e-5, -0.27363e-5, 0.27363e-5, 0.20002e-5}));
  EXPECT_EQ(table.rows[3].node, 522);
  EXPECT_EQ(row_of(table, 3), (Row{-0.39087e-11, -0.45018e-4, -0.56373e-4, 0.56373e-4, 0.47670e-4}));
  EXPECT_EQ(row_of(table, 4), (Row{0, 0, 0, 0, 0}));
  EXPECT_TRUE(table.rows_left_out);
  ASSERT_EQ(table.extrema.size(), 2u);
  EXPECT_EQ(table.extrema[0].nodes, (std::vector<int>{5853, 522, 772, 582, 582}));
  EXPECT_EQ(table.extrema[0].values, (Row{-0.46736e-6, -0.45018e-4, -0.47300e-4, 0, 0}));
  EXPECT_EQ(table.extrema[1].nodes, (std::vector<int>{918, 757, 6161, 918, 918}));
  EXPECT_EQ(table.extrema[1].values, (Row{0.54383e-4, 0.46425e-5, 0.15919e-6, 0.70761e-4, 0.73925e-4}));
}

TEST(ListingReader, ThePrintedListingsOfTheThesisParseCompletely) {
  // Thesis, section 4.4.3: the numbers of both listings as they are printed, fused, wrapped and split as there. Four and
  // five rows, extrema of every column; SEQV of the third row and of the maxima stands on the next line.
  const auto tables = shipped_listing("thesis_4_4_3.lis");
  ASSERT_EQ(tables.size(), 2u);
  const ListingTable &moved = tables[0], &stress = tables[1];
  EXPECT_EQ(moved.labels, (std::vector<std::string>{"UX", "UY", "UZ", "USUM"}));
  ASSERT_EQ(moved.rows.size(), 4u);
  EXPECT_EQ(row_of(moved, 0), (Row{0.14822e-2, 0.17681e-3, 0.88863e-3, 0.17372e-2}));
  EXPECT_EQ(row_of(moved, 1), (Row{0.97184e-3, 0.23932e-3, 0.45338e-3, 0.10988e-2}));
  EXPECT_EQ(row_of(moved, 2), (Row{-0.10168e-2, 0.32514e-3, -0.13787e-3, 0.10764e-2}));
  EXPECT_EQ(row_of(moved, 3), (Row{0, 0, 0, 0}));
  ASSERT_EQ(moved.extrema.size(), 1u);
  EXPECT_EQ(moved.extrema[0].nodes, (std::vector<int>{1151, 452, 1151, 1151}));
  EXPECT_EQ(moved.extrema[0].values, (Row{0.14822e-2, -0.98007e-3, 0.88863e-3, 0.17372e-2}));
  EXPECT_EQ(stress.labels, (std::vector<std::string>{"S1", "S2", "S3", "SINT", "SEQV"}));
  ASSERT_EQ(stress.rows.size(), 5u);
  EXPECT_EQ(stress.rows[0].surface, ShellSurface::top);
  EXPECT_EQ(row_of(stress, 0), (Row{0.31641e-13, -0.65500e-6, -0.14692e-5, 0.14692e-5, 0.12749e-5}));
  EXPECT_EQ(row_of(stress, 1), (Row{0.64755e-5, 0.64719e-7, -0.21309e-5, 0.86063e-5, 0.77456e-5}));
  EXPECT_EQ(row_of(stress, 2), (Row{0.19002e-11, -0.32529e-5, -0.45117e-5, 0.45117e-5, 0.40325e-5}));
  EXPECT_EQ(row_of(stress, 3), (Row{-0.15152e-11, -0.23058e-4, -0.32057e-4, 0.32057e-4, 0.28638e-4}));
  EXPECT_EQ(row_of(stress, 4), (Row{0, 0, 0, 0, 0}));
  ASSERT_EQ(stress.extrema.size(), 2u);
  EXPECT_EQ(stress.extrema[0].nodes, (std::vector<int>{1146, 452, 549, 685, 685}));
  EXPECT_EQ(stress.extrema[0].values, (Row{-0.25991e-6, -0.23058e-4, -0.33844e-4, 0, 0}));
  EXPECT_EQ(stress.extrema[1].nodes, (std::vector<int>{567, 389, 1630, 567, 567}));
  EXPECT_EQ(stress.extrema[1].values, (Row{0.28321e-4, 0.95594e-5, 0.59702e-6, 0.34880e-4, 0.32108e-4}));
}

TEST(ListingReader, PagesAndWrappedLinesGiveOneTable) {
  // Reference book, section 5.1: a page break with banner and repeated heads, 13-wide fields, six components of which
  // two wrap. The numbers are those from which the text was made.
  const auto tables = shipped_listing("ansys_pages.lis");
  ASSERT_EQ(tables.size(), 3u);
  const Row first = {-0.15152e-11, -0.23058e-4, 0, 0.23058e-4}, second = {0.10751e-3, 12.345, -1.5, 12.436},
            third = {-0.15e-2, -0.1e-7, -99999, 99999};
  for (std::size_t t = 0; t < 3; ++t) {
    ASSERT_EQ(tables[t].rows.size(), 3u);
    EXPECT_EQ(tables[t].rows[2].node, 1234567);
    EXPECT_EQ(tables[t].load_step, 1);
    for (const auto& [row, expected] : {std::pair{0, first}, std::pair{1, second}, std::pair{2, third}}) {
      Row all = expected;
      if (t == 1) all.push_back(1.25);
      if (t == 2) all.insert(all.end(), {-3.25e5, 7e-101});
      EXPECT_EQ(row_of(tables[t], row), all);
    }
  }
  EXPECT_EQ(tables[2].extrema[1].values.size(), 6u);
}

TEST(ListingReader, ANodeOccursOnceASurfaceElementAndMaterial) {
  // TOP/BOTTOM lists each node twice; PRESOL heads each element; a further material is a further table.
  input::Diagnostics diagnostics;
  const std::string head = "  SHELL NODAL RESULTS ARE AT TOP/BOTTOM FOR MATERIAL   2\n    NODE     S1           S2\n";
  const auto shell = parse(head + "       7   1.0000       2.0000\n       7  -1.0000      -2.0000\n", diagnostics);
  ASSERT_EQ(shell[0].rows.size(), 2u);
  EXPECT_EQ(shell[0].rows[0].surface, ShellSurface::top);
  EXPECT_EQ(shell[0].rows[1].surface, ShellSurface::bottom);
  EXPECT_EQ(shell[0].rows[1].material, 2);
  const auto elements = parse(
      " PRINT S    ELEMENT SOLUTION PER ELEMENT\n ***** POST1 ELEMENT NODAL STRESS LISTING *****\n"
      "  ELEMENT=       1        SHELL181\n    NODE    SX\n       1 1.0000\n       2 2.0000\n"
      "  ELEMENT=       2        SHELL181\n    NODE    SX\n       2 4.0000\n",
      diagnostics);
  ASSERT_EQ(elements.size(), 1u);
  EXPECT_EQ(elements[0].rows[2].element, 2);
  const NodalField field = field_of(elements, {});
  EXPECT_EQ(field.columns[0].values, (Row{1, 3}));  // the mean over the elements, as PRNSOL prints it
  const NodalField surfaces = field_of(shell, {});
  EXPECT_EQ(surfaces.find("S1 BOTTOM")->values, (Row{-1}));
  EXPECT_EQ(field_of(shell, {.surface = ShellSurface::top, .nodes = {}}).find("S1")->values, (Row{1}));
  EXPECT_FALSE(diagnostics.any());
}

TEST(ListingReader, WrongRowsAreReportedAtTheirPlace) {
  // Too few values, too many, no number, values without node, a row cut off from its head: line and column are named.
  const auto error_of = [](const std::string& rows) {
    input::Diagnostics diagnostics;
    parse("    NODE  UX  UY\n" + rows, diagnostics);
    return diagnostics.any() ? to_string(diagnostics.errors()[0]) : "";
  };
  EXPECT_EQ(error_of("       1 0.10000\n       2 0.10000 0.20000\n").substr(0, 42),
            "some.lis:2:1: error: node 1 has 1 values w");
  EXPECT_EQ(error_of("       1 0.1 0.2 0.3\n").substr(0, 35), "some.lis:2:9: error: node 1 has 3 v");
  EXPECT_EQ(error_of("       1 0.1 0.2x\n").substr(0, 41), "some.lis:2:17: error: \"x\" is no number; g");
  EXPECT_NE(error_of("       1 0.1 0.2 L\n").find("some.lis:2:18: error: the values of the node are along the axes of its own frame"), std::string::npos);
  EXPECT_EQ(error_of(" 0.1 0.2\n").substr(0, 42), "some.lis:2:2: error: values without a node");
  EXPECT_EQ(error_of("       1 0.1 0.2\nsome text\n       2 0.1 0.2\n").substr(0, 35),
            "some.lis:4:8: error: a row of value");
  EXPECT_EQ(error_of("       1 0.1 0.2\n"), "");
}

TEST(ListingReader, AFileWithoutATableIsWrongInput) {
  // A missing file, a directory and a file without a head are InputErrors that name the remedy.
  const auto folder = test::fresh_folder("listing");
  std::ofstream(folder / "empty.lis") << "nothing here\n";
  EXPECT_THROW(read_listing(folder / "none.lis"), input::InputError);
  EXPECT_THROW(read_listing(folder), input::InputError);
  EXPECT_THROW(read_listing(folder / "empty.lis"), input::InputError);
}

TEST(ListingReader, WhatIsWrittenIsReadAndComparesToZero) {
  // Write, read and write again gives the same rows; the file compared with itself differs by nothing; compared with
  // the doubles it was written from it differs by no more than half a unit of the fifth digit.
  const BodyResult body = test::body_scene();
  const auto folder = test::fresh_folder("round-trip");
  for (const auto& [name, listing] :
       {std::pair{"displacement.lis", displacement_listing(body)}, std::pair{"stress.lis", stress_listing(body)},
        std::pair{"nodes.lis", node_listing(body)}}) {
    std::ofstream file(folder / name);
    write_listing(file, listing);
    file.close();
    const auto tables = read_listing(folder / name);
    ASSERT_EQ(tables.size(), 1u);
    EXPECT_EQ(tables[0].labels, listing.labels);
    Listing again = listing;
    for (std::size_t r = 0; r < listing.rows.size(); ++r) {
      again.rows[r] = row_of(tables[0], r);
      for (std::size_t c = 0; c < listing.labels.size(); ++c)
        EXPECT_NEAR(again.rows[r][c], listing.rows[r][c], printed_precision * std::abs(listing.rows[r][c]));
    }
    std::ostringstream text;
    write_listing(text, again);
    const auto rows = [](const std::string& all) { return all.substr(0, all.find(" MINIMUM")); };  // below: ties
    EXPECT_EQ(rows(text.str()), rows(test::text_of(folder / name)));
  }
  const Comparison same = compare(read_field(folder), read_field(folder));
  ASSERT_EQ(same.columns.size(), 9u);
  EXPECT_EQ(same.matching, "by node number");
  for (const ColumnComparison& column : same.columns) EXPECT_EQ(column.maximum, 0.0) << column.label;
}

TEST(ListingReader, AMillionLinesReadInLessThanThreeSeconds) {
  // A displacement listing of 1 000 000 rows with fused columns and page heads, in processor time (the file is in
  // memory).
  std::string text;
  const std::string head =
      "\n  ***** POST1 NODAL DEGREE OF FREEDOM LISTING *****\n\n    NODE   UX          UY          UZ          USUM\n";
  for (int n = 1; n <= 1000000; ++n) {
    if (n % 50 == 1) text += head;
    fmt::format_to(std::back_inserter(text), " {:7d} -0.{:05d}E-11-0.23058E-04  12.345     0.23058E-04\n", n,
                   10000 + n % 90000);
  }
  input::Diagnostics diagnostics;
  const std::clock_t start = std::clock();
  const auto tables = parse(text, diagnostics);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].rows.size(), 1000000u);
  EXPECT_DOUBLE_EQ(tables[0].value(99999, 0), -0.20000e-11);
  EXPECT_LT(seconds, 3.0);
  RecordProperty("seconds", fmt::format("{:.3f}", seconds));
  fmt::print("a million rows in {:.2f} s of processor time\n", seconds);
}

}  // namespace
}  // namespace snug::postproc
