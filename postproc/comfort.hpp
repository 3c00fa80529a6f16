// Overall pressure comfort of a garment from the sensations at the locations it covers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "postproc/fuzzy.hpp"

namespace snug::postproc {

struct LocationMembership {
  std::string location;
  double rating = 0.0;
  std::vector<double> degrees;  ///< of the terms of `sensation_terms`, in [0, 1]
};

struct FiredRule {
  std::string rule;       ///< as read by people
  double strength = 0.0;  ///< in [0, 1]
};

struct Comfort {
  double score = 0.0;  ///< [0, 4], grows with discomfort: 0 comfortable, 2 acceptable, 4 uncomfortable
  std::string term;    ///< comfortable | acceptable | uncomfortable: the output term the score belongs to most
  std::vector<std::string> sensation_terms;  ///< neutral ... extremely uncomfortable
  std::vector<LocationMembership> memberships;
  std::vector<FiredRule> rules;                                    ///< every rule with its strength
  std::vector<std::pair<std::string, double>> output_memberships;  ///< of the score
};

/// The fuzzy system for the named locations (thesis 5.2.3, tables 5.3 and 5.4). Choices that the source lost are
/// declared in comfort.cpp: the coefficients of the bells, the order of the output terms, and "or" as the bounded sum.
FuzzySystem comfort_system(std::size_t locations);

/// Judges the ratings (location, rating in [0, 4]); only the locations given take part.
/// Throws std::invalid_argument when there is none.
Comfort judge(const std::vector<std::pair<std::string, double>>& ratings);

}  // namespace snug::postproc
