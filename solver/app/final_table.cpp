#include "solver/app/final_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/suggestion.hpp"
#include "postproc/summary.hpp"
#include "postproc/tables.hpp"
#include "postproc/units.hpp"
#include "solver/app/print_plan.hpp"

namespace snug::app {

namespace {

using postproc::to_gf_cm2;
using postproc::to_mmHg;

std::string rating_text(const postproc::LocationRow& row) {
  std::string text = row.rating ? fmt::format("{:.2f} {}", *row.rating, row.term) : "-";
  if (row.rating && !row.significant) text += " (the trial found no effect of pressure here)";
  if (row.extrapolated)
    text += fmt::format(" ({} the trial's {:.0f} to {:.0f} Pa)", row.mean_pressure > row.trial_high ? "above" : "below", row.trial_low, row.trial_high);
  if (row.pressures_of == "hem") text += " (its cover is a hem: no pressure beside it)";
  return text;
}

std::string comfort_text(const postproc::Comfort& comfort) {
  std::string text = fmt::format("  comfort            {:.2f} {} ({})\n", comfort.score, comfort.term, comfort.scale);
  if (comfort.interval)
    text += fmt::format("    of which         {:.0f} % of {} draws about the curves lie in {:.2f} to {:.2f}{}\n",
                        comfort.interval->level * 100.0, comfort.interval->samples, comfort.interval->low,
                        comfort.interval->high,
                        comfort.interval->without_scatter.empty()
                            ? ""
                            : "; no scatter known of " + input::joined(comfort.interval->without_scatter));
  if (!comfort.left_out.empty())
    text += fmt::format("    not judged       {}: no input of the fuzzy system \"{}\"\n",
                        input::joined(comfort.left_out), comfort.system);
  return text;
}

std::string balance_text(const postproc::RunResult& run) {
  const postproc::Balance& balance = run.balance;
  const double force = balance.force_error.norm();
  std::string text = fmt::format("  force balance      |sum of forces| {:.2e} N", force);
  if (balance.contact_force > 0.0)
    text += fmt::format(", {:.1e} of the contact force {:.3g} N", force / balance.contact_force, balance.contact_force);
  text += fmt::format("\n  moment balance     {:.2e} N m\n", balance.moment_error.norm());
  if (const double weight = balance.garment_weight.norm(); weight > 0.0)
    text += fmt::format("  weight of garment  {:.3g} N\n", weight);
  for (const auto& [name, reaction] : balance.reactions)
    text += fmt::format("  reaction           {}: {:.3g} {:.3g} {:.3g} N (x y z)\n", name, reaction.x(), reaction.y(),
                        reaction.z());
  for (const postproc::SurfaceContact& contact : run.surface_contacts)
    text += fmt::format("  {:<18} {:.4g} N between {} and {} over {:.4g} cm2, {:.4g} Pa in the mean, at most {:.4g} Pa{}\n", contact.name, contact.force, contact.slave,
                        contact.master, 1e4 * contact.area, contact.mean_pressure(), contact.largest_pressure,
                        contact.friction_force > 0.0 ? fmt::format("; friction {:.4g} N", contact.friction_force) : "");
  if (balance.friction_force > 0.0 && run.numbers.contains("max_shear_traction_Pa"))
    text += fmt::format("  friction           {:.3g} N (sum of the points' tangential forces), at most {:.3g} Pa, {:.0f} % of the contact slips\n",
                        balance.friction_force, run.numbers.at("max_shear_traction_Pa"),
                        100.0 * run.numbers.at("slipping_share_of_contact"));
  if (balance.contact_force > 0.0)
    text += fmt::format("  penetration        {:.1e} mm at most\n", run.max_penetration * 1e3);
  return text;
}

std::string tools_text(const postproc::RunResult& run) {
  std::string text;
  for (const postproc::ToolResult& tool : run.tools)
    text += fmt::format("  {:<18} {:.4g} N at {:.4g} mm: {:.4g} N/mm ({:.4g} at the end); {:.4g} cm2, {:.4g} Pa in the mean, at most {:.4g} Pa ({})\n", tool.name, tool.end().force,
                        1e3 * tool.end().depth, 1e-3 * tool.stiffness(), 1e-3 * tool.slope(), 1e4 * tool.end().area, tool.mean_pressure(), tool.end().largest_pressure, tool.shape);
  return text;
}

/// A line a posture; of one that was not reached the last state on the way to it.
std::string postures_text(const postproc::RunResult& run, const postproc::Evaluation& evaluation) {
  std::string text;
  for (std::size_t n = 0; n < run.movement.size(); ++n) {
    const postproc::MovementState& state = run.movement[n];
    if (!state.reached() && n + 1 < run.movement.size()) continue;
    text += fmt::format("  posture            {}", state.posture);
    if (!state.reached()) text += fmt::format(", {:.0f} % of the way", 100.0 * state.share);
    if (state.progress > 0.0) text += fmt::format(" ({})", postproc::bones_text(state));
    text += fmt::format(": {:.0f} Pa in the mean, at most {:.0f} Pa, over {:.4g} cm2", state.mean_pressure, state.max_pressure, 1e4 * state.contact_area);
    if (n < evaluation.movement.size() && evaluation.movement[n].comfort) text += fmt::format("; comfort {:.2f} {}", evaluation.movement[n].comfort->score, evaluation.movement[n].comfort->term);
    text += state.contact_force > 0.0 ? fmt::format("; |sum of forces| {:.1e} of the contact force\n", state.force_error / state.contact_force) : fmt::format("; |sum of forces| {:.1e} N\n", state.force_error);
  }
  return text;
}

std::string hems_text(const postproc::RunResult& run) {
  std::string text;
  for (const postproc::Hem& hem : run.hems)
    text += fmt::format("  hem                {} edge: {:.3g} N/m over {:.0f} mm, a line load; pressures of locations and the largest one leave out {:.1f} mm beside it\n",
                        hem.edge, hem.line_load, 1e3 * hem.length, 1e3 * hem.strip);
  return text;
}

std::string bands_text(const postproc::RunResult& run) {
  std::string text;
  for (const postproc::Band& band : run.bands)
    text += fmt::format("  band               {}, {} edge: {:.3g} N ({:.3g} to {:.3g}) at {:.4g} mm, {:.4g} mm at rest; it presses with {:.3g} N/m\n", band.garment, band.edge,
                        band.tension, band.least_tension, band.largest_tension, 1e3 * band.length, 1e3 * band.rest_length, band.line_load);
  return text;
}

std::string pieces_text(const postproc::RunResult& run) {
  std::string text;
  for (const postproc::PieceRow& piece : run.pieces)
    text += fmt::format("  piece              {}, {}: {}, {:.4g} cm2, {:.3g} g; {:.3g} N/m along the warp, {:.3g} along the weft (at most {:.3g}), stretched to {:.3f} and {:.3f}\n",
                        piece.garment, piece.piece, piece.fabric.empty() ? "the case's fabric" : piece.fabric, 1e4 * piece.area, 1e3 * piece.weight, piece.tension_warp,
                        piece.tension_weft, piece.largest_tension, piece.stretch_warp, piece.stretch_weft);
  for (const postproc::SeamRow& seam : run.seams)
    text += fmt::format("  seam               {}, {}: {:.3g} N/m across it in the mean, {:.3g} at most, {:.3g} along it; {:.4g} mm\n", seam.garment, seam.seam, seam.line_load,
                        seam.largest, seam.along, 1e3 * seam.length);
  for (const postproc::ProfileRow& row : run.profile)
    text += fmt::format("  profile            {}, {:.4g} mm up: {:.0f} Pa, {:.2f} mmHg, {:.1f} % of the {:.0f} Pa it is made for\n", row.garment, 1e3 * row.height, row.found,
                        to_mmHg(row.found), 100.0 * row.found / row.wanted, row.wanted);
  return text;
}

std::string sensors_text(const postproc::Evaluation& evaluation) {
  std::string text;
  for (const postproc::SensorRow& row : evaluation.sensors) {
    text += fmt::format("  sensor             {}: {:.0f} Pa, {:.2f} mmHg over {:.4g} mm at ({:.0f}, {:.0f}, {:.0f}) mm", row.name, row.reading(), to_mmHg(row.reading()), 1e3 * row.diameter,
                        1e3 * row.at.x(), 1e3 * row.at.y(), 1e3 * row.at.z());
    if (row.coverage < 0.995) text += fmt::format(", {:.0f} % of it covered", 100.0 * row.coverage);
    text += std::isfinite(row.bulge) ? fmt::format("; {:.0f} Pa of it by the bulge of its {:.3g} mm\n", row.bulge, 1e3 * row.thickness) : "\n";
  }
  return text;
}

std::string listed(const char* name, const std::vector<std::string>& texts) {
  std::string text;
  for (const std::string& one : texts) text += fmt::format("  {:<18} {}\n", text.empty() ? name : "", one);
  return text;
}

std::string warnings_text(const postproc::RunResult& run) {
  std::string text;
  for (const postproc::Warning& w : run.warnings)
    text += fmt::format("  warning            {}: {}{}; {}\n", w.name, w.text, w.place.empty() ? "" : " (" + w.place + ")", w.remedy);
  return text;
}

std::string sanity_text(const postproc::RunResult& run) {
  const double p = run.mean_laplace_pressure;
  if (!(p > 0.0)) return {};
  return fmt::format(
      "  L0 sanity value    {:.0f} Pa, {:.2f} gf/cm2, {:.2f} mmHg (tension x curvature on the undeformed skin, "
      "mean over the cover)\n",
      p, to_gf_cm2(p), to_mmHg(p));
}

std::string parts_text(const postproc::Phase& phase) {
  std::string text;
  for (const postproc::Phase& part : phase.parts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", part.name, duration_text(part.seconds));
  return text;
}

std::string linear_text(const postproc::RunResult& run) {
  const auto count = [&](const char* what) {
    const auto it = run.linear_solver.find(what);
    return it == run.linear_solver.end() ? 0L : it->second;
  };
  if (count("solutions") == 0) return {};
  std::string text = fmt::format("  linear systems     {} solved with {} factors, {} iterations of FGMRES",
                                 count("solutions"), count("factorisations"), count("krylov_iterations"));
  if (!run.factor.empty()) text += ", " + run.factor;
  if (count("ranks") > 1) text += fmt::format(", {} ranks", count("ranks"));
  return text + "\n";
}

std::string memory_of_ranks(const postproc::RunResult& run) {
  const auto ranks = run.linear_solver.find("ranks");
  if (ranks == run.linear_solver.end() || ranks->second < 2) return {};
  return fmt::format(" of {} ranks together, at most {} of one", ranks->second, memory_text(run.peak_memory_of_a_rank));
}

std::string donning_text(const postproc::RunResult& run) {
  if (run.donning.empty()) return {};
  std::string text = "  spread over the assumed way of putting on, on the rigid skin (mean and largest pressure):\n";
  for (const postproc::DonningRow& row : run.donning)
    text += fmt::format("    {:<46} {:>8.0f} Pa {:>8.0f} Pa{}\n", row.name, row.mean_pressure, row.max_pressure,
                        row.converged ? "" : "  not converged");
  return text;
}

std::string phases_text(const postproc::RunResult& run) {
  std::string text;
  double total = 0.0;
  for (const postproc::Phase& phase : run.phases) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", phase.name, duration_text(phase.seconds));
    total += phase.seconds;
  }
  text = fmt::format("  time               {} ({})\n", duration_text(total), text);
  for (const postproc::Phase& phase : run.phases)
    if (!phase.parts.empty()) text += fmt::format("    of {:<14} {}\n", phase.name, parts_text(phase));
  return text + linear_text(run);
}

/// What the state is, where it is not the answer: on what follows no class, rating, threshold or comfort is made.
std::string truth_text(const postproc::RunResult& run) {
  if (run.status == postproc::Status::converged || run.truth.stage.empty()) return {};
  return fmt::format("  state              {}\n                     its pressures are not the answer; no class, rating, threshold or comfort is made of them\n",
                     postproc::state_text(run));
}

}  // namespace

std::string locations_text(const postproc::Evaluation& evaluation) {
  std::string text;
  if (!evaluation.locations.empty())
    text += fmt::format("  {:<16} {:>7} {:>9} {:>9} {:>8} {:>9}  {}\n", "location", "cover", "mean [Pa]", "[gf/cm2]",
                        "[mmHg]", "max [Pa]", "rating 0-4");
  for (const postproc::LocationRow& row : evaluation.locations)
    text += fmt::format("  {:<16} {:>5.0f} % {:>9.0f} {:>9.2f} {:>8.2f} {:>9.0f}  {}\n", row.name, row.coverage * 100.0,
                        row.mean_pressure, to_gf_cm2(row.mean_pressure), to_mmHg(row.mean_pressure), row.max_pressure,
                        rating_text(row));
  if (std::any_of(evaluation.locations.begin(), evaluation.locations.end(), [](const auto& row) { return row.rating.has_value(); }))
    text += "  ratings            0 neutral, 1 comfortable, 2 uncomfortable, 3 very, 4 extremely uncomfortable\n";
  for (const postproc::ThresholdRow& row : evaluation.thresholds)
    text += fmt::format("  {:<16} {} ({})\n", row.location, row.verdict, row.set);
  for (const postproc::TargetRow& row : evaluation.targets)
    text += fmt::format("  {:<16} {:.0f} Pa, {:.2f} mmHg, {:.1f} % of the {:.0f} Pa that it is to have\n", row.place, row.found, to_mmHg(row.found), 100.0 * row.found / row.wanted, row.wanted);
  if (evaluation.comfort) text += comfort_text(*evaluation.comfort);
  if (!evaluation.no_score.empty()) text += fmt::format("  comfort            none: {}\n", evaluation.no_score);
  return text;
}

std::string final_text(const postproc::RunResult& run, const postproc::Evaluation& evaluation,
                       const std::filesystem::path& out) {
  std::string text = fmt::format("\n{}: {}, {} increments, {} Newton iterations\n", run.title, name_of(run.status),
                                 run.increments, run.iterations);
  text += truth_text(run) + listed("what to try", run.remedies) + warnings_text(run);
  text += locations_text(evaluation) + sensors_text(evaluation) + tools_text(run) + postures_text(run, evaluation) + hems_text(run) + bands_text(run) + pieces_text(run) + listed("assumed", run.assumptions) + balance_text(run) + sanity_text(run) + donning_text(run) + phases_text(run);
  if (run.peak_memory > 0.0) text += fmt::format("  memory             {}{}\n", memory_text(run.peak_memory), memory_of_ranks(run));
  return text + fmt::format("  files              {}\n", out.string());
}

}  // namespace snug::app
