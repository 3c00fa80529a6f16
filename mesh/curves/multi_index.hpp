// Multi-indices a = (a_1…a_m) with |a| = n: what the coefficients of a B-form are numbered by.
#pragma once

#include <span>
#include <vector>

namespace snug::mesh::curves {

/// All multi-indices of `corners` parts with the sum `degree`, the first part from `degree` down to 0, then the second,
/// …
class MultiIndices {
 public:
  /// Throws std::invalid_argument unless 1 <= corners, 0 <= degree and there are at most `most` of them.
  MultiIndices(int corners, int degree);
  static constexpr int most = 1000000;

  int corners() const { return corners_; }
  int degree() const { return degree_; }
  int count() const { return static_cast<int>(parts_.size()) / corners_; }
  std::span<const int> operator[](int position) const {
    return {parts_.data() + position * corners_, static_cast<std::size_t>(corners_)};
  }
  /// Where an index of this sum stands.
  int position(std::span<const int> index) const;
  /// n! / a!
  double multinomial(int position) const;

 private:
  int corners_, degree_;
  std::vector<int> parts_;
};

}  // namespace snug::mesh::curves
