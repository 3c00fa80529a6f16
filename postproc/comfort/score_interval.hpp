// How far the score may move when the ratings scatter about their curves as the trial's did.
#pragma once

#include <vector>

#include "postproc/comfort/comfort.hpp"

namespace snug::postproc {

/// Central 95 % of the scores of `sampling.samples` draws: each rating plus its standard error times Student's t with
/// its degrees of freedom (the distribution of the prediction of one more rating), independent between locations,
/// clamped to the scale. Ratings without a known error stay as they are and are named. The same seed gives the same
/// interval. `ratings` in the order of the engine's inputs.
ScoreInterval score_interval(const std::vector<LocationRating>& ratings, FuzzyEngine& engine, const Sampling& sampling);

}  // namespace snug::postproc
