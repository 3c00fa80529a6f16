#include "solver/scene/run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/algebra/communicator.hpp"
#include "solver/scene/guards.hpp"
#include "solver/scene/laplace.hpp"
#include "solver/scene/layers.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/movement.hpp"
#include "solver/scene/movement_result.hpp"
#include "solver/scene/result.hpp"
#include "solver/scene/tools.hpp"
#include "solver/stepping/arc_length.hpp"
#include "solver/stepping/donning.hpp"
#include "solver/stepping/drape.hpp"
#include "solver/stepping/run_log.hpp"
#include "solver/stepping/stages.hpp"
#include "solver/terms/drag.hpp"

namespace snug::solver {

namespace {

/// Iterations of increments that failed, over a whole run: some five times what a good scene takes in all.
constexpr int most_lost = 60;
/// The same of the way to a posture, whose steps may become short where cloth slips and folds open.
constexpr int most_lost_in_a_posture = 150;
/// The same of a way that another one stands in for where it fails, and its halvings in a row.
constexpr int most_lost_before_another_way = 30, failures_before_another_way = 2;

/// Of the state that a movement begins with: a rigid motion of it needs no iteration, and its pressures keep to 1e-9.
constexpr double settled_residual = 1e-12;
constexpr int settling_rounds = 2;

/// Fractions of the tightening from which friction acts in the rows that show the spread.
constexpr std::array<double, 2> spread = {0.5, 0.1};

/// One run: the parts of the flow share the clock, the observer and the result.
class Run {
 public:
  Run(const Model& model, const Meshes& meshes, const Observer& observer, const KeptStates& kept, const Stop& stop, Journal* journal, double memory)
      : model_(model), worn_(model.has_friction() ? model : model.with_friction(usual_friction)), meshes_(meshes), kept_(kept), stop_(stop),
        journal_(journal), memory_(memory), movement_(model, meshes.body), log_(result_, observer) {
    const Plan parts = plan(model, meshes, memory);
    result_.title = model.asked.title;
    result_.tier = parts.tier;
    result_.unknowns = parts.unknowns;
    result_.parts_in = parts.parts_in, result_.parts_out = parts.parts_out;
    log_.expect(parts.seconds);
    result_.body = body_result(meshes.body, model.deformable());
  }

  postproc::RunResult operator()() {
    if (model_.falls()) return falling();
    assume();
    if (!model_.garments.empty()) laplace();
    std::vector<Way> ways = ways_of(model_, worn_, meshes_, kept_.steps > 0);
    if (!movement_.empty())
      for (Way& way : ways) add_postures(movement_, way);
    if (ways.empty()) finish_laplace();
    for (std::size_t w = 0; w < ways.size(); ++w)
      if (walk(ways[w], w + 1 < ways.size())) break;
    refuse_borne_motions();
    look_back();
    return std::move(result_);
  }

 private:
  /// Tier particle: there is no path of scenes.
  postproc::RunResult falling() {
    assume_of_particles();
    drape(model_, meshes_, kept_, stop_, log_, result_);
    note_memory();
    return std::move(result_);
  }

  void assume_of_particles() {
    const ContactModel* contact = model_.contact_of(0);
    if (contact && !contact->friction.of_case)
      result_.assumptions.push_back(fmt::format("friction {:g} of the {} on the skin ({})", contact->friction.coefficient, contact->slave, contact->friction.source));
    result_.assumptions.push_back("particles: the shape in which cloth hangs, without lateral contraction and without contact of the cloth with itself; what the skin bears is an "
                                  "estimate to the balance error told, and no pressure");
    result_.assumptions.push_back(fmt::format("air of {:g} N s/m3 against the velocity while it falls (at rest it bears nothing)", air_drag));
  }

