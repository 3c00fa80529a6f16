// Curves, surfaces and nets as files hold them: JSON of ours, DXF, STEP, IGES, and pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "mesh/curves/b_form.hpp"
#include "mesh/curves/b_spline.hpp"
#include "mesh/curves/four_point.hpp"

namespace snug::mesh {

template <class Shape>
struct Named {
  std::string name;  ///< empty where the file has none
  Shape shape;
};

/// What a file holds, lengths in m. Curves have two or three coordinates, all others three.
struct CurveSet {
  std::vector<Named<curves::BSplineCurve>> curves;
  std::vector<Named<curves::BSplineSurface>> surfaces;
  std::vector<Named<curves::Net>> nets;     ///< control nets of four-point subdivision
  std::vector<Named<curves::BForm>> forms;  ///< B-forms; Bézier triangles where they have three corners

  bool empty() const { return curves.empty() && surfaces.empty() && nets.empty() && forms.empty(); }
};

/// JSON of ours: {"format": "snug curves", "unit": "1 m", "curves": [{"name", "degree", "knots", "points", "weights"}],
/// "surfaces":
/// [{"name", "degrees", "knots": [[…], […]], "points": rows, "weights": rows}], "nets": [{"name", "closed": [rows,
/// columns], "points": rows}], "forms": [{"name", "corners", "degree", "points"}]}. Left out: weights (all 1), knots
/// (one Bézier segment on [0, 1]), closed (neither). Throws input::InputError with line and column of everything that
/// is wrong.
CurveSet parse_curve_json(const std::string& text, const std::string& shown_as);
/// In m and with 17 digits: what is read back is the same to the last bit.
std::string curve_json(const CurveSet& set);

/// SPLINE entities of a DXF text (group codes of AutoCAD's reference); other entities are left out, their kinds and
/// numbers told in `left_out`. The header's $INSUNITS gives the unit, millimetres where there is none. Throws
/// input::InputError.
CurveSet parse_dxf_splines(const std::string& text, const std::string& shown_as, std::string& left_out);
/// Millimetres, one SPLINE a curve, its name as layer. Surfaces, nets and forms are not written; the caller says so.
std::string dxf_splines(const CurveSet& set);

/// What is drawn of the nets: their points and lines, and the surface after this many steps of subdivision.
struct PictureOptions {
  int subdivisions = 4;
  double width = 640.0;  ///< of the picture, px
};
/// A picture: control polygons and nets thin, curves and lines of the surfaces on top, seen along the axis in which the
/// set is flat, else from the front, right and above.
std::string curve_svg(const CurveSet& set, const PictureOptions& options = {});

}  // namespace snug::mesh
