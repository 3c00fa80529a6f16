// Graduated tubes that are made for a course of pressures: their circumferences by the law of Laplace, and better ones after a solution.
#pragma once

#include <vector>

#include "postproc/result.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// Pressure (Pa) that a tube is made for at a height over its lower edge (m): straight between its rows, beyond them as at the ends.
double wanted_pressure(const input::PatternSpec& tube, double height);

/// Circumferences with which the tube would press by the law of Laplace as it is to, sliding freely on the undeformed skin: at each height the tension
/// T = p G / (2 pi) of a limb of girth G, and the circumference at which the fabric there bears it. Throws input::InputError where the fabric does not bear
/// it at any stretch up to 3.
std::vector<input::GirthRow> laplace_girths(const GarmentModel& garment, const mesh::Limb& limb);

/// What the tubes that are made for pressures press with: one row a height of their `pressures`, the mean over a ring of the skin about it that leaves
/// the strips beside the hems out.
std::vector<postproc::ProfileRow> pressure_profile(const Model& model, const Meshes& meshes, const postproc::RunResult& run);

/// The circumferences of a garment of that run, each changed so that its tension grows as the pressure of the ring about it is short of what is wanted.
std::vector<input::GirthRow> corrected_girths(const Model& model, int garment, const Meshes& meshes, const postproc::RunResult& run);

}  // namespace snug::solver
