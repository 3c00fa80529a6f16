// snug explain KEY and snug list: the list of keys, made of their descriptions.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cases/input/key_list.hpp"
#include "cases/input/suggestion.hpp"
#include "solver/app/body_list.hpp"
#include "solver/app/comfort_pages.hpp"
#include "solver/app/command.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/material_list.hpp"
#include "solver/app/shipped_cases.hpp"

namespace snug::app {

namespace {

std::vector<input::KeyRow> all_keys() {
  std::vector<input::KeyRow> rows = input::case_keys();
  for (input::KeyRow& row : law_keys()) rows.push_back(std::move(row));
  return rows;
}

/// "body.layers[].cells" for the comparison with what a user types: "body.layers.cells".
std::string plain(std::string key) {
  for (std::size_t at; (at = key.find("[]")) != std::string::npos;) key.erase(at, 2);
  return key;
}

std::string last_part(const std::string& key) { return plain(key.substr(key.rfind('.') + 1)); }

/// The whole key, its last part, or a section before it.
bool matches(const std::string& key, const std::string& asked) {
  const std::string full = plain(key), wanted = plain(asked);
  if (full == wanted) return true;
  return full.size() > wanted.size() &&
         full.compare(full.size() - wanted.size() - 1, std::string::npos, "." + wanted) == 0;
}

/// A key that belongs to the section `asked`, at any depth.
bool inside(const std::string& key, const std::string& asked) {
  const std::string full = "." + plain(key), wanted = "." + plain(asked) + ".";
  return full.find(wanted) != std::string::npos;
}

/// One row of a list: the key, its meaning and what may be written.
std::string row_text(const input::KeyRow& row) {
  std::string facts = row.kind + (row.field.unit.empty() ? "" : ", " + row.field.unit);
  if (row.field.required) facts += ", required";
  if (!row.field.choices.empty()) facts += ": " + input::joined(row.field.choices);
  if (!row.default_value.empty()) facts += "; default " + row.default_value;
  return fmt::format("  {:<36} {}\n", row.key, row.field.meaning + " (" + facts + ")");
}

class Explain : public Command {
 public:
  std::string name() const override { return "explain"; }
  std::string summary() const override { return "what a key of case.toml, a law or a set of sensation curves means"; }

  void declare(CLI::App& app) override {
    app.add_option("KEY", key_,
                   "e.g. garment.position, thickness, a section such as garment, a law such as law.Ogden, or curves "
                   "such as \"wear trial 2002\"")
        ->required();
  }

  int execute() override {
    std::string text = law_page_text(key_) + curves_page(key_), keys;
    std::vector<std::string> known = law_names();
    Json rows = Json::array();
    const std::string page = text;
    if (!text.empty() && key_.starts_with("law.")) key_.erase(0, 4);
    for (const input::KeyRow& row : all_keys()) {
      known.push_back(last_part(row.key));
      if (matches(row.key, key_)) text += explanation(row);
      if (inside(row.key, key_)) keys += row_text(row);
      if (matches(row.key, key_) || inside(row.key, key_)) rows.push_back(key_json(row));
    }
    if (!keys.empty()) text += "keys of it\n" + keys;
    if (text.empty()) {
      const std::string near = input::nearest(last_part(key_), known);
      throw input::InputError({"snug explain", 0, 0}, "there is no key " + key_,
                              (near.empty() ? "" : "did you mean " + near + "? ") + "snug list shows all of them");
    }
    console().say(text);
    console().document() = {{"asked", key_}, {"keys", rows}, {"page", page.empty() ? Json() : Json(page)}};
    return done;
  }

 private:
  std::string key_;
};

class List : public Command {
 public:
  std::string name() const override { return "list"; }
  std::string summary() const override { return "everything that can be chosen: keys, laws, materials, cases"; }
  void declare(CLI::App& app) override {
    app.add_option("TOPIC", topic_, "curves: only the sensation curves, thresholds and fuzzy systems; bodies: only the standard bodies")
        ->check(CLI::IsMember({"curves", "bodies"}));
  }

  int execute() override {
    Json& document = console().document();
    if (topic_ == "bodies") {
      document["bodies"] = bodies_json();
      console().say(bodies_text());
      return done;
    }
    document["curves"] = curves_json();
    if (topic_ == "curves") {
      console().say(curves_text());
      return done;
    }
    document["keys"] = list_rows("keys of case.toml", input::case_keys());
    document["laws"] = law_names(), document["cases"] = shipped_cases();
    console().print("\nlaws of solids (snug explain law.NAME)\n  {}\n", input::joined(law_names()));
    document["keys_of_laws"] = list_rows("\nkeys of an inline material, { law = \"LAW\", ... }", law_keys());
    console().print("\nshipped materials\n{}", materials_text());
    document["materials"] = materials_json();
    console().print("\nsensation curves and thresholds (snug explain \"NAME\"), or a TOML or CSV file of the case\n{}", curves_text());
    console().print("\nstandard bodies (body.scan.standard)\n{}", bodies_text());
    document["bodies"] = bodies_json();
    console().print("\nshipped cases (snug new NAME --like CASE)\n");
    for (const std::string& name : shipped_cases()) console().print("  {}\n", name);
    return done;
  }

 private:
  Json list_rows(const std::string& head, const std::vector<input::KeyRow>& rows) const {
    Json json = Json::array();
    console().print("{}\n", head);
    for (const input::KeyRow& row : rows) {
      console().say(row_text(row));
      json.push_back(key_json(row));
    }
    return json;
  }

  std::string topic_;
};

}  // namespace

std::unique_ptr<Command> make_explain() { return std::make_unique<Explain>(); }
std::unique_ptr<Command> make_list() { return std::make_unique<List>(); }

}  // namespace snug::app
