#include "solver/scene/scene.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>

#include "materials/laws/skin_membrane.hpp"
#include "solver/algebra/communicator.hpp"
#include "solver/scene/friction_choice.hpp"
#include "solver/scene/loads.hpp"
#include "solver/terms/shell.hpp"
#include "solver/terms/skin_membrane_term.hpp"

namespace snug::solver {

namespace {

class ScatterSink : public Sink {
 public:
  ScatterSink(SparseScatter& scatter, int group) : scatter_(scatter), group_(group) {}
  void add(int element, std::span<const double> residual, std::span<const double> matrix) override {
    scatter_.add(group_, element, residual, matrix);
  }
  void add_condensed(int element, std::span<const double> values) override { scatter_.add_condensed(group_, element, values); }
  bool wants(int element) const override { return scatter_.touches(group_, element); }

 private:
  SparseScatter& scatter_;
  int group_;
};

class VectorSink : public Sink {
 public:
  VectorSink(const ElementEntries& entries, Eigen::VectorXd& sum) : entries_(entries), sum_(sum) {}
  void add(int element, std::span<const double> residual, std::span<const double>) override {
    const auto entries = entries_.of(element);
    for (std::size_t i = 0; i < entries.size(); ++i) sum_[entries[i]] += residual[i];
  }

 private:
  const ElementEntries& entries_;
  Eigen::VectorXd& sum_;
};

/// Adds tangent * direction, element by element.
class ProductSink : public Sink {
 public:
  ProductSink(const ElementEntries& entries, const Eigen::VectorXd& direction, Eigen::VectorXd& sum)
      : entries_(entries), direction_(direction), sum_(sum) {}
  void add(int element, std::span<const double>, std::span<const double> matrix) override {
    const auto entries = entries_.of(element);
    for (std::size_t k = 0; k < matrix.size(); ++k)
      sum_[entries[k / entries.size()]] += matrix[k] * direction_[entries[k % entries.size()]];
  }

