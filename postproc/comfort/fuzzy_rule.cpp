#include "postproc/comfort/fuzzy_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace snug::postproc {
namespace {

using Kind = Condition::Kind;

std::vector<std::string> words_of(const std::string& text) {
  std::string spaced;
  for (const char c : text) spaced += c == '(' || c == ')' ? fmt::format(" {} ", c) : std::string(1, c);
  std::istringstream stream(spaced);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Recursive descent over the words of one rule.
class RuleParser {
 public:
  explicit RuleParser(const std::string& text) : text_(text), words_(words_of(text)) {}

  FuzzyRule rule() {
    FuzzyRule rule;
    expect("if");
    rule.condition = disjunction();
    expect("then");
    rule.output = name();
    expect("is");
    rule.term = name();
    if (peek() == "with") {
      next();
      rule.weight = number();
    }
    if (at_ < words_.size()) fail();
    return rule;
  }

 private:
  Condition disjunction() { return joined(Kind::disjunction, "or", &RuleParser::conjunction); }
  Condition conjunction() { return joined(Kind::conjunction, "and", &RuleParser::primary); }

  Condition joined(Kind kind, const char* word, Condition (RuleParser::*part)()) {
    Condition whole{.kind = kind, .parts = {(this->*part)()}};
    while (peek() == word) {
      next();
      whole.parts.push_back((this->*part)());
    }
    return whole.parts.size() == 1 ? Condition(whole.parts.front()) : whole;
  }

  Condition primary() {
    if (peek() == "(") {
      if (++depth_ > 100) fail();
      next();
      Condition inner = disjunction();
      expect(")");
      --depth_;
      return inner;
    }
    Condition proposition{.variable = name()};
    expect("is");
    proposition.term = name();
    while (at_ < words_.size() && !ends_a_proposition(peek())) {
      proposition.hedges.push_back(proposition.term);
      proposition.term = name();
    }
    return proposition;
  }

  static bool ends_a_proposition(const std::string& word) {
    return word == "and" || word == "or" || word == "then" || word == ")";
  }
  std::string peek() const { return at_ < words_.size() ? words_[at_] : std::string(); }
  std::string next() {
    if (at_ >= words_.size()) fail();
    return words_[at_++];
  }
  std::string name() {
    const std::string word = next();
    if (word == "(" || word == ")" || word == "if" || word == "is" || word == "then" || word == "and" || word == "or")
      fail();
    return word;
  }
  double number() {
    const std::string word = next();
    std::size_t used = 0;
    double value = 0.0;
    try {
      value = std::stod(word, &used);
    } catch (const std::logic_error&) {
      fail();
    }
    if (used != word.size()) fail();
    return value;
  }
  void expect(const std::string& word) {
    if (next() != word) fail();
  }
  [[noreturn]] void fail() const {
    throw std::invalid_argument("the rule \"" + text_ + "\" is not \"if INPUT is TERM and ... then OUTPUT is TERM\"");
  }

  const std::string& text_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

std::string text_of(const Condition& condition, bool inside) {
  if (condition.kind == Kind::proposition) {
    std::string text = condition.variable + " is ";
    for (const std::string& hedge : condition.hedges) text += hedge + " ";
    return text + condition.term;
  }
  std::string text;
  for (const Condition& part : condition.parts) {
    if (!text.empty()) text += condition.kind == Kind::conjunction ? " and " : " or ";
    text += text_of(part, true);
  }
  return inside ? "(" + text + ")" : text;
}

std::optional<Condition> kept(const Condition& condition, const std::vector<std::string>& present) {
  if (condition.kind == Kind::proposition) {
    if (std::find(present.begin(), present.end(), condition.variable) == present.end()) return std::nullopt;
    return condition;
  }
  Condition rest{.kind = condition.kind};
  for (const Condition& part : condition.parts)
    if (auto left = kept(part, present)) rest.parts.push_back(std::move(*left));
  if (rest.parts.empty()) return std::nullopt;
  return rest.parts.size() == 1 ? Condition(rest.parts.front()) : rest;
}

// ---- in words

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// "a", "a or b", "a, b or c"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

/// A condition on one variable as its name and the terms that may hold.
struct Choice {
  std::string variable;
  std::vector<std::string> terms;
};

std::optional<Choice> as_choice(const Condition& condition) {
  if (condition.kind == Kind::proposition) {
    std::string term;
    for (const std::string& hedge : condition.hedges) term += hedge + " ";
    return Choice{condition.variable, {term + spoken(condition.term)}};
  }
  if (condition.kind != Kind::disjunction) return std::nullopt;
  Choice all;
  for (const Condition& part : condition.parts) {
    const auto one = as_choice(part);
    if (!one || (!all.variable.empty() && one->variable != all.variable)) return std::nullopt;
    all.variable = one->variable;
    all.terms.insert(all.terms.end(), one->terms.begin(), one->terms.end());
  }
  return all;
}

/// "every location is ..." when the parts say the same of all inputs.
std::optional<std::string> of_every_input(const Condition& condition, const FuzzySystem& system) {
  if (condition.kind != Kind::conjunction || condition.parts.size() != system.inputs.size()) return std::nullopt;
  std::vector<std::string> seen, terms;
  for (const Condition& part : condition.parts) {
    const auto choice = as_choice(part);
    if (!choice || (!terms.empty() && choice->terms != terms)) return std::nullopt;
    if (std::find(seen.begin(), seen.end(), choice->variable) != seen.end()) return std::nullopt;
    seen.push_back(choice->variable);
    terms = choice->terms;
  }
  return "every location is " + listed(terms);
}

std::string in_words(const Condition& condition, const FuzzySystem& system, bool inside) {
  if (const auto choice = as_choice(condition)) return spoken(choice->variable) + " is " + listed(choice->terms);
  if (const auto every = of_every_input(condition, system)) return *every;
  std::string text;
  for (const Condition& part : condition.parts) {
    if (!text.empty()) text += condition.kind == Kind::conjunction ? " and " : " or ";
    text += in_words(part, system, true);
  }
  return inside ? "(" + text + ")" : text;
}

}  // namespace

FuzzyRule parse_rule(const std::string& text) { return RuleParser(text).rule(); }

std::string text_of(const FuzzyRule& rule) {
  std::string text = fmt::format("if {} then {} is {}", text_of(rule.condition, false), rule.output, rule.term);
  if (rule.weight != 1.0) text += fmt::format(" with {}", rule.weight);
  return text;
}

FuzzySystem restricted(const FuzzySystem& system, const std::vector<std::size_t>& present) {
  FuzzySystem rest = system;
  rest.inputs.clear();
  rest.rules.clear();
  std::vector<std::string> names;
  for (const std::size_t i : present) {
    rest.inputs.push_back(system.inputs.at(i));
    names.push_back(system.inputs[i].name);
  }
  for (const std::string& text : system.rules) {
    FuzzyRule rule = parse_rule(text);
    if (auto condition = kept(rule.condition, names)) {
      rule.condition = std::move(*condition);
      rest.rules.push_back(text_of(rule));
    }
  }
  return rest;
}

std::vector<std::vector<Condition>> alternatives(const Condition& condition, std::size_t most) {
  if (condition.kind == Kind::proposition) return {{condition}};
  std::vector<std::vector<Condition>> all;
  if (condition.kind == Kind::conjunction) all.push_back({});
  for (const Condition& part : condition.parts) {
    const auto choices = alternatives(part, most);
    if (condition.kind == Kind::disjunction) {
      all.insert(all.end(), choices.begin(), choices.end());
    } else {
      std::vector<std::vector<Condition>> product;
      for (const auto& before : all)
        for (const auto& choice : choices) {
          product.push_back(before);
          product.back().insert(product.back().end(), choice.begin(), choice.end());
          if (product.size() > most) break;
        }
      all = std::move(product);
    }
    if (all.size() > most) throw std::invalid_argument(fmt::format("a rule has more than {} alternatives", most));
  }
  return all;
}

std::string in_words(const FuzzyRule& rule, const FuzzySystem& system) {
  return fmt::format("if {} then the garment is {}", in_words(rule.condition, system, false), spoken(rule.term));
}

}  // namespace snug::postproc
