// How far a step may go before a point of the body inverts.
#pragma once

#include <Eigen/Core>

namespace snug::solver {

/// First root in (0, limit] of det(F + a dF) = 0.05 det F, a cubic in a; `limit` when there is none.
double first_inversion(const Eigen::Matrix3d& F, const Eigen::Matrix3d& dF, double limit);

}  // namespace snug::solver
