#include "solver/scene/scene.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>

#include "solver/algebra/communicator.hpp"

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
      proximal_weights_(Eigen::VectorXd::Zero(layout.size())) {
  mark_force_rows();
}

void Scene::mark_force_rows() {
  force_row_.assign(numbering_.unknowns(), 1);
  for (int i = layout_.positions(); i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) force_row_[unknown] = 0;
}

void Scene::hold(Supports supports, Numbering numbering) {
  supports_ = std::move(supports), numbering_ = std::move(numbering);
  mark_force_rows();
  drop_matrix();
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
  placed.load = from.load, placed.release = from.release, placed.posture = from.posture;
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

void Scene::take_unknowns(const Eigen::VectorXd& x, Eigen::VectorXd& step) const {
  for (int i = 0; i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) step[i] = x[unknown];
  numbering_.spread(step);
}

void Scene::add_to_unknowns(Eigen::VectorXd forces, Eigen::VectorXd& sum) const {
  numbering_.fold(forces);
  for (int i = 0; i < layout_.size(); ++i)
    if (const int unknown = numbering_.unknown(i); unknown >= 0) sum[unknown] += forces[i];
}

OneWay Scene::one_way(const State& state) const {
  std::vector<Eigen::Triplet<double>> parts;
  for (const auto& term : terms_) term->add_one_way(state, parts);
  if (parts.empty()) return {};
  Eigen::SparseMatrix<double, Eigen::RowMajor> derivative(layout_.size(), layout_.size());
  derivative.setFromTriplets(parts.begin(), parts.end());
  return [this, derivative = std::move(derivative)](const Eigen::VectorXd& x, Eigen::VectorXd& sum) {
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(layout_.size());
    take_unknowns(x, direction);
    add_to_unknowns(derivative * direction, sum);
  };
}

LinearReport Scene::solve(const State& state, Tangent tangent, double proximal, const Lag& lag, Eigen::VectorXd& step, bool whole) {
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
  const LinearReport report = solver_.solve(scatter_, right, x, lag, whole ? one_way(state) : OneWay{});
  if (report.refactored) of_minimum_ = report.ok && tangent == Tangent::full && report.negative_pivots <= saddle_rows();
  costs_.factorisation += report.factor_seconds, costs_.solution += report.solve_seconds;
  costs_.factorisations += report.refactored ? 1 : 0, ++costs_.solutions, costs_.iterations += report.iterations;
  costs_.factor = report.factor;
  take_unknowns(x, step);
  for (const auto& term : terms_) term->recover(state, step);
  return report;
}

bool Scene::respond(const State& state, const Eigen::VectorXd& forces, Eigen::VectorXd& step) {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(numbering_.unknowns()), x;
  add_to_unknowns(forces, right);
  if (!solver_.solve_again(right, x)) return false;
  Eigen::VectorXd still = Eigen::VectorXd::Zero(layout_.size());
  step = still;
  take_unknowns(x, step);
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
  if (supports_.move() || (supports_.carry() && measure.contact_force == 0.0)) {  // the supports' forces are the load
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

}  // namespace snug::solver
