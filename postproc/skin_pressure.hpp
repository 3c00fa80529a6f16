// From point forces of the garment to pressure and coverage at the nodes of the skin.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

#include "postproc/result.hpp"

namespace snug::postproc {

/// Nodal contact quantities of the skin; every vector has one entry a node of the body mesh (0 off the skin).
struct SkinPressure {
  std::vector<double> pressure;  ///< Pa, force per garment-covered area; 0 where coverage is below 5 %; never negative
  std::vector<double> coverage;  ///< 0..1, covered share of the node's part of the deformed skin
  std::vector<double> area;      ///< m2, covered area of the node; sums to the area of the samples on facets
  std::vector<double> force;     ///< N, consistent nodal force f_j = sum_q force_q N_j(xi_q); sums to the sample forces
  std::vector<double> node_area; ///< m2, of the node's part of the skin (`nodal_areas`)
  double lost_force = 0.0;       ///< N, force of the samples that the returned pressure does not carry (signed):
                                 ///< samples without a facet, uncovered nodes, clipped negative pressures
};

/// Positions of the nodes in the deformed body, m.
std::vector<Eigen::Vector3d> nodes_now(const BodyResult& body);

/// Area of each node's part of the skin, m2: integral of the bilinear hat on the 3 x 3 nodes of each facet. The hats
/// are positive and sum to one, unlike the biquadratic functions, whose negative lobes make a poor measure of area.
/// Facets of 4 or 6 nodes (-1 past them) share the area of the triangles between their nodes.
std::vector<double> nodal_areas(const std::vector<std::array<int, 9>>& facets, std::size_t nodes,
                                const std::vector<Eigen::Vector3d>& positions);

/// Consistent transfer of the samples' forces to nodal pressure: p_j = f_j / sum_q area_q N_j, then `sweeps` Richardson
/// sweeps p += D^-1 (f - M p) towards the solution with the consistent mass M_ij = sum_q area_q N_i N_j.
/// D is the lumped mass; at nodes on a hem, where that is small or negative, half the absolute row sum of M replaces
/// it, which bounds every sweep. Facets of 4 and 6 nodes use bilinear functions and hats on their four triangles as N. A uniform pressure comes back exactly whatever the samples. `positions`: deformed, m,
/// one a node. Samples with facet < 0 carry nothing. Throws std::out_of_range on a bad facet. Source:
/// lumped-to-consistent iteration as in Donea, IJNME 20 (1984), Taylor-Galerkin.
SkinPressure transfer(const std::vector<std::array<int, 9>>& facets, std::size_t nodes,
                      const std::vector<Eigen::Vector3d>& positions, const std::vector<ContactSample>& samples,
                      int sweeps = 2);

/// A nodal field of the skin at the place of a sample that is on a facet, with the shape functions of the transfer.
double field_at(const std::vector<std::array<int, 9>>& facets, const ContactSample& sample, const std::vector<double>& field);

/// Hats of a facet's nodes at a point: what of the cover there counts to each node, 0 to 1, together 1.
std::array<double, 9> hats_at(const std::array<int, 9>& facet, double xi, double eta);

/// Values at a point of a facet of the shape functions of its nodes, as the transfer has them.
std::array<double, 9> shape_at(const std::array<int, 9>& facet, double xi, double eta);

/// Friction (`shear`) of the samples on the nodes, Pa: the nodal pressure times the ratio of shear to normal force round the
/// node. The weights of that ratio are positive hats, so that what obeys |t| <= mu p at the samples does so at the nodes.
/// A node sticks (1) or slips (2) by the larger covered area of its samples; 0 where the pressure is 0.
struct SkinShear {
  std::vector<Eigen::Vector3d> traction;
  std::vector<double> slip;
};
SkinShear transfer_shear(const std::vector<std::array<int, 9>>& facets, const SkinPressure& normal,
                         const std::vector<ContactSample>& samples);

}  // namespace snug::postproc
