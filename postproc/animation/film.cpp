#include "postproc/animation/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cases/input/diagnostics.hpp"
#include "postproc/animation/four_point.hpp"
#include "postproc/report/surfaces.hpp"
#include "postproc/store.hpp"

namespace snug::postproc::animation {

namespace {

namespace fs = std::filesystem;
using report::Garment;
using report::Skin;
using Positions = Eigen::Map<const Eigen::Matrix3Xd>;

/// A state: skin, garment or both.
struct Shot {
  std::optional<Skin> skin;
  std::optional<Garment> garment;
};

/// Where the fields of a shot lie in the column of a frame: first all positions, then the scalars that may not be
/// negative.
struct Columns {
  Eigen::Index skin = 0, garment = 0, triangles = 0;  ///< counts
  Eigen::Index positions() const { return 3 * (skin + garment); }
  Eigen::Index size() const { return positions() + 2 * skin + garment + 2 * triangles; }
};

Columns columns_of(const Shot& shot) {
  Columns columns;
  if (shot.skin) columns.skin = static_cast<Eigen::Index>(shot.skin->nodes.size());
  if (shot.garment) {
    columns.garment = static_cast<Eigen::Index>(shot.garment->nodes.size());
    columns.triangles = static_cast<Eigen::Index>(shot.garment->triangles.size());
  }
  return columns;
}

/// Calls `field` with every scalar field of a shot in the order of the column.
template <class AShot, class Field>
void each_scalar(AShot& shot, Field field) {
  if (shot.skin) field(shot.skin->pressure), field(shot.skin->coverage);
  if (shot.garment) field(shot.garment->pressure), field(shot.garment->tension_warp), field(shot.garment->tension_weft);
}

Eigen::VectorXd pack(const Shot& shot) {
  Eigen::VectorXd values(columns_of(shot).size());
  Eigen::Index at = 0;
  if (shot.skin)
    for (const Eigen::Vector3d& u : shot.skin->displacement) values.segment<3>(3 * at++) = u;
  if (shot.garment)
    for (const Eigen::Vector3d& x : shot.garment->nodes) values.segment<3>(3 * at++) = x;
  at *= 3;
  each_scalar(shot, [&](const std::vector<double>& field) {
    for (const double value : field) values[at++] = value;
  });
  return values;
}

/// The shot that `like` is, with the values of a frame.
Shot unpack(const Eigen::VectorXd& values, Shot like) {
  Eigen::Index at = 0;
  if (like.skin)
    for (Eigen::Vector3d& u : like.skin->displacement) u = values.segment<3>(3 * at++);
  if (like.garment)
    for (Eigen::Vector3d& x : like.garment->nodes) x = values.segment<3>(3 * at++);
  at *= 3;
  each_scalar(like, [&](std::vector<double>& field) {
    for (double& value : field) value = std::max(0.0, values[at++]);
  });
  if (like.skin)
    for (double& c : like.skin->coverage) c = std::min(c, 1.0);
  return like;
}

std::vector<Shot> read_shots(const std::vector<GridStep>& body, const std::vector<GridStep>& garment,
                             const fs::path& out) {
  std::vector<Shot> shots(std::max(body.size(), garment.size()));
  for (std::size_t i = 0; i < body.size(); ++i) shots[i].skin = report::read_skin(out / body[i].file, out / skin_file);
  for (std::size_t i = 0; i < garment.size(); ++i) shots[i].garment = report::read_garment(out / garment[i].file);
  return shots;
}

/// Skin and garment as grids: a surface of plane triangles each.
void write_shot(const Shot& shot, const fs::path& folder, std::size_t n, double time, std::vector<GridStep>& skins,
                std::vector<GridStep>& garments) {
  if (shot.skin) {
    skins.push_back({time, fmt::format("skin_{:04}.vtu", n)});
    Grid grid = surface_grid(shot.skin->nodes, shot.skin->triangles);
    if (!shot.skin->displacement.empty()) grid.fields.set(field::displacement, shot.skin->displacement);
    grid.fields.set(field::contact_pressure, shot.skin->pressure);
    grid.fields.set(field::coverage, shot.skin->coverage);
    write_grid(grid, folder / skins.back().file);
  }
  if (shot.garment) {
    garments.push_back({time, fmt::format("garment_{:04}.vtu", n)});
    Grid grid = surface_grid(shot.garment->nodes, shot.garment->triangles);
    grid.fields.set(field::contact_pressure, shot.garment->pressure);
    grid.fields.set(field::tension_warp, shot.garment->tension_warp);
    grid.fields.set(field::tension_weft, shot.garment->tension_weft);
    write_grid(grid, folder / garments.back().file);
  }
}

}  // namespace

Film make_film(const fs::path& out, const fs::path& folder, const FilmSettings& settings) {
  const std::vector<GridStep> body = read_series(out / body_series_file), garment = read_series(out / garment_series_file);
  const std::vector<GridStep>& listed = body.empty() ? garment : body;
  if (listed.size() < 2 || (!body.empty() && !garment.empty() && body.size() != garment.size()))
    throw input::InputError({out.string(), 0, 0}, fmt::format("{} state of the load path is kept here", listed.size()),
                            "run the case with --states 8 (or another number) first");
  const std::vector<Shot> shots = read_shots(body, garment, out);
  Frames frames;
  for (std::size_t i = 0; i < shots.size(); ++i)
    frames.times.push_back(listed[i].time), frames.values.push_back(pack(shots[i]));
  const Eigen::Index positions = columns_of(shots.front()).positions();
  const Distance distance = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (Positions(b.data(), 3, positions / 3) - Positions(a.data(), 3, positions / 3)).colwise().norm().maxCoeff();
  };
  Film film{shots.size(), 0, 0.0};
  frames = fill_in(std::move(frames), distance, settings.step, settings.most);
  film.frames = frames.times.size();
  fs::create_directories(folder);
  std::vector<GridStep> skins, garments;
  for (std::size_t n = 0; n < film.frames; ++n) {
    if (n > 0) film.widest = std::max(film.widest, distance(frames.values[n - 1], frames.values[n]));
    write_shot(unpack(frames.values[n], shots.front()), folder, n, frames.times[n], skins, garments);
  }
  if (!skins.empty()) write_series(skins, folder / "skin.pvd");
  if (!garments.empty()) write_series(garments, folder / "garment.pvd");
  return film;
}

}  // namespace snug::postproc::animation
