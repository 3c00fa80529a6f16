#include "materials/database/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cases/input/suggestion.hpp"
#include "materials/database/curve.hpp"
#include "materials/database/equation.hpp"
#include "materials/database/items.hpp"

namespace snug::materials {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int longest_chain = 100;  // of equations that need one another

const std::string& symbol_of(const Datum& datum) { return datum.symbol.empty() ? datum.name : datum.symbol; }

/// What a symbol of an equation means: the first datum that has it as its symbol, else the one of that name.
const Datum* meant_by(const Entity& entity, const std::string& symbol) {
  const auto found =
      std::find_if(entity.data.begin(), entity.data.end(), [&](const Datum& datum) { return datum.symbol == symbol; });
  return found != entity.data.end() ? entity.find(found->name) : entity.find(symbol);
}

std::vector<std::string> known_symbols(const Entity& entity) {
  std::vector<std::string> known;
  for (const Datum& datum : entity.data)
    if (datum.type != DatumType::figure) known.push_back(symbol_of(datum));
  return known;
}

/// By the name that the item usually has it, so that messages say J/m2 of a work and not N/m.
std::string si_unit_of(const Datum& datum, UnitBook& units) {
  const Item* item = usual_item(datum.name.substr(datum.name.rfind('.') + 1));
  if (item && std::string(item->unit) != "text") return item->unit;
  const auto unit = units.find(datum.unit);
  return unit ? unit->name : std::string();
}

class Evaluation {
 public:
  Evaluation(const Entity& entity, const Given& given, UnitBook& units)
      : entity_(entity), given_(given), units_(units) {}

  /// In SI; unknown where a state variable is not given, whose symbol is then `missing`.
  double value_of(const Datum& datum) {
    const auto before = known_.find(&datum);
    if (before != known_.end()) return before->second;
    return known_[&datum] = new_value_of(datum);
  }
  std::string missing;

 private:
  double new_value_of(const Datum& datum) {
    if (const auto given = given_number(datum)) return *given;
    if (datum.type != DatumType::equation) {
      if (!datum.si) missing = symbol_of(datum);
      return datum.si.value_or(unknown);
    }
    if (++depth_ > longest_chain)
      throw input::InputError(entity_.where,
                              entity_.id + ", " + datum.name +
                                  ": the equations need themselves, or one another in a chain of more than " +
                                  std::to_string(longest_chain),
                              "give one of them as a value");
    const double result = Equation::parse(datum.value, entity_.where).value([&](const std::string& symbol) {
      const Datum* needed = meant_by(entity_, symbol);
      if (needed) return value_of(*needed);
      missing = symbol;
      return unknown;
    });
    --depth_;
    return result;
  }
  std::optional<double> given_number(const Datum& datum) {
    auto found = given_.find(symbol_of(datum));
    if (found == given_.end()) found = given_.find(datum.name);
    if (found == given_.end()) return std::nullopt;
    const auto printed = printed_quantity(found->second, units_);
    const auto unit = printed ? units_.find(printed->unit) : std::nullopt;
    if (!unit || !Dimension(unit->name).same_as(Dimension(si_unit_of(datum, units_))))
      throw input::InputError({found->first + " = " + found->second, 0, 0},
                              "this is no number of the dimension of " + datum.name,
                              "write it with a unit like " + (datum.unit.empty() ? "none, e.g. " + found->first + "=0.5"
                                                                                 : "\"" + datum.unit + "\""));
    return *plain_number(printed->number) * unit->factor;
  }

