// What was done with a scan until it was a body, for printing and for tests.
#pragma once

#include <string>
#include <vector>

namespace snug::mesh {

/// A cut of a scanned body, m and m2.
struct CutRow {
  std::string name;
  double girth_of_scan = 0.0;  ///< of the section as the scan has it
  double girth = 0.0;          ///< of the mesh
  double area = 0.0;           ///< of the mesh's section
};

/// Section of the largest outline at a height, m.
struct SectionRow {
  double height = 0.0, girth_of_scan = 0.0, girth = 0.0;
  int limbs = 0;  ///< outlines at this height
};

struct ScanReport {
  std::vector<std::string> said;  ///< unit, axes, mendings, what was chosen: one sentence each
  std::vector<CutRow> cuts;
  std::vector<SectionRow> sections;
  double volume_of_scan = 0.0, volume = 0.0;  ///< m3, between the cuts
  double cell_size = 0.0, smoothing_radius = 0.0, deviation_rms = 0.0, deviation_max = 0.0;  ///< m
  int skin_triangles = 0, skin_on_facets = 0;  ///< nodes that stayed on the scan's facets

  bool empty() const { return said.empty() && cuts.empty(); }
};

}  // namespace snug::mesh
