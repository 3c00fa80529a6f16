// snug materials near, clusters, regress: what the library teaches.
#include "solver/app/learning_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "materials/database/items.hpp"
#include "materials/learning/standard_scale.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/library_command.hpp"
#include "solver/app/project_text.hpp"
#include "solver/app/run_table.hpp"

namespace snug::app {

namespace {

using Eigen::Index, Eigen::MatrixXd;
using materials::Entity, materials::Kind, materials::Library;

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

double number_of(const Entity& entity, const std::string& item) {
  const materials::Datum* datum = entity.find(item);
  return datum && datum->si ? *datum->si : not_there;
}

/// The names of items as a user may write them, by symbol too. Throws input::InputError for one that no entity has as a number.
std::vector<std::string> known_items(const std::vector<std::string>& asked, const std::vector<Entity>& entities, const std::string& command) {
  std::set<std::string> known;
  for (const Entity& entity : entities)
    for (const materials::Datum& datum : entity.data)
      if (datum.si) known.insert(datum.name);
  std::vector<std::string> items;
  for (std::string item : asked) {
    if (const materials::Item* usual = known.contains(item) ? nullptr : materials::usual_symbol(item)) item = usual->name;
    if (!known.contains(item))
      throw input::InputError({"snug materials " + command, 0, 0}, "none of these entities has a number \"" + item + "\"", input::did_you_mean(item, {known.begin(), known.end()}));
    items.push_back(item);
  }
  return items;
}

MatrixXd table_of(const std::vector<Entity>& entities, const std::vector<std::string>& items) {
  MatrixXd table(static_cast<Index>(entities.size()), static_cast<Index>(items.size()));
  for (Index r = 0; r < table.rows(); ++r)
    for (Index c = 0; c < table.cols(); ++c) table(r, c) = number_of(entities[static_cast<std::size_t>(r)], items[static_cast<std::size_t>(c)]);
  return table;
}

std::vector<Entity> entities_of(const Library& library, Kind kind, const std::string& question) {
  std::vector<Entity> entities;
  for (const std::string& id : question.empty() ? library.ids(kind) : library.find_where(question, kind)) entities.push_back(library.entity(id));
  return entities;
}

std::string printed(const Entity& entity, const std::string& item) {
  const materials::Datum* datum = entity.find(item);
  return datum ? materials::quantity_text(*datum) : "-";
}

/// Numbers in SI by their names; null where an entity has none.
Json si_json(const Entity& entity, const std::vector<std::string>& items) {
  Json json = Json::object();
  for (const std::string& item : items) {
    const double number = number_of(entity, item);
    json[item] = std::isnan(number) ? Json() : Json(number);
  }
  return json;
}

class Near : public LibraryCommand {
 public:
  Near() : LibraryCommand("near", "the entities that are most like one, by their numbers in standard deviations") {}
  void declare(CLI::App& app) override {
    app.add_option("ID", id_, "entity")->required();
    app.add_option("--by", items_, "items that count (else all numbers that another one has, too)")->delimiter(',');
    app.add_option("--most", most_, "how many")->check(CLI::PositiveNumber)->capture_default_str();
  }

