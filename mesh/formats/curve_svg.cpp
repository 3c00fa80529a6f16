#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/formats/curve_set.hpp"

namespace snug::mesh {

namespace {

using curves::BForm;
using curves::BSplineCurve;
using curves::BSplineSurface;
using curves::Net;

constexpr int fine = 24;  // straight pieces a segment
constexpr int lines = 8;  // lines a patch, each way

/// A line through points, and how it is drawn.
struct Stroke {
  std::string kind;
  std::vector<Eigen::Vector3d> points;
};

Eigen::Vector3d in_space(const Eigen::VectorXd& point) {
  return {point[0], point[1], point.size() > 2 ? point[2] : 0.0};
}

class Strokes {
 public:
  void curve(const BSplineCurve& curve) {
    polygon(curve.points);
    Stroke stroke{"curve", {}};
    for (const curves::WCurve& segment : curve.segments())
      for (int i = 0; i <= fine; ++i) stroke.points.push_back(in_space(segment.point(between(segment.knots(), i))));
    all.push_back(std::move(stroke));
  }
  void surface(const BSplineSurface& surface) {
    grid(surface.rows(), surface.columns(), false, false, surface.points, "net", 1, 1);
    for (const curves::WSurface& patch : surface.patches())
      for (int k = 0; k <= fine; k += fine / lines) {
        Stroke along_u{"surface", {}}, along_v{"surface", {}};
        for (int i = 0; i <= fine; ++i) {
          along_u.points.push_back(patch.point(between(patch.u_knots(), i), between(patch.v_knots(), k)));
          along_v.points.push_back(patch.point(between(patch.u_knots(), k), between(patch.v_knots(), i)));
        }
        all.push_back(std::move(along_u)), all.push_back(std::move(along_v));
      }
  }
  void net(const Net& net, int subdivisions) {
    grid(net.rows, net.columns, net.rows_closed, net.columns_closed, net.points, "net", 1, 1);
    Net smooth = net;
    for (int step = 0; step < subdivisions; ++step) smooth = subdivided(smooth);
    const int stride = 1 << std::max(subdivisions - 1, 0);  // lines through the points and one between
    grid(smooth.rows, smooth.columns, smooth.rows_closed, smooth.columns_closed, smooth.points, "surface", stride,
         stride);
  }
  /// Bézier triangles; of other simplices nothing is a surface by itself.
  void form(const BForm& form) {
    if (form.corners() != 3) return;
    const auto cell = [&](const std::array<int, 3>& a, int from, int to) {
      std::array<int, 3> b = a;
      if (b[from] == 0) return;
      --b[from], ++b[to];
      all.push_back({"net", {form.coefficient(a), form.coefficient(b)}});
    };
    for (int i = 0; i < form.indices().count(); ++i) {
      const std::array<int, 3> a = {form.indices()[i][0], form.indices()[i][1], form.indices()[i][2]};
      cell(a, 0, 1), cell(a, 1, 2), cell(a, 2, 0);
    }
    for (int corner = 0; corner < 3; ++corner)
      for (int k = 0; k < lines; ++k) {
        Stroke stroke{"surface", {}};
        for (int i = 0; i <= fine; ++i) {
          Eigen::Vector3d xi;
          xi[corner] = static_cast<double>(k) / lines;
          xi[(corner + 1) % 3] = (1.0 - xi[corner]) * i / fine;
          xi[(corner + 2) % 3] = 1.0 - xi[corner] - xi[(corner + 1) % 3];
          stroke.points.push_back(form.value(xi));
        }
        all.push_back(std::move(stroke));
      }
  }

  std::vector<Stroke> all;

