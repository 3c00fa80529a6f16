#include "solver/stepping/drape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "solver/scene/result.hpp"

namespace snug::solver {

namespace {

constexpr double first_step = 0.002, longest_step = 2.0, shortest_step = 1e-5;  // s
constexpr double farthest = 1.0 / 3.0;  // of the mean edge, that a particle goes in a step
constexpr double growth = 1.5;          // of the step

class Drape {
 public:
  Drape(const Model& model, const Meshes& meshes, const RestRule& rule, const Stop& stop, RunLog& log, postproc::RunResult& result)
      : model_(model), meshes_(meshes), rule_(rule), stop_(stop), log_(log), result_(result), scene_(make_particle_scene(model, meshes)),
        edge_(meshes.garments.front().mean_edge) {
    std::tie(first_height_, length_) = height_and_extent();
  }

  void fall() {
    const IterationSink sink = log_.sink("draping");
    double dt = first_step;
    for (result_.increments = 1;; ++result_.increments) {
      const int before = scene_.cloth->iterations();
      scene_.cloth->step(dt);
      time_ += dt;
      note(sink, dt, scene_.cloth->iterations() - before);
      if (ended()) return;
      dt = std::clamp(std::min(growth * dt, farthest * edge_ / std::max(fastest(), 1e-9)), shortest_step, longest_step);
    }
  }

  /// States evenly spread over the way that the cloth has gone, the placed one first.
  void keep(const KeptStates& kept) const {
    if (kept.steps == 0 || way_.empty()) return;
    ParticleScene then = make_particle_scene(model_, meshes_);
    for (int n = 0; n <= kept.steps; ++n) {
      const double wanted = static_cast<double>(n) / kept.steps * way_.back();
      const auto at = std::lower_bound(way_.begin(), way_.end(), wanted) - way_.begin();
      postproc::RunResult shot;
      shot.body = body_result(meshes_.body, false);
      then.cloth->move_to(shapes_[at].places, shapes_[at].velocities);
      fill_particle_result(then, model_, meshes_, shot);
      kept.keep(static_cast<double>(n) / kept.steps, shot);
    }
  }

  void fill() { fill_particle_result(scene_, model_, meshes_, result_); }
  int iterations() const { return scene_.cloth->iterations(); }
  void remember() { remembers_ = true, shapes_.push_back(shape()), way_.push_back(0.0); }

 private:
  struct Shape {
    mesh::Places places, velocities;  // m, m/s
  };
  Shape shape() const { return {scene_.cloth->places(), scene_.cloth->velocities()}; }

  /// m: mean height of the particles; vertical extent of the garment.
  std::pair<double, double> height_and_extent() const {
    double sum = 0.0, low = std::numeric_limits<double>::max(), high = -low;
    for (const Eigen::Vector3d& p : scene_.cloth->places()) sum += p.z(), low = std::min(low, p.z()), high = std::max(high, p.z());
    return {sum / static_cast<double>(scene_.held.size()), high - low};
  }

  double fastest() const {
    double largest = 0.0;
    for (const Eigen::Vector3d& v : scene_.cloth->velocities()) largest = std::max(largest, v.norm());
    return largest;
  }

  void note(const IterationSink& sink, double dt, int iterations) {
    double unbalanced = 0.0, moved = 0.0;
    const mesh::Places total = scene_.cloth->total_forces();
    int touching = 0;
    for (std::size_t n = 0; n < total.size(); ++n) {
      unbalanced += scene_.cloth->free_part(static_cast<int>(n), total[n]).norm();
      moved += dt * scene_.cloth->velocities()[n].norm() / static_cast<double>(total.size());
      touching += scene_.cloth->touches(static_cast<int>(n)) ? 1 : 0;
    }
    residual_ = unbalanced / scene_.weight;
    kinetic_ = scene_.cloth->kinetic_energy() / (scene_.weight * edge_);
    if (remembers_) shapes_.push_back(shape()), way_.push_back(way_.back() + moved);
    postproc::Iteration row{.increment = result_.increments, .load = time_, .iteration = iterations, .residual = residual_, .complementarity = 0.0,
                            .step = 1.0, .contact_nodes = touching, .changed = 0};
    row.energy = scene_.cloth->potential_energy() + scene_.cloth->kinetic_energy();
    sink(row);
  }

