// STEP and IGES by OpenCASCADE. A library of its own, so that only a program that converts such files links it.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/formats/curve_set.hpp"

namespace snug::mesh {

/// True for names that end in .step, .stp, .iges or .igs.
bool is_cad_file(const std::filesystem::path& file);

/// Curves and surfaces as B-splines, in m. STEP gives names of products, IGES none. Faces come as their surfaces within
/// the parameters of the face; what its border trims off inside of those is not cut. Analytic curves and surfaces come
/// as the rational B-splines that equal them. Runs OpenCASCADE in a process of its own. Throws input::InputError at the
/// file.
CurveSet read_cad_file(const std::filesystem::path& file);

/// The text of a STEP file (AP214) or, when the name says so, of an IGES file, in millimetres with 17 digits; curves
/// and surfaces, the ends clamped. STEP takes the names as those of products. Nets and B-forms are not written; the
/// caller says so. Throws input::InputError at `file` where OpenCASCADE refuses a shape.
std::string cad_text(const CurveSet& set, const std::filesystem::path& file);

}  // namespace snug::mesh