 private:
  static double between(const curves::SegmentKnots& knots, int i) {
    return knots.start() + (knots.end() - knots.start()) * i / fine;
  }
  void polygon(const Eigen::MatrixXd& points) {
    Stroke stroke{"net", {}};
    for (Eigen::Index i = 0; i < points.cols(); ++i) stroke.points.push_back(in_space(points.col(i)));
    all.push_back(std::move(stroke));
  }
  void grid(int rows, int columns, bool rows_closed, bool columns_closed, const Eigen::MatrixXd& points,
            const char* kind, int row_stride, int column_stride) {
    for (int i = 0; i < rows; i += row_stride) {
      Stroke stroke{kind, {}};
      for (int j = 0; j < columns + columns_closed; ++j)
        stroke.points.push_back(in_space(points.col(i * columns + j % columns)));
      all.push_back(std::move(stroke));
    }
    for (int j = 0; j < columns; j += column_stride) {
      Stroke stroke{kind, {}};
      for (int i = 0; i < rows + rows_closed; ++i)
        stroke.points.push_back(in_space(points.col(i % rows * columns + j)));
      all.push_back(std::move(stroke));
    }
  }
};

/// Two rows: the picture's axes, right and up. A flat set is seen from ahead, any other from the front, right and
/// above.
Eigen::Matrix<double, 2, 3> view_of(const std::vector<Stroke>& strokes) {
  Eigen::AlignedBox3d box;
  for (const Stroke& stroke : strokes)
    for (const Eigen::Vector3d& point : stroke.points) box.extend(point);
  Eigen::Matrix<double, 2, 3> view;
  int flat = 0;
  const double thinnest = box.sizes().minCoeff(&flat);
  if (thinnest <= 1e-9 * box.sizes().maxCoeff()) {
    view.setZero();
    view(0, flat == 0 ? 1 : 0) = 1.0, view(1, flat == 2 ? 1 : 2) = 1.0;
    return view;
  }
  const double turn = 0.6, lift = 0.45;  // rad
  view << std::cos(turn), std::sin(turn), 0.0, -std::sin(turn) * std::sin(lift), std::cos(turn) * std::sin(lift),
      std::cos(lift);
  return view;
}

}  // namespace

std::string curve_svg(const CurveSet& set, const PictureOptions& options) {
  Strokes strokes;
  for (const auto& one : set.surfaces) strokes.surface(one.shape);
  for (const auto& one : set.nets) strokes.net(one.shape, options.subdivisions);
  for (const auto& one : set.forms) strokes.form(one.shape);
  for (const auto& one : set.curves) strokes.curve(one.shape);
  std::stable_sort(strokes.all.begin(), strokes.all.end(),
                   [](const Stroke& a, const Stroke& b) { return a.kind == "net" && b.kind != "net"; });
  const Eigen::Matrix<double, 2, 3> view = view_of(strokes.all);
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : strokes.all)
    for (const Eigen::Vector3d& point : stroke.points) box.extend(Eigen::Vector2d(view * point));
  if (box.isEmpty()) box.extend(Eigen::Vector2d(0, 0));
  const double margin = 12.0, extent = std::max({box.sizes().x(), box.sizes().y(), 1e-300}),
               scale = (options.width - 2.0 * margin) / extent;
  const auto shown = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d at = view * point - box.min();
    return fmt::format("{:.2f},{:.2f}", margin + scale * at.x(), margin + scale * (box.sizes().y() - at.y()));
  };
  std::string text =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"none\">\n",
                  2.0 * margin + scale * box.sizes().x(), 2.0 * margin + scale * box.sizes().y());
  text +=
      "<style>.net{stroke:#d08a3c;stroke-width:1}.surface{stroke:#2f6fa8;stroke-width:.7}.curve{stroke:#1b3f66;stroke-"
      "width:2}</style>\n";
  text += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (const Stroke& stroke : strokes.all) {
    text += fmt::format("<polyline class=\"{}\" points=\"", stroke.kind);
    for (std::size_t i = 0; i < stroke.points.size(); ++i)
      text.append(i > 0 ? " " : "").append(shown(stroke.points[i]));
    text += "\"/>\n";
  }
  return text + "</svg>\n";
}

}  // namespace snug::mesh
