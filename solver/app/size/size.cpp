// snug size CASE: the cut that gives a pressure, as a case to run, and what it means for a population.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cases/input/files.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/text.hpp"
#include "cases/input/toml_edit.hpp"
#include "cases/input/units.hpp"
#include "postproc/units.hpp"
#include "solver/app/case_copy.hpp"
#include "solver/app/cleaner.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/size/cut.hpp"
#include "solver/app/size/population_table.hpp"

namespace snug::app {

namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
  return result + "\"";
}

/// "Ankle = 20 mmHg" as an entry of target.pressures. Throws input::InputError.
std::string wanted_entry(const std::string& text, const std::vector<std::string>& locations) {
  const auto wrong = [&](const std::string& found, const std::string& remedy) { return input::InputError({"--target " + quoted(text), 0, 0}, found, remedy); };
  const std::size_t equals = text.rfind('=');
  if (equals == text.npos) throw wrong("there is no PLACE = PRESSURE", "write for example --target \"Ankle = 20 mmHg\"");
  const std::string place = input::trimmed_copy(text.substr(0, equals)), pressure = input::trimmed_copy(text.substr(equals + 1));
  const input::Quantity value = input::to_si(pressure, "Pa");
  if (!value.ok() || !(value.value > 0.0))
    throw wrong(value.ok() ? "the pressure is not above 0" : fmt::format("\"{}\" is no pressure: {}", pressure, value.found), "write for example \"20 mmHg\", \"2.7 kPa\" or \"27 gf/cm2\"");
  if (input::to_si(place, "m").ok()) return fmt::format("{{ height = {}, pressure = {} }}", quoted(place), quoted(pressure));
  if (std::find(locations.begin(), locations.end(), place) == locations.end())
    throw wrong(fmt::format("\"{}\" is no location of the case", place),
                locations.empty() ? "add [[body.locations]] with that name, or write a height: \"50 mm = 20 mmHg\"" : input::did_you_mean(place, locations) + "; or write a height: \"50 mm = 20 mmHg\"");
  return fmt::format("{{ location = {}, pressure = {} }}", quoted(place), quoted(pressure));
}

std::string wanted_table(const std::vector<std::string>& targets, const input::Case& description) {
  std::vector<std::string> locations, entries;
  if (description.body)
    for (const input::LocationSpec& location : description.body->locations) locations.push_back(location.name);
  for (const std::string& target : targets) entries.push_back(wanted_entry(target, locations));
  return fmt::format("[{}]", fmt::join(entries, ", "));
}

/// A name that is free: NAME-sized, NAME-sized-2, …
fs::path free_name(const fs::path& directory) {
  const fs::path whole = fs::absolute(directory).lexically_normal();
  const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string() + "-sized";
  fs::path free = name;
  for (int n = 2; fs::exists(free); ++n) free = fmt::format("{}-{}", name, n);
  return free;
}

class Size : public Command {
 public:
  std::string name() const override { return "size"; }
  std::string summary() const override { return "the cut that gives a pressure, verified, as a case to run; sizes for a population"; }

  void declare(CLI::App& app) override {
    app.add_option("CASE", directory_, "case directory")->required();
    options_.declare(app);
    app.add_option("--target", targets_, "what is wanted: \"Ankle = 20 mmHg\", or at a height \"50 mm = 2.7 kPa\"; several are met in least squares (left out: [target] of the case)")
        ->type_name("PLACE=PRESSURE")
        ->allow_extra_args(false);
    app.add_option("--vary", vary_, "size or circumference: one factor on all girths of the garment; circumferences: of a graduated tube course by course, for its own pressures")
        ->check(CLI::IsMember({"size", "garment.size", "circumference", "circumferences"}))
        ->capture_default_str();
    app.add_option("--garment", garment_, "which of several garments");
    app.add_option("--solves", solves_, "solutions at the tier of the case, at most")->check(CLI::Range(1, 20))->capture_default_str();
    app.add_option("--within", within_, "percent of the wanted pressure that is near enough")->check(CLI::Range(0.01, 50.0))->capture_default_str();
    app.add_option("--out", out_, "the case to write (CASE-sized); nothing is overwritten")->type_name("DIR");
    app.add_option("--girths", question_.girths, "a population: CSV with a column of girths for each place, called like it, a row a wearer")->type_name("FILE.csv");
    app.add_option("--population", question_.distribution, "a population: mean girth at the first place and its standard deviation, \"220 mm +- 15 mm\"")->type_name("GIRTH");
    app.add_option("--class", question_.classes, "the set of compression classes that counts (snug list curves); left out: the thresholds of the case")->type_name("SET");
    app.add_option("--sizes", question_.sizes, "how many sizes to cut for the population")->check(CLI::Range(1, 40))->capture_default_str();
    app.add_option("--inside", inside_, "percent off the wanted pressure that counts as right, where no class holds it")->check(CLI::Range(0.1, 90.0))->capture_default_str();
    app.footer("Looks by the law of Laplace (L0) first, then solves at the tier of the case and corrects. Exit status 1 where what is wanted is not met:\n"
               "the cut that comes nearest is written all the same.");
  }

