#include "mesh/garment/sliding.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>

#include "mesh/garment/corner_gradients.hpp"

namespace snug::mesh {

namespace {

using Gradient = Eigen::Matrix<double, 3, 2>;
using Tangents = Eigen::Matrix<double, 3, 2>;

constexpr int most_steps = 60;
constexpr double at_rest = 1e-4;  // of the mean edge: the longest step that is no longer worth another

struct Triangle : CornerGradients {
  std::array<int, 3> unknown;
};

/// The isometry nearest to a gradient.
Gradient isometry(const Gradient& gradient) {
  const auto svd = gradient.jacobiSvd(Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU().leftCols<2>() * svd.matrixV().transpose();
}

class Sliding {
 public:
  Sliding(const SewnMesh& sewn, const LimbSheet& sheet) : sheet_(sheet), round_(sheet.mean_girth()), rest_(at_rest * sewn.mean_edge) {
    std::vector<int> unknown(sewn.flat.size(), -1);
    for (const auto& t : sewn.triangles) {
      Triangle triangle{corner_gradients(sewn.flat[t[0]], sewn.flat[t[1]], sewn.flat[t[2]]), {}};
      for (int k = 0; k < 3; ++k) {
        int& number = unknown[sewn.merged[t[k]]];
        if (number < 0) number = static_cast<int>(vertices_.size()), vertices_.push_back(sewn.merged[t[k]]);
        triangle.unknown[k] = number;
      }
      triangles_.push_back(triangle);
    }
  }

  void operator()(std::vector<ChartPlace>& places) {
    std::vector<ChartPlace> now;
    for (const int v : vertices_) now.push_back(places[v]);
    if (!look(now)) return;
    for (int step = 0; step < most_steps; ++step) {
      const Eigen::VectorXd direction = next_step();
      double length = 1.0;
      std::vector<ChartPlace> tried = moved(now, direction, length);
      while (!look(tried) && length > 1e-2) tried = moved(now, direction, length *= 0.5);
      if (length <= 1e-2) break;
      now = tried;
      if (direction.cwiseAbs().maxCoeff() < rest_) break;
    }
    for (std::size_t n = 0; n < vertices_.size(); ++n) places[vertices_[n]] = now[n];
  }

 private:
  std::vector<ChartPlace> moved(std::vector<ChartPlace> places, const Eigen::VectorXd& direction, double length) const {
    for (std::size_t n = 0; n < places.size(); ++n)
      places[n].share += length * direction[2 * n] / round_, places[n].height += length * direction[2 * n + 1];
    return places;
  }

  /// What a triangle needs of the surface where its middle lies.
  struct There {
    Tangents tangents;
    Gradient gradient;
  };

  /// Puts the vertices there; false where a triangle is turned over.
  bool look(const std::vector<ChartPlace>& places) {
    std::vector<There> there;
    for (const Triangle& t : triangles_) {
      const ChartPlace& first = places[t.unknown[0]];
      Eigen::Matrix<double, 2, 3> corners;  // lengths round and heights, from the first corner
      for (int k = 0; k < 3; ++k) {
        const ChartPlace& corner = places[t.unknown[k]];
        corners.col(k) << round_ * std::remainder(corner.share - first.share, 1.0), corner.height - first.height;
      }
      const Eigen::Matrix2d chart = corners * t.shape.transpose();
      if (!(chart.determinant() > 0.0)) return false;
      const Eigen::Vector2d middle = corners.rowwise().mean();
      const SheetPoint p = sheet_.near(first.share + middle[0] / round_, first.height + middle[1]);
      There& now = there.emplace_back();
      now.tangents << p.x_round / round_, p.x_up;
      now.gradient = now.tangents * chart;
    }
    there_ = std::move(there);
    return true;
  }

  /// From where the vertices were put last.
  Eigen::VectorXd next_step() const {
    const auto size = static_cast<Eigen::Index>(2 * vertices_.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(size);
    double trace = 0.0;
    for (std::size_t n = 0; n < triangles_.size(); ++n) {
      const Triangle& t = triangles_[n];
      const auto& [tangents, gradient] = there_[n];
      const Gradient force = 2.0 * t.area * (gradient - isometry(gradient));
      const Eigen::Matrix2d metric = tangents.transpose() * tangents;
      for (int a = 0; a < 3; ++a) {
        slope.segment<2>(2 * t.unknown[a]) += tangents.transpose() * force * t.shape.col(a);
        for (int b = 0; b < 3; ++b) {
          const Eigen::Matrix2d block = 2.0 * t.area * t.shape.col(a).dot(t.shape.col(b)) * metric;
          if (a == b) trace += block.trace();
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) entries.emplace_back(2 * t.unknown[a] + i, 2 * t.unknown[b] + j, block(i, j));
        }
      }
    }
    for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 1e-8 * trace / static_cast<double>(size));
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return without_drift(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix), slope);
  }

  /// The step whose mean turn and mean rise vanish.
  static Eigen::VectorXd without_drift(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factor, const Eigen::VectorXd& slope) {
    Eigen::MatrixXd means = Eigen::MatrixXd::Zero(slope.size(), 2);
    for (Eigen::Index n = 0; n < slope.size(); n += 2) means(n, 0) = means(n + 1, 1) = 1.0;
    const Eigen::VectorXd free = factor.solve(slope);
    const Eigen::MatrixXd drift = factor.solve(means);
    const Eigen::Matrix2d own = means.transpose() * drift;
    const Eigen::Vector2d held = own.fullPivLu().solve(means.transpose() * free);
    return -(free - drift * held);
  }

  const LimbSheet& sheet_;
  double round_, rest_;  // m
  std::vector<int> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<There> there_;
};

}  // namespace

void slide(const SewnMesh& sewn, const LimbSheet& sheet, std::vector<ChartPlace>& places) { Sliding(sewn, sheet)(places); }

}  // namespace snug::mesh
