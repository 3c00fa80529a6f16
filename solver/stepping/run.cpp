#include "solver/scene/run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/scene/guards.hpp"
#include "solver/scene/laplace.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/result.hpp"
#include "solver/stepping/arc_length.hpp"
#include "solver/stepping/donning.hpp"
#include "solver/stepping/load_path.hpp"
#include "solver/stepping/run_log.hpp"

namespace snug::solver {

namespace {

/// Contact pressure over the softest (stiffened) shear modulus where a release step by step starts: small strains.
constexpr double gentle_release = 0.3;

/// Iterations of increments that failed, over a whole run: some five times what a good scene takes in all.
constexpr int most_lost = 60;
/// The same of a stage that another way stands in for where it fails.
constexpr int most_lost_before_another_way = 30;

/// No coefficient of friction of cloth on skin is as large.
constexpr double no_friction = 10.0;

/// Fractions of the tightening from which friction acts in the rows that show the spread.
constexpr std::array<double, 2> spread = {0.5, 0.1};

/// One run: the parts of the flow share the clock, the observer and the result.
class Run {
 public:
  Run(const Model& model, const Meshes& meshes, const Observer& observer, const KeptStates& kept, const Stop& stop, Journal* journal)
      : model_(model), worn_(model), meshes_(meshes), kept_(kept), stop_(stop), journal_(journal), log_(result_, observer) {
    const Plan parts = plan(model, meshes);
    result_.title = model.asked.title;
    result_.tier = parts.tier;
    result_.unknowns = parts.unknowns;
    result_.parts_in = parts.parts_in, result_.parts_out = parts.parts_out;
    log_.expect(parts.seconds);
    result_.body = body_result(meshes.body, model.deformable());
  }

  postproc::RunResult operator()() {
    assume();
    if (!model_.garments.empty()) laplace();
    if (result_.tier == "L0")
      finish_laplace();
    else if (model_.has_friction())
      placed_and_let_go();
    else if (model_.contact_of(0))
      garment_then_body();
    else if (model_.deformable())
      one_path(Skin::deformable, "body");
    else
      one_path(Skin::rigid, "garment");
    refuse_borne_motions();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    result_.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
    if (!result_.garment.triangles.empty()) guard(model_, meshes_, result_), log_.phase("results");
    result_.remedies = what_to_try(model_, meshes_, result_);
    return std::move(result_);
  }

 private:
  /// What the case leaves to the run.
  void assume() {
    if (result_.tier == "L0" || !model_.has_friction()) return;
    for (const ContactModel& contact : model_.contacts)
      if (contact.garment >= 0 && !contact.friction.of_case)
        result_.assumptions.push_back(fmt::format("friction {:g} of the {} on the skin ({})", contact.friction.coefficient, contact.slave, contact.friction.source));
    result_.assumptions.push_back("the way on: placed round the body, sticking while it tightens, then let go (contact.spread = true shows others)");
  }

  void laplace() {
    const LaplacePressure l0 = laplace_pressure(model_.garments, meshes_.limb, meshes_.body);
    result_.mean_laplace_pressure = l0.mean;
    result_.body.laplace_pressure = l0.pressure;
    log_.phase("law of Laplace");
  }

  void finish_laplace() {
    result_.body.contact_pressure = result_.body.laplace_pressure;
    if (result_.body.contact_pressure.empty()) result_.body.contact_pressure.assign(result_.body.nodes.size(), 0.0);
    for (std::size_t i = 0; i < result_.body.coverage.size(); ++i)
      result_.body.coverage[i] = result_.body.contact_pressure[i] > 0.0 ? 1.0 : 0.0;
    result_.numbers["mean_contact_pressure_Pa"] = result_.mean_laplace_pressure;
    result_.status = "converged";
  }

  /// The user wants no more: no other way is looked for, and nothing is said of what there might be.
  bool stopped() const { return stop_ && stop_(); }

