#include "solver/app/study/study_files.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "cases/input/csv.hpp"
#include "cases/input/files.hpp"
#include "postproc/tables.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// The numbers of a row by the name of their column; one list writes and reads.
template <class Row, class Visit>
void visit_numbers(Row& row, Visit visit) {
  visit("unknowns", row.unknowns, 1.0);
  visit("skin_nodes", row.skin_nodes, 1.0);
  visit("increments", row.increments, 1.0);
  visit("iterations", row.iterations, 1.0);
  visit("wall_s", row.wall, 1.0);
  visit("user_s", row.user, 1.0);
  visit("system_s", row.system, 1.0);
  visit("memory_MB", row.memory, 1e6);
  visit("mean_pressure_Pa", row.mean_pressure, 1.0);
  visit("mean_displacement_m", row.mean_displacement, 1.0);
  visit("mean_pressure_error", row.errors.mean_pressure, 1.0);
  visit("pressure_rms_error", row.errors.pressure_rms, 1.0);
  visit("pressure_max_error", row.errors.pressure_max, 1.0);
  visit("mean_displacement_error", row.errors.mean_displacement, 1.0);
  visit("displacement_rms_error", row.errors.displacement_rms, 1.0);
}

std::vector<std::string> phase_names(const std::vector<StudyRow>& rows) {
  std::vector<std::string> names;
  for (const StudyRow& row : rows)
    for (const auto& phase : row.phases)
      if (std::find(names.begin(), names.end(), phase.name) == names.end()) names.push_back(phase.name);
  return names;
}

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{:.8g}", value); }

double seconds_of(const StudyRow& row, const std::string& phase) {
  for (const auto& p : row.phases)
    if (p.name == phase) return p.seconds;
  return not_known;
}

/// A name as it stands in study.csv and in the plot: gnuplot reads neither commas nor quotes inside quotes.
std::string plain(std::string name) {
  std::replace(name.begin(), name.end(), ',', ';');
  for (char& c : name)
    if (c == '"' || static_cast<unsigned char>(c) < ' ') c = ' ';
  return postproc::csv_cell(name);
}

/// A text that gnuplot takes as it is: inside single quotes it runs no backticks and knows no escapes; a quote is doubled. A
/// line end would end the text, and a control character has no business in a name.
std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? ' ' : c;
    if (c == '\'') quoted += c;
  }
  return quoted + '\'';
}

}  // namespace

void write_study_csv(const std::vector<StudyRow>& rows, const fs::path& file) {
  std::ostringstream out;
  const std::vector<std::string> phases = phase_names(rows);
  out << "series,level,status";
  visit_numbers(rows.front(), [&](const char* name, double, double) { out << ',' << name; });
  for (const std::string& name : phases) out << ',' << postproc::csv_cell(name + "_s");
  out << ",settings\n";
  for (const StudyRow& row : rows) {
    out << plain(row.series) << ',' << postproc::csv_cell(row.level) << ',' << row.status;
    visit_numbers(row, [&](const char*, double value, double unit) { out << ',' << cell(value / unit); });
    for (const std::string& name : phases) out << ',' << cell(seconds_of(row, name));
    out << ',' << postproc::csv_cell(row.settings) << '\n';
  }
  input::write_file(file, out.view());
}

std::vector<StudyRow> read_study_csv(const fs::path& file) {
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  const auto series = input::texts(csv, "series", diagnostics), level = input::texts(csv, "level", diagnostics);
  diagnostics.throw_if_any();
  std::vector<StudyRow> rows(csv.rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    rows[n].series = series[n], rows[n].level = level[n], rows[n].status = "measured elsewhere";
    visit_numbers(rows[n], [&](const std::string& name, double& value, double unit) {
      const int column = csv.find(name);
      const std::string text = column < 0 ? "" : csv.rows[n].cells[static_cast<std::size_t>(column)];
      if (text.empty()) return;
      char* end = nullptr;
      value = unit * std::strtod(text.c_str(), &end);
      if (*end != '\0')
        diagnostics.error(csv.place(n, static_cast<std::size_t>(column)), "\"" + text + "\" is no number",
                          "write a number, or leave the cell empty");
    });
  }
  diagnostics.throw_if_any();
  return rows;
}

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "an unknown processor";
}

std::string load_average() {
  double load[1] = {0.0};
  return getloadavg(load, 1) == 1 ? fmt::format("{:.2f}", load[0]) : "unknown";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 16> text;
  std::strftime(text.data(), text.size(), "%F", std::localtime(&now));
  return text.data();
}

std::string count(double value) { return std::isnan(value) ? "–" : fmt::format("{:.0f}", value); }
std::string seconds(double value) { return std::isnan(value) ? "–" : fmt::format("{:.2f}", value); }
std::string error(double value) { return std::isnan(value) ? "–" : fmt::format("{:.1e}", value); }
std::string order(double value) { return std::isnan(value) ? "–" : fmt::format("{:.1f}", value); }

using Error = double StudyErrors::*;
const std::array<Error, 4> columns = {&StudyErrors::mean_pressure, &StudyErrors::pressure_rms,
                                      &StudyErrors::mean_displacement, &StudyErrors::displacement_rms};

/// Wall time that no phase of the run accounts for: start of the program, writing of results, its end.
double rest(const StudyRow& row) {
  double sum = 0.0;
  for (const auto& phase : row.phases) sum += phase.seconds;
  return row.phases.empty() ? not_known : row.wall - sum;
}