  /// What the case leaves to the run.
  void assume() {
    if (model_.asked.solver.tier == input::Tier::L0 || !model_.has_friction()) return;
    for (const ContactModel& contact : model_.contacts)
      if (contact.garment >= 0 && !contact.friction.of_case)
        result_.assumptions.push_back(fmt::format("friction {:g} of the {} on {} ({})", contact.friction.coefficient, contact.slave, layers_under(model_, meshes_.garments, contact.garment).empty() ? "the skin" : "what it lies on",
                                                  contact.friction.source));
    result_.assumptions.push_back("the way on: placed round the body, sticking while it tightens, then let go (contact.spread = true shows others)");
  }

  void laplace() {
    const LaplacePressure l0 = laplace_pressure(model_.garments, meshes_);
    result_.mean_laplace_pressure = l0.mean;
    if (!l0.pressure.empty()) result_.body.fields.set(postproc::field::laplace_pressure, l0.pressure);
    log_.phase("law of Laplace");
  }

  void finish_laplace() {
    show_laplace(result_.body);
    result_.numbers["mean_contact_pressure_Pa"] = result_.mean_laplace_pressure;
    result_.status = postproc::Status::converged;
  }

  /// Walks the stages of a way. False: it came to nothing, and what stands in for it is to be walked (`another`).
  bool walk(const Way& way, bool another) {
    Trail trail;
    const Stage* before = nullptr;
    result_.message.clear();  // of a way before this one
    for (const Stage& stage : way.stages) {
      Standing at = enter(stage, before, way, trail);
      const bool elsewhere = another && stage.posture == 0;
      const PathResult path = follow(stage, at, trail, elsewhere);
      at.state = path.state;
      if (!accept(stage, *at.scene, path)) return (elsewhere && !stopped()) ? false : stop_at(stage, at, path, trail);
      trail.push_back(std::move(at));
      before = &stage;
      const std::string objection = stage.objection ? stage.objection(trail.back()) : std::string();
      if (!objection.empty()) {
        fail(objection);
        break;
      }
      if (stage.spreads) add_spread(trail.back());
    }
    return report(trail.back());
  }

  Scene scene_of(const Model& model, Skin skin) const {
    Scene scene = make_scene(model, meshes_, skin);
    scene.may_take(memory_);
    return scene;
  }

  /// A stage starts where the one before has ended, on the same scene where both solve the same.
  Standing enter(const Stage& stage, const Stage* before, const Way& way, const Trail& trail) {
    if (before && before->model == stage.model && before->skin == stage.skin) {
      return stage.posture == 1 ? begin_movement(stage, trail.back()) : trail.back();
    }
    if (before) trail.back().scene->drop_matrix();  // the next one needs the memory
    Standing at{std::make_shared<Scene>(scene_of(*stage.model, stage.skin)), {}};
    log_.phase("set-up");
    at.state = placed_state(at.scene->layout(), model_, meshes_);
    if (before) {
      at.state = at.scene->transfer(trail.back().state, trail.back().scene->layout(), at.state);
    } else {
      at.state.release = way.release;
      keep(*at.scene, at.state, 0.0);
    }
    return at;
  }

  /// From here on bones carry what they hold. The dressed state is the first one of the movement: solved once more as all others of it are, as its contact was cut a little beside its answer.
  Standing begin_movement(const Stage& first, const Standing& dressed) {
    Scene& scene = *dressed.scene;
    carrier_ = std::make_shared<Carrier>(movement_, meshes_, scene.layout(), dressed.state);
    Supports supports = carried_supports(*first.model, meshes_, scene.layout(), carrier_);
    Numbering numbering = make_numbering(*first.model, meshes_, scene.layout(), supports);
    scene.hold(std::move(supports), std::move(numbering));
    scene.may_take(memory_);
    PathSettings settings = settings_of_posture(first);
    settings.accepted = nullptr, settings.longest_step = 1.0, settings.failures = 0;
    settings.newton.residual = settled_residual;
    Standing at = dressed;
    for (int round = 0; round < settling_rounds; ++round) {  // the contact is cut anew at the start of each
      const PathResult settled = follow_path(scene, at.state, [](State&, double) {}, settings, log_.sink("dressed"));
      log_.end_path(scene, settled.increments, "dressed");
      if (settled.complete) at.state = settled.state;
    }
    note_posture(scene, at.state, 0, 1.0);
    return at;
  }

