#include "solver/scene/run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <limits>

#include "solver/scene/laplace.hpp"
#include "solver/scene/result.hpp"
#include "solver/stepping/donning.hpp"
#include "solver/stepping/load_path.hpp"
#include "solver/stepping/run_log.hpp"

namespace snug::solver {

namespace {

/// Contact pressure over the softest (stiffened) shear modulus where a release step by step starts: small strains.
constexpr double gentle_release = 0.3;

/// One run: the parts of the flow share the clock, the observer and the result.
class Run {
 public:
  Run(const input::Case& description, const Meshes& meshes, const Observer& observer, const KeptStates& kept)
      : case_(description), meshes_(meshes), kept_(kept), log_(result_, observer) {
    const Plan parts = plan(description, meshes);
    result_.title = description.title;
    result_.tier = parts.tier;
    result_.unknowns = parts.unknowns;
    result_.parts_in = parts.parts_in, result_.parts_out = parts.parts_out;
    log_.expect(parts.seconds);
    result_.body = body_result(meshes.body, parts.tier == "L4");
  }

  postproc::RunResult operator()() {
    if (case_.garment) laplace();
    if (result_.tier == "L0")
      finish_laplace();
    else if (has_friction(case_))
      garment_with_friction();
    else if (case_.garment && case_.contact)
      garment_then_body();
    else if (result_.tier == "L4")
      one_path(Skin::deformable, "body");
    else
      one_path(Skin::rigid, "garment");
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    result_.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
    return std::move(result_);
  }

