#include "materials/database/equation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "cases/input/units.hpp"

namespace snug::materials {

namespace {

constexpr std::size_t longest = 2000, most_nodes = 500;
constexpr int deepest_equation = 50;

/// "(N/m)2 (m)-1" of the powers times `scale`.
std::string unit_text(const std::map<std::string, double>& powers, double scale) {
  std::string text;
  for (const auto& [unit, power] : powers)
    text += fmt::format("{}({})^{}", text.empty() ? "" : " ", unit, std::lround(power * scale));
  return text.empty() ? "m/m" : text;
}

/// The smallest factor that makes whole numbers of the powers; 0: there is none up to 12.
double whole(const std::map<std::string, double>& powers) {
  const auto is_whole = [](double x) { return std::abs(x - std::round(x)) < 1e-9 && std::abs(x) < 100.0; };
  for (int scale = 1; scale <= 12; ++scale)
    if (std::all_of(powers.begin(), powers.end(), [&](const auto& one) { return is_whole(one.second * scale); }))
      return scale;
  return 0.0;
}

bool is_letter(unsigned char c) { return std::isalpha(c) || c == '_' || c >= 0x80; }

}  // namespace

Dimension Dimension::times(const Dimension& other, double exponent) const {
  Dimension product = *this;
  for (const auto& [unit, power] : other.powers_) {
    const double sum = product.powers_[unit] += power * exponent;
    if (std::abs(sum) < 1e-12) product.powers_.erase(unit);
  }
  return product;
}

bool Dimension::same_as(const Dimension& other) const {
  const Dimension ratio = times(other, -1.0);
  if (ratio.powers_.empty()) return true;
  const double scale = whole(ratio.powers_);
  double factor = 0.0;
  return scale > 0.0 && input::unit_factor(unit_text(ratio.powers_, scale), "m/m", factor);
}

std::string Dimension::text() const {
  std::string text;
  for (const auto& [unit, power] : powers_) {
    const bool compound = unit.find_first_of(" /") != unit.npos && (power != 1.0 || powers_.size() > 1);
    text += (text.empty() ? "" : " ") + (compound ? "(" + unit + ")" : unit) +
            (power == 1.0 ? "" : fmt::format("^{:.4g}", power));
  }
  return text.empty() ? "a plain number" : text;
}

/// Recursive descent; precedence of school, ^ binds to the right and before a sign.
class EquationParser {
  using Op = Equation::Op;

 public:
  EquationParser(const std::string& text, const input::Location& where) {
    equation_.text_ = text;
    equation_.where_ = where;
  }

  Equation parse() {
    if (text().size() > longest)
      refuse(fmt::format("an equation of {} characters", text().size()), fmt::format("at most {} are read", longest));
    sum();
    if (at_ < text().size())
      refuse("\"" + text().substr(at_, 20) + "\" where the equation should end",
             "write an operator + - * / ^ before it, or leave it out");
    return std::move(equation_);
  }

 private:
  const std::string& text() const { return equation_.text_; }
  [[noreturn]] void refuse(const std::string& found, const std::string& remedy) const {
    input::Location where = equation_.where_;
    where.column += static_cast<int>(at_);
    throw input::InputError(where, "equation, character " + std::to_string(at_ + 1) + ": " + found, remedy);
  }
  char next() {
    while (at_ < text().size() && (text()[at_] == ' ' || text()[at_] == '\t')) ++at_;
    return at_ < text().size() ? text()[at_] : '\0';
  }
  bool take(char c) {
    if (next() != c || c == '\0') return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) refuse(std::string("a ") + c + " is missing", std::string("write the ") + c);
  }
  int add(Equation::Node node) {
    if (equation_.nodes_.size() >= most_nodes)
      refuse(fmt::format("more than {} numbers and symbols", most_nodes), "make an item of a part of it");
    node.column = static_cast<int>(at_);
    equation_.nodes_.push_back(std::move(node));
    return static_cast<int>(equation_.nodes_.size()) - 1;
  }

