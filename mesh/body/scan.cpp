#include "mesh/body/scan.hpp"

namespace snug::mesh {

Limb limb_from_scan(const input::BodySpec& spec) {
  throw input::InputError(spec.where, "body kind \"scan\" is not built yet", "use kind = \"stations\"");
}

}  // namespace snug::mesh