  /// The first attempt that comes to its end, or the last one. `another`: another way stands in for this one.
  PathResult follow(const Stage& stage, const Standing& from, const Trail& trail, bool another) {
    const PathSettings settings = stage.posture > 0 ? settings_of_posture(stage) : settings_of(stage, another);
    const std::vector<Attempt> attempts = stage.attempts(trail);
    std::optional<PathResult> hard;  // states on which the skin has yielded are on no way that is reported
    for (std::size_t n = 0;; ++n) {
      PathSettings one = settings;
      one.failures = attempts[n].failures.value_or(one.failures), one.first_step = attempts[n].first_step;
      one.creeps = one.creeps && n + 1 == attempts.size() && from.scene->find<Drag>();  // another attempt is cheaper
      const PathResult path = stage.curve ? follow_curve(*stage.curve, attempts[n].rows, from, one)
                                          : follow_path(*from.scene, from.state, attempts[n].change, one, log_.sink(attempts[n].rows));
      if (path.complete) return path;
      if (path.state.yielding == 0.0) hard = path;
      if (n + 1 == attempts.size()) return hard ? *hard : path;
      lost_ += path.lost;
    }
  }

  PathResult follow_curve(const Curve& curve, const std::string& rows, const Standing& from, const PathSettings& settings) {
    auto [path, limit_load] = follow_load(*from.scene, from.state, curve.from_the_start, settings, log_.sink(rows), log_.sink(rows + ", along its curve"));
    if (limit_load) result_.numbers["limit_load_share"] = *limit_load;
    return path;
  }

  PathSettings settings_of(const Stage& stage, bool another) {
    PathSettings path = settings(stage.skin);
    path.newton.residual = stage.residual;
    path.intermediate_residual = stage.intermediate_residual;
    path.leads_on = stage.leads_on;
    path.creeps = !another;
    if (!another) return path;
    path.failures = std::min(path.failures, failures_before_another_way);
    path.lost_iterations = std::min(path.lost_iterations, most_lost_before_another_way);
    return path;
  }

  /// Each state on the way is an answer. It begins anew where a run goes on: all its states are results.
  PathSettings settings_of_posture(const Stage& stage) {
    PathSettings path = settings_of(stage, false);
    path.exact = true, path.journal = nullptr;
    path.lost_iterations = most_lost_in_a_posture;
    path.longest_step = 1.0 / movement_.steps(stage.posture);
    path.carry = [this](State& state, const State& to) { carrier_->carry(state, to.posture); };
    path.accepted = [this, posture = stage.posture](const Scene& scene, const State& state, double t) { note_posture(scene, state, posture, t); };
    return path;
  }

  PathSettings settings(Skin skin) {
    PathSettings path;
    path.newton.stop = stop_;
    path.journal = journal_;
    path.newton.may_lag = skin == Skin::deformable;
    path.minimum = !model_.garments.empty();
    path.lost_iterations = std::max(0, most_lost - lost_);
    path.newton.penetration = 1e-6 * contact_edge();
    path.exact = !model_.asked.tools.empty();
    path.longest_step = 1.0 / std::max(tool_steps(model_), kept_.steps);
    if (kept_.steps > 0 || path.exact)
      path.accepted = [this](const Scene& scene, const State& state, double t) {
        note_tools(scene, state);
        if (state.yielding == 0.0) keep(scene, state, stages_ + t);  // the skin of no wearer is a mattress
      };
    return path;
  }

