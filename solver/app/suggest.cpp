// snug materials suggest: fabrics and sizes for pressures that are wanted, guessed and then run.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "materials/database/named.hpp"
#include "postproc/evaluate.hpp"
#include "solver/app/learning_commands.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/library_command.hpp"
#include "solver/app/library_file.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/app/project_text.hpp"
#include "solver/app/study/child_process.hpp"
#include "solver/app/suggestion.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

using materials::Kind, materials::Library;

input::InputError wrong(const std::string& found, const std::string& remedy) { return {{"snug materials suggest", 0, 0}, found, remedy}; }

/// "Front thigh = 3 gf/cm2".
Target target_of(const std::string& text, materials::UnitBook& units) {
  const auto sign = text.find('=');
  std::string name = text.substr(0, sign), value = sign == text.npos ? "" : text.substr(sign + 1);
  name.erase(name.find_last_not_of(' ') + 1);
  const auto printed = materials::printed_quantity(value, units);
  const auto unit = printed ? units.find(printed->unit) : std::nullopt;
  const auto number = printed ? materials::plain_number(printed->number) : std::nullopt;
  if (name.empty() || !number || !unit || unit->name != units.find("Pa")->name || *number * unit->factor <= 0.0)
    throw wrong("\"" + text + "\" is no target", "write a location of the case and a pressure above 0: --target \"Front thigh = 3 gf/cm2\"");
  return {name, *number * unit->factor};
}

using Pressures = std::map<std::string, double>;  // Pa, by location

/// By the law of Laplace, on the undeformed skin.
Pressures laplace(const fs::path& directory, CaseOptions options, const std::vector<std::string>& overrides) {
  options.tier = "L0";
  options.overrides.insert(options.overrides.end(), overrides.begin(), overrides.end());
  const PreparedCase prepared = prepare(directory, options);
  const postproc::RunResult run = solver::solve(prepared);
  Pressures pressures;
  for (const postproc::LocationRow& row : postproc::evaluate(run, std::nullopt, prepared.description.directory).locations) pressures[row.name] = row.mean_pressure;
  return pressures;
}

/// What may be changed of a case: its only garment, or the one of that name.
struct Wearing {
  std::string fabric_key, size_key = {};
  double size = 1.0;       ///< what stands at size_key, in its unit
  std::string unit = {};   ///< " m", or empty
  std::string fabric;      ///< as the case names it
  const char* meaning = "";
  std::string pattern_file = {};  ///< of a pattern that the case names as a text, in whose place --set puts a table; else empty
};

/// Whether the case can be read with a value in place of another.
bool takes(const fs::path& directory, CaseOptions options, const std::string& set) {
  options.overrides.push_back(set);
  try {
    options.read(directory);
    return true;
  } catch (const input::InputError&) {
    return false;
  }
}

Wearing wearing_of(const fs::path& directory, const CaseOptions& options, const std::string& asked) {
  const input::Case description = options.read(directory);
  std::vector<std::string> names;
  for (const input::GarmentSpec& garment : description.garments) names.push_back(garment.name);
  const auto found = asked.empty() ? description.garments.begin() : std::find_if(description.garments.begin(), description.garments.end(), [&](const auto& one) { return one.name == asked; });
  if (description.garments.empty()) throw wrong("the case has no garment", "name a case with one");
  if (found == description.garments.end() || (asked.empty() && names.size() > 1))
    throw wrong(asked.empty() ? "the case has several garments" : "the case has no garment \"" + asked + "\"", "--garment names one of " + input::joined(names));
  const std::string prefix = "garment." + (names.size() > 1 ? found->name + "." : std::string());
  const input::PatternSpec& pattern = found->pattern;
  Wearing wearing{.fabric_key = prefix + "fabric", .fabric = found->fabric.name};
  if (pattern.kind == input::PatternKind::tube) return wearing.size_key = prefix + "pattern.flat_circumference", wearing.size = pattern.flat_circumference, wearing.unit = " m", wearing.meaning = "circumference as cut", wearing;
  if (pattern.kind == input::PatternKind::sewn) {
    wearing.size_key = prefix + "pattern.girth_scale", wearing.size = pattern.girth_scale, wearing.meaning = "widths of the pattern";
    if (takes(directory, options, wearing.size_key + "=1")) return wearing;
    wearing.size_key = prefix + "pattern";
    wearing.pattern_file = pattern.file.lexically_normal().lexically_relative(description.directory.lexically_normal()).generic_string();
    return wearing;
  }
  throw wrong("the circumferences of a graduated tube follow from the pressures that it is made for", "snug design finds them");
}

/// The fabrics that may be worn: with a law.
std::vector<std::string> candidates(const Library& library, const std::string& question) {
  std::vector<std::string> fabrics;
  for (const std::string& id : question.empty() ? library.ids(Kind::fabric) : library.find_where(question, Kind::fabric))
    if (library.entity(id).find("law")) fabrics.push_back(id);
  if (fabrics.empty()) throw wrong("no fabric of the library that a case can wear fits the question", "ask for others: snug materials find");
  return fabrics;
}

