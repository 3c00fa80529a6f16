#include "solver/scene/scene.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>

#include "solver/algebra/communicator.hpp"
#include "solver/scene/bands.hpp"
#include "solver/scene/layers.hpp"
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

void Scene::own(std::unique_ptr<Term> term) {
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
  if (report.refactored) of_minimum_ = report.ok && tangent == Tangent::full && report.negative_pivots <= saddle_rows();
  costs_.factorisation += report.factor_seconds, costs_.solution += report.solve_seconds;
  costs_.factorisations += report.refactored ? 1 : 0, ++costs_.solutions, costs_.iterations += report.iterations;
  costs_.factor = report.factor;
  for (int i = 0; i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) step[i] = x[unknown];
  numbering_.spread(step);
  for (const auto& term : terms_) term->recover(state, step);
  return report;
}

bool Scene::respond(const State& state, const Eigen::VectorXd& forces, Eigen::VectorXd& step) {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(numbering_.unknowns()), x;
  Eigen::VectorXd folded = forces;
  numbering_.fold(folded);
  for (int i = 0; i < layout_.size(); ++i)
    if (const int row = numbering_.unknown(i); row >= 0) right[row] += folded[i];
  if (!solver_.solve_again(right, x)) return false;
  Eigen::VectorXd still = Eigen::VectorXd::Zero(layout_.size());
  step = still;
  for (int i = 0; i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) step[i] = x[unknown];
  numbering_.spread(step);
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

double Scene::energy(const State& state) const {
  double sum = 0.0;
  for (const auto& term : terms_) sum += term->stored_energy(state);
  return sum;
}

Measure Scene::measure(const State& state) const {
  Measure measure;
  for (const auto& term : terms_) term->measure(state, measure);
  if (supports_.move()) {  // the supports' forces are the load
    const Eigen::VectorXd residual = full_residual(state);
    for (const int entry : supports_.table().prescribed_entries()) measure.contact_force += std::abs(residual[entry]);
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

// Pressure per gap of the stiffest layer: computed, never a user's number.
double body_stiffness(const Model& model, double master_edge) {
  double stiffest = 0.0;
  for (const materials::Tissue& tissue : model.tissues)
    stiffest = std::max(stiffest, 3.0 * materials::initial_shear_modulus(tissue.law) / master_edge);
  return stiffest;
}

// The same of a sheet.
double sheet_stiffness(const GarmentModel& model, const mesh::GarmentMesh& garment) {
  return model.stiffness() / (garment.mean_edge * garment.mean_edge);
}

ShellElasticity shell_elasticity(const materials::Tissue& tissue, const mesh::Layer& layer) {
  if (const auto* elastic = std::get_if<materials::LinearElastic>(&tissue.law)) return {elastic->youngs_modulus, elastic->poisson_ratio};
  throw input::InputError(layer.material.where, "the law of the shell \"" + layer.name + "\" is not linear",
                          "write law = \"linear-elastic\" with youngs_modulus and poisson_ratio");
}

// The same of a shell body: of its stiffest triangle as a sheet.
double shell_stiffness(const Model& model, const mesh::BodyMesh& body, double edge) {
  double stiffest = 0.0;
  for (const mesh::ShellTriangle& t : body.shell)
    stiffest = std::max(stiffest, shell_elasticity(model.tissues[t.layer], body.layers[t.layer]).youngs_modulus * t.thickness / (edge * edge));
  return stiffest;
}

void add_body(const Model& model, const mesh::BodyMesh& body, Scene& scene) {
  const Field& position = scene.layout()["body"];
  scene.add(Part{"body", Role::body, position});
  if (!body.shell.empty()) {
    std::vector<ShellElasticity> elasticity;
    for (std::size_t l = 0; l < body.layers.size(); ++l) elasticity.push_back(shell_elasticity(model.tissues[l], body.layers[l]));
    scene.add(std::make_unique<Shell>(position, body, std::move(elasticity), model.asked.body->where));
  } else {
    std::vector<materials::SolidLaw> laws;
    for (const materials::Tissue& tissue : model.tissues) laws.push_back(tissue.law);
    scene.add(std::make_unique<Tissue>("tissue", body_fields(scene.layout(), "body"), body, std::move(laws)));
    for (const materials::SkinMembrane& membrane : model.membranes)
      scene.add(std::make_unique<SkinMembraneTerm>(position, body, membrane));
  }
  add_loads(model, body, scene);
}

double ground_stiffness(const Model& model, const mesh::BodyMesh& body, double edge) {
  return body.shell.empty() ? body_stiffness(model, edge) : shell_stiffness(model, body, edge);
}

void add_touch(const ContactModel& contact, std::vector<std::string> masters, const FabricMembrane* sheet, Interface interface, double stiffness,
               double stick, Scene& scene) {
  const double edge = interface.slave.mean_edge;
  Touch touch{.slave = contact.slave, .masters = std::move(masters), .sheet = sheet};
  touch.contact = &scene.add(std::make_unique<Contact>(contact.name, std::move(interface), stiffness,
                                                       contact.dual ? GapBasis::dual : GapBasis::hat));
  if (contact.friction.coefficient > 0.0)
    touch.friction = &scene.add(std::make_unique<Friction>(contact.friction_name(), *touch.contact, contact.friction.coefficient,
                                                           Friction::usual_elastic_slip * edge, sticking * stick));
  scene.add(std::move(touch));
}

void add_garment(const Model& model, int g, const Meshes& meshes, Skin skin, std::optional<double> prestretch, Scene& scene) {
  const GarmentModel& garment = model.garments[g];
  const mesh::GarmentMesh& mesh = meshes.garments[g];
  const Field& position = scene.layout()[mesh.name];
  scene.add(Part{mesh.name, Role::garment, position});
  const FabricMembrane& fabric = scene.add(std::make_unique<FabricMembrane>(mesh.name, position, mesh, garment.fabrics(), prestretch));
  add_loose_cloth(model, g, mesh, scene);
  add_bands(garment.spec, mesh, scene);
  const ContactModel* contact = model.contact_of(g);
  if (!contact) return;
  const double sheet = sheet_stiffness(garment, mesh);
  const std::vector<int> under = layers_under(model, meshes.garments, g);
  MasterSurface ground(scene.layout()["body"], meshes.body, meshes.body.skin_facets);
  double stiffness = skin == Skin::deformable ? std::max(sheet, ground_stiffness(model, meshes.body, ground.mean_edge())) : sheet;
  for (const int layer : under) stiffness = std::max(stiffness, sheet_stiffness(model.garments[layer], meshes.garments[layer]));
  add_touch(*contact, master_names(meshes.garments, under), &fabric,
            {scene.layout()[contact->name], slave_with_bands(position, garment.spec, mesh), over_layers(scene.layout(), meshes.garments, under, std::move(ground))},
            stiffness, sheet, scene);
}

void add_solid_contact(const Model& model, const ContactModel& contact, const mesh::BodyMesh& body, Scene& scene) {
  const Field& position = scene.layout()["body"];
  MasterSurface master(position, body, contact_facets(body, contact.master, contact.where));
  const double stiffness = body_stiffness(model, master.mean_edge());
  add_touch(contact, {contact.master}, nullptr,
            {scene.layout()[contact.name], surface_slave(position, body, slave_facets(body, contact)), std::move(master)}, stiffness,
            stiffness, scene);
}

// What is left free must be in balance before anything moves.
void check_balance(const Scene& scene, const Meshes& meshes, const input::Location& where) {
  State state = placed_state(scene.layout(), meshes);
  state.load = 1.0;
  const Eigen::VectorXd load = scene.load_forces(state);
  const Field& body = scene.layout()["body"];
  std::vector<Eigen::Vector3d> forces;
  for (int node = 0; node < body.count; ++node) forces.push_back(load.segment<3>(body(node)));
  check_balance(scene.supports(), meshes.body, forces, where);
}

}  // namespace

Scene make_scene(const Model& model, const Meshes& meshes, Skin skin, std::optional<double> prestretch) {
  const Layout layout = make_layout(model, meshes, skin);
  Supports supports(model, meshes.body, layout);
  Numbering numbering = make_numbering(model, meshes, layout, supports);
  Scene scene(layout, std::move(numbering), std::move(supports));
  if (skin == Skin::deformable) add_body(model, meshes.body, scene);
  if (!scene.supports().free_parts().empty()) check_balance(scene, meshes, model.asked.body->where);
  for (std::size_t g = 0; g < model.garments.size(); ++g) add_garment(model, static_cast<int>(g), meshes, skin, prestretch, scene);
  for (const ContactModel& contact : model.contacts)
    if (contact.garment < 0 && skin == Skin::deformable) add_solid_contact(model, contact, meshes.body, scene);
  return scene;
}

State placed_state(const Layout& layout, const Meshes& meshes) {
  State state;
  state.values = Eigen::VectorXd::Zero(layout.size());
  const auto place = [&](const Field& field, const std::vector<Eigen::Vector3d>& at) {
    for (int node = 0; node < field.count; ++node) state.values.segment<3>(field(node)) = at[node];
  };
  place(layout["body"], meshes.body.nodes);
  for (const mesh::GarmentMesh& garment : meshes.garments) place(layout[garment.name], garment.placed);
  return state;
}

}  // namespace snug::solver
