// Expressions of symbols: "2*(eps_a/eps)*(eps_f*delta/R_f)". The parser is our own because the dimension of every node
// is looked at, for which a tree is needed; parsers of the usual libraries (muParser) keep a program of numbers.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::materials {

/// A product of powers of units of the SI, as udunits compares them: {"N/m": 1, "m": -2}. Empty: a plain number.
class Dimension {
 public:
  Dimension() = default;
  explicit Dimension(const std::string& si_unit) {
    if (!si_unit.empty()) powers_[si_unit] = 1.0;
  }
  Dimension times(const Dimension& other, double exponent = 1.0) const;
  Dimension to_the(double exponent) const { return Dimension().times(*this, exponent); }
  bool same_as(const Dimension& other) const;
  bool is_number() const { return same_as({}); }
  /// "N/m / m^2", "1"
  std::string text() const;

 private:
  std::map<std::string, double> powers_;  // none is zero
};

/// + - * / ^ ( ), numbers, symbols (letters, digits, _ and ' behind the first), pi, sqrt exp log abs sin cos tan min
/// max. Nothing else can be said: no assignment, no file, no loop. At most 2,000 characters, 500 numbers and symbols,
/// nested 50 deep.
class Equation {
 public:
  /// Throws input::InputError; the column counts within the expression behind that of `where`.
  static Equation parse(const std::string& text, const input::Location& where);

  /// Each once, in the order of the text.
  std::vector<std::string> symbols() const;
  /// In SI; not a number where a root, a logarithm or a quotient has none. `number_of`: of a symbol.
  double value(const std::function<double(const std::string&)>& number_of) const;
  /// Throws input::InputError where unlike things are added or compared, where an exponent has a dimension or is no
  /// number though its base has a dimension, and where a function takes plain numbers only.
  Dimension dimension(const std::function<Dimension(const std::string&)>& dimension_of) const;

 private:
  friend class EquationParser;
  enum class Op {
    number,
    symbol,
    negative,
    add,
    subtract,
    multiply,
    divide,
    power,
    sqrt,
    exp,
    log,
    abs,
    sin,
    cos,
    tan,
    min,
    max
  };
  struct Node {
    Op op;
    double number = 0.0;
    std::string symbol = {};
    int left = -1, right = -1;
    int column = 0;
  };
  [[noreturn]] void refuse(const Node& node, const std::string& found, const std::string& remedy) const;
  Dimension of_power(const Node& node, const Dimension& base, const Dimension& exponent) const;

  std::string text_;
  input::Location where_;
  std::vector<Node> nodes_;  // operands before what takes them; the last is the whole
};

}  // namespace snug::materials
