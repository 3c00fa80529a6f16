// What commands have found, as parts of their JSON documents (--json): numbers in SI, the unit at the end of the key.
#pragma once

#include "cases/input/key_list.hpp"
#include "materials/database/runs.hpp"
#include "mesh/pattern/checks.hpp"
#include "mesh/pattern/sewn_mesh.hpp"
#include "postproc/comparison.hpp"
#include "postproc/documents.hpp"
#include "solver/app/prepared_case.hpp"

namespace snug::app {

using postproc::Json;

/// {"tier", "in", "out", "unknowns", "memory_bytes", "disk_bytes", "seconds"}; what is not known is null.
Json plan_json(const solver::Plan& plan);
/// Adds "layers", "garments" and, of scans, "scan" and "girths".
void add_meshes(Json& json, const PreparedCase& prepared);
/// Wanted and found pressures, a row a place.
Json targets_json(const std::vector<postproc::TargetRow>& rows);

/// What snug compare found; differences in the unit of the column.
Json comparison_json(const postproc::Comparison& comparison);

/// Pieces, seams and open edges of a pattern; its mesh.
Json pattern_json(const mesh::CheckedPattern& checked);
Json mesh_json(const mesh::SewnMesh& mesh);

/// A key of case.toml or of a law, with kind, unit, default, choices and meaning.
Json key_json(const input::KeyRow& row);

/// An entity of the library with its data, each as printed and in SI.
Json entity_json(const materials::Entity& entity, materials::UnitBook& units);
/// One datum: "item", "printed", "value_SI", "unit_SI", "source".
Json datum_json(const materials::Datum& datum, materials::UnitBook& units);

/// A recorded run; with `whole` its settings, inputs and versions, too.
Json run_json(const materials::RunRecord& run, bool whole);

/// Rows of cells under the names of the first row.
Json rows_json(const std::vector<std::vector<std::string>>& rows);

}  // namespace snug::app