 private:
  const ElementEntries& entries_;
  const Eigen::VectorXd& direction_;
  Eigen::VectorXd& sum_;
};

}  // namespace

Scene::Scene(const Layout& layout, Numbering numbering, Supports supports)
    : layout_(layout),
      numbering_(std::move(numbering)),
      supports_(std::move(supports)),
      proximal_weights_(Eigen::VectorXd::Zero(layout.size())),
      force_row_(numbering_.unknowns(), 1) {
  for (int i = layout.positions(); i < layout.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) force_row_[unknown] = 0;
}

void Scene::add(std::unique_ptr<Term> term) {
  term->damp(proximal_weights_);
  terms_.push_back(std::move(term));
  built_.clear();
}

bool Scene::bends() const {
  return std::any_of(terms_.begin(), terms_.end(), [](const auto& term) { return term->bends(); });
}

bool Scene::renews_near_answer() const {
  return std::any_of(terms_.begin(), terms_.end(), [](const auto& term) { return term->renews_near_answer(); });
}

bool Scene::pattern_is_of(const State& state) const {
  if (built_.size() != terms_.size()) return false;
  for (std::size_t t = 0; t < terms_.size(); ++t)
    if (&terms_[t]->entries(state) != built_[t]) return false;
  return true;
}

void Scene::rebuild(const State& state) {
  const Stopwatch watch(costs_.pattern);
  built_.clear();
  for (const auto& term : terms_) built_.push_back(&term->entries(state));
  built_of_ = state.history;
  const auto [first, end] = numbering_.owned(rank());
  scatter_.build(numbering_, built_, first, end);
  const bool symmetric = std::all_of(terms_.begin(), terms_.end(), [](const auto& term) { return term->symmetric(); });
  solver_.reset(scatter_, numbering_.unknowns(), symmetric);
}

void Scene::renew(State& state) {
  const Stopwatch watch(costs_.search);
  for (const auto& term : terms_) term->renew(state);
}

void Scene::look(State& state) const {
  if (!state.history.list().empty()) return;
  for (const auto& term : terms_) term->renew(state);
  for (const auto& term : terms_) term->update(state);
}

void Scene::restore(State& state) const {
  for (const auto& term : terms_) term->restore(state);
}

void Scene::drop_matrix() {
  solver_ = {};
  scatter_ = {};
  built_.clear(), built_of_ = {};
}

void Scene::commit(State& state) const {
  for (const auto& term : terms_) term->commit(state);
}

void Scene::update(State& state) {
  {
    const Stopwatch watch(costs_.search);
    for (const auto& term : terms_) term->update(state);
  }
  if (!pattern_is_of(state)) rebuild(state);
}

State Scene::transfer(const State& from, const Layout& layout, State placed) const {
  placed.load = from.load, placed.release = from.release;
  for (const Field& to : layout_.fields())
    if (const Field& source = layout[to.name]; source.size() == to.size())
      placed.values.segment(to.first, to.size()) = from.values.segment(source.first, source.size());
  for (const auto& term : terms_) term->carry(from, placed);
  return placed;
}

bool Scene::assemble(const State& state, Tangent tangent) {
  const Stopwatch watch(costs_.assembly);
  if (!pattern_is_of(state)) throw std::logic_error("the matrix is assembled at a state that the scene has not looked at");
  scatter_.zero();
  bool admissible = true;
  for (std::size_t t = 0; t < terms_.size() && admissible; ++t) {
    ScatterSink sink(scatter_, static_cast<int>(t));
    admissible = terms_[t]->assemble(state, tangent, sink);
  }
  return on_all_ranks(admissible);
}

int Scene::saddle_rows() const {
  int rows = 0;
  for (int i = layout_.positions(); i < layout_.size(); ++i) rows += numbering_.unknown(i) >= 0;
  return rows;
}

Eigen::VectorXd Scene::full_residual(const State& state) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(layout_.size());
  for (const auto& term : terms_) {
    VectorSink sink(term->entries(state), sum);
    term->assemble(state, Tangent::none, sink);
  }
  return sum;
}

Eigen::VectorXd Scene::load_forces(const State& state) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(layout_.size());
  for (const auto& term : terms_) {
    if (!term->is_load()) continue;
    VectorSink sink(term->entries(state), sum);
    term->assemble(state, Tangent::none, sink);
  }
  return -sum;
}

LinearReport Scene::solve(const State& state, Tangent tangent, double proximal, const Lag& lag, Eigen::VectorXd& step) {
  const int first = scatter_.first_row();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(numbering_.unknowns());
  right.segment(first, scatter_.rows()) = -(scatter_.residual() + scatter_.condensed());
  step = Eigen::VectorXd::Zero(layout_.size());
  if (const Eigen::VectorXd gap = supports_.gap(state); gap.size() > 0) step = gap;
  if (!step.isZero(0.0)) {
    Eigen::VectorXd product = Eigen::VectorXd::Zero(layout_.size());
    for (const auto& term : terms_) {
      ProductSink sink(term->entries(state), step, product);
      term->assemble(state, tangent, sink);
    }
    numbering_.fold(product);
    for (int i = 0; i < layout_.size(); ++i)
      if (const int row = numbering_.unknown(i); row >= first && row < first + scatter_.rows()) right[row] -= product[i];
  }
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(scatter_.rows());
  for (int i = 0; i < layout_.size(); ++i)
    if (const int row = numbering_.unknown(i) - first; row >= 0 && row < scatter_.rows())
      diagonal[row] += proximal * proximal_weights_[i];
  for (const auto& [entry, follows] : numbering_.bound())
    for (const Follow& to : follows)
      if (const int row = numbering_.unknown(to.entry) - first; row >= 0 && row < scatter_.rows())
        diagonal[row] += to.weight * to.weight * proximal * proximal_weights_[entry];
  scatter_.add_diagonal(diagonal);
  Eigen::VectorXd x;
  const LinearReport report = solver_.solve(scatter_, right, x, lag);
  costs_.factorisation += report.factor_seconds, costs_.solution += report.solve_seconds;
  costs_.factorisations += report.refactored ? 1 : 0, ++costs_.solutions, costs_.iterations += report.iterations;
  for (int i = 0; i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) step[i] = x[unknown];
  numbering_.spread(step);
  for (const auto& term : terms_) term->recover(state, step);
  return report;
}

