#include "solver/app/study/study_row.hpp"

#include <algorithm>
#include <cmath>

namespace snug::app {

double observed_order(const std::vector<const StudyRow*>& rows, double StudyErrors::*error) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const StudyRow* row : rows) {
    const double e = std::abs(row->errors.*error), h = std::pow(row->skin_nodes, -0.5);
    if (!(e > 0.0) || !std::isfinite(h)) continue;
    const double a = std::log(h), b = std::log(e);
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  const double spread = n * xx - x * x;
  return n >= 2.0 && spread > 1e-12 ? (n * xy - x * y) / spread : not_known;
}

std::vector<const StudyRow*> rows_of(const std::vector<StudyRow>& rows, const std::string& series) {
  std::vector<const StudyRow*> found;
  for (const StudyRow& row : rows)
    if (row.series == series) found.push_back(&row);
  return found;
}

std::vector<std::string> series_of(const std::vector<StudyRow>& rows) {
  std::vector<std::string> names;
  for (const StudyRow& row : rows)
    if (std::find(names.begin(), names.end(), row.series) == names.end()) names.push_back(row.series);
  return names;
}

}  // namespace snug::app
