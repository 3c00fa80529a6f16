// Cylinders with sleeves, described in code: the scenes whose answers are exact.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "cases/input/case.hpp"
#include "solver/scene/garment_cells.hpp"
#include "solver/scene/layers.hpp"
#include "tests/scenes.hpp"

namespace snug::tests {

/// A cylindrical limb with a rigid bone, tissue, and a sleeve as long as the limb whose ends are held along the axis.
struct TubeCase {
  double bone = 0.020, radius = 0.055, length = 0.060;           ///< m
  double taper = 0.0;                                             ///< radius gained along the length
  double sleeve = 0.044;                                          ///< m, rest radius
  std::string tissue = "law = 'neo-Hooke'\nshear_modulus = '10 kPa'\npoisson_ratio = 0.49";
  std::string fabric = "law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '300 N/m'\npoisson = 0";
  int around = 16, along = 4, through = 2;
  double cell_size = 0.0;                                         ///< m, garment; 0: half the skin's
  input::Tier tier = input::Tier::L4;
  input::GapTests basis = input::GapTests::hat;
  input::Elements elements = input::Elements::Q2P1;
  double bone_ratio = 1.0, bone_offset = 0.0;                     ///< width over depth of the bone; m, along x
};

inline std::filesystem::path write_stations(const TubeCase& tube) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("snug-tube-" + std::to_string(::getpid()) + "-" + std::to_string(tube.radius) + "-" + std::to_string(tube.taper) + ".csv");
  std::ofstream out(path);
  out.precision(17);
  out << "height [m], girth [m], bone_girth [m], bone_width_to_depth, bone_x [m]\n";
  for (const double z : {0.0, 0.5 * tube.length, tube.length})
    out << z << ", " << 2.0 * std::numbers::pi * (tube.radius + tube.taper * z) << ", " << 2.0 * std::numbers::pi * tube.bone << ", "
        << tube.bone_ratio << ", " << tube.bone_offset << "\n";
  return path;
}

inline input::Case describe_tube(const TubeCase& tube) {
  input::Case c;
  c.title = "tube";
  c.body.emplace();
  c.body->stations = write_stations(tube);
  input::LayerSpec bone, tissue;
  bone.name = "bone", bone.material.name = "rigid", bone.form = input::LayerForm::rigid;
  tissue.name = "tissue", tissue.material.table = input::table_of(tube.tissue), tissue.cells = tube.through;
  c.body->layers = {bone, tissue};
  c.body->elements = tube.elements;
  c.body->cells_around = tube.around, c.body->cells_along = tube.along;
  c.garments.emplace_back().position = 0.0;
  c.garments.front().pattern.flat_circumference = 2.0 * std::numbers::pi * tube.sleeve;
  c.garments.front().pattern.length = tube.length;
  c.garments.front().fabric.table = input::table_of(tube.fabric);
  c.garments.front().cell_size = tube.cell_size;
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}, {.edge = "lower", .held = input::HeldDirection::axis}};
  c.contacts.emplace_back();
  c.contacts.front().friction = 0.0;
  c.contacts.front().basis = tube.basis;
  c.solver.tier = tube.tier;
  return c;
}

inline solver::Meshes make_meshes(const input::Case& c) {
  solver::Meshes meshes;
  meshes.limb = mesh::make_limb(*c.body);
  meshes.body = mesh::make_body_mesh(*c.body, meshes.limb);
  const solver::Model model = solver::make_model(c, meshes.body);
  for (std::size_t g = 0; g < c.garments.size(); ++g)
    meshes.garments.push_back(mesh::make_tube_mesh(
        c.garments[g], meshes.limb, solver::worn_cell_size(model, static_cast<int>(g), mesh::tube_fit(c.garments[g]), meshes.limb, meshes.body),
        solver::placing_lift(model, meshes.garments, mesh::tube_fit(c.garments[g]))));
  return meshes;
}

inline postproc::RunResult run(const TubeCase& tube) {
  const input::Case c = describe_tube(tube);
  return tests::solve(c, make_meshes(c));
}

}  // namespace snug::tests
