#include "mesh/body/branching_body.hpp"

#include <fmt/format.h>

#include <utility>

#include "mesh/body/scan.hpp"

namespace snug::mesh {

using input::InputError;

namespace {

/// Of two cuts the lower one and the upper one along the file's up axis.
std::pair<const input::NamedCut*, const input::NamedCut*> by_height(const input::ScanSpec& scan) {
  const int axis = static_cast<int>(scan.up);
  const auto height = [&](const input::NamedCut& cut) { return (axis < 3 ? 1.0 : -1.0) * cut.point[axis % 3]; };
  const auto &a = scan.cuts[0], &b = scan.cuts[1];
  return height(a) < height(b) ? std::pair{&a, &b} : std::pair{&b, &a};
}

}  // namespace

input::BodySpec with_lower_and_upper(const input::BodySpec& spec) {
  input::BodySpec limb = spec;
  if (spec.scan->lower || spec.scan->cuts.size() != 2) return limb;
  const auto [low, high] = by_height(*spec.scan);
  limb.scan->lower = input::CutPlane{low->point, low->normal}, limb.scan->upper = input::CutPlane{high->point, high->normal};
  return limb;
}

void name_cuts(const input::BodySpec& spec, BodyMesh& mesh) {
  if (!spec.scan || spec.scan->cuts.size() != 2) return;
  const auto [low, high] = by_height(*spec.scan);
  for (const auto& [surface, name] : {std::pair{"lower", low->name}, std::pair{"upper", high->name}})
    if (const Surface* face = mesh.surface(surface); face && !mesh.surface(name)) {
      Surface same = *face;
      same.name = name;
      mesh.surfaces.push_back(std::move(same));
    }
}

CellChoice choose_cells(const input::BodySpec& spec) {
  if (!spec.scan) return {};
  const input::ScanSpec& scan = *spec.scan;
  if (scan.cells != input::ScanCells::automatic) return {scan.cells == input::ScanCells::tetrahedra, "as the case asks"};
  if (scan.core || !scan.bone) return {true, "the body has a core instead of one bone's outline"};
  if (scan.cuts.empty()) return {false, "one limb lies between two cuts"};
  if (scan.cuts.size() != 2) return {true, fmt::format("there are {} cuts", scan.cuts.size())};
  try {
    limb_from_scan(with_lower_and_upper(spec));
  } catch (const InputError& error) {
    return {true, fmt::format("no single limb lies between the two cuts ({})", error.what())};
  }
  return {false, "one limb lies between two cuts"};
}

}  // namespace snug::mesh
