#include "solver/library/size_estimate.hpp"

#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace snug::solver {

namespace {

// Bytes by count, measured with shipped cases (peak of snug check, 2026-11), rounded up.
constexpr double meshing_node = 2e3, meshing_triangle = 2e3;

std::string gigabytes(double bytes) { return fmt::format("{:.3g} GB", 1e-9 * bytes); }

double solid_cells(const input::BodySpec& body) {
  double cells = 0.0;
  for (const input::LayerSpec& layer : body.layers)
    if (layer.form == input::LayerForm::solid) cells += layer.cells;
  return cells;
}

struct BodySize {
  double nodes, unknowns;
};

BodySize body_size(const input::BodySpec& body, double around, double along, double through) {
  const bool quadratic = body.elements != input::Elements::Q1P0;
  const double nodes = 2.0 * around * (2.0 * along + 1.0) * (2.0 * through + 1.0);  // meshed with 27 nodes in any case
  return {nodes, 3.0 * (quadratic ? nodes : nodes / 8.0)};
}

double body_bytes(const input::BodySpec& body, double around, double along, double through, bool deformable) {
  const BodySize size = body_size(body, around, along, through);
  return meshing_node * size.nodes + need_of_run(0.0, deformable ? size.unknowns : 0.0).memory_beside_disk;
}

// docs/growth.md has the times on one rank and on two.
constexpr double two_ranks_from = 1e5;  // unknowns of the body
constexpr double memory_of_two = 1.4;   // over that of one rank

/// A folder in memory (tmpfs) would take what is to be saved.
void refuse_small_disk(double bytes, const std::filesystem::path& folder, const input::Location& where) {
  struct statfs about {};
  if (::statfs(folder.c_str(), &about) != 0) return;  // it is told when it is written to
  const std::string found = fmt::format("the factor of the matrix does not fit into memory and takes {} on disk; ", gigabytes(bytes)), remedy = "set TMPDIR to a folder on a larger disk, or take fewer cells";
  if (about.f_type == TMPFS_MAGIC || about.f_type == RAMFS_MAGIC) throw input::InputError(where, found + folder.string() + " is itself in memory", remedy);
  const double room = static_cast<double>(about.f_bavail) * static_cast<double>(about.f_bsize);
  if (bytes > room) throw input::InputError(where, fmt::format("{}there are {} in {}", found, gigabytes(room), folder.string()), remedy);
}

}  // namespace

double memory_of_machine() {
  double bytes = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double limit = 0.0;
    if (std::ifstream(file) >> limit && limit > 0.0) bytes = std::min(bytes, limit);
  }
  return bytes;
}

int usual_ranks(const input::Case& description, unsigned cores, double memory) {
  const bool lattice = description.body && description.body->kind != input::BodyKind::imported;
  if (!lattice || description.solver.tier != input::Tier::L4 || cores < 2) return 1;
  const input::BodySpec& body = *description.body;
  const double unknowns = body_size(body, body.cells_around, body.cells_along, solid_cells(body)).unknowns;
  return unknowns >= two_ranks_from && memory_of_two * need_of_run(0.0, unknowns).memory <= 0.5 * memory ? 2 : 1;
}

void refuse_large_body(const input::Case& description, double limit) {
  const input::BodySpec& body = *description.body;
  const double through = solid_cells(body), around = body.cells_around, along = body.cells_along;
  const bool deformable = description.solver.tier == input::Tier::L4;
  const double bytes = body_bytes(body, around, along, through, deformable);
  if (bytes <= limit) return;
  double factor = 1.0;  // of all three counts
  while (factor > 1e-3 && body_bytes(body, factor * around, factor * along, factor * through, deformable) > limit) factor *= 0.95;
  throw input::InputError(body.where, fmt::format("{:.0f} x {:.0f} x {:.0f} cells take about {}, there are {}", around, along, through, gigabytes(bytes), gigabytes(limit)),
                          fmt::format("about cells_around = {:.0f}, cells_along = {:.0f} and {:.0f} cells through the layers fit; --memory says what may be taken",
                                      std::floor(factor * around), std::floor(factor * along), std::max(1.0, std::floor(factor * through))));
}

void refuse_large_garment(const mesh::GarmentCut& garment, double cell_size, double limit) {
  const auto [area, border] = mesh::size_of(garment);
  const double sides = border / cell_size;
  const double triangles = area / (0.433 * cell_size * cell_size) + sides;  // equilateral, and at least one at each edge of the rim
  const double unknowns = 3.0 * triangles * (garment.spec.order == 2 ? 2.0 : 0.5);
  const double bytes = triangles * meshing_triangle + need_of_run(unknowns, 0.0).memory;
  if (bytes <= limit) return;
  throw input::InputError(garment.spec.where,
                          fmt::format("a pattern of {:.4g} m2 in triangles of {:.3g} mm has about {:.2g} of them, which take about {}; there are {}",
                                      area, 1e3 * cell_size, triangles, gigabytes(bytes), gigabytes(limit)),
                          fmt::format("about cell_size = \"{:.3g} mm\" fits; see whether the measures are those that were meant",
                                      1e3 * cell_size * std::max(std::sqrt(bytes / limit), triangles > 0.0 ? bytes / limit * sides / triangles : 1.0)));
}

void refuse_large_plan(const solver::Plan& plan, double limit, const input::Case& description) {
  const input::Location where{(description.directory / "case.toml").string(), 0, 0};
  if (plan.memory_bytes > limit)
    throw input::InputError(where, fmt::format("the case is expected to take {}, there are {}", gigabytes(plan.memory_bytes), gigabytes(limit)),
                            "take fewer cells; --memory says what may be taken");
  if (plan.disk_bytes > 0.0) refuse_small_disk(plan.disk_bytes, std::filesystem::temp_directory_path(), where);
}

}  // namespace snug::solver
