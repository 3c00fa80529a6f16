// All that an entry says of a fabric: what a run takes, the way back, and what stays data.
#pragma once

#include "materials/fabric/sheet.hpp"

namespace snug::materials {

struct FabricData {
  Fabric loading;
  std::optional<Fabric> unloading;  ///< where it was measured
  Sheet sheet;
};

/// As find_fabric.
FabricData fabric_data(const input::MaterialEntry& asked);

}  // namespace snug::materials