  int sum() {
    if (++depth_ > deepest_equation) refuse(fmt::format("nested more than {} deep", deepest_equation), "make an item of a part of it");
    int left = product();
    for (;;) {
      const Op op = next() == '+' ? Op::add : Op::subtract;
      if (!take('+') && !take('-')) break;
      const int right = product();
      left = add({.op = op, .left = left, .right = right});
    }
    --depth_;
    return left;
  }
  int product() {
    int left = signed_power();
    for (;;) {
      const Op op = next() == '*' ? Op::multiply : Op::divide;
      if (!take('*') && !take('/')) return left;
      const int right = signed_power();
      left = add({.op = op, .left = left, .right = right});
    }
  }
  int signed_power() {
    if (++depth_ > deepest_equation) refuse(fmt::format("nested more than {} deep", deepest_equation), "make an item of a part of it");
    int node = -1;
    if (take('-')) {
      const int of = signed_power();
      node = add({.op = Op::negative, .left = of});
    } else {
      node = take('+') ? signed_power() : power();
    }
    --depth_;
    return node;
  }
  int power() {
    const int base = primary();
    if (!take('^')) return base;
    const int exponent = signed_power();
    return add({.op = Op::power, .left = base, .right = exponent});
  }
  int primary() {
    if (take('(')) {
      const int inner = sum();
      expect(')');
      return inner;
    }
    const char c = next();
    if ((c >= '0' && c <= '9') || c == '.') return number();
    if (is_letter(static_cast<unsigned char>(c))) return name();
    if (c == '\0') refuse("it ends where a number or a symbol should stand", "write one");
    refuse(std::string("\"") + c + "\" where a number or a symbol should stand",
           "write one; symbols begin with a letter");
  }
  int number() {
    double value = 0.0;
    const char *begin = text().data() + at_, *end = text().data() + text().size();
    const auto [rest, fault] = std::from_chars(begin, end, value);
    if (fault != std::errc{} || !std::isfinite(value))
      refuse("no finite number", "write digits with a decimal point, e.g. 0.57");
    at_ += static_cast<std::size_t>(rest - begin);
    return add({.op = Op::number, .number = value});
  }
  int name() {
    const std::size_t begin = at_;
    while (at_ < text().size() && (is_letter(static_cast<unsigned char>(text()[at_])) ||
                                   std::isdigit(static_cast<unsigned char>(text()[at_])) || text()[at_] == '\''))
      ++at_;
    const std::string word = text().substr(begin, at_ - begin);
    if (next() == '(') return call(word);
    if (word == "pi") return add({.op = Op::number, .number = std::numbers::pi});
    return add({.op = Op::symbol, .symbol = word});
  }
  int call(const std::string& word) {
    static constexpr std::array<std::pair<const char*, Op>, 9> functions = {{{"sqrt", Op::sqrt},
                                                                             {"exp", Op::exp},
                                                                             {"log", Op::log},
                                                                             {"abs", Op::abs},
                                                                             {"sin", Op::sin},
                                                                             {"cos", Op::cos},
                                                                             {"tan", Op::tan},
                                                                             {"min", Op::min},
                                                                             {"max", Op::max}}};
    const auto function =
        std::find_if(functions.begin(), functions.end(), [&](const auto& one) { return word == one.first; });
    if (function == functions.end())
      refuse("there is no function " + word,
             "there are sqrt exp log abs sin cos tan min max; a product is written with *");
    expect('(');
    const int left = sum();
    int right = -1;
    if (function->second == Op::min || function->second == Op::max) {
      expect(',');
      right = sum();
    }
    expect(')');
    return add({.op = function->second, .left = left, .right = right});
  }

