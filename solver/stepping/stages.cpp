#include "solver/stepping/stages.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/stepping/donning.hpp"

namespace snug::solver {

namespace {

/// Contact pressure over the softest (stiffened) shear modulus where a release step by step starts: small strains.
constexpr double gentle_release = 0.3;

/// No coefficient of friction of cloth on skin is as large.
constexpr double no_friction = 10.0;

std::function<std::vector<Attempt>(const Trail&)> once(Attempt attempt) {
  return [attempt](const Trail&) { return std::vector{attempt}; };
}

/// Why a garment that neither an edge nor friction holds slides off.
std::function<std::string(const Standing&)> sliding(const Model& model, const Meshes& meshes) {
  return [&](const Standing& at) -> std::string {
    if (!model.slides_freely()) return {};
    const Push net = push_on_probes(*at.scene, at.state, model, meshes);
    return net.force == 0.0 ? "" : no_equilibrium(net, model, meshes);
  };
}

/// A garment tightens where it was placed. Where that fails the skin yields under it first: what folds, or lies in a cleft, touches now
/// here and now there, and the set of what touches circles. Particles lay a garment on a body that branches only nearly as it will
/// lie: there this way is the first (leggings on both legs: 18 iterations, the other way stops after 36).
std::function<std::vector<Attempt>(const Trail&)> tighten(const Meshes& meshes) {
  return [&meshes](const Trail&) {
    std::vector<Attempt> attempts = {{.rows = "tightening", .change = tightening()},
                                     {.rows = "tightening, the skin yields", .change = hardening(), .failures = 2, .first_step = 0.5}};
    if (meshes.form) std::swap(attempts[0], attempts[1]);
    return attempts;
  };
}

/// The body gives way under the garment that the rigid skin holds tight, in one step where it gives way little (pressure below
/// its shear modulus). Where that fails, or is more than tissue can answer in one step, its stiffness falls to its own from
/// where its answer is small.
std::function<std::vector<Attempt>(const Trail&)> release(const Model& model, bool every_step) {
  return [&model, every_step](const Trail& trail) {
    const Standing& rigid = trail.back();
    const double give = softest_shear_modulus(model) / rigid.scene->measure(rigid.state).pressure_scale;
    std::vector<Attempt> attempts;
    if (give > 1.0 && !every_step) attempts.push_back({.rows = "body", .change = releasing(1.0), .failures = 0});
    attempts.push_back({.rows = "body, step by step", .change = releasing(std::max(10.0, 1.0 / (gentle_release * give))),
                        .first_step = attempts.empty() ? 1.0 : 0.5});  // the whole step fails from a stiffer body, too
    return attempts;
  };
}

/// Everything at once, where no garment touches the body.
Way at_once(const Model& model) {
  const std::string name = model.deformable() ? "body" : "garment";
  Stage stage{.name = name, .model = &model, .skin = model.deformable() ? Skin::deformable : Skin::rigid,
              .attempts = once({.rows = name, .change = tightening()})};
  if (std::any_of(model.asked.tools.begin(), model.asked.tools.end(), [](const auto& tool) { return tool.friction > 0.0; })) stage.residual = rubbing_residual;
  if (model.garments.empty() && model.contacts.empty() && model.asked.tools.empty()) stage.curve = Curve{model.asked.solver.path == input::LoadPath::arc_length};
  return {.stages = {stage}};
}

/// The garment tightens on the rigid skin first (tier L1, cheap and robust: its path is fictitious anyway); the body is then
/// released under the tightened garment.
Way garment_then_body(const Model& model, const Meshes& meshes, bool every_step) {
  Way way;
  way.stages.push_back({.name = "rigid skin", .model = &model, .attempts = once({.rows = "rigid skin", .change = tightening()}),
                        .objection = sliding(model, meshes)});
  if (model.deformable())
    way.stages.push_back({.name = "body", .model = &model, .skin = Skin::deformable, .attempts = release(model, every_step),
                          .fallback = Fallback::before_if_nothing, .objection = sliding(model, meshes)});
  return way;
}

double first_coefficient(const Model& model) {
  const ContactModel* contact = model.contact_of(0);
  return contact ? contact->friction.coefficient : 0.0;
}

/// A garment that hardly touches and that nothing holds falls: what sticks on the way is no answer.
std::function<std::string(const Standing&)> falling(const Model& model, const Model& worn, const Meshes& meshes) {
  return [&](const Standing& sticking) -> std::string {
    const Push net = push_where_it_sticks(*sticking.scene, sticking.state, worn);
    return model.slides_freely() && net.friction_needed > no_friction ? no_equilibrium(net, model, meshes) : "";
  };
}

/// What a garment that was not let go all the way is held by, and that it slides off where no edge holds it and friction cannot.
auto held_on_the_way(const Model& model, const Model& worn, const Meshes& meshes) {
  return [&](const Trail& trail, const Standing& held, postproc::RunResult& result) {
    result.message += held.state.release > 0.0
                          ? fmt::format("; what is reported is held by a coefficient of {:.2g}, and with less no equilibrium was found",
                                        first_coefficient(worn) / held.state.release)
                          : "; what is reported sticks without a bound";
    const Push net = push_where_it_sticks(*trail.front().scene, trail.front().state, worn);
    const ContactModel* contact = worn.contact_of(net.garment);
    if (model.slides_freely() && net.friction_needed > 0.9 * (contact ? contact->friction.coefficient : 0.0))
      result.status = postproc::Status::failed, result.message = no_equilibrium(net, model, meshes);
  };
}

/// From the garment that friction holds to the one without any: the coefficient falls a hundredfold, then it is left out.
void add_vanishing_friction(const Model& model, const Model& worn, Skin skin, Way& way) {
  const auto tell = [&model](const Trail&, const Standing& held, postproc::RunResult& result) {
    result.status = postproc::Status::partial;
    result.message = fmt::format("without friction no equilibrium was found near the placed garment; what is reported is held by a "
                                 "coefficient of {:.2g}; {}",
                                 usual_friction / held.state.release,
                                 model.garments.front().spec.held.size() > 1 ? "a wider garment or stiffer tissue has one"
                                                                             : "give contact.friction, or hold the other edge, too");
  };
  way.stages.push_back({.name = "fading friction", .model = &worn, .skin = skin, .attempts = once({.rows = "friction fades", .change = fading()}),
                        .leads_on = true, .residual = rubbing_residual, .tell = tell});
  way.stages.push_back({.name = "without friction", .model = &model, .skin = skin,
                        .attempts = once({.rows = "without friction", .change = without_friction(), .failures = 0}),
                        .residual = rubbing_residual, .fallback = Fallback::before, .tell = tell});
}

/// Placed and let go. While its rest metric goes to that of the pattern the garment sticks to the skin where it was placed:
/// nothing slides, gathers or goes slack on a way that is fictitious anyway. The body is released under the garment that still
/// sticks, then friction's bound comes down to mu p: what cannot hold slips. Both at once would save some iterations where it
/// works and swings to and fro where it does not (a calf), and the answers of the two ways differ by a thousandth: one way for all.
/// Without friction of its own the answer is the limit of friction that vanishes: on a bulging limb the states of a
/// half-tightened sleeve without friction do not exist.
Way placed_and_let_go(const Model& model, const Model& worn, const Meshes& meshes, bool every_step) {
  const Skin skin = model.deformable() ? Skin::deformable : Skin::rigid;
  const bool vanishing = !model.has_friction();
  Way way{.release = 0.0, .stages = {}};
  way.stages.push_back({.name = "tightening where it was placed", .model = &worn, .attempts = tighten(meshes),
                        .leads_on = true, .residual = rubbing_residual, .objection = falling(model, worn, meshes),
                        .spreads = std::any_of(model.contacts.begin(), model.contacts.end(), [](const auto& contact) { return contact.spread; })});
  if (model.deformable())
    way.stages.push_back({.name = "releasing the body", .model = &worn, .skin = skin, .attempts = release(worn, every_step), .leads_on = true,
                          .residual = rubbing_residual, .fallback = Fallback::before_if_nothing});
  way.stages.push_back({.name = "letting go", .model = &worn, .skin = skin, .attempts = once({.rows = "let go", .change = letting_go()}),
                        .leads_on = vanishing, .residual = rubbing_residual,
                        .intermediate_residual = 1e-6,  // friction's part of the balance is small: looser states would not follow its bound at all
                        .tell = held_on_the_way(model, worn, meshes)});
  if (vanishing)
    add_vanishing_friction(model, worn, skin, way);
  else
    way.stages.back().objection = sliding(model, meshes);  // of several garments one may be without friction
  return way;
}

}  // namespace

void add_postures(const Movement& movement, Way& way) {
  const Stage last = way.stages.back();
  for (int k = 1; k <= movement.postures(); ++k) {
    const std::string name = fmt::format("posture \"{}\"", movement.name(k));
    const auto tell = [&movement](const Trail&, const Standing& reported, postproc::RunResult& result) {
      result.message += fmt::format("; what is reported stands at {}", movement.text(reported.state.posture));
    };
    way.stages.push_back({.name = name, .model = last.model, .skin = last.skin, .attempts = once({.rows = name, .change = posing(k)}),
                          .tell = tell, .posture = k});
  }
}

std::vector<Way> ways_of(const Model& model, const Model& worn, const Meshes& meshes, bool every_step) {
  if (model.asked.solver.tier == input::Tier::L0) return {};
  if (model.has_friction()) return {placed_and_let_go(model, worn, meshes, every_step)};
  const bool touched = std::any_of(model.contacts.begin(), model.contacts.end(), [](const auto& contact) { return contact.garment >= 0; });
  if (!touched) return {at_once(model)};
  // Without friction the states on the way may not exist where the last one does; one that no edge holds has no other way.
  std::vector<Way> ways = {garment_then_body(model, meshes, every_step)};
  if (!model.slides_freely()) ways.push_back(placed_and_let_go(model, worn, meshes, every_step));
  return ways;
}

}  // namespace snug::solver