 private:
  int act(Library& library) override {
    const Entity asked = library.entity(id_);
    const std::vector<Entity> entities = entities_of(library, asked.kind, {});
    const std::vector<std::string> items = items_.empty() ? own_items(asked, entities) : known_items(items_, entities, "near");
    for (const std::string& item : items)
      if (std::isnan(number_of(asked, item)))
        throw input::InputError({"snug materials near", 0, 0}, id_ + " has no number \"" + item + "\"", "compare by what it has: snug materials show \"" + id_ + "\"");
    if (items.empty()) throw input::InputError({"snug materials near", 0, 0}, id_ + " has no number that another one has, too", "add some: snug materials edit");
    const auto own = std::find_if(entities.begin(), entities.end(), [&](const Entity& one) { return one.id == id_; });
    std::vector<std::vector<std::string>> rows{{"id", "distance", "of items"}};
    for (const std::string& item : items) rows.front().push_back(item);
    Json& told = console().document()["entities"] = Json::array();
    const auto add = [&](const Entity& entity, double distance, std::size_t shared) {
      rows.push_back({entity.id, fmt::format("{:.3f}", distance), std::to_string(shared)});
      for (const std::string& item : items) rows.back().push_back(printed(entity, item));
      told.push_back({{"id", entity.id}, {"distance", distance}, {"of_items", shared}, {"items", si_json(entity, items)}});
    };
    add(asked, 0.0, items.size());
    for (const materials::Neighbour& one : materials::neighbours(table_of(entities, items), own - entities.begin())) {
      if (rows.size() > static_cast<std::size_t>(most_) + 1) break;
      add(entities[static_cast<std::size_t>(one.row)], one.distance, static_cast<std::size_t>(one.shared));
    }
    console().say(aligned(rows));
    return done;
  }
  static std::vector<std::string> own_items(const Entity& asked, const std::vector<Entity>& entities) {
    std::vector<std::string> items;
    for (const materials::Datum& datum : asked.data) {
      const bool shared = std::any_of(entities.begin(), entities.end(), [&](const Entity& one) { return one.id != asked.id && !std::isnan(number_of(one, datum.name)); });
      if (datum.si && shared && asked.find(datum.name) == &datum) items.push_back(datum.name);
    }
    return items;
  }
  std::string id_;
  std::vector<std::string> items_;
  int most_ = 5;
};

class Groups : public LibraryCommand {
 public:
  Groups() : LibraryCommand("clusters", "entities in groups that are alike (k-means in standard deviations; begins with the one farthest from the mean)") {}
  void declare(CLI::App& app) override {
    app.add_option("QUESTION", question_, "only those (snug materials find)");
    app.add_option("--by", items_, "items that count; entities without one of them are left out")->delimiter(',')->required();
    app.add_option("--count", count_, "how many groups")->check(CLI::PositiveNumber)->capture_default_str();
    declare_kind(app, "--kind", kind_);
  }

 private:
  int act(Library& library) override {
    std::vector<Entity> entities = entities_of(library, kind_of(kind_), question_);
    const std::vector<std::string> items = known_items(items_, entities, "clusters");
    const auto lacks = [&](const Entity& one) { return std::any_of(items.begin(), items.end(), [&](const std::string& item) { return std::isnan(number_of(one, item)); }); };
    const auto left_out = std::erase_if(entities, lacks);
    const materials::Clusters found = clusters_of(entities, items);
    console().print("{} {}s in {} groups by {}; {:.1f} % of the variance is between them{}\n", entities.size(), kind_, found.centres.rows(), input::joined(items), 100.0 * found.share_between,
               left_out ? fmt::format("; {} without one of the numbers left out", left_out) : "");
    std::vector<std::vector<std::string>> rows{{"group", "id"}};
    Json told = Json::array();
    for (const std::string& item : items) rows.front().push_back(item);
    for (int k = 0; k < found.centres.rows(); ++k)
      for (std::size_t r = 0; r < entities.size(); ++r) {
        if (found.of[r] != k) continue;
        rows.push_back({std::to_string(k + 1), entities[r].id});
        told.push_back({{"group", k + 1}, {"id", entities[r].id}, {"items", si_json(entities[r], items)}});
        for (const std::string& item : items) rows.back().push_back(printed(entities[r], item));
      }
    console().say(aligned(rows));
    console().document() = {{"share_of_variance_between", found.share_between}, {"entities", told}};
    return done;
  }
  materials::Clusters clusters_of(const std::vector<Entity>& entities, const std::vector<std::string>& items) const {
    try {
      return materials::clusters(table_of(entities, items), count_);
    } catch (const std::invalid_argument&) {
      throw input::InputError({"--count", 0, 0}, fmt::format("{} groups of {} entities, some of which may be alike", count_, entities.size()), "ask for fewer groups");
    }
  }
  std::string question_, kind_ = "fabric";
  std::vector<std::string> items_;
  int count_ = 3;
};

class Regress : public LibraryCommand {
 public:
  Regress() : LibraryCommand("regress", "a pressure or comfort as a polynomial of what differs between recorded runs, with its error and sensitivities") {}
  void declare(CLI::App& app) override {
    app.add_option("RESULT", result_, "\"Front thigh\", comfort, …")->required();
    app.add_option("--on", keys_, "settings that it depends on, WT or garment.fabric.WT (else those of garments that differ)")->delimiter(',');
    app.add_option("--project", project_, "only runs of this project");
    app.add_option("--tier", tier_, "only runs of this tier")->check(CLI::IsMember({"L0", "L1", "L4"}));
    app.add_flag("--quadratic", quadratic_, "squares and products, too");
    app.add_option("--unit", unit_, "of pressures")->capture_default_str();
  }