  PathSettings settings(Skin skin) const {
    PathSettings path;
    path.newton.stop = stop_;
    path.journal = journal_;
    path.newton.may_lag = skin == Skin::deformable;
    if (worn_.has_friction()) path.newton.residual = 1e-10;  // it converges linearly: the last step overshoots less than elsewhere
    path.minimum = !model_.garments.empty();
    path.lost_iterations = std::max(0, most_lost - lost_);
    path.newton.penetration = 1e-6 * contact_edge();
    if (kept_.steps > 0) {
      path.longest_step = 1.0 / kept_.steps;
      path.accepted = [this](const Scene& scene, const State& state, double t) { keep(scene, state, stages_ + t); };
    }
    return path;
  }

  /// Of the finest surface that carries contact pressures, m; 1 where there is none.
  double contact_edge() const {
    double edge = std::numeric_limits<double>::infinity();
    for (const mesh::GarmentMesh& garment : meshes_.garments) edge = std::min(edge, garment.mean_edge);
    for (const ContactModel& contact : model_.contacts)
      if (contact.garment < 0) edge = std::min(edge, mesh::mean_edge(meshes_.body, slave_facets(meshes_.body, contact)));
    return std::isfinite(edge) ? edge : 1.0;
  }

  /// Of a stage from whose end another one goes on.
  PathSettings on_the_way(Skin skin) const {
    PathSettings path = settings(skin);
    path.leads_on = true;
    return path;
  }

  /// Of a stage along which nothing changes: half of it is no easier.
  static PathSettings in_one_step(PathSettings path) {
    path.failures = 0;
    return path;
  }

  /// Of a stage that another way stands in for.
  static PathSettings with_another_way(PathSettings path) {
    path.failures = std::min(path.failures, 2);
    path.lost_iterations = std::min(path.lost_iterations, most_lost_before_another_way);
    return path;
  }

  /// Hands a state of the load path to who wants to see it.
  void keep(const Scene& scene, const State& state, double way) const {
    if (kept_.steps == 0) return;
    postproc::RunResult shot;
    shot.body = body_result(meshes_.body, model_.deformable());
    State seen = state;
    scene.look(seen);
    fill_result(scene, seen, model_, meshes_, shot);
    kept_.keep(way, shot);
  }

  /// The result of the run: what is reported belongs to this state.
  void fill(const Scene& scene, const State& state) {
    fill_result(scene, state, model_, meshes_, result_);
  }

  bool accept(Scene& scene, const PathResult& path, const std::string& name) {
    lost_ += path.lost;
    log_.end_path(scene, path.increments, name);
    result_.status = path.complete ? "converged" : log_.increments() > 0 ? "partial" : "failed";
    const double fraction = path.state.load < 1.0 ? path.state.load : path.reached;
    result_.truth = {name, fraction, path.state.stiffening, 1.0 / path.state.release};
    if (!path.complete)
      result_.message = fmt::format("{} stopped at {:.1f} % of its path: {}", name, 100.0 * path.reached, path.message);
    ++stages_;
    return path.complete;
  }

  void one_path(Skin skin, const std::string& name) {
    Scene scene = make_scene(model_, meshes_, skin);
    log_.phase("set-up");
    const State placed = placed_state(scene.layout(), meshes_);
    keep(scene, placed, 0.0);
    const auto [path, limit_load] =
        !model_.garments.empty() || !model_.contacts.empty() ? LoadedPath{follow_path(scene, placed, tightening(), settings(skin), log_.sink(name)), {}}
                      : follow_load(scene, placed, model_.asked.solver.path == "arc length", settings(skin), log_.sink(name),
                                    log_.sink(name + ", along its curve"));
    accept(scene, path, name);
    if (limit_load) result_.numbers["limit_load_share"] = *limit_load;
    fill(scene, path.state);
    log_.phase("results");
  }

