#include "solver/stepping/run_log.hpp"

#include "solver/algebra/communicator.hpp"

namespace snug::solver {

RunLog::RunLog(postproc::RunResult& result, const Observer& observer)
    : result_(result), observer_(observer), start_(Clock::now()) {}

double RunLog::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void RunLog::phase(const std::string& name) {
  const double now = seconds(), spent = now - last_phase_;
  last_phase_ = now;
  for (auto& p : result_.phases)
    if (p.name == name) {
      p.seconds += spent;
      return;
    }
  result_.phases.push_back({name, spent});
}

void RunLog::account(Scene& scene, const std::string& name) {
  const Costs fresh = scene.take_costs();
  Costs& costs = spent_[name];
  costs += fresh;
  result_.linear_solver["factorisations"] += fresh.factorisations;
  result_.linear_solver["solutions"] += fresh.solutions;
  result_.linear_solver["krylov_iterations"] += fresh.iterations;
  result_.linear_solver["ranks"] = ranks();
  if (!fresh.factor.empty()) result_.factor = fresh.factor;
  for (auto& p : result_.phases)
    if (p.name == name)
      p.parts = {{"search", costs.search},
                 {"pattern", costs.pattern},
                 {"assembly", costs.assembly},
                 {"factorisation", costs.factorisation},
                 {"solution", costs.solution}};
}

void RunLog::end_path(Scene& scene, int increments, const std::string& name) {
  result_.increments = increments_before_ += increments;
  result_.iterations = static_cast<int>(result_.history.size());
  phase(name);
  account(scene, name);
}

IterationSink RunLog::sink(const std::string& name) {
  return [this, name](postproc::Iteration row) {
    row.increment += increments_before_;
    row.seconds = seconds();
    result_.history.push_back(row);
    show(name, row);
  };
}

IterationSink RunLog::quiet(const std::string& name) {
  return [this, name](const postproc::Iteration& row) { show(name, row); };
}

void RunLog::show(const std::string& name, const postproc::Iteration& row) const {
  if (observer_)
    observer_({name, row.increment, row.iteration, row.load, row.residual, row.contact_nodes, seconds(), expected_, row.attempt});
}

}  // namespace snug::solver
