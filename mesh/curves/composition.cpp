#include "mesh/curves/composition.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <type_traits>

namespace snug::mesh::curves {

namespace {

/// Polynomials over a simplex by their degree.
struct OnSimplex {
  using Form = BForm;
  static BForm zero(const BForm& region, int degree, int dimension) {
    const int full = degree * region.degree();
    return {region.corners(), full, Eigen::MatrixXd::Zero(dimension, MultiIndices(region.corners(), full).count())};
  }
  static std::vector<int> index(const BForm& form, int position) {
    return {form.indices()[position].begin(), form.indices()[position].end()};
  }
  static int position(const BForm& form, const std::vector<int>& index) { return form.indices().position(index); }
  static double multinomial(const BForm& form, int position) { return form.indices().multinomial(position); }
};

/// Polynomials over a box.
struct OnBox {
  using Form = TensorBezier;
  static TensorBezier zero(const TensorBezier& region, int degree, int dimension) {
    std::vector<int> degrees = region.degrees();
    Eigen::Index count = 1;
    for (int& one : degrees) count *= (one *= degree) + 1;
    return {degrees, Eigen::MatrixXd::Zero(dimension, count)};
  }
  static std::vector<int> index(const TensorBezier& form, int position) { return form.index(position); }
  static int position(const TensorBezier& form, const std::vector<int>& index) { return form.position(index); }
  static double multinomial(const TensorBezier& form, int position) { return form.multinomial(position); }
};

/// Which coefficient the product of two others goes to: coefficients times their multinomials multiply like those of
/// powers.
template <class Kind, class Form>
std::vector<std::vector<int>> product_places(const Form& region, const Form& factor, const Form& product) {
  const auto a_count = region.coefficients().cols(), b_count = factor.coefficients().cols();
  std::vector<std::vector<int>> places(a_count, std::vector<int>(b_count));
  for (int a = 0; a < a_count; ++a)
    for (int b = 0; b < b_count; ++b) {
      std::vector<int> sum = Kind::index(region, a);
      const std::vector<int> other = Kind::index(factor, b);
      for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += other[j];
      places[a][b] = Kind::position(product, sum);
    }
  return places;
}

/// De Casteljau's steps with polynomials in place of numbers: c_a <- sum_j xi_j c_{a + e_j}, each scaled by its
/// multinomials.
template <class Kind, class Form = typename Kind::Form>
Form compose(const BForm& outer, const Form& region) {
  if (region.dimension() != outer.corners())
    throw std::invalid_argument(fmt::format("the region has {} barycentric coordinates, the B-form {} corners",
                                            region.dimension(), outer.corners()));
  Eigen::MatrixXd xi = region.coefficients();
  for (int a = 0; a < xi.cols(); ++a) xi.col(a) *= Kind::multinomial(region, a);
  const int n = outer.degree(), dimension = outer.dimension();
  std::vector<Eigen::MatrixXd> level;
  for (int a = 0; a < outer.indices().count(); ++a) level.push_back(outer.coefficients().col(a));
  for (int step = 1; step <= n; ++step) {
    const MultiIndices lower(outer.corners(), n - step), upper(outer.corners(), n - step + 1);
    const Form factor = Kind::zero(region, step - 1, 1), product = Kind::zero(region, step, 1);
    const auto places = product_places<Kind>(region, factor, product);
    std::vector<Eigen::MatrixXd> next(lower.count(), Eigen::MatrixXd::Zero(dimension, product.coefficients().cols()));
    for (int a = 0; a < lower.count(); ++a)
      for (int j = 0; j < outer.corners(); ++j) {
        std::vector<int> index(lower[a].begin(), lower[a].end());
        ++index[j];
        const Eigen::MatrixXd& from = level[upper.position(index)];
        for (int p = 0; p < xi.cols(); ++p)
          for (int q = 0; q < from.cols(); ++q) next[a].col(places[p][q]) += xi(j, p) * from.col(q);
      }
    level = std::move(next);
  }
  Form result = Kind::zero(region, n, dimension);
  for (int a = 0; a < level[0].cols(); ++a) level[0].col(a) /= Kind::multinomial(result, a);
  if constexpr (std::is_same_v<Form, BForm>)
    return {result.corners(), result.degree(), level[0]};
  else
    return {result.degrees(), level[0]};
}

}  // namespace

BForm composed(const BForm& outer, const BForm& region) { return compose<OnSimplex>(outer, region); }
TensorBezier composed(const BForm& outer, const TensorBezier& region) { return compose<OnBox>(outer, region); }

TensorBezier parallelogram_section() {
  Eigen::MatrixXd xi(4, 4);  // columns (s, t) = (0,0), (0,1), (1,0), (1,1)
  for (int c = 0; c < 4; ++c) {
    const double s = c >> 1, t = c & 1;
    xi.col(c) << 0.5 * s, 0.5 * t, 0.5 * (1.0 - s), 0.5 * (1.0 - t);
  }
  return {{1, 1}, xi};
}

Eigen::VectorXd polygon_coordinates(int corners, const Eigen::Vector2d& point) {
  if (corners < 3) throw std::invalid_argument("a polygon has three corners at least");
  const double step = 2.0 * std::numbers::pi / corners;
  Eigen::VectorXd distance(corners), product = Eigen::VectorXd::Ones(corners);
  for (int e = 0; e < corners; ++e)  // edge e ends at the corners e and e + 1
    distance[e] =
        std::cos(0.5 * step) - std::cos((e + 0.5) * step) * point.x() - std::sin((e + 0.5) * step) * point.y();
  for (int c = 0; c < corners; ++c)
    for (int e = 0; e < corners; ++e)
      if (e != c && (e + 1) % corners != c) product[c] *= distance[e];
  return product / product.sum();
}

}  // namespace snug::mesh::curves