  /// The garment tightens on the rigid skin first (tier L1, cheap and robust: its path is fictitious anyway); the body
  /// is then released under the tightened garment in one increment. Where that fails, the body takes the whole path.
  void garment_then_body() {
    Scene rigid = make_scene(model_, meshes_, Skin::rigid);
    log_.phase("set-up");
    State state = placed_state(rigid.layout(), meshes_);
    keep(rigid, state, 0.0);
    const auto path = follow_path(rigid, state, tightening(), model_.slides_freely() ? settings(Skin::rigid) : with_another_way(settings(Skin::rigid)),
                                  log_.sink("rigid skin"));
    const bool complete = accept(rigid, path, "rigid skin");
    rigid.drop_matrix();  // the body needs the memory
    if (!complete && !model_.slides_freely() && !stopped()) return limit_of_small_friction();
    if (complete && model_.deformable() && !stray(rigid, path.state)) return release_body(rigid, path.state);
    fill(rigid, path.state);
    if (complete) name_sliding(rigid, path.state);
    log_.phase("results");
  }

  /// Without friction the states on the way may not exist where the last one does: on a bulging limb a half-tightened sleeve
  /// slides off. Then the answer is looked for as the limit of friction that vanishes.
  void limit_of_small_friction() {
    worn_ = model_.with_friction(usual_friction);
    placed_and_let_go();
  }

  /// Placed and let go. While its rest metric goes to that of the pattern the garment sticks to the skin where it was
  /// placed: nothing slides, gathers or goes slack on a way that is fictitious anyway. Then friction's bound comes down to
  /// mu p, on the body where there is one: what cannot hold slips.
  void placed_and_let_go() {
    Scene rigid = make_scene(worn_, meshes_, Skin::rigid);
    log_.phase("set-up");
    State placed = placed_state(rigid.layout(), meshes_);
    placed.release = 0.0;
    keep(rigid, placed, 0.0);
    const PathResult path = follow_path(rigid, placed, tightening(), on_the_way(Skin::rigid), log_.sink("tightening"));
    const bool tight = accept(rigid, path, "tightening where it was placed");
    const Push net = push_where_it_sticks(rigid, path.state, worn_);
    if (tight && model_.slides_freely() && net.friction_needed > no_friction) return fall(rigid, path.state, net);
    if (tight && shows_spread()) add_spread(rigid, path.state);
    if (tight && model_.deformable()) {
      rigid.drop_matrix();  // the body needs the memory
      return let_go_on_body(rigid, path.state);
    }
    if (tight) return let_go(rigid, path.state, Skin::rigid, net);
    fill(rigid, path.state);
    log_.phase("results");
  }

  /// A garment that hardly touches and that nothing holds falls: what sticks on the way is no answer.
  void fall(const Scene& rigid, const State& sticking, const Push& net) {
    fail(no_equilibrium(net, model_, meshes_));
    fill(rigid, sticking);
    log_.phase("results");
  }

  /// The body is released under the garment that still sticks, then friction's bound comes down. Both at once would save
  /// some iterations where it works and swings to and fro where it does not (a calf), and the answers of the two ways differ
  /// by a thousandth: one way for all.
  void let_go_on_body(const Scene& rigid, const State& on_rigid) {
    Scene scene = make_scene(worn_, meshes_, Skin::deformable);
    log_.phase("set-up");
    const State start = scene.transfer(on_rigid, rigid.layout(), placed_state(scene.layout(), meshes_));
    const double give = softest_shear_modulus(model_) / rigid.measure(on_rigid).reference_pressure;
    const PathResult path = release(scene, start, give, on_the_way(Skin::deformable));
    if (accept(scene, path, "releasing the body")) return let_go(scene, path.state, Skin::deformable, push_where_it_sticks(rigid, on_rigid, worn_));
    finish_on_body(scene, path, rigid, on_rigid);
  }