class Suggest : public LibraryCommand {
 public:
  Suggest() : LibraryCommand("suggest", "fabrics and sizes for pressures that are wanted; the best are run, and the error of the guess is told") {}
  void declare(CLI::App& app) override {
    app.add_option("--for", directory_, "the case: body, garment and locations")->type_name("CASE")->required();
    app.add_option("--target", targets_, "\"LOCATION = PRESSURE\", e.g. \"Front thigh = 3 gf/cm2\"; may be repeated")->required()->allow_extra_args(false);
    app.add_option("--among", question_, "only fabrics that a question describes (snug materials find)")->type_name("QUESTION");
    app.add_option("--garment", garment_, "the garment that may change, where the case has several")->type_name("NAME");
    app.add_option("--sizes", sizes_, "from and to: factors on the size that the case has")->expected(2)->check(CLI::Range(0.3, 3.0))->capture_default_str();
    app.add_option("--verify", verified_, "how many of the best are run")->check(CLI::Range(0, 20))->capture_default_str();
    app.add_option("--out", out_, "folder for the results of the runs (suggested in the case directory)")->type_name("DIR");
    app.add_option("--unit", unit_, "of pressures")->capture_default_str();
    options_.declare(app);
    app.footer("The guess is tension over radius (tier L0), corrected by the pressures of the case as it is, which is run first. The runs are recorded\n"
               "as those of snug run are. A size is a factor on the circumference of a tube, or on the widths of a pattern.");
  }

 private:
  int act(Library& library) override {
    for (const std::string& text : targets_) wanted_.push_back(target_of(text, library.units()));
    if (sizes_[0] >= sizes_[1]) throw wrong("sizes from " + fmt::format("{} to {}", sizes_[0], sizes_[1]), "give the smaller one first");
    const PressureUnit unit(unit_);
    const fs::path out = out_.empty() ? fs::path(directory_) / "suggested" : fs::path(out_);
    wearing_ = wearing_of(directory_, options_, garment_);
    const std::vector<std::string> fabrics = candidates(library, question_);
    const Pressures as_it_is = laplace(directory_, options_, {});
    check_locations(as_it_is);
    const auto base = run(out / "as-it-is", {}, "as it is");
    if (!base) return not_converged;
    std::map<std::string, double> correction;
    for (const Target& target : wanted_) {
      if (!(as_it_is.at(target.location) > 0.0 && base->at(target.location) > 0.0))
        throw wrong("nothing presses on \"" + target.location + "\" in the case as it is", "begin with a garment that is narrower there than the body");
      correction[target.location] = base->at(target.location) / as_it_is.at(target.location);
    }
    std::vector<Proposal> proposals;
    for (const std::string& fabric : fabrics)
      if (auto proposal = proposed(fabric, correction)) proposals.push_back(std::move(*proposal));
    rank(proposals);
    print_guesses(proposals, unit);
    return verify(proposals, out, unit);
  }

  void check_locations(const Pressures& pressures) const {
    std::vector<std::string> known;
    for (const auto& [name, pressure] : pressures) known.push_back(name);
    for (const Target& target : wanted_)
      if (!pressures.contains(target.location)) throw wrong("the case has no location \"" + target.location + "\"", input::did_you_mean(target.location, known));
  }

  std::vector<std::string> overrides(const std::string& fabric, double factor) const {
    const std::string size = fmt::format("{:.6g}", factor * wearing_.size);
    const std::string value = !wearing_.pattern_file.empty() ? "{ file = \"" + wearing_.pattern_file + "\", girth_scale = " + size + " }"
                              : wearing_.unit.empty()        ? size
                                                             : "\"" + size + wearing_.unit + "\"";
    return {wearing_.fabric_key + "=\"" + fabric + "\"", wearing_.size_key + "=" + value};
  }

  /// The size of a fabric that comes nearest to the targets; none where the fabric cannot be worn in this case.
  std::optional<Proposal> proposed(const std::string& fabric, const std::map<std::string, double>& correction) const {
    try {
      return best_size(fabric, wanted_, sizes_[0], sizes_[1], [&](double factor) {
        Pressures pressures = laplace(directory_, options_, overrides(fabric, factor));
        for (auto& [name, pressure] : pressures)
          if (const auto corrected = correction.find(name); corrected != correction.end()) pressure *= corrected->second;
        return pressures;
      });
    } catch (const input::InputError& error) {
      console().warn(fmt::format("warning: {} is left out: {}", fabric, error.errors().front().found));
      return std::nullopt;
    }
  }

  std::string size_text(double factor) const {
    return wearing_.unit.empty() ? fmt::format("{:.3f}", factor * wearing_.size) : fmt::format("{:.1f} mm", 1e3 * factor * wearing_.size);
  }

