#include "solver/app/size/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "postproc/units.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/progress.hpp"
#include "solver/library/graduated.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

const input::TargetSpec& target_of(const PreparedCase& prepared) {
  if (!prepared.jobs.target)
    throw input::InputError({(prepared.description.directory / "case.toml").string(), 0, 0}, "nothing says what pressure is wanted",
                            "give --target \"Ankle = 20 mmHg\", or add [target] to the case");
  return *prepared.jobs.target;
}

std::vector<double> wanted_of(const input::TargetSpec& target) {
  std::vector<double> wanted;
  for (const input::WantedPressure& one : target.pressures) wanted.push_back(one.pressure);
  return wanted;
}

std::string named_place(const input::WantedPressure& wanted) { return wanted.location.empty() ? fmt::format("{:.4g} mm", 1e3 * *wanted.height) : wanted.location; }

std::string round_text(int round, const std::string& tier, const std::string& cut, const std::vector<postproc::TargetRow>& rows) {
  std::string text = fmt::format("solution {}, {}: {}\n", round, tier, cut);
  for (const postproc::TargetRow& row : rows)
    text += fmt::format("  {:<24} {:>8.0f} Pa {:>7.2f} mmHg  {:+6.1f} % of the {:.0f} Pa wanted\n", row.place, row.found, postproc::to_mmHg(row.found), 100.0 * (row.found / row.wanted - 1.0),
                        row.wanted);
  return text;
}

double largest_error(const std::vector<postproc::TargetRow>& rows) {
  double error = 0.0;
  for (const postproc::TargetRow& row : rows) error = std::max(error, std::abs(row.found / row.wanted - 1.0));
  return error;
}

/// What a least-squares search makes least.
double squares(const std::vector<postproc::TargetRow>& rows) {
  double sum = 0.0;
  for (const postproc::TargetRow& row : rows) sum += std::pow(row.found / row.wanted - 1.0, 2);
  return sum;
}

}  // namespace

std::string toml_of(const std::vector<input::GirthRow>& rows, const char* between) {
  std::string text = "[";
  for (const input::GirthRow& row : rows)
    text += fmt::format("{}{{ height = \"{:.1f} mm\", girth = \"{:.1f} mm\" }}", &row == &rows.front() ? (*between == '\n' ? between : "") : fmt::format(",{}", between),
                        1e3 * row.height, 1e3 * row.girth);
  return text + (*between == '\n' ? ",\n]" : "]");
}

std::string garment_path(const input::Case& description, int garment) {
  return description.garments.size() > 1 ? "garment." + description.garments[garment].name + "." : "garment.";
}

ScaledCut::ScaledCut(const PreparedCase& prepared, int garment)
    : path_(garment_path(prepared.description, garment) + "pattern."),
      base_(prepared.model.garments[garment].spec.pattern),
      table_(prepared, garment, target_of(prepared)),
      search_(wanted_of(target_of(prepared)), [this](std::size_t place, double size) { return table_.at(place, size); }, table_.smallest(), table_.largest()),
      wanted_(table_.places()) {
  choose();
}

/// What is cut is rounded as it is written.
void ScaledCut::choose() {
  size_ = search_.next();
  if (base_.kind == input::PatternKind::tube) size_ = 1e-4 * std::round(1e4 * size_ * base_.flat_circumference) / base_.flat_circumference;
  if (base_.sewn()) size_ = 1e-4 * std::round(1e4 * size_ * base_.girth_scale) / base_.girth_scale;
}

std::vector<Setting> ScaledCut::settings_of(double size) const {
  if (base_.sewn()) return {{path_ + "girth_scale", fmt::format("{:.4f}", size * base_.girth_scale)}};
  if (!base_.graduated()) return {{path_ + "flat_circumference", fmt::format("\"{:.1f} mm\"", 1e3 * size * base_.flat_circumference)}};
  std::vector<input::GirthRow> rows = base_.circumferences;
  for (input::GirthRow& row : rows) row.girth *= size;
  return {{path_ + "circumferences", toml_of(rows, "\n  ")}};
}

std::vector<Setting> ScaledCut::next() { return settings_of(size_); }
std::vector<Setting> ScaledCut::settings(const PreparedCase&) const { return settings_of(size_); }

std::string ScaledCut::text(const PreparedCase&) const {
  if (base_.sewn()) return fmt::format("girth_scale {:.4f}", size_ * base_.girth_scale);
  if (!base_.graduated()) return fmt::format("flat_circumference {:.1f} mm", 1e3 * size_ * base_.flat_circumference);
  const auto& rows = base_.circumferences;
  return fmt::format("circumferences {:.1f} to {:.1f} mm ({:.2f} % of the case's)", 1e3 * size_ * rows.front().girth, 1e3 * size_ * rows.back().girth, 100.0 * size_);
}

std::vector<postproc::TargetRow> ScaledCut::compare(const PreparedCase& prepared, const postproc::RunResult& run) const {
  std::vector<postproc::TargetRow> rows = solver::evaluate(prepared, run).targets;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].place = named_place(prepared.jobs.target->pressures[i]);
  return rows;
}