  int execute() override {
    const input::Case description = options_.read(directory_);
    if (!out_.empty() && fs::exists(out_)) throw input::InputError({out_, 0, 0}, "this is there already", "choose another name; nothing is overwritten");
    if (!question_.girths.empty() && !question_.distribution.empty())
      throw input::InputError({"--population", 0, 0}, "two populations are given", "give --girths or --population");
    if (!question_.asked() && !question_.classes.empty())
      throw input::InputError({"--class", 0, 0}, "a class counts for a population, and none is given", "add --girths FILE.csv or --population \"220 mm +- 15 mm\"");
    question_.inside = 0.01 * inside_;
    const int garment = garment_of(description);
    return vary_ == "circumferences" ? by_course(description) : by_size(description, garment);
  }

 private:
  int garment_of(const input::Case& description) const {
    const std::string file = (description.directory / "case.toml").string();
    std::vector<std::string> names;
    for (const input::GarmentSpec& garment : description.garments) names.push_back(garment.name);
    if (names.empty()) throw input::InputError({file, 0, 0}, "there is no [garment] to cut", "add one");
    if (garment_.empty() && names.size() == 1) return 0;
    const auto found = std::find(names.begin(), names.end(), garment_);
    if (found == names.end())
      throw input::InputError({"--garment", 0, 0}, garment_.empty() ? "which of the garments is to be cut is not said" : fmt::format("there is no garment \"{}\"", garment_),
                              fmt::format("name one of: {}", fmt::join(names, ", ")));
    return static_cast<int>(found - names.begin());
  }

  int by_course(const input::Case& description) {
    if (!targets_.empty() || question_.asked())
      throw input::InputError({"--vary circumferences", 0, 0}, "the courses are knitted for the pressures of the pattern, and not for --target or a population",
                              "leave those out, or take --vary size");
    designed_garment(description);
    const Cleaner cleaner;
    CourseCut cut;
    const FoundCut found = search_cut(directory_, options_, cut, solves_, 0.01 * within_, cleaner, console());
    return found.settings.empty() ? found.status : finish(found, "");
  }

  int by_size(const input::Case& description, int garment) {
    CaseOptions options = options_;
    if (!targets_.empty()) options.overrides.push_back("target={ pressures = " + wanted_table(targets_, description) + " }");
    const PreparedCase prepared = prepare(directory_, options);
    for (const input::Diagnostic& warning : prepared.warnings) console().warn(warning);
    const Cleaner cleaner;
    ScaledCut cut(prepared, garment);
    check_population(question_, prepared, garment);
    console().print("{}\nlaw of Laplace, L0: {}\n", prepared.description.title, cut.text(prepared));
    for (std::size_t i = 0; i < cut.table().places(); ++i) {
      console().print("  {:<24} {:>8.0f} Pa {:>7.2f} mmHg\n", place(prepared, i), cut.predicted(i), postproc::to_mmHg(cut.predicted(i)));
      console().document()["law_of_Laplace"].push_back({{"place", place(prepared, i)}, {"pressure_Pa", cut.predicted(i)}});
    }
    if (!cut.within_reach()) return out_of_reach(prepared, cut);
    const FoundCut found = search_cut(directory_, options, cut, solves_, 0.01 * within_, cleaner, console());
    if (found.settings.empty()) return found.status;
    const PopulationAnswer population = question_.asked() ? population_answer(question_, found, garment) : PopulationAnswer{};
    console().print("\n{}{}", ease_text(found, garment), population.text);
    add_ease(found, garment);
    if (question_.asked()) console().document()["population"] = population.document;
    return finish(found, population.csv);
  }

  static std::string place(const PreparedCase& prepared, std::size_t i) {
    const input::WantedPressure& wanted = prepared.jobs.target->pressures[i];
    return wanted.location.empty() ? fmt::format("{:.4g} mm", 1e3 * *wanted.height) : wanted.location;
  }

