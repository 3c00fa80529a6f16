#include "solver/fem/element.hpp"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <stdexcept>

namespace snug::fem {

namespace {

bool simplex(Domain domain) { return domain == Domain::triangle || domain == Domain::tetrahedron; }

/// deal.II's lines, squares and cubes are [0, 1]^d, its simplices are ours: theirs = scale (ours - first).
struct Frame {
  double first, scale;
};
Frame frame(Domain domain) {
  return domain == Domain::line || domain == Domain::square ? Frame{-1.0, 0.5} : Frame{0.0, 1.0};
}

/// Calls `use` with deal.II's element.
template <class Use>
auto with_element(Element element, const Use& use) {
  switch (element) {
    case Element::line2: return use(dealii::FE_Q<1>(1));
    case Element::line3: return use(dealii::FE_Q<1>(2));
    case Element::tri3: return use(dealii::FE_SimplexP<2>(1));
    case Element::tri6: return use(dealii::FE_SimplexP<2>(2));
    case Element::quad4: return use(dealii::FE_Q<2>(1));
    case Element::quad9: return use(dealii::FE_Q<2>(2));
    case Element::tet4: return use(dealii::FE_SimplexP<3>(1));
    case Element::tet10: return use(dealii::FE_SimplexP<3>(2));
    case Element::hex8: return use(dealii::FE_Q<3>(1));
    case Element::hex27: return use(dealii::FE_Q<3>(2));
  }
  throw std::invalid_argument("no such element");
}

template <class Theirs>
auto their_point(Element element, const Points& points, Eigen::Index q) {
  const auto [first, scale] = frame(domain(element));
  dealii::Point<Theirs::dimension> point;
  for (unsigned int d = 0; d < Theirs::dimension; ++d) point[d] = scale * (points(d, q) - first);
  return point;
}

/// Where deal.II has each node of ours: the function that is one there.
template <class Theirs>
std::vector<int> their_order(const Theirs& theirs, Element element) {
  const Points nodes = reference_nodes(element);
  std::vector<int> order;
  for (Eigen::Index a = 0; a < nodes.cols(); ++a) {
    const auto node = their_point<Theirs>(element, nodes, a);
    int i = 0;
    while (theirs.shape_value(i, node) < 0.5) ++i;
    order.push_back(i);
  }
  return order;
}

template <class Theirs>
Table table_of(const Theirs& theirs, Element element, const Points& points) {
  constexpr int dim = Theirs::dimension;
  const double scale = frame(domain(element)).scale;
  const std::vector<int> order = their_order(theirs, element);
  const auto nodes = static_cast<Eigen::Index>(order.size());
  Table table{Eigen::MatrixXd(nodes, points.cols()), {}, {}};
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const auto point = their_point<Theirs>(element, points, q);
    auto& gradient = table.gradients.emplace_back(nodes, dim);
    auto& hessian = table.hessians.emplace_back(nodes, dim * (dim + 1) / 2);
    for (Eigen::Index a = 0; a < nodes; ++a) {
      table.values(a, q) = theirs.shape_value(order[a], point);
      const auto first = theirs.shape_grad(order[a], point);
      const auto second = theirs.shape_grad_grad(order[a], point);
      for (int d = 0; d < dim; ++d) {
        gradient(a, d) = scale * first[d];
        hessian(a, d) = scale * scale * second[d][d];
      }
      for (int d = dim; d < hessian.cols(); ++d) hessian(a, d) = scale * scale * second[d - dim][(d - dim + 1) % dim];
    }
  }
  return table;
}

Points tensor_nodes(int dim, int along, double first) {
  int count = 1;
  for (int d = 0; d < dim; ++d) count *= along;
  Points nodes(dim, count);
  for (int a = 0; a < count; ++a)
    for (int d = 0, rest = a; d < dim; ++d, rest /= along)
      nodes(d, a) = first + (1.0 - first) * (rest % along) / (along - 1.0);
  return nodes;
}

Points simplex_nodes(int dim, int count) {
  Points nodes = Points::Zero(dim, count);
  for (int d = 0; d < dim; ++d) nodes(d, d + 1) = 1.0;
  for (int a = dim + 1; a < count; ++a) {
    const auto [v, w] = simplex_edges[a - dim - 1];
    nodes.col(a) = 0.5 * (nodes.col(v) + nodes.col(w));
  }
  return nodes;
}

}  // namespace

Points reference_nodes(Element element) {
  const int dim = dimension(domain(element)), count = node_count(element);
  if (simplex(domain(element))) return simplex_nodes(dim, count);
  return tensor_nodes(dim, count == 1 << dim ? 2 : 3, frame(domain(element)).first);
}

Table tabulate(Element element, const Points& points) {
  return with_element(element, [&](const auto& theirs) { return table_of(theirs, element, points); });
}

}  // namespace snug::fem
