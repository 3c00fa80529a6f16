// A small result with every field filled: two curved hexahedra and a garment of two triangles.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "postproc/result.hpp"

namespace snug::postproc::test {

inline BodyResult body_scene() {
  BodyResult body;
  // 5 x 3 x 3 lattice, bent round the z axis; cells side by side in i.
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 5; ++i) {
        const double angle = 0.2 * i, radius = 0.04 + 0.01 * k;
        body.nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.02 * j);
      }
  const auto node = [](int i, int j, int k) { return 15 * k + 5 * j + i; };
  for (int c = 0; c < 2; ++c) {
    std::array<int, 27> cell;
    std::array<int, 9> facet;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) cell[9 * k + 3 * j + i] = node(2 * c + i, j, k);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) facet[3 * j + i] = node(2 * c + i, j, 2);
    body.cells.push_back(cell);
    body.skin_facets.push_back(facet);
  }
  body.layers = {"muscle", "skin"};
  body.cell_layer = {0, 1};
  body.locations = {"Front thigh", "Side thigh"};
  std::vector<Eigen::Vector3d> displacement;
  std::vector<double> pressure, coverage;
  std::vector<Stress> stress;
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    const bool skin = n >= 30;
    body.node_location.push_back(!skin ? -1 : n % 5 < 3 ? 0 : 1);
    displacement.emplace_back(1e-3 * n, -2e-5 * n, n == 7 ? 0.25 : 0.0);
    pressure.push_back(skin ? 300.0 : 0.0);
    coverage.push_back(skin && n % 5 < 3 ? 1.0 : 0.0);
    stress.push_back((Stress() << 100 + 1.0 * n, 50, -20, 10, 5, -1e-7).finished());
  }
  body.fields.set(field::displacement, displacement);
  body.fields.set(field::contact_pressure, pressure);
  body.fields.set(field::coverage, coverage);
  add_stress(body.fields, stress);
  return body;
}

inline GarmentResult garment_scene() {
  GarmentResult garment;
  std::vector<double> pressure;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      garment.pattern.emplace_back(0.1 * i, 0.1 * j);
      garment.placed.emplace_back(0.1 * i, 0.1 * j, 0.0);
      garment.current.emplace_back(0.11 * i, 0.1 * j, 0.02);
      pressure.push_back(10.0 * (i + j));
    }
  garment.triangles = {{0, 2, 6, 1, 4, 3}, {2, 8, 6, 5, 7, 4}};
  garment.fields.set(field::contact_pressure, pressure);
  garment.fields.set(field::tension_warp, {20, 21});
  garment.fields.set(field::tension_weft, {10, 11});
  garment.fields.set(field::shear, {0.5, -0.5});
  garment.fields.set(field::stretch, {{1.1, 1.05}, {1.2, 0.95}});
  garment.fields.set(field::wrinkled, {0, 1});
  return garment;
}

inline RunResult run_scene() {
  RunResult run;
  run.title = "two cells";
  run.tier = "L4";
  run.status = postproc::Status::converged;
  run.body = body_scene();
  run.garment = garment_scene();
  run.history = {{.increment = 1, .load = 0.5, .iteration = 1, .residual = 1e-3, .event = "refactored, again"},
                 {.increment = 2, .load = 1.0, .iteration = 4, .residual = 3e-8, .event = ""}};
  run.unknowns = {{"body", 135}, {"garment", 27}};
  run.parts_in = {"body"};
  run.parts_out = {"friction: not in the case"};
  run.phases = {{"mesh", 0.5}, {"solve", 1.5}};
  run.numbers = {{"mean_contact_pressure_Pa", 300.0}};
  return run;
}

/// An empty folder of its own for a test.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / ("snug-postproc-" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace snug::postproc::test