  std::string state_text() const {
    return fmt::format("forces out of balance are {:.2g} of the weight (at rest: {:.0e}), and the fastest particle goes {:.2g} mm/s", residual_, rule_.residual,
                       1e3 * fastest());
  }

  bool ended() {
    if (residual_ <= rule_.residual && kinetic_ <= rule_.energy) {
      result_.status = postproc::Status::converged;
      return true;
    }
    if (first_height_ - height_and_extent().first > length_) {
      result_.status = postproc::Status::failed;
      result_.message = "the garment slides off the body: it has fallen by its own length";
      return true;
    }
    const bool stopped = stop_ && stop_();
    if (!stopped && result_.increments < rule_.steps) return false;
    result_.status = postproc::Status::partial;
    result_.message = fmt::format("the cloth is not at rest after {} steps, {:.3g} s of its fall: {}", result_.increments, time_, state_text());
    return true;
  }

  const Model& model_;
  const Meshes& meshes_;
  const RestRule rule_;
  const Stop& stop_;
  RunLog& log_;
  postproc::RunResult& result_;
  ParticleScene scene_;
  double edge_, first_height_ = 0.0, length_ = 0.0;  // m
  double time_ = 0.0, residual_ = 0.0, kinetic_ = 0.0;
  bool remembers_ = false;
  std::vector<Shape> shapes_;  // of every step, where they are wanted
  std::vector<double> way_;    // m, that a particle has gone in the mean
};

/// A garment that is tight sinks into the skin that bears it: particles are for cloth that hangs.
void warn_of_tightness(postproc::RunResult& result) {
  constexpr double worth_a_word = 1e-4;  // m
  result.numbers["max_penetration_m"] = result.max_penetration;
  if (result.max_penetration <= worth_a_word) return;
  result.warnings.push_back({.name = "cloth in the skin",
                             .text = fmt::format("the cloth presses so hard that it lies up to {:.2f} mm inside the skin", 1e3 * result.max_penetration),
                             .place = "",
                             .remedy = "take tier L1 or L4 for a garment that is tight; particles are for cloth that hangs",
                             .quantity = "max_penetration_m",
                             .value = result.max_penetration,
                             .limit = worth_a_word});
  if (result.max_penetration <= skin_reach || result.status != postproc::Status::converged) return;
  result.status = postproc::Status::partial;  // it is not the shape of cloth on this body
  result.message = fmt::format("the cloth is at rest, but lies up to {:.1f} mm inside the skin", 1e3 * result.max_penetration);
}

std::vector<std::string> what_holds(const Model& model, postproc::Status status) {
  if (status == postproc::Status::converged) return {};
  std::vector<std::string> list;
  if (model.slides_freely())
    list.push_back("hold an edge that something really holds: garment.held = [{ edge = \"upper\", held = \"all\" }], or give it a band that grips");
  if (!model.has_friction()) list.push_back("give contact.friction: without it cloth that lies on a body slides");
  list.push_back("larger cells (garment.cell_size) and a stiffer bending (B of the fabric) come to rest sooner; narrow folds wander for long");
  return list;
}

}  // namespace

void drape(const Model& model, const Meshes& meshes, const KeptStates& kept, const Stop& stop, RunLog& log, postproc::RunResult& result, const RestRule& rule) {
  Drape run(model, meshes, rule, stop, log, result);
  log.phase("set-up");
  if (kept.steps > 0) run.remember();
  run.fall();
  result.iterations = run.iterations();
  log.phase("draping");
  run.fill();
  warn_of_tightness(result);
  run.keep(kept);
  result.remedies = what_holds(model, result.status);
  log.phase("results");
}

}  // namespace snug::solver
