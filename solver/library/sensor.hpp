// What flat sensors between garment and skin would read.
#pragma once

#include <vector>

#include "cases/input/job_spec.hpp"
#include "postproc/evaluate.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// The middles of the sensors of a case on the undeformed skin (m), before anything is solved. Throws input::InputError where one is not on it.
std::vector<Eigen::Vector3d> sensor_places(const std::vector<input::SensorSpec>& sensors, const input::Case& asked, const mesh::BodyMesh& body);

/// One row a sensor of the case: normal force on the skin within a disc about its middle, over the area of the disc (both of the deformed skin; the
/// disc is measured on the undeformed one). `coverage` is the share of the disc that lies under cloth; the force is that share times the mean pressure
/// of the contact's points in the disc, so that what is bare counts as 0 and even cloth reads its pressure whatever the meshes. With `bulge` what a sensor of that thickness adds by the law of Laplace, see bulge_pressure.
/// Throws input::InputError where a sensor's place is not on the skin.
std::vector<postproc::SensorRow> sensor_rows(const std::vector<input::SensorSpec>& sensors, const Model& model, const Meshes& meshes, const postproc::RunResult& run);

/// Pressure (Pa) that a sensor of thickness t and diameter d (m) adds to what it measures: the garment over it, whose principal tensions add up to
/// T (N/m), takes the curvature of the spherical cap over d with height h, 8 h / (d^2 + 4 h^2), in both directions beside its own, so that
/// T 8 h / (d^2 + 4 h^2) comes on top of the pressure. The skin under it yields by t - h as a half space of an incompressible solid with shear modulus
/// G (Pa) does under a flat round punch, mean pressure 16 G (t - h) / (pi d) (Johnson, Contact Mechanics, 1985, eq. 3.36 and 3.40); h is where both
/// are equal. G infinite: the skin does not yield, h = t. A bound from above: a sensor with a flat face and a stiff rim bends the garment less.
double bulge_pressure(double tension, double thickness, double diameter, double shear_modulus);

}  // namespace snug::solver
