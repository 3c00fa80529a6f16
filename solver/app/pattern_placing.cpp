#include "solver/app/pattern_placing.hpp"

#include <fmt/format.h>

#include <chrono>

#include "cases/input/choice.hpp"
#include "mesh/placement/placed_drawing.hpp"
#include "postproc/grid.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::string body_text(const mesh::DressForm& form) {
  const mesh::Landmarks& marks = form.marks;
  const auto mm = [](double length) { return 1e3 * length; };
  return fmt::format(
      "\nbody\n  height {:.0f} mm; heights of ankle {:.0f}, crotch {:.0f}, seat {:.0f}, waist {:.0f}, armpit {:.0f} "
      "mm\n"
      "  taped girths: seat {:.0f}, waist {:.0f}, chest {:.0f} mm\n",
      mm(form.body.stature), mm(marks.ankle), mm(marks.crotch), mm(marks.seat), mm(marks.waist), mm(marks.armpit),
      mm(marks.seat_girth), mm(marks.waist_girth), mm(marks.chest_girth));
}

std::string placed_text(const mesh::PlacedGarment& placed) {
  const mesh::StretchFigures& s = placed.figures;
  std::string text = fmt::format("\nplaced {}\n", placed.kind ? "as a garment with " + input::text_of(*placed.kind)
                                                              : "from the places of its pieces");
  if (!placed.kind) text += fmt::format("  all pieces raised by {:.0f} mm\n", 1e3 * placed.lift);
  text += fmt::format("  gap between nodes of a seam: {:.1f} mm at first, {:.2f} mm before merging{}\n",
                      1e3 * placed.first_gap, 1e3 * placed.last_gap,
                      placed.widest_seam.empty() ? "" : " (" + placed.widest_seam + ")");
  text += fmt::format("  principal stretch: median {:.3f}, 99 % {:.3f}, largest {:.3f}; smallest {:.3f}\n", s.median,
                      s.percentile_99, s.largest, s.smallest);
  text += fmt::format(
      "  mended in {} rounds: {} triangles pushed out of the body, {} folded ones smoothed, {} squeezed ones widened\n",
      placed.mended.rounds, placed.mended.pushed_out, placed.mended.smoothed, placed.mended.widened);
  text += fmt::format("  pairs of triangles of the cloth that cross each other: {}\n", placed.self_crossings);
  for (const mesh::Criterion& one : placed.acceptance)
    text += fmt::format("  {:<4} {}: {}\n", one.met ? "yes" : "NO", one.what, one.found);
  return text;
}

Json placed_json(const mesh::PlacedGarment& placed) {
  const mesh::StretchFigures& s = placed.figures;
  Json criteria = Json::array();
  for (const mesh::Criterion& one : placed.acceptance) criteria.push_back({{"criterion", one.what}, {"found", one.found}, {"met", one.met}});
  return {{"first_gap_m", placed.first_gap}, {"last_gap_m", placed.last_gap}, {"widest_seam", placed.widest_seam}, {"self_crossings", placed.self_crossings},
          {"principal_stretch", {{"smallest", s.smallest}, {"median", s.median}, {"percentile_99", s.percentile_99}, {"largest", s.largest}}}, {"acceptance", criteria}};
}

void write_garment(const mesh::SewnMesh& sewn, const mesh::PlacedGarment& placed, const fs::path& file) {
  std::vector<std::array<int, 3>> corners;
  for (const auto& t : sewn.triangles) corners.push_back({t[0], t[1], t[2]});
  postproc::Grid grid = postproc::surface_grid(placed.places, corners);
  std::vector<Eigen::Vector2d> stretches;
  for (const auto& [larger, smaller] : placed.stretches) stretches.emplace_back(larger, smaller);
  grid.fields.add({"principal_stretch",
                   "",
                   "length as placed over that in the flat piece",
                   postproc::Place::cell,
                   std::move(stretches),
                   {"larger", "smaller"}});
  grid.fields.add({"piece", "", "index into piece_names", postproc::Place::cell, sewn.triangle_piece, {}});
  grid.names.emplace_back("piece_names", sewn.pieces);
  postproc::write_grid(grid, file);
}

}  // namespace

void place_on_scan(const mesh::CheckedPattern& checked, const mesh::SewnMesh& sewn, const PlacingRequest& request, Console& console) {
  Clock::time_point begin = Clock::now();
  const mesh::DressForm form(
      mesh::standing_body(mesh::read_surface(request.scan), request.axes, {request.scan.string()}));
  const double body_seconds = seconds_since(begin);
  console.say(body_text(form));
  begin = Clock::now();
  const mesh::PlacedGarment placed = mesh::place_garment(checked, sewn, form, request.options);
  const double seconds = seconds_since(begin);
  console.print("{}  {:.2f} s, and {:.2f} s for the body\n", placed_text(placed), seconds, body_seconds);
  write_garment(sewn, placed, request.out / "garment.vtu");
  postproc::write_grid(postproc::surface_grid(form.body.surface.vertices, form.body.surface.triangles),
                       request.out / "body.vtu");
  write_named(request.out / "placed.svg", mesh::placed_svg(placed, form));
  console.document()["placed"] = placed_json(placed);
  console.print("\nplaced shape: {0}/garment.vtu, {0}/body.vtu, {0}/placed.svg\n", request.out.string());
  mesh::check_accepted(placed, checked.pattern);
}

}  // namespace snug::app
