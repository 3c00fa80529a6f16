// Memberships from a wear trial in which subjects gave a rating and chose a word for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/input/csv.hpp"
#include "postproc/comfort/fuzzy.hpp"

namespace snug::postproc {

/// What became of one bell.
struct FittedTerm {
  std::string name;
  int answers = 0;      ///< that chose this word
  bool fitted = false;  ///< false: no answer, or one word only at the location; the former bell is kept
  double width_before = 0.0, slope_before = 0.0, width = 0.0, slope = 0.0;
};

struct FittedVariable {
  std::string location;
  std::vector<FittedTerm> terms;
  double deviation = 0.0;  ///< root mean square distance between observed and modelled shares, weighted by answers
};

/// The system of table 5.4 for the locations of the table, and what was fitted.
struct MembershipFit {
  FuzzySystem system;
  std::vector<FittedVariable> variables;  ///< empty when the table has no column sensation_term
};

/// Columns: location, sensation_rating, sensation_term (neutral ... extremely uncomfortable) and, where rows stand for
/// several equal answers, answers. The membership of a word at a rating is read as the share of subjects who choose it
/// there: p_t(x) = m_t(x) / sum_u m_u(x) over the words used at the location. Half widths and slopes of the bells are
/// the weighted least-squares ones of the observed shares; the centres stay on the marks, which define the scale.
/// Without the column sensation_term the shipped memberships are kept. Throws InputError: an unknown word, a fit that
/// does not converge.
MembershipFit fit_memberships(const input::Csv& table);

}  // namespace snug::postproc
