// The size at which a garment presses as is wanted: by the law of Laplace first, put right by solutions.
#pragma once

#include <functional>
#include <vector>

#include "solver/library/prepared_case.hpp"

namespace snug::solver {

/// Mean pressures (Pa) of the law of Laplace at the places of a target, over the size of a garment: a factor on all its girths as cut, 1 for the
/// case as it stands. Tabulated once; other garments of the case keep their size.
class LaplaceTable {
 public:
  /// Throws input::InputError where the body is no limb: it branches, or is of another program.
  LaplaceTable(const PreparedCase& prepared, int garment, const input::TargetSpec& target);

  std::size_t places() const { return pressure_.size(); }
  /// Between these: the fabric at 2.9 times its length somewhere, and a garment as wide as the body or wider.
  double smallest() const { return size_.front(); }
  double largest() const { return size_.back(); }
  double at(std::size_t place, double size) const;  ///< linear between the rows of the table
  double height(std::size_t place) const { return height_[place]; }  ///< m, mean of the place

 private:
  std::vector<double> size_, height_;
  std::vector<std::vector<double>> pressure_;  ///< of a place by size
};

/// Looks for the size by what solutions have found: the cheap pressures, each times a factor that meets the solutions (constant after one, by a power
/// of the size through the last two). Where one pressure is wanted it is met, of several the sum of the squares of found / wanted - 1 is least.
class SizeSearch {
 public:
  using Pressure = std::function<double(std::size_t place, double size)>;
  SizeSearch(std::vector<double> wanted, Pressure cheap, double smallest, double largest);

  void found(double size, const std::vector<double>& pressures);
  double next() const;
  double predicted(std::size_t place, double size) const;
  /// False where the best size is an end of the range: what is wanted is not within reach.
  bool within_reach(double size) const { return size > 1.001 * smallest_ && size < 0.999 * largest_; }

 private:
  double misfit(double size) const;

  struct Solution {
    double size;
    std::vector<double> factor;
  };
  std::vector<double> wanted_;
  Pressure cheap_;
  double smallest_, largest_;
  std::vector<Solution> solutions_;
};

/// Smallest f over [low, high] by a scan in equal ratios and golden-section search round its best point.
double least(const std::function<double(double)>& f, double low, double high);

}  // namespace snug::solver