 private:
  int act(Library& library) override {
    const PressureUnit unit(unit_);
    const RunTable table = run_table(library, {.result = result_, .keys = keys_, .project = project_, .tier = tier_});
    const double factor = table.unit == "Pa" ? unit.factor : 1.0;
    const auto degree = quadratic_ ? materials::Degree::quadratic : materials::Degree::linear;
    const Eigen::VectorXd response = table.response / factor;
    const materials::ResponseSurface fit = fitted(table, response, degree);
    const std::string of = table.unit == "Pa" ? " " + unit.name : "";
    console().print("{} of {} runs{}\n", result_, table.response.size(), table.left_out.empty() ? "" : "; left out: " + table.left_out);
    console().print("  {}, {} coefficients: R2 {:.4f}, rms {:.3g}{}\n", quadratic_ ? "quadratic" : "linear", fit.coefficients.size(), fit.r_squared, fit.rms, of);
    if (std::isnan(fit.cross_validated_rms)) console().print("  cross-validated: not known, one of the runs alone decides about a coefficient\n");
    else console().print("  cross-validated (each run told by the others): rms {:.3g}{}, Q2 {:.4f}{}\n", fit.cross_validated_rms, of, fit.q_squared, fit.q_squared < 0.5 ? ": it tells little about a new run" : "");
    const double middle = fit.at(fit.mean);
    const Eigen::VectorXd slope = fit.gradient(fit.mean);
    std::vector<std::vector<std::string>> rows{{"setting", "mean", "from", "to", "change per unit", "per deviation", "% per %"}};
    for (Index c = 0; c < slope.size(); ++c) {
      const RunColumn& column = table.columns[static_cast<std::size_t>(c)];
      const Eigen::VectorXd values = table.properties.col(c);
      rows.push_back({column.key + (column.unit.empty() ? "" : " [" + column.unit + "]"), fmt::format("{:.4g}", fit.mean[c]), fmt::format("{:.4g}", values.minCoeff()), fmt::format("{:.4g}", values.maxCoeff()),
                      fmt::format("{:.4g}", slope[c]), fmt::format("{:+.3g}", slope[c] * fit.deviation[c]), fmt::format("{:+.2f}", slope[c] * fit.mean[c] / middle)});
    }
    console().print("  sensitivities at the mean of the runs, where it is {:.4g}{}\n{}", middle, of, aligned(rows));
    console().document() = document(table, fit, degree);
    return done;
  }
  /// In SI, whatever --unit says.
  Json document(const RunTable& table, const materials::ResponseSurface& shown, materials::Degree degree) const {
    const materials::ResponseSurface fit = fitted(table, table.response, degree);
    const Eigen::VectorXd slope = fit.gradient(fit.mean);
    Json settings = Json::array();
    for (Index c = 0; c < slope.size(); ++c) {
      const RunColumn& column = table.columns[static_cast<std::size_t>(c)];
      const Eigen::VectorXd values = table.properties.col(c);
      settings.push_back({{"setting", column.key}, {"unit", column.unit}, {"mean", fit.mean[c]}, {"from", values.minCoeff()}, {"to", values.maxCoeff()}, {"change_per_unit", slope[c]}, {"deviation", fit.deviation[c]}});
    }
    return {{"result", result_}, {"unit", table.unit}, {"runs", table.response.size()}, {"left_out", table.left_out}, {"r_squared", shown.r_squared}, {"rms", fit.rms},
            {"cross_validated_rms", fit.cross_validated_rms}, {"q_squared", shown.q_squared}, {"at_the_mean", fit.at(fit.mean)}, {"settings", settings}};
  }
  materials::ResponseSurface fitted(const RunTable& table, const Eigen::VectorXd& response, materials::Degree degree) const {
    try {
      return materials::fit_response(table.properties, response, degree);
    } catch (const std::invalid_argument& error) {
      throw input::InputError({"snug materials regress", 0, 0},
                              fmt::format("{} coefficients from {} runs: {}", materials::terms_of(table.properties.cols(), degree), response.size(), error.what()),
                              "name fewer settings by --on, leave --quadratic out, or run more variants");
    }
  }
  std::string result_, project_, tier_, unit_ = "gf/cm2";
  std::vector<std::string> keys_;
  bool quadratic_ = false;
};

}  // namespace

void add_learning_commands(std::vector<std::unique_ptr<Command>>& commands) {
  commands.push_back(std::make_unique<Near>());
  commands.push_back(std::make_unique<Groups>());
  commands.push_back(std::make_unique<Regress>());
  commands.push_back(make_suggest());
}

}  // namespace snug::app
