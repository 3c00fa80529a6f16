// The size of a fabric that comes nearest to pressures that are wanted.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace snug::app {

struct Target {
  std::string location;
  double pressure = 0.0;  ///< Pa
};

struct Proposal {
  std::string fabric;
  double size = 1.0;                             ///< factor on the size of the case
  std::map<std::string, double> pressures = {};  ///< Pa, that it is guessed to give
  double off = 0.0;                         ///< root mean square of the targets' relative misses
  double per_percent = 0.0;                 ///< change of the mean of the targets' pressures, in percent, where it is cut one percent wider
};

/// Pressures by location at a factor on the size.
using Guess = std::function<std::map<std::string, double>(double size)>;

/// Looks for the size in [from, to] at which the root mean square of the relative misses is least: between sizes that were guessed the logarithms of the
/// pressures are taken as straight, and the best size by these is guessed next, and one half way to its neighbour where that is far off; at most six times, until
/// the miss is below a hundredth or the size stays the same to half a thousandth. The best of all that were guessed is given.
Proposal best_size(const std::string& fabric, const std::vector<Target>& targets, double from, double to, const Guess& guess);

/// The nearest first; among those that miss by the same to one percent of the targets, the one whose pressure depends least on the size.
void rank(std::vector<Proposal>& proposals);

}  // namespace snug::app
