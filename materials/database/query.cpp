#include "materials/database/query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/suggestion.hpp"
#include "materials/database/equation.hpp"
#include "materials/database/items.hpp"

namespace snug::materials {

namespace {

constexpr std::size_t longest = 4000, most_comparisons = 100;
constexpr int deepest_query = 50;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

/// Escapes what LIKE takes for a pattern.
std::string like_text(const std::string& text) {
  std::string pattern = "%";
  for (const char c : text) {
    if (c == '%' || c == '_' || c == '\\') pattern += '\\';
    pattern += c;
  }
  return pattern + "%";
}

class QuestionParser {
 public:
  QuestionParser(const std::string& text, UnitBook& units, const ItemUnit& unit_of,
                 const std::vector<std::string>& known)
      : text_(text), units_(units), unit_of_(unit_of), known_(known) {}

  Condition parse() {
    if (text_.size() > longest)
      refuse(fmt::format("a question of {} characters", text_.size()), fmt::format("at most {} are read", longest));
    condition_.sql = any();
    if (next() != '\0')
      refuse("\"" + text_.substr(at_, 20) + "\" where the question should end",
             "join comparisons by and, or; parentheses go in pairs");
    return std::move(condition_);
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& remedy) const {
    throw input::InputError({"question", 1, static_cast<int>(at_) + 1}, found, remedy);
  }
  char next() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  /// A word of the language that stands alone.
  bool is_word(const std::string& word, std::size_t at) const {
    const std::size_t end = at + word.size();
    return text_.compare(at, word.size(), word) == 0 &&
           (end >= text_.size() || is_blank(text_[end]) || text_[end] == '(' || text_[end] == ')');
  }
  bool take_word(const std::string& word) {
    next();
    if (!is_word(word, at_)) return false;
    at_ += word.size();
    return true;
  }
  std::string place(std::variant<double, std::string> value) {
    condition_.places.push_back(std::move(value));
    return fmt::format("?{}", condition_.places.size());
  }

  std::string any() {
    if (++depth_ > deepest_query) refuse(fmt::format("nested more than {} deep", deepest_query), "ask for less at once");
    const std::size_t bounds = condition_.bounds.size();
    std::string sql = all();
    while (take_word("or")) {
      sql = "(" + sql + " OR " + all() + ")";
      condition_.bounds.resize(bounds);
    }
    --depth_;
    return sql;
  }
  std::string all() {
    std::string sql = part();
    while (take_word("and")) sql = "(" + sql + " AND " + part() + ")";
    return sql;
  }
  std::string part() {
    if (++depth_ > deepest_query) refuse(fmt::format("nested more than {} deep", deepest_query), "ask for less at once");
    std::string sql;
    if (take_word("not")) {
      const std::size_t bounds = condition_.bounds.size();
      sql = "NOT " + part();
      condition_.bounds.resize(bounds);
    } else if (next() == '(') {
      ++at_;
      sql = any();
      if (next() != ')') refuse("a ) is missing", "write it");
      ++at_;
    } else {
      sql = comparison();
    }
    --depth_;
    return sql;
  }

  std::string comparison() {
    if (++comparisons_ > most_comparisons)
      refuse(fmt::format("more than {} comparisons", most_comparisons), "ask for less at once");
    if (take_word("has"))
      return "EXISTS (SELECT 1 FROM datum WHERE entity = e.number AND +name = " + place(item()) + ")";
    next();
    const std::size_t begin = at_;
    const std::string name = word("an item");
    const std::string sign = comparison_sign();
    if (name == "id" || name == "kind" || name == "parent") return of_entity(name, sign);
    const std::string known = known_item(name, begin);
    const auto unit = unit_of_(known);
    return unit == "text" ? of_text(known, sign) : of_number(known, sign, *unit);
  }
  std::string item() {
    next();
    const std::size_t begin = at_;
    return known_item(word("an item"), begin);
  }
  /// The name of an item that is in the library, by its name or symbol.
  std::string known_item(const std::string& name, std::size_t begin) {
    if (unit_of_(name)) return name;
    const Item* usual = usual_symbol(name);
    if (usual && unit_of_(usual->name)) return usual->name;
    at_ = begin;
    refuse("no entity has the item \"" + name + "\"", input::did_you_mean(name, known_));
  }

