// The numbers of an Ansys listing, which stand in fields without separators, and the words of its lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace snug::postproc {

constexpr int most_listing_errors = 10;  ///< with so many a reader gives up

/// What stands at the beginning of a text.
struct ListingNumber {
  double value = 0.0;      ///< NaN for an overflown field (************)
  std::size_t length = 0;  ///< characters that belong to it; 0: no number stands here
  int fields = 1;          ///< overflown fields run together: how many there are
  bool integer = false;    ///< neither a decimal point nor an exponent: a node number or a page mark
};

/// Reads the number with which `text` begins. A number ends where the next one must begin, so that fields that touch
/// are told apart: -0.15152E-11-0.23058E-04 and 0.32500E+060.70000E-100 are two numbers each (fields hold 0.ddddd,
/// hence the digit before a second point belongs to the next number). Exponents have one to three digits after E, e, D
/// or d, or three after a bare sign, as Fortran prints 0.70000-100. NaN and Infinity count as numbers. Source: Fortran
/// 2018, 13.7.2.3 (Ew.d, Gw.d); Ansys commands /FORMAT.
ListingNumber scan_number(std::string_view text);

/// What stands between blanks.
std::vector<std::string> words_of(std::string_view text);

}  // namespace snug::postproc