/// Of several pressures the best cut may meet none: it has settled where the next one would not change what is pressed.
bool ScaledCut::learn(const PreparedCase&, const postproc::RunResult&, const std::vector<postproc::TargetRow>& rows, double within) {
  std::vector<double> found;
  for (const postproc::TargetRow& row : rows) found.push_back(row.found);
  search_.found(size_, found);
  if (wanted_ == 1 && largest_error(rows) <= within) return true;
  choose();
  if (wanted_ == 1) return false;
  double change = 0.0;
  for (std::size_t i = 0; i < wanted_; ++i) change = std::max(change, std::abs(search_.predicted(i, size_) - found[i]) / rows[i].wanted);
  return change <= within;
}

int designed_garment(const input::Case& description) {
  int found = -1;
  const std::string file = (description.directory / "case.toml").string();
  for (std::size_t g = 0; g < description.garments.size(); ++g) {
    if (description.garments[g].pattern.pressures.empty()) continue;
    if (found >= 0) throw input::InputError({file, 0, 0}, "two garments are made for pressures", "design one after the other: leave the pressures of the other out");
    found = static_cast<int>(g);
  }
  if (found < 0)
    throw input::InputError({file, 0, 0}, "no garment says what pressures it is made for",
                            "write pattern = { kind = \"graduated\", length = \"300 mm\", pressures = [{ height = \"0 mm\", pressure = \"20 mmHg\" }, …] }");
  return found;
}

std::vector<Setting> CourseCut::settings(const PreparedCase& prepared) const {
  const int garment = designed_garment(prepared.description);
  return {{garment_path(prepared.description, garment) + "pattern.circumferences", toml_of(prepared.model.garments[garment].spec.pattern.circumferences, "\n  ")}};
}

std::string CourseCut::text(const PreparedCase& prepared) const {
  const auto& rows = prepared.model.garments[designed_garment(prepared.description)].spec.pattern.circumferences;
  return fmt::format("{} circumferences from {:.1f} to {:.1f} mm", rows.size(), 1e3 * rows.front().girth, 1e3 * rows.back().girth);
}

std::vector<postproc::TargetRow> CourseCut::compare(const PreparedCase&, const postproc::RunResult& run) const {
  std::vector<postproc::TargetRow> rows;
  for (const postproc::ProfileRow& row : run.profile) rows.push_back({fmt::format("{:.4g} mm up the tube", 1e3 * row.height), row.wanted, row.found});
  return rows;
}

bool CourseCut::learn(const PreparedCase& prepared, const postproc::RunResult& run, const std::vector<postproc::TargetRow>& rows, double within) {
  const int garment = designed_garment(prepared.description);
  next_ = {{garment_path(prepared.description, garment) + "pattern.circumferences", toml_of(solver::corrected_girths(prepared.model, garment, prepared.meshes, run), " ")}};
  return largest_error(rows) <= within;
}

FoundCut search_cut(const std::string& directory, const CaseOptions& options, Cut& cut, int rounds, double within, const Cleaner& cleaner, Console& console) {
  FoundCut best;
  double least = std::numeric_limits<double>::max();
  std::unique_ptr<Scratch> scratch;
  std::unique_ptr<SolverSession> session;
  for (int round = 1; round <= rounds && !best.settled; ++round) {
    CaseOptions now = options;
    for (const Setting& setting : cut.next()) now.overrides.push_back(setting.path + "=" + setting.literal);
    const auto prepared = std::make_shared<PreparedCase>(prepare(directory, now));
    if (!session) scratch = prepare_for_mpi(cleaner), session = std::make_unique<SolverSession>();
    const postproc::RunResult run = [&] {
      ProgressLine line(console, false);
      return solver::solve(*prepared, [&](const solver::Progress& progress) { line.show(progress); });
    }();
    if (run.status != postproc::Status::converged) {
      console.error(fmt::format("{}: error: solution {} ({}) does not converge: {}; want less, hold an edge (garment.held), or take a graduated tube and a stiffer knit, of which the limb stretches less",
                                (fs::path(directory) / "case.toml").string(), round, cut.text(*prepared), run.message));
      best.status = not_converged;
      break;
    }
    const std::vector<postproc::TargetRow> rows = cut.compare(*prepared, run);
    console.say(round_text(round, run.tier, cut.text(*prepared), rows));
    console.document()["solutions"].push_back({{"tier", run.tier}, {"cut", cut.text(*prepared)}, {"targets", targets_json(rows)}});
    if (const double sum = squares(rows); sum < least || largest_error(rows) <= within) {
      least = sum;
      best.settings = cut.settings(*prepared), best.rows = rows, best.error = largest_error(rows), best.prepared = prepared, best.warnings = run.warnings;
    }
    best.settled = cut.learn(*prepared, run, rows, within);
  }
  return best;
}

}  // namespace snug::app
