// Sizes that no wearer and no garment has: likely slips of a unit or a digit.
#pragma once

#include <vector>

#include "cases/input/case.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// What in the case is likely a slip, each with its place and what was perhaps meant. Throws input::InputError for what cannot be: a body
/// of tens of metres, a garment that would have to stretch to five times its size. The garments need not be meshed, their fits are given.
std::vector<input::Diagnostic> implausible(const Model& model, const Meshes& meshes, const std::vector<mesh::GarmentFit>& fits);

}  // namespace snug::solver
