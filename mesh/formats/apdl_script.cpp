#include "mesh/formats/apdl_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::mesh {

namespace {

constexpr long most_turns = 1'000'000;  // of all loops together
constexpr int deepest = 100;            // of parentheses and signs

bool is_name(std::string_view text) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
  return !text.empty() && text.size() <= 32 && letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || std::isdigit(static_cast<unsigned char>(c)); });
}

/// Recursive descent over sum, product, power and factor.
class Expression {
 public:
  Expression(std::string_view text, const std::map<std::string, double>& names) : rest_(text), names_(names) {}

  std::optional<double> value() {
    const double result = sum(0);
    blanks();
    return failed_ || !rest_.empty() || !std::isfinite(result) ? std::nullopt : std::optional(result);
  }

 private:
  void blanks() { rest_ = trimmed(rest_); }
  bool accept(std::string_view sign) {
    blanks();
    if (!rest_.starts_with(sign) || (sign == "*" && rest_.starts_with("**"))) return false;
    rest_.remove_prefix(sign.size());
    return true;
  }
  double fail() {
    failed_ = true, rest_ = {};
    return 0.0;
  }

  double sum(int depth) {
    double value = product(depth);
    while (!failed_) {
      if (accept("+")) value += product(depth);
      else if (accept("-")) value -= product(depth);
      else break;
    }
    return value;
  }
  double product(int depth) {
    double value = power(depth);
    while (!failed_) {
      if (accept("*")) value *= power(depth);
      else if (accept("/")) value /= power(depth);
      else break;
    }
    return value;
  }
  double power(int depth) {
    const double base = factor(depth + 1);
    return accept("**") ? std::pow(base, factor(depth + 1)) : base;
  }
  double factor(int depth) {
    if (depth > deepest) return fail();
    if (accept("-")) return -power(depth + 1);
    if (accept("+")) return power(depth + 1);
    if (accept("(")) {
      const double value = sum(depth + 1);
      return accept(")") ? value : fail();
    }
    blanks();
    return !rest_.empty() && (std::isalpha(static_cast<unsigned char>(rest_[0])) || rest_[0] == '_') ? named(depth) : number();
  }
  double named(int depth) {
    const auto end = std::min(rest_.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_"), rest_.size());
    const std::string name = upper_case(rest_.substr(0, end));
    rest_.remove_prefix(end);
    if (!accept("(")) {
      const auto known = names_.find(name);
      return known == names_.end() ? fail() : known->second;
    }
    const double argument = sum(depth + 1);
    return accept(")") ? function(name, argument) : fail();
  }
  double function(const std::string& name, double x) {
    using Function = double (*)(double);
    static const std::map<std::string, Function> functions = {
        {"SIN", std::sin}, {"COS", std::cos}, {"TAN", std::tan}, {"ASIN", std::asin}, {"ACOS", std::acos}, {"ATAN", std::atan},
        {"SQRT", std::sqrt}, {"ABS", std::fabs}, {"EXP", std::exp}, {"LOG", std::log}, {"LOG10", std::log10}, {"NINT", std::round}};
    const auto known = functions.find(name);
    return known == functions.end() ? fail() : known->second(x);
  }
  double number() {
    std::size_t end = 0;
    const auto digits = [&] { while (end < rest_.size() && std::isdigit(static_cast<unsigned char>(rest_[end]))) ++end; };
    digits();
    if (end < rest_.size() && rest_[end] == '.') ++end, digits();
    if (end > 0 && end < rest_.size() && std::string_view("EeDd").find(rest_[end]) != std::string_view::npos) {
      const std::size_t mantissa = end++;
      if (end < rest_.size() && (rest_[end] == '+' || rest_[end] == '-')) ++end;
      const std::size_t exponent = end;
      digits();
      if (end == exponent) end = mantissa;
    }
    const auto value = number_of(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end, rest_.size()));
    return value ? *value : fail();
  }

  std::string_view rest_;
  const std::map<std::string, double>& names_;
  bool failed_ = false;
};

}  // namespace

std::optional<double> apdl_value(std::string_view expression, const std::map<std::string, double>& names) {
  return Expression(expression, names).value();
}

std::optional<double> ApdlScript::value_of(std::string_view text) const {
  if (const auto number = number_of(text)) return number;
  return apdl_value(text, numbers_);
}

bool ApdlScript::take(const FieldLine& line, LineSource& source) {
  const std::string name = upper_case(line.text(0));
  if (name == "*IF") return begin_condition(line), true;
  if (name == "*ELSEIF" || name == "*ELSE") return otherwise(line, name == "*ELSEIF"), true;
  if (name == "*ENDIF") {
    if (conditions_.empty() || (!loops_.empty() && conditions_.size() <= loops_.back().conditions)) line.error(0, "there is no *IF that ends here", "take it away");
    else conditions_.pop_back();
    return true;
  }
  if (name == "*DO") return begin_loop(line, source), true;
  if (name == "*ENDDO") return end_loop(line, source), true;
  if (skipping()) return true;
  if (name == "*SET" && upper_case(line.text(1)).starts_with("_")) return true;  // Ansys' own
  if (name == "*SET") return assign(line, upper_case(line.text(1)), line.text(2), 2), true;
  if (name == "*DIM" || name == "*GET" || name.starts_with("*STAT") || name == "*MSG") return true;  // said where it is used
  const auto equals = line.text(0).find('=');
  if (equals == std::string_view::npos) return false;
  assign(line, upper_case(trimmed(line.text(0).substr(0, equals))), trimmed(line.text(0).substr(equals + 1)), 0);
  return true;
}