 private:
  void laplace() {
    const auto fabric = materials::find_fabric(case_.garment->fabric);
    const auto l0 = laplace_pressure(*case_.garment, fabric, meshes_.limb, meshes_.body);
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

  PathSettings settings(Skin skin) const {
    PathSettings path;
    path.newton.may_lag = skin == Skin::deformable;
    path.newton.penetration = 1e-6 * meshes_.garment.mean_edge;
    if (kept_.steps > 0) {
      path.longest_step = 1.0 / kept_.steps;
      path.accepted = [this](const Scene& scene, const State& state, double t) { keep(scene, state, stages_ + t); };
    }
    return path;
  }

  /// Where friction only sets in on the tightened garment there is nothing to halve. A sleeve that slips off is told from
  /// one that holds after few failures.
  PathResult with_friction(Scene& scene, const State& at, double from, const IterationSink& rows, PathSettings path) {
    path.first_step = from < 1.0 ? 0.5 : 1.0;
    path.failures = from < 1.0 ? 3 : 0;
    return follow_path(scene, at, tightening(from, 1.0), path, rows);
  }

  /// Hands a state of the load path to who wants to see it.
  void keep(const Scene& scene, const State& state, double way) const {
    if (kept_.steps == 0) return;
    postproc::RunResult shot;
    shot.body = body_result(meshes_.body, result_.tier == "L4");
    fill_result(scene, state, meshes_.body, meshes_.garment, shot);
    kept_.keep(way, shot);
  }

  bool accept(Scene& scene, const PathResult& path, const std::string& name) {
    log_.end_path(scene, path.increments, name);
    result_.status = path.complete ? "converged" : log_.increments() > 0 ? "partial" : "failed";
    if (!path.complete)
      result_.message = fmt::format("{} stopped at {:.1f} % of its path: {}", name, 100.0 * path.reached, path.message);
    ++stages_;
    return path.complete;
  }

  void one_path(Skin skin, const std::string& name) {
    Scene scene = make_scene(case_, meshes_.body, meshes_.garment, skin);
    log_.phase("set-up");
    const State placed = placed_state(scene.layout(), meshes_.body, meshes_.garment);
    keep(scene, placed, 0.0);
    const auto path = follow_path(scene, placed, tightening(), settings(skin), log_.sink(name));
    accept(scene, path, name);
    fill_result(scene, path.state, meshes_.body, meshes_.garment, result_);
    log_.phase("results");
  }

  /// The garment tightens on the rigid skin first (tier L1, cheap and robust: its path is fictitious anyway); the body
  /// is then released under the tightened garment in one increment. Where that fails, the body takes the whole path.
  void garment_then_body() {
    Scene rigid = make_scene(case_, meshes_.body, meshes_.garment, Skin::rigid);
    log_.phase("set-up");
    State state = placed_state(rigid.layout(), meshes_.body, meshes_.garment);
    keep(rigid, state, 0.0);
    const auto path = follow_path(rigid, state, tightening(), settings(Skin::rigid), log_.sink("rigid skin"));
    const bool complete = accept(rigid, path, "rigid skin");
    rigid.drop_matrix();  // the body needs the memory
    if (complete && result_.tier == "L4" && !stray(rigid, path.state)) return release_body(rigid, path.state);
    fill_result(rigid, path.state, meshes_.body, meshes_.garment, result_);
    if (complete) name_sliding();
    log_.phase("results");
  }

  /// The path of the tightening is fictitious, so that the garment tightens on the rigid skin without friction up to the
  /// fraction from which the case wants it. From there on it acts: on the rigid skin, then on the body.
  void garment_with_friction() {
    Scene smooth = make_scene(without_friction(case_), meshes_.body, meshes_.garment, Skin::rigid);
    Scene rigid = make_scene(case_, meshes_.body, meshes_.garment, Skin::rigid);
    log_.phase("set-up");
    std::map<double, State> at;
    State state = placed_state(smooth.layout(), meshes_.body, meshes_.garment);
    keep(smooth, state, 0.0);
    for (const double to : donning_stops(case_)) {
      const auto path = follow_path(smooth, state, tightening(state.load, to), settings(Skin::rigid), log_.sink("rigid skin"));
      if (!accept(smooth, path, "rigid skin")) {
        fill_result(smooth, path.state, meshes_.body, meshes_.garment, result_);
        return log_.phase("results");
      }
      at[to] = state = path.state;
    }
    const double from = case_.contact->friction_from;
    const auto path = with_friction(rigid, at.at(from), from, log_.sink("friction"), settings(Skin::rigid));
    const bool complete = accept(rigid, path, "friction");
    if (complete) {
      result_.donning = {donning_row("without friction", 1.0, true, smooth, state, meshes_),
                         donning_row(donning_name(from), from, true, rigid, path.state, meshes_)};
      add_donning_variations(at);
      smooth.drop_matrix(), rigid.drop_matrix();  // the body needs the memory
      if (result_.tier == "L4") return release_body(rigid, path.state);
    }
    fill_result(rigid, path.state, meshes_.body, meshes_.garment, result_);
    if (!complete) name_slipping(smooth, state);
    log_.phase("results");
  }

  /// Two more paths on the rigid skin show what the assumption changes; `at`: frictionless states on the way.
  void add_donning_variations(const std::map<double, State>& at) {
    const std::string name = "spread over donning paths";
    Scene rigid = make_scene(case_, meshes_.body, meshes_.garment, Skin::rigid);
    PathSettings aside = settings(Skin::rigid);
    aside.accepted = nullptr;  // their states are not on the way to the answer
    for (const double from : donning_variations(case_)) {
      const auto path = with_friction(rigid, at.at(from), from, log_.quiet(donning_name(from)), aside);
      result_.donning.push_back(donning_row(donning_name(from), from, path.complete, rigid, path.state, meshes_));
    }
    log_.phase(name);
    log_.account(rigid, name);
  }

  /// The rigid skin carries any pressure; tissue gives way. Where it gives way little (pressure below its shear modulus) the
  /// body is released under the tight garment at once. Where that fails, or is more than tissue can answer in one step,
  /// its stiffness falls to its own from where its answer is small.
  void release_body(const Scene& rigid, const State& on_rigid) {
    Scene scene = make_scene(case_, meshes_.body, meshes_.garment, Skin::deformable);
    log_.phase("set-up");
    const double give = softest_shear_modulus() / rigid.measure(on_rigid).reference_pressure;
    const State start = transfer(on_rigid, rigid.layout(), scene.layout(), meshes_.body);
    PathResult released{start, 0.0, false, 0, ""};
    if (give > 1.0 && kept_.steps == 0) released = release_at_once(scene, start);
    if (!released.complete)
      released = follow_path(scene, start, releasing(std::max(10.0, 1.0 / (gentle_release * give))), settings(Skin::deformable),
                             log_.sink("body, step by step"));
    accept(scene, released, "body");
    if (!released.complete && released.increments == 0) {  // nothing of the body converged: the rigid skin's answer stands
      result_.message += "; what is reported is the garment on the rigid skin (tier L1)";
      fill_result(rigid, on_rigid, meshes_.body, meshes_.garment, result_);
    } else {
      fill_result(scene, released.state, meshes_.body, meshes_.garment, result_);
    }
    if (released.complete) name_sliding();
    log_.phase("results");
  }

  PathResult release_at_once(Scene& scene, const State& start) {
    PathResult released{start, 1.0, false, 1, ""};
    const IterationSink rows = log_.sink("body");
    const auto in_one_step = [&](postproc::Iteration row) {
      row.increment = 1;
      rows(row);
    };
    NewtonSettings newton_settings = settings(Skin::deformable).newton;
    newton_settings.recut = true;
    released.complete = newton(scene, released.state, newton_settings, in_one_step) == Outcome::converged;
    return released;
  }

  double softest_shear_modulus() const {
    double softest = std::numeric_limits<double>::max();
    for (const auto& layer : meshes_.body.layers)
      softest = std::min(softest, materials::initial_shear_modulus(materials::find_tissue(layer.material).law));
    return softest;
  }

  postproc::RunResult result_on_rigid(const Scene& scene, const State& state) const {
    postproc::RunResult result;
    result.body = body_result(meshes_.body, false);
    fill_result(scene, state, meshes_.body, meshes_.garment, result);
    return result;
  }

  /// A garment that no edge holds was held at its probe edge: a force there means that it would slide off.
  bool stray(const Scene& scene, const State& state) const {
    return slides_freely(case_) && push(result_on_rigid(scene, state), meshes_.garment).force != 0.0;
  }

  /// No edge holds the garment and friction does not, either: the frictionless state, held at its probe edge, tells what
  /// would have to be borne.
  void name_slipping(const Scene& smooth, const State& tight) {
    if (!slides_freely(case_)) return;
    const Push net = push(result_on_rigid(smooth, tight), meshes_.garment);
    if (net.friction_needed > 0.9 * case_.contact->friction) fail(no_equilibrium(net, case_, meshes_.garment));
  }

  void name_sliding() {
    if (!slides_freely(case_) || has_friction(case_)) return;
    const Push net = push(result_, meshes_.garment);
    if (net.force != 0.0) fail(no_equilibrium(net, case_, meshes_.garment));
  }

  void fail(const std::string& why) { result_.status = "failed", result_.message = why; }

  const input::Case& case_;
  const Meshes& meshes_;
  const KeptStates& kept_;
  int stages_ = 0;
  postproc::RunResult result_;
  RunLog log_;
};

}  // namespace

postproc::RunResult solve(const input::Case& description, const Meshes& meshes, const Observer& observer,
                          const KeptStates& kept) {
  return Run(description, meshes, observer, kept)();
}

}  // namespace snug::solver