  /// From a garment that sticks to the answer; `net`: what pushed it.
  void let_go(Scene& scene, const State& sticking, Skin skin, const Push& net) {
    const bool vanishing = !model_.has_friction();
    PathSettings way = vanishing ? on_the_way(skin) : settings(skin);
    way.intermediate_residual = 1e-6;  // friction's part of the balance is small: looser states would not follow its bound at all
    const PathResult path = follow_path(scene, sticking, letting_go(), way, log_.sink("let go"));
    const bool holds = accept(scene, path, "letting go");
    if (holds && vanishing) return without_any(scene, path.state, skin);
    if (!holds && !stopped()) name_coefficient(path.state), name_slipping(net);
    if (holds) name_sliding(scene, path.state);  // of several garments one may be without friction
    fill(scene, path.state);
    log_.phase("results");
  }

  /// Friction vanishes: its coefficient falls a hundredfold, then it is left out.
  void without_any(Scene& scene, const State& rough, Skin skin) {
    const PathResult faint = follow_path(scene, rough, fading(), on_the_way(skin), log_.sink("friction fades"));
    Scene smooth = make_scene(model_, meshes_, skin);
    PathResult path{.state = smooth.transfer(faint.state, scene.layout(), placed_state(smooth.layout(), meshes_))};
    path.state.release = 1.0;
    if (accept(scene, faint, "fading friction"))
      path = follow_path(smooth, path.state, tightening(1.0, 1.0), in_one_step(settings(skin)), log_.sink("without friction"));
    if (path.complete && accept(smooth, path, "without friction")) {
      fill(smooth, path.state);
    } else {
      result_.status = "partial";
      result_.message = fmt::format("without friction no equilibrium was found near the placed garment; what is reported is held by a "
                                    "coefficient of {:.2g}; {}",
                                    usual_friction / faint.state.release,
                                    model_.garments.front().spec.held.size() > 1 ? "a wider garment or stiffer tissue has one"
                                                                   : "give contact.friction, or hold the other edge, too");
      fill(scene, faint.state);
    }
    log_.phase("results");
  }