void write_runs(const std::vector<StudyRow>& rows, std::ostream& out) {
  out << "| series | level | unknowns | Newton iterations | wall s | CPU s | memory MB | mean pressure | pressure rms "
         "| "
         "mean displacement | displacement rms |\n| --- | --- |"
      << " ---: |"
      << " ---: | ---: | ---: | ---: | ---: | ---: | "
         "---: | ---: |\n";
  for (const StudyRow& row : rows) {
    const std::string broken = row.status == "partial" || row.status == "failed" ? " (" + row.status + ")" : "";
    fmt::print(out, "| {} | {}{} | {} | {} | {} | {} | {} |", row.series, row.level, broken, count(row.unknowns),
               count(row.iterations), seconds(row.wall), seconds(row.user + row.system), count(1e-6 * row.memory));
    for (const Error e : columns) fmt::print(out, " {} |", error(row.errors.*e));
    out << '\n';
  }
}

void write_orders(const std::vector<StudyRow>& rows, std::ostream& out) {
  out << "| series | levels | mean pressure | pressure rms | mean displacement | displacement rms |\n"
         "| --- | --- | ---: | ---: | ---: | ---: |\n";
  const auto line = [&](const std::string& series, const std::string& levels, const std::vector<const StudyRow*>& of) {
    fmt::print(out, "| {} | {} |", series, levels);
    for (const Error e : columns) fmt::print(out, " {} |", order(observed_order(of, e)));
    out << '\n';
  };
  for (const std::string& name : series_of(rows)) {
    const std::vector<const StudyRow*> all = rows_of(rows, name);
    if (all.size() < 2 || std::isnan(all.front()->skin_nodes)) continue;
    for (std::size_t n = 1; n < all.size(); ++n)
      line(name, all[n - 1]->level + " to " + all[n]->level, {all[n - 1], all[n]});
    if (all.size() > 2) line(name, "all, least squares", all);
  }
}

void write_phases(const std::vector<StudyRow>& rows, std::ostream& out) {
  const std::vector<std::string> phases = phase_names(rows);
  out << "| series | level |";
  for (const std::string& name : phases) out << ' ' << name << " |";
  out << " start, files, end |\n| --- | --- |";
  for (std::size_t n = 0; n <= phases.size(); ++n) out << " ---: |";
  out << '\n';
  for (const StudyRow& row : rows) {
    if (row.phases.empty()) continue;
    fmt::print(out, "| {} | {} |", row.series, row.level);
    for (const std::string& name : phases) fmt::print(out, " {} |", seconds(seconds_of(row, name)));
    fmt::print(out, " {} |\n", seconds(rest(row)));
  }
}

}  // namespace

void write_study_table(const std::vector<StudyRow>& rows, const StudyHead& head, const fs::path& file) {
  std::ostringstream out;
  fmt::print(out,
             "# Error against run time: {}\n\nWritten by `{}` on {}, on {}, {} cores, load average {} at the end.\n",
             head.title, head.command, date(), processor(), std::thread::hardware_concurrency(), load_average());
  fmt::print(
      out,
      "Each run is a process of its own, from its start to its end with all files written.\n\n"
      "Errors are relative to {}. *mean pressure*: contact force over covered area; *rms*: over the skin's nodes "
      "in the zone.\n\n![Error against time, memory and unknowns](study.svg)\n\n## Runs\n\n",
      head.against);
  write_runs(rows, out);
  for (const std::string& note : head.notes) out << "\n- " << note << '\n';
  out << "\n## Observed orders\n\nSlope of log error over log h; h is the number of skin nodes to the power -1/2.\n\n";
  write_orders(rows, out);
  out << "\n## Wall time by phase, s\n\n";
  write_phases(rows, out);
  input::write_file(file, out.view());
}

void write_study_plot(const std::vector<StudyRow>& rows, const std::string& title, const fs::path& file) {
  std::ostringstream out;
  out << "# Draws study.svg from study.csv: gnuplot study.gp\n"
         "set terminal svg size 1260,760 font 'sans,13' background 'white'\n"
         "set output 'study.svg'\n"
         "set datafile separator ','\n"
         "set datafile columnheaders\n"
         "set datafile missing NaN\n"
         "set logscale xy\nset format x '10^{%L}'\nset format y '10^{%L}'\nset grid\n";
  const std::vector<std::string> series = series_of(rows);
  fmt::print(out, "array series[{}]\n", series.size());
  for (std::size_t n = 0; n < series.size(); ++n) fmt::print(out, "series[{}] = {}\n", n + 1, gnuplot_text(plain(series[n])));
  const auto known = [&](Error e) {
    return std::any_of(rows.begin(), rows.end(), [&](const StudyRow& row) { return std::abs(row.errors.*e) > 0.0; });
  };
  std::string drawn;  // against a number there is no error of the map
  if (known(&StudyErrors::pressure_rms)) drawn += "pressure_rms_error ";
  if (known(&StudyErrors::mean_pressure)) drawn += "mean_pressure_error";
  fmt::print(out, "drawn = '{}'\nset multiplot layout words(drawn),3 title {} noenhanced\n", drawn, gnuplot_text(title));
  out << "set key noenhanced top right font ',10'\n"
         "positive(x) = abs(x) > 0 ? abs(x) : NaN\n"
         "do for [error in drawn] {\n"
         "  set ylabel error[1:strlen(error)-6] . ' error' noenhanced\n"
         "  do for [cost in 'wall_s memory_MB unknowns'] {\n"
         "    set xlabel cost noenhanced\n"
         "    plot for [n=1:|series|] 'study.csv' using (strcol(1) eq series[n] ? column(cost) : NaN):"
         "(positive(column(error))) with linespoints linewidth 2 pointtype 6+n title series[n]\n"
         "    unset key\n"
         "  }\n"
         "}\n"
         "unset multiplot\n";
  input::write_file(file, out.view());
}

}  // namespace snug::app
