// A limb from a scanned surface between two cut planes.
#pragma once

#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// Builds the limb of `spec.scan`. Throws input::InputError (no scan section, unreadable or open surface, ...).
Limb limb_from_scan(const input::BodySpec& spec);

}  // namespace snug::mesh