void ApdlScript::assign(const FieldLine& line, std::string name, std::string_view value, std::size_t field) {
  if (name.find('(') != name.npos) {
    if (!value.starts_with("'")) line.error(field, "a value of an array is set", "use plain parameters: arrays are not evaluated");
    return;
  }
  if (!is_name(name)) return line.error(0, fmt::format("\"{}\" is no name of a parameter", name.substr(0, 40)), "begin it with a letter; letters, digits and _ follow");
  numbers_.erase(name), texts_.erase(name);
  if (value.empty()) return;
  if (value.front() == '\'') {
    texts_[name] = std::string(trimmed(value.substr(1, value.find('\'', 1) - 1)));
    return;
  }
  if (const auto number = value_of(value)) numbers_[name] = *number;
  else line.error(field, fmt::format("\"{}\" cannot be evaluated", value.substr(0, 40)), "give a number, or an expression of parameters that were set before");
}

/// Values that are not known are zero to a test, as Ansys has it.
bool ApdlScript::test(const FieldLine& line) {
  const auto side = [&](std::size_t field) { return value_of(line.text(field)).value_or(0.0); };
  const double a = side(1), b = side(3);
  const std::string how = upper_case(line.text(2));
  const bool equal = std::abs(a - b) <= 1e-10 * std::max(std::abs(a), std::abs(b));
  if (how == "EQ") return equal;
  if (how == "NE") return !equal;
  if (how == "LT") return a < b && !equal;
  if (how == "GT") return a > b && !equal;
  if (how == "LE") return a <= b || equal;
  if (how == "GE") return a >= b || equal;
  line.error(2, fmt::format("\"{}\" is no test", line.text(2)), "write EQ, NE, LT, GT, LE or GE");
  return false;
}

void ApdlScript::begin_condition(const FieldLine& line) {
  const bool within = !skipping();
  if (upper_case(line.text(4)) != "THEN") {
    if (within) line.error(4, "this condition is no *IF,a,EQ,b,THEN", "write *IF,a,EQ|NE|LT|GT|LE|GE,b,THEN and *ENDIF");
    return;
  }
  const bool met = within && test(line);
  conditions_.push_back({met, met, within, line.number});
}

void ApdlScript::otherwise(const FieldLine& line, bool with_test) {
  if (conditions_.empty()) return line.error(0, "there is no *IF before it", "take it away");
  Condition& now = conditions_.back();
  now.taken = now.within && !now.met && (!with_test || test(line));
  now.met = now.met || now.taken;
}

void ApdlScript::begin_loop(const FieldLine& line, const LineSource& source) {
  if (skipping()) {
    ++skipped_loops_;
    return;
  }
  const std::string name = upper_case(line.text(1));
  const auto first = value_of(line.text(2)), last = value_of(line.text(3)), step = line.empty(4) ? std::optional(1.0) : value_of(line.text(4));
  if (!is_name(name) || !first || !last || !step || *step == 0.0) {
    line.error(1, "this loop cannot be counted", "write *DO,name,first,last,step with numbers or parameters that were set before");
    ++skipped_loops_;
  } else if ((*last - *first) / *step < -1e-9) {
    ++skipped_loops_;
  } else {
    numbers_[name] = *first;
    loops_.push_back({name, *first, *last, *step, source, conditions_.size(), line.number});
  }
}

void ApdlScript::end_loop(const FieldLine& line, LineSource& source) {
  if (skipped_loops_ > 0) {
    --skipped_loops_;
    return;
  }
  if (skipping()) return;
  if (loops_.empty()) return line.error(0, "there is no *DO that ends here", "take it away");
  Loop& loop = loops_.back();
  if (conditions_.size() != loop.conditions) return line.error(0, "the loop ends inside an *IF that began in it", "put *ENDIF before *ENDDO");
  loop.value += loop.step;
  if ((loop.last - loop.value) / loop.step < -1e-9) {
    loops_.pop_back();
  } else if (++turns_ > most_turns) {
    line.error(0, "the loops have more than a million turns", "write the meshed model with CDWRITE,DB");
    loops_.pop_back();
  } else {
    numbers_[loop.name] = loop.value;
    source = loop.begin;
  }
}

std::vector<TextField> ApdlScript::evaluated(const std::vector<TextField>& fields) {
  kept_.clear();
  std::vector<TextField> result = fields;
  for (std::size_t f = 1; f < result.size(); ++f) {
    const std::string_view text = result[f].text;
    if (text.empty() || number_of(text)) continue;
    if (const auto known = texts_.find(upper_case(text)); known != texts_.end()) {
      result[f].text = kept_.emplace_back(known->second);
    } else if (const auto value = value_of(text)) {
      const bool whole = std::abs(*value) < 1e9 && std::abs(*value - std::round(*value)) < 1e-9;
      result[f].text = kept_.emplace_back(whole ? fmt::format("{:.0f}", *value) : fmt::format("{:.17g}", *value));
    }
  }
  return result;
}

void ApdlScript::finish(const std::string& file, input::Diagnostics& diagnostics) const {
  for (const Loop& loop : loops_) diagnostics.error({file, loop.line, 1}, "this loop has no end", "write *ENDDO after its lines");
  for (const Condition& condition : conditions_) diagnostics.error({file, condition.line, 1}, "this condition has no end", "write *ENDIF after its lines");
}

}  // namespace snug::mesh
