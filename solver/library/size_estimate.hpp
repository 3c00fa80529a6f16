// What a case will take, reckoned before anything is meshed.
#pragma once

#include "cases/input/case.hpp"
#include "mesh/garment/garment_cut.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// Bytes of the machine, or of the control group that this process is in.
double memory_of_machine();

/// Processes that solve a case fastest: two where there are `cores` for them and the factor takes most of the time, since MUMPS uses
/// them better than a BLAS of two threads does, on blocks of low rank above all. They take more memory, though: one where that would
/// be more than half of `memory` (bytes).
int usual_ranks(const input::Case& description, unsigned cores, double memory);

/// Hexahedra of a body of stations or of a scan, and what meshing and solving them takes. Throws input::InputError with the
/// numbers of cells that would fit when it is over `limit` (bytes).
void refuse_large_body(const input::Case& description, double limit);
/// Triangles of the pattern with edges of `cell_size` (m). Throws input::InputError with a cell size that would fit.
void refuse_large_garment(const mesh::GarmentCut& garment, double cell_size, double limit);
/// The meshed case, of an imported body too. Throws input::InputError.
void refuse_large_plan(const solver::Plan& plan, double limit, const input::Case& description);

}  // namespace snug::solver
