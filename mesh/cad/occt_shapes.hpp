// Our curves and surfaces as shapes of OpenCASCADE, in millimetres, and back. For the sources of this folder only.
#pragma once

#include <TopoDS_Shape.hxx>

#include "mesh/formats/curve_set.hpp"

namespace snug::mesh {

constexpr double millimetre = 1e-3;

/// No message of OpenCASCADE reaches the terminal.
void silence_occt();

/// An edge and a face. Throw Standard_Failure.
TopoDS_Shape shape_of(const curves::BSplineCurve& curve);
TopoDS_Shape shape_of(const curves::BSplineSurface& surface);

/// Adds the faces of a shape and its edges that belong to no face. Throws Standard_Failure.
void add_shape(const TopoDS_Shape& shape, const std::string& name, CurveSet& to);

}  // namespace snug::mesh
