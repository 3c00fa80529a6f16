// Small bodies and garments for tests.
#pragma once

#include <numbers>

#include "mesh/body/body_mesh.hpp"
#include "mesh/body/elliptic_outline.hpp"
#include "mesh/body/section_centres.hpp"
#include "mesh/garment/garment_mesh.hpp"

namespace snug::mesh {

/// Circular limb of 50 mm radius round a bone of 15 mm, from 0 to 200 mm.
inline Limb cylinder() { return straight_limb({0, 0.05, 0.05, 0, 0}, {0, 0.015, 0.015, 0, 0}, 0.0, 0.2); }

/// Elliptic limb (60 x 45 mm semi-axes, off the origin) round an eccentric bone.
inline Limb ellipse() {
  return straight_limb({0, 0.06, 0.045, 0.01, -0.02}, {0, 0.014, 0.012, 0.015, -0.015}, 0.1, 0.3);
}

/// Rigid bone, tissue, solid skin of 2 mm.
inline input::BodySpec layered_spec() {
  input::BodySpec spec;
  spec.layers.resize(3);
  spec.layers[0].name = "bone";
  spec.layers[0].form = input::LayerForm::rigid;
  spec.layers[1].name = "tissue";
  spec.layers[2].name = "skin";
  spec.layers[2].thickness = 2e-3;
  spec.layers[2].cells = 1;
  spec.cells_around = 16;
  spec.cells_along = 6;
  return spec;
}

inline input::GarmentSpec tube_spec(double circumference = 0.28, double length = 0.06, double position = 0.14) {
  input::GarmentSpec spec;
  spec.pattern.flat_circumference = circumference;
  spec.pattern.length = length;
  spec.position = position;
  return spec;
}

/// What a location covers of the skin by the shares of its nodes: area, m2, and the mean of the points there.
struct Covered {
  double area = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

inline Covered covered_by(const BodyMesh& mesh, int location) {
  Covered covered;
  for (const auto& t : triangulated_nodes(mesh)) {
    const double third = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).norm() / 6.0;
    for (const int n : t) {
      covered.area += third * mesh.location_shares.at(location).at(n);
      covered.middle += third * mesh.location_shares.at(location).at(n) * mesh.nodes[n];
    }
  }
  covered.middle /= covered.area;
  return covered;
}

}  // namespace snug::mesh
