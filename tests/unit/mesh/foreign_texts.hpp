// Models of other programs from texts in a test, and what is measured of the bodies that are made of them.
#pragma once

#include <Eigen/Core>

#include <string>

#include "mesh/body/foreign.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

inline Model apdl(const std::string& text) {
  input::Diagnostics diagnostics;
  Model model = parse_apdl(text, "part.cdb", diagnostics);
  diagnostics.throw_if_any();
  return model;
}

inline Model inp(const std::string& text) {
  input::Diagnostics diagnostics;
  Model model = parse_calculix(text, "part.inp", diagnostics);
  diagnostics.throw_if_any();
  return model;
}

template <class Read>
std::string fault(Read read, const std::string& text) {
  try {
    read(text);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

inline input::BodySpec in_centimetres() {
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "part.cdb", spec.unit = 1e-2;
  return spec;
}

inline double volume_of(const BodyMesh& body) {
  double volume = 0.0;
  for (const QualityRow& row : quality(body)) volume += row.volume;
  return volume;
}

inline Eigen::Vector3d resultant(const BodyMesh& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const NodalForce& force : body.forces) sum += force.force;
  return sum;
}

}  // namespace snug::mesh
