#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "postproc/stress.hpp"
#include "postproc/tables.hpp"

// The layout follows PRNSOL and NLIST of Ansys with the default /FORMAT: 7 digits for the node, 5 significant digits.

namespace snug::postproc {
namespace {

constexpr int width = 13, digits = 5;

std::vector<std::string> nodal_heading(const std::string& command, const std::string& kind, const std::string& frame) {
  return {" PRINT " + command,
          "",
          "  ***** POST1 NODAL " + kind + " LISTING *****",
          "",
          "  LOAD STEP=     1  SUBSTEP=     1",
          "   TIME=    1.0000      LOAD CASE=   0",
          "",
          "  " + frame,
          ""};
}

/// Writes one "NODE / VALUE" pair: for each column the row that comes first in the order `before`.
template <class Before>
void write_extrema(std::ostream& out, const Listing& listing, const char* title, Before before) {
  std::string nodes, values;
  for (std::size_t c = 0; c < listing.labels.size(); ++c) {
    const auto best = std::min_element(listing.rows.begin(), listing.rows.end(),
                                       [&](const auto& a, const auto& b) { return before(a[c], b[c]); });
    nodes += fmt::format("{:>{}}", listing.node(best - listing.rows.begin()), width);
    values += ansys_number((*best)[c]);
  }
  fmt::print(out, "\n {} VALUES\n NODE    {}\n VALUE   {}\n", title, nodes, values);
}

}  // namespace

std::string ansys_number(double value) {
  if (!std::isfinite(value))
    return fmt::format("{:>{}}", std::isnan(value) ? "NaN" : value < 0 ? "-Infinity" : "Infinity", width);
  if (std::abs(value) < 1e-99) return fmt::format("{:>{}.4f}    ", 0.0, width - 4);
  // The rounded decimal form decides between the fixed and the exponent field, as in Fortran.
  const std::string scientific = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1)) + 1;  // of 0.ddddd
  if (exponent >= 0 && exponent <= digits) return fmt::format("{:>#{}.{}f}    ", value, width - 4, digits - exponent);
  const std::string mantissa = scientific.substr(0, 1) + scientific.substr(2, digits - 1);
  if (std::abs(exponent) > 99) return std::string(width, '*');
  return fmt::format("{:>{}}", fmt::format("{}0.{}E{:+03d}", value < 0 ? "-" : "", mantissa, exponent), width);
}

Listing displacement_listing(const BodyResult& body) {
  Listing listing;
  listing.nodes = body.node_numbers;
  listing.heading = nodal_heading("U    NODAL SOLUTION PER NODE", "DEGREE OF FREEDOM",
                                  "THE FOLLOWING DEGREE OF FREEDOM RESULTS ARE IN THE GLOBAL COORDINATE SYSTEM");
  listing.labels = {"UX", "UY", "UZ", "USUM"};
  listing.extrema = Extrema::range_and_absolute;
  for (const Eigen::Vector3d& u : body.fields[field::displacement]) listing.rows.push_back({u.x(), u.y(), u.z(), u.norm()});
  return listing;
}

Listing stress_listing(const BodyResult& body) {
  Listing listing;
  listing.nodes = body.node_numbers;
  listing.heading =
      nodal_heading("S    NODAL SOLUTION PER NODE", "STRESS", "THE FOLLOWING X,Y,Z VALUES ARE IN GLOBAL COORDINATES");
  listing.labels = {"S1", "S2", "S3", "SINT", "SEQV"};
  const auto add = [&](const Eigen::Vector3d& s, double equivalent) {
    listing.rows.push_back({s[0], s[1], s[2], stress_intensity(s), equivalent});
  };
  const std::vector<Stress>*top = body.fields.find(field::stress_top), *bottom = body.fields.find(field::stress_bottom);
  if (!top || !bottom) {
    const std::vector<Eigen::Vector3d>& principal = body.fields[field::principal_stress];
    const std::vector<double>& equivalent = body.fields[field::von_mises];
    for (std::size_t n = 0; n < principal.size(); ++n) add(principal[n], equivalent[n]);
    return listing;
  }
  listing.heading.insert(listing.heading.end(), {"  SHELL NODAL RESULTS ARE AT TOP/BOTTOM FOR MATERIAL   1", ""});
  listing.nodes.clear();
  for (std::size_t n = 0; n < top->size(); ++n) {
    listing.nodes.insert(listing.nodes.end(), 2, body.node_number(n));
    for (const Stress& stress : {(*top)[n], (*bottom)[n]}) add(principal_stresses(stress), von_mises(stress));
  }
  return listing;
}

Listing node_listing(const BodyResult& body) {
  Listing listing;
  listing.nodes = body.node_numbers;
  listing.heading = {" LIST ALL SELECTED NODES.   DSYS=      0", ""};
  listing.labels = {"X", "Y", "Z"};
  listing.extrema = Extrema::none;  // NLIST prints none
  for (const Eigen::Vector3d& x : body.nodes) listing.rows.push_back({x.x(), x.y(), x.z()});
  return listing;
}

void write_listing(std::ostream& out, const Listing& listing) {
  std::string text;
  for (const std::string& line : listing.heading) text += line + '\n';
  text += "    NODE     ";
  for (const std::string& label : listing.labels) text += fmt::format("{:<{}}", label, width);
  text += '\n';
  for (std::size_t n = 0; n < listing.rows.size(); ++n) {
    fmt::format_to(std::back_inserter(text), " {:>7} ", listing.node(n));
    for (double value : listing.rows[n]) text += ansys_number(value);
    text += '\n';
  }
  out << text;
  if (listing.rows.empty() || listing.extrema == Extrema::none) return;
  write_extrema(out, listing, "MINIMUM", [](double a, double b) { return a < b; });
  write_extrema(out, listing, "MAXIMUM", [](double a, double b) { return a > b; });
  if (listing.extrema == Extrema::range_and_absolute)
    write_extrema(out, listing, "MAXIMUM ABSOLUTE", [](double a, double b) { return std::abs(a) > std::abs(b); });
}

}  // namespace snug::postproc