  void print_guesses(const std::vector<Proposal>& proposals, const PressureUnit& unit) const {
    std::vector<std::vector<std::string>> rows{{"fabric", wearing_.meaning, "factor"}};
    for (const Target& target : wanted_) rows[0].push_back(target.location + " [" + unit.name + "]");
    rows[0].insert(rows[0].end(), {"off", "per % of size"});
    for (const Proposal& one : proposals) {
      rows.push_back({one.fabric, size_text(one.size), fmt::format("{:.3f}", one.size)});
      for (const Target& target : wanted_) rows.back().push_back(fmt::format("{:.3g}", one.pressures.at(target.location) / unit.factor));
      rows.back().insert(rows.back().end(), {fmt::format("{:.1f} %", 100.0 * one.off), fmt::format("{:+.1f} %", one.per_percent)});
    }
    Json& list = console().document()["guesses"] = Json::array();
    for (const Proposal& one : proposals) {
      Json pressures = Json::object();
      for (const Target& target : wanted_) pressures[target.location] = one.pressures.at(target.location);
      list.push_back({{"fabric", one.fabric}, {"factor_on_size", one.size}, {"size", one.size * wearing_.size}, {"size_means", wearing_.meaning}, {"pressures_Pa", pressures}, {"off", one.off}});
    }
    console().print("guess: tension over radius, corrected by the case as it is ({})\n{}", wearing_.fabric, aligned(rows));
  }

  int verify(const std::vector<Proposal>& proposals, const fs::path& out, const PressureUnit& unit) const {
    std::vector<std::vector<std::string>> rows{{"run", wearing_.meaning, "location", "wanted", "guess", "found [" + unit.name + "]", "error of the guess", "off the target"}};
    int status = done;
    double squares = 0.0, count = 0.0;
    for (std::size_t n = 0; n < proposals.size() && n < static_cast<std::size_t>(verified_); ++n) {
      const Proposal& one = proposals[n];
      const auto found = run(out / file_name(one.fabric), overrides(one.fabric, one.size), fmt::format("suggested: {}, {}", one.fabric, size_text(one.size)));
      if (!found) status = not_converged;
      for (const Target& target : wanted_) {
        Json& verified = console().document()["verified"];
        verified.push_back({{"fabric", one.fabric}, {"factor_on_size", one.size}, {"place", target.location}, {"wanted_Pa", target.pressure}, {"guess_Pa", one.pressures.at(target.location)},
                            {"found_Pa", found ? Json(found->at(target.location)) : Json()}});
        const double guess = one.pressures.at(target.location), there = found ? found->at(target.location) : std::nan("");
        rows.push_back({one.fabric, size_text(one.size), target.location, fmt::format("{:.3g}", target.pressure / unit.factor), fmt::format("{:.3g}", guess / unit.factor)});
        rows.back().push_back(found ? fmt::format("{:.3g}", there / unit.factor) : "did not converge");
        if (!found) continue;
        for (const double off : {guess / there, there / target.pressure}) rows.back().push_back(fmt::format("{:+.1f} %", 100.0 * (off - 1.0)));
        squares += std::pow(guess / there - 1.0, 2), count += 1.0;
      }
    }
    if (rows.size() > 1) console().print("verified by running\n{}", aligned(rows));
    if (count > 0.0) console().print("error of the guess: {:.1f} % rms over {:.0f} pressures\n", 100.0 * std::sqrt(squares / count), count);
    return status;
  }

  /// A name for a folder that says which fabric it is.
  static std::string file_name(std::string text) {
    for (char& c : text)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && static_cast<unsigned char>(c) < 0x80) c = '_';
    return text;
  }

  /// The case as `snug run` solves it, a process of its own; nothing where it does not converge.
  std::optional<Pressures> run(const fs::path& out, const std::vector<std::string>& overrides, const std::string& note) const {
    std::vector<std::string> words = {fs::read_symlink("/proc/self/exe").string(), "run", fs::absolute(directory_).string(), "--quiet", "--no-report", "--out", fs::absolute(out).string(), "--note", note};
    CaseOptions options = options_;
    options.overrides.insert(options.overrides.end(), overrides.begin(), overrides.end());
    for (const std::string& word : options.words()) words.push_back(word);
    fs::create_directories(out.parent_path());
    const ChildOutcome child = run_child(words, fs::current_path());
    if (child.status == input_wrong) throw wrong("a run of the case is refused: " + child.output, "snug check tells what a case needs");
    if (child.status != done && child.status != outside_tolerance) {
      console().error(child.output);
      return std::nullopt;
    }
    std::ifstream file(out / "summary.json");
    Pressures pressures;
    const nlohmann::json summary = nlohmann::json::parse(file);
    for (const auto& row : summary.at("locations")) pressures[row.at("location")] = row.at("mean_pressure_Pa").get<double>();
    return pressures;
  }

  std::string directory_, question_, garment_, out_, unit_ = "gf/cm2";
  std::vector<std::string> targets_;
  std::vector<double> sizes_ = {0.8, 1.1};
  int verified_ = 3;
  CaseOptions options_;
  std::vector<Target> wanted_;
  Wearing wearing_;
};

}  // namespace

std::unique_ptr<Command> make_suggest() { return std::make_unique<Suggest>(); }

}  // namespace snug::app