  /// Of the finest surface that carries contact pressures, m; 1 where there is none.
  double contact_edge() const {
    double edge = std::numeric_limits<double>::infinity();
    for (const mesh::GarmentMesh& garment : meshes_.garments) edge = std::min(edge, garment.mean_edge);
    for (const ContactModel& contact : model_.contacts)
      if (contact.garment < 0) edge = std::min(edge, mesh::mean_edge(meshes_.body, slave_facets(meshes_.body, contact)));
    edge = std::min(edge, tool_edge(model_, meshes_.body));
    return std::isfinite(edge) ? edge : 1.0;
  }

  /// The force over the travel of the tools.
  void note_tools(const Scene& scene, const State& state) {
    const std::vector<postproc::ToolRow> rows = tool_rows(scene, state, model_, meshes_.body);
    tool_way_.resize(rows.size());
    for (std::size_t t = 0; t < rows.size(); ++t) tool_way_[t].push_back(rows[t]);
  }

  /// Hands a state of the load path to who wants to see it.
  void keep(const Scene& scene, const State& state, double way) const {
    if (kept_.steps > 0) kept_.keep(way, shot_of(scene, state));
  }

  postproc::RunResult shot_of(const Scene& scene, const State& state) const {
    postproc::RunResult shot;
    shot.body = body_result(meshes_.body, model_.deformable());
    State seen = state;
    scene.look(seen);
    fill_result(scene, seen, model_, meshes_, shot);
    return shot;
  }

  /// A state of the movement is a row of the result, and a picture of its film.
  void note_posture(const Scene& scene, const State& state, int posture, double share) {
    const postproc::RunResult shot = shot_of(scene, state);
    result_.movement.push_back(movement_state(movement_, posture, share, shot, meshes_.body.mean_skin_cell));
    if (kept_.keep && !(posture == 0 && kept_.steps > 0)) kept_.keep(posture == 0 ? stages_ : stages_ + share, shot);  // the end of dressing is kept already
  }

  /// Books what a stage has spent and where it has come to. True: to its end.
  bool accept(const Stage& stage, Scene& scene, const PathResult& path) {
    lost_ += path.lost;
    log_.end_path(scene, path.increments, stage.name);
    if (path.crept > 0 && path.complete)
      result_.assumptions.push_back(fmt::format("{}: cloth crept to where it rests, {:.3g} mm away at most ({} iterations), for no path of equilibria was found; where loose cloth rests hangs on the way there", stage.name, 1e3 * path.slid, path.crept));
    result_.status = path.complete ? postproc::Status::converged : log_.increments() > 0 ? postproc::Status::partial : postproc::Status::failed;
    const double fraction = path.state.load < 1.0 ? path.state.load : path.reached;
    before_ = std::exchange(result_.truth, {stage.name, stage.skin == Skin::deformable, fraction, path.state.stiffening, 1.0 / path.state.release});
    if (!path.complete)
      result_.message = fmt::format("{} stopped at {:.1f} % of its path: {}{}", stage.name, 100.0 * path.reached, path.message,
                                    path.crept > 0 ? fmt::format("; cloth crept on by {:.3g} mm at most ({} iterations) and did not come to rest", 1e3 * path.slid, path.crept) : "");
    ++stages_;
    return path.complete;
  }

  /// The way ends within a stage.
  bool stop_at(const Stage& stage, const Standing& here, const PathResult& path, const Trail& trail) {
    const bool nothing = stage.fallback == Fallback::before_if_nothing && path.increments == 0;
    const Standing& reported = nothing || stage.fallback == Fallback::before ? trail.back() : here;
    if (&reported != &here) result_.truth = before_;
    if (nothing) result_.message += "; what is reported is the garment on the rigid skin (tier L1)", result_.truth.stage = "rigid skin";
    if (stage.tell && !stopped()) stage.tell(trail, reported, result_);
    return report(reported);
  }