bool Scene::respond(const State& state, const Eigen::VectorXd& forces, Eigen::VectorXd& step) {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(numbering_.unknowns()), x;
  for (int i = 0; i < layout_.size(); ++i)
    if (const int row = numbering_.unknown(i); row >= 0) right[row] += forces[i];
  if (!solver_.solve_again(right, x)) return false;
  Eigen::VectorXd still = Eigen::VectorXd::Zero(layout_.size());
  step = still;
  for (int i = 0; i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) step[i] = x[unknown];
  for (const auto& term : terms_) term->recover(state, step), term->recover(state, still);
  step -= still;  // what is recovered without any step belongs to `solve`
  return true;
}

double Scene::force_norm(const Eigen::VectorXd& rows) const {
  double squared = 0.0;
  for (int row = 0; row < scatter_.rows(); ++row)
    if (force_row_[scatter_.first_row() + row]) squared += rows[row] * rows[row];
  return std::sqrt(sum_over_ranks(squared));
}

double Scene::force_residual() const { return force_norm(scatter_.residual()); }

double Scene::condensed_residual() const { return force_norm(scatter_.residual() + scatter_.condensed()); }

double Scene::slope(const Eigen::VectorXd& step) const {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(scatter_.rows());  // entries that share an unknown count once
  for (int i = 0; i < layout_.size(); ++i)
    if (const int row = numbering_.unknown(i) - scatter_.first_row(); row >= 0 && row < scatter_.rows())
      direction[row] = step[i];
  return sum_over_ranks(direction.dot(scatter_.residual()));
}

double Scene::round_off(const State& state) const {
  const double total = sum_over_ranks(scatter_.squared_diagonal());
  return std::numeric_limits<double>::epsilon() * farthest(state) * std::sqrt(total);
}

double Scene::farthest(const State& state) const { return state.values.head(layout_.positions()).cwiseAbs().maxCoeff(); }

Measure Scene::measure(const State& state) const {
  Measure measure;
  for (const auto& term : terms_) term->measure(state, measure);
  if (supports_.move()) {  // the supports' forces are the load
    const Eigen::VectorXd residual = full_residual(state);
    for (const int entry : supports_.entries()) measure.contact_force += std::abs(residual[entry]);
  }
  return measure;
}

double Scene::step_bound(const State& state, const Eigen::VectorXd& step) const {
  double bound = 1.0;
  for (const auto& term : terms_) bound = term->step_bound(state, step, bound);
  return bound;
}

