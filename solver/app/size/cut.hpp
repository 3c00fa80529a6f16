// What of a garment is looked for, and the loop that looks: solve, compare with what is wanted, correct.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/app/console.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/solver_session.hpp"
#include "solver/library/size_search.hpp"

namespace snug::app {

/// One value of case.toml: its dotted path and what stands there, as TOML.
struct Setting {
  std::string path, literal;
};

/// "[{ height = \"0 mm\", girth = \"180.2 mm\" }, …]", to a tenth of a millimetre.
std::string toml_of(const std::vector<input::GirthRow>& rows, const char* between);

/// "garment.", or of one of several garments "garment.NAME.".
std::string garment_path(const input::Case& description, int garment);

/// What is looked for.
class Cut {
 public:
  virtual ~Cut() = default;
  /// What is set for the next solution.
  virtual std::vector<Setting> next() = 0;
  /// What a case prepared with it is cut to, and a few words of it.
  virtual std::vector<Setting> settings(const PreparedCase& prepared) const = 0;
  virtual std::string text(const PreparedCase& prepared) const = 0;
  /// Wanted and found, the place in words.
  virtual std::vector<postproc::TargetRow> compare(const PreparedCase& prepared, const postproc::RunResult& run) const = 0;
  /// Takes a solution in; true where another one would not come nearer by more than `within` (a share of the pressures).
  virtual bool learn(const PreparedCase& prepared, const postproc::RunResult& run, const std::vector<postproc::TargetRow>& rows, double within) = 0;
};

/// One factor on all girths of a garment, for the [target] of the case.
class ScaledCut : public Cut {
 public:
  /// `prepared`: the case as it stands. Throws input::InputError where it has no [target] or no limb.
  ScaledCut(const PreparedCase& prepared, int garment);

  std::vector<Setting> next() override;
  std::vector<Setting> settings(const PreparedCase& prepared) const override;
  std::string text(const PreparedCase& prepared) const override;
  std::vector<postproc::TargetRow> compare(const PreparedCase& prepared, const postproc::RunResult& run) const override;
  bool learn(const PreparedCase& prepared, const postproc::RunResult& run, const std::vector<postproc::TargetRow>& rows, double within) override;

  const solver::LaplaceTable& table() const { return table_; }
  double size() const { return size_; }  ///< of the next solution
  bool within_reach() const { return search_.within_reach(size_); }
  double predicted(std::size_t place) const { return search_.predicted(place, size_); }

 private:
  void choose();
  std::vector<Setting> settings_of(double size) const;

  std::string path_;
  input::PatternSpec base_;
  solver::LaplaceTable table_;
  solver::SizeSearch search_;
  std::size_t wanted_;
  double size_ = 1.0;
};

/// The circumferences of a graduated tube, course by course, for the pressures that it is made for.
class CourseCut : public Cut {
 public:
  std::vector<Setting> next() override { return next_; }
  std::vector<Setting> settings(const PreparedCase& prepared) const override;
  std::string text(const PreparedCase& prepared) const override;
  std::vector<postproc::TargetRow> compare(const PreparedCase& prepared, const postproc::RunResult& run) const override;
  bool learn(const PreparedCase& prepared, const postproc::RunResult& run, const std::vector<postproc::TargetRow>& rows, double within) override;

 private:
  std::vector<Setting> next_;
};

/// The only garment that is made for pressures. Throws input::InputError where there is none, or several.
int designed_garment(const input::Case& description);

/// What the search came to.
struct FoundCut {
  std::vector<Setting> settings;
  std::vector<postproc::TargetRow> rows;
  double error = 0.0;     ///< largest of |found / wanted - 1|
  bool settled = false;   ///< another solution would not come nearer
  int status = 0;         ///< exit status of a solution that failed, else done
  std::shared_ptr<PreparedCase> prepared;  ///< of the best solution
  std::vector<postproc::Warning> warnings;  ///< of that solution
};

/// Solves with one cut after the other, `rounds` times at most, and prints each; the best one is what is found.
FoundCut search_cut(const std::string& directory, const CaseOptions& options, Cut& cut, int rounds, double within, const Cleaner& cleaner, Console& console);

}  // namespace snug::app
