#include "mesh/curves/multi_index.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mesh/curves/binomial.hpp"

namespace snug::mesh::curves {

MultiIndices::MultiIndices(int corners, int degree) : corners_(corners), degree_(degree) {
  if (corners < 1 || degree < 0) throw std::invalid_argument("a B-form has one corner at least and no negative degree");
  if (binomial(degree + corners - 1, corners - 1) > most)
    throw std::invalid_argument(
        fmt::format("a B-form of degree {} on {} corners has more than {} coefficients", degree, corners, most));
  std::vector<int> index(corners, 0);
  index[0] = degree;
  while (true) {
    parts_.insert(parts_.end(), index.begin(), index.end());
    int last = corners - 2;  // the last part but the final one that can give away
    while (last >= 0 && index[last] == 0) --last;
    if (last < 0) return;
    const int rest = index[corners - 1];
    index[corners - 1] = 0;
    --index[last];
    index[last + 1] = rest + 1;
  }
}

int MultiIndices::position(std::span<const int> index) const {
  double before = 0.0;
  int left = degree_;
  for (int j = 0; j + 1 < corners_; ++j) {
    left -= index[j];  // those with a greater part j come before
    before += binomial(left - 1 + corners_ - 1 - j, corners_ - 1 - j);
  }
  return static_cast<int>(before);
}

double MultiIndices::multinomial(int position) const {
  double value = 1.0;
  int left = degree_;
  for (const int part : (*this)[position]) {
    value *= binomial(left, part);
    left -= part;
  }
  return value;
}

}  // namespace snug::mesh::curves
