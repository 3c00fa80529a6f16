#include "postproc/comfort/score_interval.hpp"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "postproc/comfort/sensation.hpp"

namespace snug::postproc {
namespace {

using Generator = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;

double drawn(const LocationRating& rating, gsl_rng* random) {
  if (!std::isfinite(rating.error) || rating.error <= 0.0) return rating.rating;
  const double t = rating.degrees > 0 ? gsl_ran_tdist(random, rating.degrees) : gsl_ran_ugaussian(random);
  return std::clamp(rating.rating + rating.error * t, lowest_rating, highest_rating);
}

}  // namespace

ScoreInterval score_interval(const std::vector<LocationRating>& ratings, FuzzyEngine& engine,
                             const Sampling& sampling) {
  const Generator random(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(random.get(), static_cast<unsigned long>(sampling.seed));
  std::vector<double> values(ratings.size()), scores;
  for (int sample = 0; sample < sampling.samples; ++sample) {
    for (std::size_t i = 0; i < ratings.size(); ++i) values[i] = drawn(ratings[i], random.get());
    if (const double score = engine.score(values); std::isfinite(score)) scores.push_back(score);
  }
  if (scores.empty()) scores.push_back(std::numeric_limits<double>::quiet_NaN());
  std::sort(scores.begin(), scores.end());
  ScoreInterval interval{.samples = sampling.samples, .seed = sampling.seed};
  const double tail = (1.0 - interval.level) / 2.0;
  interval.low = gsl_stats_quantile_from_sorted_data(scores.data(), 1, scores.size(), tail);
  interval.high = gsl_stats_quantile_from_sorted_data(scores.data(), 1, scores.size(), 1.0 - tail);
  interval.deviation = scores.size() > 1 ? gsl_stats_sd(scores.data(), 1, scores.size()) : 0.0;
  for (const LocationRating& rating : ratings)
    if (!std::isfinite(rating.error)) interval.without_scatter.push_back(rating.location);
  return interval;
}

}  // namespace snug::postproc