  const Entity& entity_;
  const Given& given_;
  UnitBook& units_;
  std::map<const Datum*, double> known_;  // each once, however often the others need it
  int depth_ = 0;
};

Dimension dimension_of(const Entity& entity, const Datum& datum, const std::string& symbol, UnitBook& units) {
  const Datum* needed = meant_by(entity, symbol);
  if (!needed)
    throw input::InputError(entity.where,
                            datum.name + ": the equation needs " + symbol + ", which is no item of " + entity.id,
                            input::did_you_mean(symbol, known_symbols(entity)) +
                                "; a state variable is an item with a unit and an empty value");
  if (needed->name == datum.name)
    throw input::InputError(entity.where, datum.name + ": the equation needs itself",
                            "write it in terms of other items");
  const bool is_text = needed->type == DatumType::value && !needed->value.empty() && !plain_number(needed->value);
  if (is_text || needed->type == DatumType::table || needed->type == DatumType::figure)
    throw input::InputError(entity.where,
                            datum.name + ": the equation needs " + symbol + ", which is " +
                                (is_text ? "a text" : "a " + input::text_of(needed->type)),
                            "take items that are numbers or equations");
  return Dimension(si_unit_of(*needed, units));
}

void check_equation(const Entity& entity, const Datum& datum, UnitBook& units) {
  const Equation equation = Equation::parse(datum.value, entity.where);
  const Dimension found =
      equation.dimension([&](const std::string& symbol) { return dimension_of(entity, datum, symbol, units); });
  const Dimension wanted(si_unit_of(datum, units));
  if (!found.same_as(wanted))
    throw input::InputError(entity.where,
                            datum.name + " = " + datum.value + " comes to " + found.text() + ", its unit is " +
                                (datum.unit.empty() ? "none" : "\"" + datum.unit + "\""),
                            "see which factor is one too many, or give the unit that it has");
}

Evaluated evaluate_table(const Datum& datum, const Given& given, UnitBook& units,
                         const std::function<std::string(const std::string&)>& content) {
  const Curve curve = Curve::parse(content(datum.value), datum.name, units);
  const auto found = given.find(curve.x.name);
  const input::Location where{datum.name, 0, 0};
  if (found == given.end())
    throw input::InputError(where, "the table runs over " + curve.x.name,
                            fmt::format("say where, e.g. --with \"{}={:.4g} {}\"", curve.x.name,
                                        curve.x.values[1] / curve.x.si.factor, curve.x.unit));
  const auto printed = printed_quantity(found->second, units);
  const auto unit = printed ? units.find(printed->unit) : std::nullopt;
  if (!unit || !Dimension(unit->name).same_as(Dimension(curve.x.si.name)))
    throw input::InputError(where, curve.x.name + " = " + found->second + " is not of the dimension of the table",
                            "write it with a unit like \"" + curve.x.unit + "\"");
  const double y = curve.at(*plain_number(printed->number) * unit->factor);
  if (!std::isfinite(y))
    throw input::InputError(where, curve.x.name + " = " + found->second + " is outside the points of the table",
                            fmt::format("stay between {:.6g} and {:.6g} {}", curve.x.values.front() / curve.x.si.factor,
                                        curve.x.values.back() / curve.x.si.factor, curve.x.unit));
  return {.si = y, .si_unit = curve.y.si.name, .in_unit = y / curve.y.si.factor, .datum = &datum};
}

}  // namespace

void check_equations(Entity& entity, UnitBook& units, input::Diagnostics& diagnostics) {
  const Given nothing;
  Evaluation evaluation(entity, nothing, units);
  for (Datum& datum : entity.data) {
    if (datum.type != DatumType::equation) continue;
    datum.si.reset();
    try {
      check_equation(entity, datum, units);
      const double value = evaluation.value_of(datum);
      if (std::isfinite(value)) datum.si = value;
    } catch (const input::InputError& error) {
      for (const input::Diagnostic& one : error.errors()) diagnostics.error(one.where, one.found, one.remedy);
    }
  }
}

Evaluated evaluate(const Entity& entity, const std::string& item, const Given& given, UnitBook& units,
                   const std::function<std::string(const std::string&)>& content) {
  const Datum* meant = meant_by(entity, item);
  if (!meant)
    throw input::InputError({entity.id, 0, 0}, "it has no item \"" + item + "\"",
                            input::did_you_mean(item, known_symbols(entity)));
  const auto of_type = [&](DatumType type) {
    const auto found = std::find_if(entity.data.begin(), entity.data.end(),
                                    [&](const Datum& one) { return one.name == meant->name && one.type == type; });
    return found == entity.data.end() ? nullptr : &*found;
  };
  const Datum* datum = of_type(DatumType::equation);
  if (!datum) datum = of_type(DatumType::table);
  if (!datum) datum = meant;
  if (datum->type == DatumType::table) return evaluate_table(*datum, given, units, content);
  Evaluation evaluation(entity, given, units);
  const double value = evaluation.value_of(*datum);
  if (std::isnan(value) && !evaluation.missing.empty())
    throw input::InputError({entity.id, 0, 0}, item + " needs " + evaluation.missing + ", which has no number",
                            "give it, e.g. --with \"" + evaluation.missing + "=...\"");
  if (!std::isfinite(value))
    throw input::InputError({entity.id, 0, 0}, item + " comes to no finite number here",
                            "see for which values a quotient, root or logarithm has one");
  const auto unit = units.find(datum->unit);
  return {.si = value, .si_unit = unit->name, .in_unit = value / unit->factor, .datum = datum};
}

}  // namespace snug::materials
