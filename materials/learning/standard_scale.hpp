// Properties of different units made comparable: less their mean, over their standard deviation.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace snug::materials {

/// Rows are entities, columns properties; NaN where an entity lacks one.
struct StandardScale {
  Eigen::VectorXd mean, deviation;  ///< of what is there (n - 1); a column with one value everywhere has deviation 0

  explicit StandardScale(const Eigen::MatrixXd& table);
  /// NaN stays; columns of deviation 0 become 0.
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& table) const;
};

struct Neighbour {
  Eigen::Index row = 0;
  double distance = 0.0;  ///< root of the mean square over the properties that both have, in standard deviations
  int shared = 0;         ///< number of those
};

/// Entities by their distance from the one of row `of`, the nearest first, itself left out, and those that have less than half of its properties.
std::vector<Neighbour> neighbours(const Eigen::MatrixXd& table, Eigen::Index of);

/// Groups of entities that are alike.
struct Clusters {
  std::vector<int> of;         ///< a row
  Eigen::MatrixXd centres;     ///< in the properties' own units, a row a cluster
  double share_between = 0.0;  ///< of the sum of squares about the mean, in standard deviations: 1 where all of a cluster are the same
  int rounds = 0;
};

/// k-means in standard deviations, on rows without NaN. The first centre is the row farthest from the mean, each further one the row farthest from those
/// chosen (the first of equals): the same table gives the same clusters. Ends when no row changes, after 1000 rounds at most. Clusters are numbered by their
/// first row. `count` in 1 .. number of different rows, else std::invalid_argument.
/// Source: Lloyd, IEEE Trans. Inf. Theory 28 (1982) 129; start by Gonzalez, Theor. Comput. Sci. 38 (1985) 293.
Clusters clusters(const Eigen::MatrixXd& table, int count);

}  // namespace snug::materials
