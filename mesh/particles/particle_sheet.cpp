#include "mesh/particles/particle_sheet.hpp"

#include <array>
#include <initializer_list>

namespace snug::mesh {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

double share(int n, int count) { return count == 1 || (n > 0 && n + 1 < count) ? 1.0 : 0.5; }

/// Flat areas of the particles of a grid times a value per area; none where it has none.
std::vector<double> over_areas(const SheetGrid& grid, double value) {
  std::vector<double> sums;
  for (int j = 0; j < grid.along_weft; ++j)
    for (int i = 0; i < grid.along_warp; ++i)
      sums.push_back(share(i, grid.along_warp) * grid.spacing_warp * share(j, grid.along_weft) * grid.spacing_weft *
                     value);
  return sums;
}

std::vector<HeldComponents> components(const std::vector<bool>& held) {
  std::vector<HeldComponents> all;
  for (const bool one : held) all.push_back(one ? held_all : HeldComponents{0});
  return all;
}

}  // namespace

ParticleSheet::ParticleSheet(const SheetGrid& grid, SheetLaws laws, std::vector<Vector3d> places,
                             const std::vector<bool>& held, std::optional<Repulsion> repulsion)
    : ImplicitParticles(std::move(places), components(held), over_areas(grid, laws.density),
                        over_areas(grid, laws.drag), laws.gravity),
      grid_(grid),
      laws_(std::move(laws)),
      repulsion_(std::move(repulsion)) {}

/// Along every edge: width w times its flat length times the energy of the strip at its stretch.
void ParticleSheet::add_stretch(const Places& x, ForceSum& into) const {
  const auto add_edge = [&](int a, int b, double length, double width, const TensileCurve& curve) {
    into.add_stretch(std::array{Weight{a, -1.0}, Weight{b, 1.0}}, x, length, width * length, curve);
  };
  for (int j = 0; j < grid_.along_weft; ++j)
    for (int i = 0; i < grid_.along_warp; ++i) {
      if (i + 1 < grid_.along_warp)
        add_edge(number(i, j), number(i + 1, j), grid_.spacing_warp, share(j, grid_.along_weft) * grid_.spacing_weft,
                 laws_.warp);
      if (j + 1 < grid_.along_weft)
        add_edge(number(i, j), number(i, j + 1), grid_.spacing_weft, share(i, grid_.along_warp) * grid_.spacing_warp,
                 laws_.weft);
    }
}

/// Of every cell: shear A phi^2/2, sin phi the product of the unit directions of its mean sides.
void ParticleSheet::add_trellis(const Places& x, ForceSum& into) const {
  const double stiffness = laws_.shear * grid_.spacing_warp * grid_.spacing_weft;
  for (int j = 0; j + 1 < grid_.along_weft; ++j)
    for (int i = 0; i + 1 < grid_.along_warp; ++i) {
      const std::array<int, 4> n = {number(i, j), number(i + 1, j), number(i, j + 1), number(i + 1, j + 1)};
      into.add_shear(std::array{Weight{n[0], -1.0}, Weight{n[1], 1.0}, Weight{n[2], -1.0}, Weight{n[3], 1.0}},
                     std::array{Weight{n[0], -1.0}, Weight{n[1], -1.0}, Weight{n[2], 1.0}, Weight{n[3], 1.0}}, x,
                     stiffness);
    }
}

/// Curvatures by second differences of places: of three particles in a row B k^2/2 on the area between their middles;
/// of a cell 4 Bt k^2/2 with the mixed difference and Bt = sqrt(B_warp B_weft)/2, which makes a plate of equal B
/// isotropic.
void ParticleSheet::add_differences(bool twist, ForceSum& into, const Places& x) const {
  const double a = grid_.spacing_warp, b = grid_.spacing_weft;
  const auto add_difference = [&](std::initializer_list<Weight> weights, double stiffness) {
    into.add_difference(Weights(weights.begin(), weights.size()), x, stiffness);
  };
  const double twisting = 2.0 * std::sqrt(laws_.bending_warp * laws_.bending_weft) / (a * b);
  for (int j = 0; j < grid_.along_weft; ++j)
    for (int i = 0; i < grid_.along_warp; ++i) {
      const bool inner_warp = i > 0 && i + 1 < grid_.along_warp, inner_weft = j > 0 && j + 1 < grid_.along_weft;
      if (!twist && inner_warp)
        add_difference({{number(i - 1, j), 1.0}, {number(i, j), -2.0}, {number(i + 1, j), 1.0}},
                       laws_.bending_warp * share(j, grid_.along_weft) * b / (a * a * a));
      if (!twist && inner_weft)
        add_difference({{number(i, j - 1), 1.0}, {number(i, j), -2.0}, {number(i, j + 1), 1.0}},
                       laws_.bending_weft * share(i, grid_.along_warp) * a / (b * b * b));
      if (twist && i + 1 < grid_.along_warp && j + 1 < grid_.along_weft)
        add_difference(
            {{number(i, j), 1.0}, {number(i + 1, j), -1.0}, {number(i, j + 1), -1.0}, {number(i + 1, j + 1), 1.0}},
            twisting);
    }
}

void ParticleSheet::add_repulsion(const Places& x, ForceSum& into) const {
  if (!repulsion_) return;
  const std::vector<double> area = over_areas(grid_, 1.0);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const auto [distance, away] = repulsion_->body(x[n]);
    const double into_reach = repulsion_->reach - distance, stiffness = repulsion_->stiffness * area[n];
    if (into_reach <= 0.0) continue;
    into.energy += 0.5 * stiffness * into_reach * into_reach;
    into.gradient[n] -= stiffness * into_reach * away;
    if (into.second) into.add_block(static_cast<int>(n), static_cast<int>(n), stiffness * away * away.transpose());
  }
}

void ParticleSheet::add(SheetForce kind, const Places& x, ForceSum& into) const {
  switch (kind) {
    case SheetForce::stretch:
      return add_stretch(x, into);
    case SheetForce::trellis:
      return add_trellis(x, into);
    case SheetForce::bend:
      return add_differences(false, into, x);
    case SheetForce::twist:
      return add_differences(true, into, x);
    case SheetForce::repulsion:
      return add_repulsion(x, into);
    case SheetForce::gravity:
      return add_gravity(x, into);
  }
}

void ParticleSheet::add_laws(const Places& x, ForceSum& into) const {
  for (const SheetForce kind :
       {SheetForce::stretch, SheetForce::trellis, SheetForce::bend, SheetForce::twist, SheetForce::repulsion})
    add(kind, x, into);
}

std::vector<Vector3d> ParticleSheet::forces(SheetForce kind) const {
  ForceSum sum(places().size());
  add(kind, places(), sum);
  for (Vector3d& gradient : sum.gradient) gradient = -gradient;
  return sum.gradient;
}

}  // namespace snug::mesh
