// Overall pressure comfort of a garment from the sensations at the locations it covers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/input/material_entry.hpp"
#include "postproc/comfort/fuzzy.hpp"

namespace snug::postproc {

struct LocationRating {
  std::string location;
  double rating = 0.0;  ///< [0, 4]
  double error = 0.0;   ///< standard error of the rating; NaN when it is not known
  int degrees = 0;      ///< of freedom behind `error`; 0: normal distribution
};

struct LocationMembership {
  std::string location;
  double rating = 0.0;
  std::vector<double> degrees;  ///< of the terms of `sensation_terms`, in [0, 1]
};

struct FiredRule {
  std::string rule;       ///< as read by people
  std::string term;       ///< of the garment, that the rule concludes
  double strength = 0.0;  ///< in [0, 1]
};

/// Where the score may lie, by sampling the ratings about their curves.
struct ScoreInterval {
  double level = 0.95;
  double low = 0.0, high = 0.0;
  double deviation = 0.0;  ///< standard deviation of the sampled scores
  int samples = 0, seed = 0;
  std::vector<std::string> without_scatter = {};  ///< locations whose curve tells no scatter: held at their rating
};

struct Comfort {
  double score = 0.0;  ///< of the output's range; shipped: [0, 4], grows with discomfort
  std::string term;    ///< the output term the score belongs to most; "undecided" when no rule fires
  std::string scale;   ///< "0 comfortable, 2 acceptable, 4 uncomfortable"
  std::string system;  ///< name of the fuzzy system
  std::vector<std::string> sensation_terms;  ///< neutral ... extremely uncomfortable
  std::vector<LocationMembership> memberships;
  std::vector<FiredRule> rules;                                    ///< every rule with its strength
  std::vector<std::pair<std::string, double>> output_memberships;  ///< of the score
  std::vector<std::string> left_out;  ///< locations with a rating that are no input of the system
  std::vector<std::string> silent;    ///< inputs of the system without a rating
  std::optional<ScoreInterval> interval;
};

/// The shipped systems by name: "wear trial 2002" and "wear trial 2002, single terms".
std::vector<std::string> fuzzy_names();

/// The rules of table 5.4 for the named locations, with the memberships of the shipped system (thesis 5.2.3, tables 5.3
/// and 5.4; what the source lost is declared in comfort.cpp). A location that the source does not know gets the
/// memberships of its first input.
FuzzySystem comfort_system(const std::vector<std::string>& locations);

/// The system that a case names: a shipped one, a .fll or .fis file relative to `directory`; for an empty name
/// comfort_system of the locations. Throws InputError.
FuzzySystem load_fuzzy(const input::MaterialEntry& reference, const std::vector<std::string>& locations,
                       const std::filesystem::path& directory = {});

/// How many samples of the ratings make the interval of the score, and where the random numbers begin.
struct Sampling {
  int samples = 0;  ///< 0: no interval
  int seed = 1;
};

/// Judges the ratings; inputs of the system without a rating drop out of its rules (fuzzy_rule.hpp), ratings of other
/// locations are left out. An input means a location when they have the same letters and digits, whatever their case.
/// Throws std::invalid_argument when no rating is an input.
Comfort judge(const std::vector<LocationRating>& ratings, const FuzzySystem& system, const Sampling& sampling = {});
/// With comfort_system of the rated locations.
Comfort judge(const std::vector<LocationRating>& ratings);

}  // namespace snug::postproc