  Equation equation_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Equation Equation::parse(const std::string& text, const input::Location& where) {
  return EquationParser(text, where).parse();
}

std::vector<std::string> Equation::symbols() const {
  std::vector<std::string> names;
  for (const Node& node : nodes_)
    if (node.op == Op::symbol && std::find(names.begin(), names.end(), node.symbol) == names.end())
      names.push_back(node.symbol);
  return names;
}

double Equation::value(const std::function<double(const std::string&)>& number_of) const {
  std::vector<double> values(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const double a = node.left >= 0 ? values[static_cast<std::size_t>(node.left)] : 0.0,
                 b = node.right >= 0 ? values[static_cast<std::size_t>(node.right)] : 0.0;
    switch (node.op) {
      case Op::number:
        values[n] = node.number;
        break;
      case Op::symbol:
        values[n] = number_of(node.symbol);
        break;
      case Op::negative:
        values[n] = -a;
        break;
      case Op::add:
        values[n] = a + b;
        break;
      case Op::subtract:
        values[n] = a - b;
        break;
      case Op::multiply:
        values[n] = a * b;
        break;
      case Op::divide:
        values[n] = a / b;
        break;
      case Op::power:
        values[n] = std::pow(a, b);
        break;
      case Op::sqrt:
        values[n] = std::sqrt(a);
        break;
      case Op::exp:
        values[n] = std::exp(a);
        break;
      case Op::log:
        values[n] = std::log(a);
        break;
      case Op::abs:
        values[n] = std::abs(a);
        break;
      case Op::sin:
        values[n] = std::sin(a);
        break;
      case Op::cos:
        values[n] = std::cos(a);
        break;
      case Op::tan:
        values[n] = std::tan(a);
        break;
      case Op::min:
        values[n] = std::min(a, b);
        break;
      case Op::max:
        values[n] = std::max(a, b);
        break;
    }
  }
  return values.back();
}

void Equation::refuse(const Node& node, const std::string& found, const std::string& remedy) const {
  input::Location where = where_;
  where.column += node.column;
  throw input::InputError(
      where, "equation \"" + text_ + "\", up to character " + std::to_string(node.column) + ": " + found, remedy);
}

Dimension Equation::of_power(const Node& node, const Dimension& base, const Dimension& exponent) const {
  if (!exponent.is_number())
    refuse(node, "an exponent of the dimension " + exponent.text(), "an exponent is a plain number");
  if (base.is_number()) return {};
  const Node &power = nodes_[static_cast<std::size_t>(node.right)],
             *inner = power.op == Op::negative ? &nodes_[static_cast<std::size_t>(power.left)] : &power;
  if (inner->op != Op::number)
    refuse(node, base.text() + " to a power that is not written as a number",
           "write the exponent as a number, or divide the base by a reference");
  return base.to_the(power.op == Op::negative ? -inner->number : inner->number);
}

Dimension Equation::dimension(const std::function<Dimension(const std::string&)>& dimension_of) const {
  std::vector<Dimension> of(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const Dimension a = node.left >= 0 ? of[static_cast<std::size_t>(node.left)] : Dimension(),
                    b = node.right >= 0 ? of[static_cast<std::size_t>(node.right)] : Dimension();
    switch (node.op) {
      case Op::number:
        break;
      case Op::symbol:
        of[n] = dimension_of(node.symbol);
        break;
      case Op::negative:
      case Op::abs:
        of[n] = a;
        break;
      case Op::add:
      case Op::subtract:
      case Op::min:
      case Op::max:
        if (!a.same_as(b))
          refuse(node, a.text() + " and " + b.text() + " are added or compared", "both sides have one dimension");
        of[n] = a;
        break;
      case Op::multiply:
        of[n] = a.times(b);
        break;
      case Op::divide:
        of[n] = a.times(b, -1.0);
        break;
      case Op::power:
        of[n] = of_power(node, a, b);
        break;
      case Op::sqrt:
        of[n] = a.to_the(0.5);
        break;
      case Op::sin:
      case Op::cos:
      case Op::tan:
        if (!a.same_as(Dimension("rad")) && !a.is_number())
          refuse(node, "a sine of the dimension " + a.text(), "it takes an angle");
        break;
      case Op::exp:
      case Op::log:
        if (!a.is_number())
          refuse(node, "an exponential or logarithm of the dimension " + a.text(),
                 "divide by a reference of this dimension");
        break;
    }
  }
  return of.back();
}

}  // namespace snug::materials
