#include "solver/scene/contact_rows.hpp"

#include <algorithm>

namespace snug::solver {

bool on_skin(const MasterStack& master, int facet) { return facet >= master.first_facet(master.surfaces() - 1); }

int skin_facet(const MasterStack& master, int facet) { return facet - master.first_facet(master.surfaces() - 1); }

std::vector<postproc::SurfaceContact> contact_rows(const Touch& touch, const State& state) {
  const Contact& contact = *touch.contact;
  std::vector<postproc::SurfaceContact> rows;
  for (const std::string& master : touch.masters) rows.push_back({.name = touch.slave + " on " + master, .slave = touch.slave, .master = master});
  for (const Contact::PointForce& point : contact.point_forces(state)) {
    if (point.facet < 0 || point.pressing <= 0.0) continue;
    postproc::SurfaceContact& row = rows[contact.master().surface_of(point.facet)];
    const double area = touch.sheet->area_ratio(state, point.triangle, point.L) * point.weight * touch.sheet->pattern_area(point.triangle);
    row.force += point.pressing, row.area += area;
    if (area > 0.0) row.largest_pressure = std::max(row.largest_pressure, point.pressing / area);
  }
  if (touch.friction)
    for (const auto& point : touch.friction->point_forces(state)) rows[contact.master().surface_of(point.facet)].friction_force += point.force.norm();
  return rows;
}

bool has_layers(const Scene& scene) {
  return std::any_of(scene.touches().begin(), scene.touches().end(), [](const Touch& touch) { return touch.sheet && touch.masters.size() > 1; });
}

}  // namespace snug::solver
