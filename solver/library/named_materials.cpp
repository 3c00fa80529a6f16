#include "solver/library/named_materials.hpp"

#include "materials/database/named.hpp"

namespace snug::solver {

void resolve_materials(input::Case& description, const std::filesystem::path& library) {
  input::Diagnostics diagnostics;
  const auto resolve = [&](input::MaterialEntry& entry, materials::Kind kind) {
    try {
      entry = materials::resolved(entry, kind, library);
    } catch (const input::InputError& error) {
      for (const input::Diagnostic& one : error.errors()) diagnostics.error(one.where, one.found, one.remedy);
    }
  };
  for (input::GarmentSpec& garment : description.garments) {
    resolve(garment.fabric, materials::Kind::fabric);
    for (input::ZoneSpec& zone : garment.zone) resolve(zone.fabric, materials::Kind::fabric);
  }
  if (description.body)
    for (input::LayerSpec& layer : description.body->layers) resolve(layer.material, materials::Kind::tissue);
  diagnostics.throw_if_any();
}

}  // namespace snug::solver
