// Skin, borders of layers and core of a scanned body as surfaces, before cells fill what lies between them.
#pragma once

#include <vector>

#include "cases/input/body_spec.hpp"
#include "mesh/body/layering.hpp"
#include "mesh/body/nested_surfaces.hpp"
#include "mesh/body/scan_report.hpp"

namespace snug::mesh {

/// What other cells may do better.
class NotMeshed : public input::InputError {
 public:
  using InputError::InputError;
};

struct ScannedSurfaces {
  std::vector<Cut> cuts;                ///< in the frame of the body, m
  std::vector<NestedSurface> surfaces;  ///< from the skin inwards to the core
  std::vector<input::LocationSpec> locations;  ///< of the case, on a body of other girths where the skin has them
  TriangleSurface kept;                 ///< of the scan, closed by flat faces at the cuts
};

/// The scan mended, cut off at its planes and drawn smooth; layers with a thickness lie that far under the skin, those inside the layer without one
/// over the core. The report says what was done; its cell_size is that which was tried, also where this throws. Throws input::InputError with place
/// and remedy, NotMeshed where smaller cells may do.
ScannedSurfaces scanned_surfaces(const input::BodySpec& spec, const Layering& layering, ScanReport& report);

}  // namespace snug::mesh