  /// Other ways of putting the garment on, on the rigid skin: friction over the last nine tenths of the tightening and over its
  /// last half; until then the garment sticks (without any pressure friction would hold nothing).
  void add_spread(const Scene& placed, const State& tight) {
    const std::string name = "spread over ways of putting on";
    Scene rigid = make_scene(worn_, meshes_, Skin::rigid);
    PathSettings aside = settings(Skin::rigid);
    aside.accepted = nullptr;  // their states are not on the way to the answer
    const auto row = [&](const std::string& way, double from, const PathResult& path) {
      result_.donning.push_back(donning_row(way, from, path.complete, rigid, path.state, model_, meshes_));
    };
    row("placed and let go", 1.0, follow_path(rigid, tight, letting_go(), aside, log_.quiet(name)));
    const State start = placed_state(placed.layout(), meshes_);
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

  /// The rigid skin carries any pressure; tissue gives way. Where it gives way little (pressure below its shear modulus) the
  /// body is released under the tight garment at once. Where that fails, or is more than tissue can answer in one step,
  /// its stiffness falls to its own from where its answer is small.
  void release_body(const Scene& rigid, const State& on_rigid) {
    Scene scene = make_scene(model_, meshes_, Skin::deformable);
    log_.phase("set-up");
    const double give = softest_shear_modulus(model_) / rigid.measure(on_rigid).reference_pressure;
    const State start = scene.transfer(on_rigid, rigid.layout(), placed_state(scene.layout(), meshes_));
    PathSettings path = settings(Skin::deformable);
    if (!model_.slides_freely()) path = with_another_way(path);
    const PathResult released = release(scene, start, give, path);
    if (!accept(scene, released, "body") && !model_.slides_freely() && !stopped()) return limit_of_small_friction();
    finish_on_body(scene, released, rigid, on_rigid);
  }

  /// `give`: softest shear modulus over the pressure.
  PathResult release(Scene& scene, const State& start, double give, PathSettings path) {
    if (give > 1.0 && kept_.steps == 0) {
      PathSettings at_once = path;
      at_once.failures = 0;
      const PathResult released = follow_path(scene, start, releasing(1.0), at_once, log_.sink("body"));
      if (released.complete) return released;
      lost_ += released.lost;
      path.first_step = 0.5;  // the whole step fails from a stiffer body, too
    }
    return follow_path(scene, start, releasing(std::max(10.0, 1.0 / (gentle_release * give))), path, log_.sink("body, step by step"));
  }

  void finish_on_body(const Scene& scene, const PathResult& path, const Scene& rigid, const State& on_rigid) {
    if (!path.complete && path.increments == 0) {  // nothing of the body converged: the rigid skin's answer stands
      result_.message += "; what is reported is the garment on the rigid skin (tier L1)";
      result_.truth = {.stage = "rigid skin"};
      fill(rigid, on_rigid);
    } else {
      fill(scene, path.state);
    }
    if (path.complete) name_sliding(scene, path.state);
    log_.phase("results");
  }

  /// A garment that no edge holds was held at its probe edge: a force there means that it would slide off.
  bool stray(const Scene& scene, const State& state) const {
    return model_.slides_freely() && push_on_probes(scene, state, model_, meshes_).force != 0.0;
  }

  /// No edge holds the garment and friction does not, either; `net`: what pushed it while it stuck.
  void name_slipping(const Push& net) {
    if (model_.slides_freely() && net.friction_needed > 0.9 * coefficient(net.garment))
      fail(no_equilibrium(net, model_, meshes_));
  }

  void name_coefficient(const State& held) {
    if (held.release > 0.0)
      result_.message += fmt::format("; what is reported is held by a coefficient of {:.2g}, and with less no equilibrium was found",
                                     coefficient(0) / held.release);
    else
      result_.message += "; what is reported sticks without a bound";
  }

  void name_sliding(const Scene& scene, const State& state) {
    if (!model_.slides_freely()) return;
    const Push net = push_on_probes(scene, state, model_, meshes_);
    if (net.force != 0.0) fail(no_equilibrium(net, model_, meshes_));
  }

  /// Parts that nothing holds balance by themselves, or not at all. (The pin that keeps a garment from turning bears what the
  /// kinks between the skin's facets ask for, and so does the body then.)
  void refuse_borne_motions() {
    const std::optional<double> borne = result_.balance.free_motions_share;
    if (!borne || *borne <= (model_.garments.empty() ? 1e-6 : 1e-2) || result_.status != "converged") return;
    fail(fmt::format("nothing holds a part of the body, and on the deformed body its loads do not balance: {:.2g} of them is left; "
                     "hold it with a [[support]]", *borne));
  }

  /// Of a garment on the way.
  double coefficient(int garment) const {
    const ContactModel* contact = worn_.contact_of(garment);
    return contact ? contact->friction.coefficient : 0.0;
  }

  bool shows_spread() const {
    return std::any_of(model_.contacts.begin(), model_.contacts.end(), [](const auto& contact) { return contact.spread; });
  }

  void fail(const std::string& why) { result_.status = "failed", result_.message = why; }

  const Model& model_;
  Model worn_;  ///< the same with the friction that holds the garments on the way
  const Meshes& meshes_;
  const KeptStates& kept_;
  const Stop& stop_;
  Journal* journal_;  ///< may be null
  int stages_ = 0;
  int lost_ = 0;     ///< iterations of increments that failed so far
  postproc::RunResult result_;
  RunLog log_;
};

}  // namespace

postproc::RunResult solve(const Model& model, const Meshes& meshes, const Observer& observer,
                          const KeptStates& kept, const Stop& stop, Journal* journal) {
  return Run(model, meshes, observer, kept, stop, journal)();
}

}  // namespace snug::solver