  /// Up to a sign, or in double quotes.
  std::string word(const std::string& what) {
    const char first = next();
    if (first == '"') return quoted();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) &&
           std::string("<>=!~()\"").find(text_[at_]) == std::string::npos)
      ++at_;
    if (at_ == begin)
      refuse(first == '\0' ? fmt::format("the question ends where {} should stand", what)
                           : fmt::format("\"{}\" where {} should stand", first, what),
             "write, for instance, weight < 250 g/m2");
    return text_.substr(begin, at_ - begin);
  }
  std::string quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == text_.npos) refuse("a text whose quote is not closed", "write the \" at its end");
    std::string result = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return result;
  }
  std::string comparison_sign() {
    next();
    for (const char* sign : {"<=", ">=", "!=", "<", ">", "=", "~"})
      if (text_.compare(at_, std::string(sign).size(), sign) == 0) {
        at_ += std::string(sign).size();
        if (std::string(sign) == "=" && at_ < text_.size() && text_[at_] == '=') ++at_;
        return sign;
      }
    refuse("no comparison behind the item",
           "write < <= > >= = != or ~ (holds the text), names with blanks in \"quotes\"");
  }
  /// What is compared with: a text in quotes, or everything up to "and", "or" or a parenthesis that was not opened in
  /// it.
  std::string operand() {
    if (next() == '"') return quoted();
    const std::size_t begin = at_;
    int open = 0;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '(') ++open;
      if (text_[at_] == ')' && --open < 0) break;
      if (at_ > begin && is_blank(text_[at_ - 1]) && (is_word("and", at_) || is_word("or", at_))) break;
    }
    std::string result = text_.substr(begin, at_ - begin);
    result.erase(result.find_last_not_of(" \t\n") + 1);
    if (result.empty()) refuse("nothing to compare with", "write a number with its unit, or a text");
    return result;
  }

  /// Entities whose first datum of an item is so (`test` begins with its name); looked for by an index where it bounds
  /// the answers.
  std::string with_datum(const std::string& test) {
    condition_.bounds.push_back("SELECT entity FROM datum WHERE " + test);
    return "EXISTS (SELECT 1 FROM datum WHERE entity = e.number AND +" + test +
           ")";  // + : by the entity, not by the index of the item
  }
  std::string of_entity(const std::string& name, const std::string& sign) {
    if (sign != "=" && sign != "!=" && sign != "~") refuse("the " + name + " is a text", "compare it by =, != or ~");
    const std::string column = name == "parent" ? "(SELECT p.id FROM entity p WHERE p.number = e.parent)" : "e." + name;
    const std::string value = operand();
    return sign == "~" ? column + " LIKE " + place(like_text(value)) + " ESCAPE '\\'"
                       : column + " " + sign + " " + place(value);
  }
  std::string of_text(const std::string& name, const std::string& sign) {
    if (sign != "=" && sign != "!=" && sign != "~")
      refuse(name + " is a text", "compare it by =, != or ~ (holds the text)");
    const std::string item = place(name), value = operand();
    const std::string test =
        sign == "~" ? "value LIKE " + place(like_text(value)) + " ESCAPE '\\'" : "value " + sign + " " + place(value);
    return with_datum("name = " + item + " AND first = 1 AND si IS NULL AND " + test);
  }
  std::string of_number(const std::string& name, const std::string& sign, const std::string& si_unit) {
    next();
    const std::size_t begin = at_;
    const std::string text = operand(), example = name + " " + sign + " 1" + (si_unit.empty() ? "" : " " + si_unit);
    const auto fail = [&](const std::string& found) {
      at_ = begin;
      refuse(found, "write a number with its unit, e.g. " + example);
    };
    if (sign == "~") fail(name + " is a number");
    const auto printed = printed_quantity(text, units_);
    if (!printed || !printed->uncertainty.empty()) fail("\"" + text + "\" is no number with a unit");
    const auto unit = units_.find(printed->unit);
    if (!Dimension(unit->name).same_as(Dimension(si_unit)))
      fail("\"" + text + "\" " + (printed->unit.empty() ? "has no unit" : "is of another dimension") + ", " + name +
           (si_unit.empty() ? " is a plain number" : " comes in " + si_unit));
    const double value = *plain_number(printed->number) * unit->factor;
    const std::string item = place(name);
    return with_datum("name = " + item + " AND first = 1 AND si IS NOT NULL AND si " + range_of(sign, value));
  }

  /// 250 g/m2 and 0.25 kg/m2 are the same, whatever the last bit of the conversion says.
  std::string range_of(const std::string& sign, double value) {
    const double margin = 1e-12 * std::abs(value), low = value - margin, high = value + margin;
    if (sign == "=" || sign == "!=") {
      const std::string from = place(low);
      return std::string(sign == "=" ? "" : "NOT ") + "BETWEEN " + from + " AND " + place(high);
    }
    return sign + " " + place(sign == "<" || sign == ">=" ? low : high);
  }

  const std::string& text_;
  UnitBook& units_;
  const ItemUnit& unit_of_;
  const std::vector<std::string>& known_;
  Condition condition_;
  std::size_t at_ = 0, comparisons_ = 0;
  int depth_ = 0;
};

}  // namespace

Condition parse_question(const std::string& question, UnitBook& units, const ItemUnit& unit_of,
                         const std::vector<std::string>& known_items) {
  return QuestionParser(question, units, unit_of, known_items).parse();
}

}  // namespace snug::materials
