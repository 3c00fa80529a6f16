#include "solver/app/convert_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cases/input/files.hpp"
#include "mesh/cad/cad_file.hpp"
#include "mesh/formats/curve_set.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_file = 256u << 20;
constexpr double most_points = 4e6;  // of a net that is subdivided

std::string ending(const std::string& file) {
  std::string text = fs::path(file).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

mesh::CurveSet read(const std::string& file) {
  if (mesh::is_cad_file(file)) return mesh::read_cad_file(file);
  const std::string text = input::read_file(file, {.most = largest_file});
  if (ending(file) == ".json") return mesh::parse_curve_json(text, file);
  std::string left_out;
  mesh::CurveSet set = mesh::parse_dxf_splines(text, file, left_out);
  if (!left_out.empty()) fmt::print(stderr, "note: {}: only SPLINE is read; left out: {}\n", file, left_out);
  return set;
}

void tell_what_is_lost(const mesh::CurveSet& set, const std::string& to, bool surfaces_too) {
  std::string lost;
  const auto add = [&](std::size_t count, const char* kind) {
    if (count > 0) lost += fmt::format("{}{} {}{}", lost.empty() ? "" : ", ", count, kind, count == 1 ? "" : "s");
  };
  if (!surfaces_too) add(set.surfaces.size(), "surface");
  add(set.nets.size(), "net"), add(set.forms.size(), "B-form");
  if (!lost.empty()) fmt::print(stderr, "note: {} cannot hold and does not have: {}\n", to, lost);
}

void subdivide(mesh::CurveSet& set, int steps, const std::string& from) {
  for (auto& [name, net] : set.nets)
    for (int step = 0; step < steps; ++step) {
      if (4.0 * static_cast<double>(net.points.cols()) > most_points)
        throw input::InputError(
            {from, 0, 0}, fmt::format("the net \"{}\" has {} points after {} steps", name, net.points.cols(), step),
            "ask for fewer steps");
      net = mesh::curves::subdivided(net);
    }
}

std::string text_for(const std::string& to, mesh::CurveSet& set, int subdivisions, const std::string& from) {
  if (ending(to) == ".svg") {
    mesh::PictureOptions options;
    if (subdivisions > 0) options.subdivisions = std::min(subdivisions, 6);
    return mesh::curve_svg(set, options);
  }
  if (ending(to) == ".json") {
    subdivide(set, subdivisions, from);
    return mesh::curve_json(set);
  }
  tell_what_is_lost(set, to, mesh::is_cad_file(to));
  if (mesh::is_cad_file(to)) return mesh::cad_text(set, to);
  if (set.curves.empty())
    throw input::InputError({to, 0, 0}, "there is no curve to write", "surfaces go to .step, .igs, .json and .svg");
  return mesh::dxf_splines(set);
}

}  // namespace

bool is_curve_file(const std::string& file) {
  return ending(file) == ".json" || ending(file) == ".dxf" || mesh::is_cad_file(file);
}

void convert_curves(const std::string& from, const std::string& to, int subdivisions) {
  if (!is_curve_file(to) && ending(to) != ".svg")
    throw input::InputError({to, 0, 0}, "the name does not say in which format",
                            "end it in .json, .step, .igs, .dxf or .svg");
  mesh::CurveSet set = read(from);
  write_named(to, text_for(to, set, subdivisions, from));
}

}  // namespace snug::app