namespace {

// A garment that sticks gives way to its own tension by this fraction of what a triangle alone would.
constexpr double sticking = 2.0;

// Pressure per gap of the stiffest part that touches: computed, never a user's number.
double contact_stiffness(const materials::Fabric& fabric, const mesh::GarmentMesh& garment, const mesh::BodyMesh& body,
                         Skin skin) {
  double local = fabric.stiffness() / (garment.mean_edge * garment.mean_edge);
  if (skin == Skin::deformable)
    for (const auto& layer : body.layers)
      local = std::max(local, 3.0 * materials::initial_shear_modulus(materials::find_tissue(layer.material).law) /
                                  body.mean_skin_cell);
  return local;
}

ShellElasticity shell_elasticity(const mesh::Layer& layer) {
  const materials::SolidLaw law = materials::find_tissue(layer.material).law;
  if (const auto* elastic = std::get_if<materials::LinearElastic>(&law)) return {elastic->youngs_modulus, elastic->poisson_ratio};
  throw input::InputError(layer.material.where, "the law of the shell \"" + layer.name + "\" is not linear",
                          "write law = \"linear-elastic\" with youngs_modulus and poisson_ratio");
}

void add_body(const input::Case& description, const mesh::BodyMesh& body, Scene& scene) {
  if (!body.shell.empty()) {
    std::vector<ShellElasticity> elasticity;
    for (const auto& layer : body.layers) elasticity.push_back(shell_elasticity(layer));
    scene.add(std::make_unique<Shell>(scene.layout()["body"], body, std::move(elasticity), description.body->where));
    return add_loads(description.load.value_or(input::LoadSpec{}), body, scene);
  }
  std::vector<materials::SolidLaw> laws;
  for (const auto& layer : body.layers) laws.push_back(materials::find_tissue(layer.material).law);
  scene.add(std::make_unique<Tissue>("tissue", body_fields(scene.layout(), "body"), body, std::move(laws)));
  for (const auto& membrane : body.membranes)
    scene.add(std::make_unique<SkinMembraneTerm>(
        scene.layout()["body"], body,
        materials::SkinMembrane{materials::find_membrane_tissue(membrane.material).law, membrane.thickness}));
  add_loads(description.load.value_or(input::LoadSpec{}), body, scene);
}

// What is left free must be in balance before anything moves.
void check_balance(const Scene& scene, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, const input::Location& where) {
  State state = placed_state(scene.layout(), body, garment);
  state.load = 1.0;
  const Eigen::VectorXd load = scene.load_forces(state);
  std::vector<Eigen::Vector3d> forces;
  for (int node = 0; node < scene.layout()["body"].count; ++node) forces.push_back(load.segment<3>(scene.layout()["body"](node)));
  check_balance(scene.supports(), body, forces, where);
}

}  // namespace

Scene make_scene(const input::Case& description, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, Skin skin,
                 std::optional<double> prestretch) {
  const bool deformable = skin == Skin::deformable, contact = description.garment && description.contact;
  const Layout layout = make_layout(body, garment, deformable, contact);
  Supports supports(description, body, layout);
  Numbering numbering = make_numbering(description, body, garment, layout, supports);
  Scene scene(layout, std::move(numbering), std::move(supports));
  if (deformable) add_body(description, body, scene);
  if (!scene.supports().free_parts().empty()) check_balance(scene, body, garment, description.body->where);
  if (!description.garment) return scene;
  const materials::Fabric fabric = materials::find_fabric(description.garment->fabric);
  const Field& position = layout["garment"];
  scene.add(std::make_unique<FabricMembrane>(position, garment, fabric, prestretch));
  add_loose_cloth(description, garment, materials::with_usual_sheet(fabric), scene);
  if (contact)
    scene.add(std::make_unique<Contact>(
        "contact", Interface{layout["contact"], garment_slave(position, garment), MasterSurface(layout["body"], body, body.skin_facets)},
        contact_stiffness(fabric, garment, body, skin), description.contact->basis == "dual" ? GapBasis::dual : GapBasis::hat));
  if (const double coefficient = friction_choice(description).coefficient; coefficient > 0.0)
    scene.add(std::make_unique<Friction>("friction", *scene.find<Contact>(), coefficient,
                                         Friction::usual_elastic_slip * garment.mean_edge,
                                         sticking * fabric.stiffness() / (garment.mean_edge * garment.mean_edge)));
  return scene;
}

State placed_state(const Layout& layout, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment) {
  State state;
  state.values = Eigen::VectorXd::Zero(layout.size());
  for (int node = 0; node < layout["body"].count; ++node) state.values.segment<3>(layout["body"](node)) = body.nodes[node];
  for (int node = 0; node < layout["garment"].count; ++node)
    state.values.segment<3>(layout["garment"](node)) = garment.placed[node];
  return state;
}

}  // namespace snug::solver
