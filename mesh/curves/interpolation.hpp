// The bicubic surface through the points of a net.
#pragma once

#include <span>

#include "mesh/curves/b_spline.hpp"
#include "mesh/curves/four_point.hpp"

namespace snug::mesh::curves {

/// The twice differentiable bicubic B-spline surface that takes the value of the net's point (i, j) at u = `rows`[i], v = `columns`[j]; its u
/// goes along the rows, its v along the columns. Closed columns come round after `period`; rows are open: without curvature at their ends
/// (a natural spline), and straight from there on for `beyond`, so that the surface lives on [rows_0 - beyond, rows_last + beyond] × [columns_0,
/// columns_0 + period]. Rows and columns strictly rising, two rows and three columns at least; checked by the caller.
BSplineSurface surface_through(const Net& net, std::span<const double> rows, std::span<const double> columns, double period, double beyond);

}  // namespace snug::mesh::curves