  /// What is reported belongs to this state.
  bool report(const Standing& at) {
    fill_result(*at.scene, at.state, model_, meshes_, result_);
    fill_tools(*at.scene, at.state, model_, meshes_.body, tool_way_, result_);
    log_.phase("results");
    return true;
  }

  /// Other ways of putting the garment on, on the rigid skin: friction over the last nine tenths of the tightening and over its
  /// last half; until then the garment sticks (without any pressure friction would hold nothing).
  void add_spread(const Standing& tight) {
    const std::string name = "spread over ways of putting on";
    Scene rigid = scene_of(worn_, Skin::rigid);
    PathSettings aside = settings(Skin::rigid);
    aside.newton.residual = rubbing_residual;
    aside.accepted = nullptr;  // their states are not on the way to the answer
    const auto row = [&](const std::string& way, double from, const PathResult& path) {
      result_.donning.push_back(donning_row(way, from, path.complete, rigid, path.state, model_, meshes_));
    };
    row("placed and let go", 1.0, follow_path(rigid, tight.state, letting_go(), aside, log_.quiet(name)));
    const State start = placed_state(rigid.layout(), meshes_);
    for (const double from : spread) {
      State state = start;
      state.release = 0.0;
      if (from > 0.0) state = follow_path(rigid, state, tightening(0.0, from), aside, log_.quiet(name)).state;
      state.release = 1.0;
      row(donning_name(from), from, follow_path(rigid, state, tightening(state.load, 1.0), aside, log_.quiet(name)));
    }
    log_.phase(name);
    log_.account(rigid, name);
  }

  /// Parts that nothing holds balance by themselves, or not at all. (The pin that keeps a garment from turning bears what the
  /// kinks between the skin's facets ask for, and so does the body then.)
  void refuse_borne_motions() {
    const std::optional<double> borne = result_.balance.free_motions_share;
    if (!borne || *borne <= (model_.garments.empty() ? 1e-6 : 1e-2) || result_.status != postproc::Status::converged) return;
    fail(fmt::format("nothing holds a part of the body, and on the deformed body its loads do not balance: {:.2g} of them is left; "
                     "hold it with a [[support]]", *borne));
  }

  /// What the result is measured for, whatever the solver says of it.
  void look_back() {
    note_memory();
    if (!result_.garment.triangles.empty()) guard(model_, meshes_, result_), log_.phase("results");
    look_at_movement(result_);
    result_.remedies = what_to_try(model_, meshes_, result_);
  }

  void note_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double own = 1024.0 * static_cast<double>(usage.ru_maxrss);
    result_.peak_memory = sum_over_ranks(own), result_.peak_memory_of_a_rank = largest_over_ranks(own);
  }

  /// The user wants no more: no other way is looked for, and nothing is said of what there might be.
  bool stopped() const { return stop_ && stop_(); }

  void fail(const std::string& why) { result_.status = postproc::Status::failed, result_.message = why; }

  const Model& model_;
  const Model worn_;  ///< the same with the friction that holds the garments on the way
  const Meshes& meshes_;
  const KeptStates& kept_;
  const Stop& stop_;
  Journal* journal_;  ///< may be null
  double memory_;     ///< bytes that the run may take; 0: no bound
  const Movement movement_;
  std::shared_ptr<const Carrier> carrier_;  ///< since the movement has begun
  int stages_ = 0;
  std::vector<std::vector<postproc::ToolRow>> tool_way_;  ///< a list a tool
  int lost_ = 0;      ///< iterations of increments that failed so far
  postproc::StateTruth before_;  ///< of the stage before
  postproc::RunResult result_;
  RunLog log_;
};

}  // namespace

postproc::RunResult solve(const Model& model, const Meshes& meshes, const Observer& observer,
                          const KeptStates& kept, const Stop& stop, Journal* journal, double memory) {
  return Run(model, meshes, observer, kept, stop, journal, memory)();
}

}  // namespace snug::solver