  int out_of_reach(const PreparedCase& prepared, const ScaledCut& cut) const {
    std::string ends;
    for (std::size_t i = 0; i < cut.table().places(); ++i)
      ends += fmt::format("{}{} from {:.0f} to {:.0f} Pa", i ? ", " : "", place(prepared, i), cut.table().at(i, cut.table().largest()), cut.table().at(i, cut.table().smallest()));
    console().error(fmt::format("{}: error: what is wanted is not within reach of this fabric: by the law of Laplace it presses at {}, from slack to 2.9 times its length; take a stiffer or a softer one",
                                (prepared.description.directory / "case.toml").string(), ends));
    return outside_tolerance;
  }

  static std::string ease_text(const FoundCut& found, int garment) {
    const PreparedCase& prepared = *found.prepared;
    const solver::LaplaceTable table(prepared, garment, *prepared.jobs.target);
    std::string text;
    for (std::size_t i = 0; i < table.places(); ++i) {
      const double body = prepared.meshes.limb.girth(table.height(i)), own = prepared.meshes.garments[garment].fit.at(table.height(i)).girth;
      text += fmt::format("  {:<24} body {:.1f} mm, garment {:.1f} mm, ease {:.1f} %\n", place(prepared, i), 1e3 * body, 1e3 * own, 100.0 * (own / body - 1.0));
    }
    for (const postproc::Warning& w : found.warnings) text += fmt::format("  warning: {}: {}; {}\n", w.name, w.text, w.remedy);
    return text;
  }

  void add_ease(const FoundCut& found, int garment) const {
    const PreparedCase& prepared = *found.prepared;
    const solver::LaplaceTable table(prepared, garment, *prepared.jobs.target);
    for (std::size_t i = 0; i < table.places(); ++i) {
      const double body = prepared.meshes.limb.girth(table.height(i)), own = prepared.meshes.garments[garment].fit.at(table.height(i)).girth;
      console().document()["ease"].push_back({{"place", place(prepared, i)}, {"body_girth_m", body}, {"garment_girth_m", own}, {"ease", own / body - 1.0}});
    }
  }

  /// Writes the case and says what was found.
  int finish(const FoundCut& found, const std::string& sizes_csv) {
    const fs::path to = out_.empty() ? free_name(directory_) : fs::path(out_);
    copy_case(directory_, to, [&](const fs::path& copy) {
      input::write_file(copy / "case.toml", case_text(found));
      if (!sizes_csv.empty()) input::write_file(copy / "sizes.csv", sizes_csv);
    });
    const bool met = found.error <= 0.01 * within_, several = found.rows.size() > 1;
    Json& told = console().document();
    told["targets"] = targets_json(found.rows), told["error"] = found.error, told["met"] = met, told["case"] = to.string();
    for (const Setting& setting : found.settings) told["settings"].push_back({{"key", setting.path}, {"toml", setting.literal}});
    console().print("{} is the case cut so{}, within {:.2f} % of what is wanted{}. Next: snug run {}\n", to.string(), sizes_csv.empty() ? "" : " with sizes.csv", 100.0 * found.error,
               met ? "" : several && found.settled ? " (in least squares; no one factor meets all)" : "", to.string());
    if (found.status != done) return found.status;
    return met || (several && found.settled) ? done : outside_tolerance;
  }

  /// The text of the case with what was set and found in it; where that cannot be written into it, the values used.
  std::string case_text(const FoundCut& found) const {
    std::optional<std::string> text = input::read_file(fs::path(directory_) / "case.toml");
    const auto put = [&](const std::string& path, const std::string& literal) {
      if (!text) return;
      std::optional<std::string> with = input::with_value(*text, path, literal);
      text = with ? with : input::with_value(*text, path, quoted(literal));  // --set takes bare words, too
    };
    for (const std::string& set : options_.overrides) put(set.substr(0, set.find('=')), set.substr(set.find('=') + 1));
    for (const Setting& setting : found.settings) put(setting.path, setting.literal);
    if (text && !targets_.empty()) put("target.pressures", wanted_table(targets_, found.prepared->description));
    const std::string head = fmt::format("# snug size: within {:.2f} % of what is wanted.\n", 100.0 * found.error);
    return head + (text ? *text : solver::echo_text(found.prepared->model) + input::echo_text(found.prepared->jobs));
  }

  std::string directory_, vary_ = "size", garment_, out_;
  std::vector<std::string> targets_;
  CaseOptions options_;
  PopulationQuestion question_;
  int solves_ = 3;
  double within_ = 1.0, inside_ = 10.0;
};

}  // namespace

std::unique_ptr<Command> make_size() { return std::make_unique<Size>(); }

}  // namespace snug::app
