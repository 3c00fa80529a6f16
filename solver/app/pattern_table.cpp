#include "solver/app/pattern_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace snug::app {

namespace {

using mesh::CheckedPattern;

std::string pieces_text(const mesh::Pattern& pattern) {
  std::string text = fmt::format("pieces\n  {:<24} {:>10} {:>9} {:>9}  fabric\n", "", "area cm2", "wide mm", "high mm");
  for (const mesh::Piece& piece : pattern.pieces) {
    const Eigen::Vector2d size = mesh::box(piece).sizes();
    const auto& fabric = piece.fabric ? piece.fabric : pattern.fabric;
    const std::string name = !fabric ? "the garment's" : fabric->name.empty() ? "of its own" : fabric->name;
    text += fmt::format("  {:<24} {:>10.1f} {:>9.1f} {:>9.1f}  {}{}\n", piece.name, 1e4 * mesh::area(piece),
                        1e3 * size.x(), 1e3 * size.y(), name, piece.from_inside ? ", drawn from its inside" : "");
    for (const mesh::PieceEdge& edge : piece.edges)
      text += fmt::format("    {:<32} {:>8.1f} mm\n", edge.name, 1e3 * mesh::ArcLength(edge.curve).length());
  }
  return text;
}

std::string seams_text(const mesh::Pattern& pattern) {
  if (pattern.seams.empty()) return "\nno seams\n";
  std::string text = fmt::format("\nseams\n  {:<24} {:>9} {:>9} {:>7}\n", "", "a mm", "b mm", "ease %");
  for (const mesh::Seam& seam : pattern.seams) {
    const double a = mesh::length(pattern, seam.a), b = mesh::length(pattern, seam.b);
    text += fmt::format("  {:<24} {:>9.1f} {:>9.1f} {:>7.2f}  {} to {}\n", seam.name, 1e3 * a, 1e3 * b,
                        100.0 * mesh::ease(a, b), mesh::name_of(pattern, seam.a), mesh::name_of(pattern, seam.b));
  }
  return text;
}

std::string open_text(const CheckedPattern& checked) {
  if (checked.sewing.open.empty()) return "\nnothing stays open\n";
  std::string text = "\nopen edges after sewing\n";
  for (const mesh::OpenLoop& loop : checked.sewing.open) {
    double length = 0.0;
    mesh::EdgeChain chain;
    for (const int s : loop.stretches)
      length += checked.sewing.stretches[s].length, chain.push_back(checked.sewing.stretches[s].part);
    text += fmt::format("  {:<24} {:>9.1f} mm  {}\n", loop.name, 1e3 * length, mesh::name_of(checked.pattern, chain));
  }
  const auto named = [&](const mesh::Hem& hem) {
    return std::any_of(checked.sewing.open.begin(), checked.sewing.open.end(),
                       [&](const mesh::OpenLoop& loop) { return loop.name == hem.name; });
  };
  for (const mesh::Hem& hem : checked.pattern.hems)
    if (!named(hem))
      text += fmt::format("  {:<24} {:>9.1f} mm  part of one: {}\n", hem.name,
                          1e3 * mesh::length(checked.pattern, hem.edges), mesh::name_of(checked.pattern, hem.edges));
  return text;
}

}  // namespace

std::string pattern_table(const CheckedPattern& checked) {
  return checked.pattern.title + "\n\n" + pieces_text(checked.pattern) + seams_text(checked.pattern) +
         open_text(checked);
}

std::string mesh_table(const mesh::SewnMesh& mesh) {
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d u = mesh.flat[t[1]] - mesh.flat[t[0]], v = mesh.flat[t[2]] - mesh.flat[t[0]];
    area += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  std::size_t gone = 0;
  for (std::size_t n = 0; n < mesh.merged.size(); ++n) gone += mesh.merged[n] != static_cast<int>(n);
  return fmt::format("\nmesh\n  {} triangles (P2), {} nodes, {} after sewing; mean edge {:.2f} mm, area {:.1f} cm2\n",
                     mesh.triangles.size(), mesh.flat.size(), mesh.flat.size() - gone, 1e3 * mesh.mean_edge,
                     1e4 * area);
}

}  // namespace snug::app
