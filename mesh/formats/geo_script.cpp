#include "mesh/formats/geo_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "mesh/formats/geo_words.hpp"

namespace snug::mesh {

namespace {

constexpr double most_turns = 1e6;  ///< of loops inside one another
constexpr std::size_t most_words = 1'000'000, most_loops = 500, longest_print = 1000;

const char* const scripts_remedy =
    "write the geometry without it, give a mesh (.msh), or say --allow-scripts when you trust the file and all it may do";

/// The numbers that single assignments `name = number` give; of a name that is assigned twice nothing is known.
class Numbers {
 public:
  void assign(const std::string& name, std::optional<double> value) {
    const auto [place, fresh] = values_.emplace(name, value);
    if (!fresh) place->second.reset();
  }
  std::optional<double> of(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? std::nullopt : found->second;
  }

 private:
  std::map<std::string, std::optional<double>> values_;
};

/// Sums, products and parentheses of numbers and names; nothing where there is more.
class Expression {
 public:
  Expression(const std::vector<GeoToken>& tokens, std::size_t begin, std::size_t end, const Numbers& numbers)
      : tokens_(tokens), at_(begin), end_(end), numbers_(numbers) {}
  std::optional<double> value() {
    const auto sum = read_sum(0);
    return at_ == end_ ? sum : std::nullopt;
  }

 private:
  bool is(const char* sign) const { return at_ < end_ && tokens_[at_].kind == GeoWord::sign && tokens_[at_].text == sign; }

  std::optional<double> read_sum(int depth) {
    auto sum = read_product(depth);
    while (sum && (is("+") || is("-"))) {
      const bool minus = is("-");
      ++at_;
      const auto next = read_product(depth);
      sum = next ? std::optional(minus ? *sum - *next : *sum + *next) : std::nullopt;
    }
    return sum;
  }
  std::optional<double> read_product(int depth) {
    auto product = read_factor(depth);
    while (product && (is("*") || is("/"))) {
      const bool over = is("/");
      ++at_;
      const auto next = read_factor(depth);
      product = next ? std::optional(over ? *product / *next : *product * *next) : std::nullopt;
    }
    return product;
  }
  std::optional<double> read_factor(int depth) {
    if (at_ >= end_ || depth > 50) return std::nullopt;
    if (is("-") || is("+")) {
      const double sign = is("-") ? -1.0 : 1.0;
      ++at_;
      const auto value = read_factor(depth + 1);
      return value ? std::optional(sign * *value) : std::nullopt;
    }
    if (is("(")) {
      ++at_;
      const auto value = read_sum(depth + 1);
      if (!is(")")) return std::nullopt;
      ++at_;
      return value;
    }
    const GeoToken& token = tokens_[at_++];
    if (token.kind == GeoWord::name) return numbers_.of(token.text);
    double number = 0.0;
    const auto [rest, fault] = std::from_chars(token.text.data(), token.text.data() + token.text.size(), number);
    return token.kind == GeoWord::number && fault == std::errc{} ? std::optional(number) : std::nullopt;
  }

  const std::vector<GeoToken>& tokens_;
  std::size_t at_, end_;
  const Numbers& numbers_;
};

class Check {
 public:
  Check(const std::vector<GeoToken>& tokens, const std::string& file) : tokens_(tokens), file_(file) {
    match_brackets();
    for (std::size_t t = 0; t < tokens_.size(); ++t)
      if (tokens_[t].kind == GeoWord::name) note_assignment(t);
  }

  void operator()() {
    for (std::size_t t = 0; t < tokens_.size(); ++t)
      if (tokens_[t].kind == GeoWord::name) check_name(t);
  }

 private:
  bool is(std::size_t t, const char* text) const {
    return t < tokens_.size() && tokens_[t].kind != GeoWord::text && tokens_[t].text == text;
  }
  bool is_a(std::size_t t, GeoWord kind) const { return t < tokens_.size() && tokens_[t].kind == kind; }
  input::Location place(std::size_t t) const { return {file_, tokens_[t].line, tokens_[t].column}; }
  [[noreturn]] void refuse(std::size_t t, const std::string& found, const std::string& remedy = scripts_remedy) const {
    throw input::InputError(place(t), found, remedy);
  }

  /// For every word the place behind the bracket that it opens, and the end of its statement; both in one go, because a script
  /// may hold a bracket in a bracket many times over.
  void match_brackets() {
    behind_.resize(tokens_.size());
    end_.resize(tokens_.size());
    std::vector<std::size_t> open;
    for (std::size_t t = 0; t < tokens_.size(); ++t) {
      behind_[t] = t + 1;
      if (is(t, "(") || is(t, "[") || is(t, "{")) open.push_back(t);
      if (open.empty() || !(is(t, ")") || is(t, "]") || is(t, "}"))) continue;
      behind_[open.back()] = t + 1;
      open.pop_back();
    }
    for (const std::size_t t : open) behind_[t] = tokens_.size();
    for (std::size_t t = tokens_.size(), end = t; t-- > 0; end_[t] = end)
      if (is(t, ";") || is(t, ",")) end = t;
  }
  std::size_t behind_bracket(std::size_t t) const { return t < tokens_.size() ? behind_[t] : t; }
  std::size_t end_of_statement(std::size_t t) const { return t < tokens_.size() ? end_[t] : t; }

  /// name = …, name() = …, name[i] += …, name++, For name In, Macro name.
  void note_assignment(std::size_t t) {
    if (t > 0 && (is(t - 1, "Macro") || is(t - 1, "Function") || is(t - 1, "For"))) assigned_.insert(tokens_[t].text);
    std::size_t next = t + 1;
    while (is(next, "~")) next = behind_bracket(next + 1);  // name~{number}
    const bool list = is(next, "(") || is(next, "[");
    if (list) next = behind_bracket(next);
    const bool plain = is(next, "=") && !is(next + 1, "=");
    const bool changed = (is(next, "+") || is(next, "-") || is(next, "*") || is(next, "/")) && (is(next + 1, "=") || is(next + 1, tokens_[next].text.c_str()));
    if (!plain && !changed) return;
    assigned_.insert(tokens_[t].text);
    numbers_.assign(tokens_[t].text, plain && !list ? Expression(tokens_, next + 1, end_of_statement(next + 1), numbers_).value() : std::nullopt);
    changed_at_.push_back(t);
  }

  void check_name(std::size_t t) {
    const std::string& name = tokens_[t].text;
    if (reaches_outside(name)) refuse(t, fmt::format("the gmsh command {} is not admitted in a mesh", name));
    if (t > 0 && is(t - 1, ".")) return check_option(t);
    if (name == "Printf" || name == "Error" || name == "Warning") return check_print(t);
    if (name == "General" && is(t + 1, ".")) return;  // its option is looked at
    if (name == "For") return check_loop(t);
    if (name == "Macro" || name == "Function") return begin_macro(t);
    if (name == "Return") return end_macro(t);
    if (name == "Call") return check_call(t);
    if (is_geometry_command(name) || macros_.count(name) || name == open_macro_) return;
    if (!assigned_.count(name))
      refuse(t, fmt::format("{} is no command that is admitted in a mesh, and the script gives it no value", name));
    if (is_a(t + 1, GeoWord::text) || is_a(t + 1, GeoWord::name)) {
      const bool header = is(t + 1, "In");
      if (!header) refuse(t, fmt::format("{} is no command that is admitted in a mesh", name));
    }
  }

  /// Mesh.X, Geometry.X, Field[1].X; of General only what the program says.
  void check_option(std::size_t t) {
    const std::string& name = tokens_[t].text;
    const bool general = t > 1 && is(t - 2, "General");
    const bool quiet = name == "Terminal" || name == "Verbosity" || name == "NumThreads" || name == "ExpertMode";
    if (general && !quiet) refuse(t, fmt::format("the gmsh option General.{} is not admitted in a mesh", name));
    if (name.find("File") != std::string::npos || name.find("Command") != std::string::npos || name.find("Path") != std::string::npos)
      refuse(t, fmt::format("the gmsh option {} is not admitted in a mesh", name));
  }

  void check_print(std::size_t t) {
    for (std::size_t n = t; n < tokens_.size() && !is(n, ";"); ++n)
      if (is(n, ">") || n > t + longest_print) refuse(t, fmt::format("{} into a file is not admitted in a mesh", tokens_[t].text));
  }

  /// For i In {from : to : step} or For (from : to : step).
  void check_loop(std::size_t t) {
    if (++loop_count_ > most_loops) refuse(t, fmt::format("more than {} loops", most_loops), "give a mesh (.msh) instead");
    const bool named = is_a(t + 1, GeoWord::name);
    const std::size_t open = named ? t + 3 : t + 1, close = std::max(open + 1, behind_bracket(open)) - 1;
    std::vector<std::optional<double>> bounds;
    for (std::size_t begin = open + 1; begin < close;) {
      std::size_t end = begin;
      while (end < close && !is(end, ":")) ++end;
      bounds.push_back(Expression(tokens_, begin, end, numbers_).value());
      begin = end + 1;
    }
    const double turns = turns_of(bounds);
    if (!(turns <= most_turns)) refuse(t, "a loop that does not end, or not in a million turns", "give it bounds and a step that end it");
    std::size_t end = t;
    int depth = 0;
    for (; end < tokens_.size(); ++end) {
      depth += is(end, "For");
      if (is(end, "EndFor") && --depth == 0) break;
    }
    for (const std::size_t change : changed_at_)
      if (named && change > close && change < end && tokens_[change].text == tokens_[t + 1].text)
        refuse(change, fmt::format("{} is changed inside the loop over it, which may then never end", tokens_[change].text), "use another name");
    check_nested(t, end, turns);
  }

  static double turns_of(const std::vector<std::optional<double>>& bounds) {
    if (bounds.size() < 2) return 1.0;
    const double step = bounds.size() > 2 ? bounds[2].value_or(1.0) : 1.0;
    if (step == 0.0) return most_turns * 10.0;
    if (!bounds[0] || !bounds[1]) return 1.0;
    const double turns = (*bounds[1] - *bounds[0]) / step + 1.0;
    return turns > 0.0 || turns != turns ? turns : 1.0;
  }

  void check_nested(std::size_t begin, std::size_t end, double turns) {
    while (!loops_.empty() && loops_.back().first < begin) loops_.pop_back();
    const double outer = loops_.empty() ? 1.0 : loops_.back().second;
    if (!(outer * turns <= most_turns)) refuse(begin, "loops inside one another that take more than a million turns", "give them bounds that end them");
    loops_.emplace_back(end, outer * turns);
  }

  /// A macro may call those that stand whole before it; none then calls itself, by whatever detour.
  void begin_macro(std::size_t t) {
    if (!is_a(t + 1, GeoWord::name) && !is_a(t + 1, GeoWord::text)) refuse(t, "a macro without a name", "name it");
    if (!open_macro_.empty() || macros_.count(tokens_[t + 1].text)) refuse(t, "a macro inside a macro, or one defined twice", "define each once");
    open_macro_ = tokens_[t + 1].text;
  }
  void end_macro(std::size_t t) {
    if (open_macro_.empty()) refuse(t, "Return outside a macro", "leave it out");
    macros_.insert(open_macro_);
    open_macro_.clear();
  }
  void check_call(std::size_t t) {
    if (!is_a(t + 1, GeoWord::name) && !is_a(t + 1, GeoWord::text)) refuse(t, "Call without the name of a macro", "name it");
    if (!macros_.count(tokens_[t + 1].text)) refuse(t, fmt::format("Call {} where no macro of that name stands whole before it", tokens_[t + 1].text), "define it before; a macro may not call itself");
  }

  const std::vector<GeoToken>& tokens_;
  const std::string& file_;
  std::vector<std::size_t> behind_, end_;
  std::size_t loop_count_ = 0;
  std::set<std::string> assigned_, macros_;
  std::string open_macro_;
  Numbers numbers_;
  std::vector<std::size_t> changed_at_;
  std::vector<std::pair<std::size_t, double>> loops_;  ///< where the open loops end, and their turns together
};

/// Words at their places again, blanks between them.
std::string written(const std::vector<GeoToken>& tokens) {
  std::string text;
  int line = 1, column = 1;
  for (const GeoToken& token : tokens) {
    for (; line < token.line; ++line, column = 1) text += '\n';
    for (; column < token.column; ++column) text += ' ';
    const std::string word = token.kind == GeoWord::text ? '"' + token.text + '"' : token.text;
    text += word;
    column += static_cast<int>(word.size());
  }
  return text + '\n';
}

}  // namespace

std::string checked_script(const std::string& text, const std::string& file) {
  const std::vector<GeoToken> tokens = geo_tokens(text, file);
  if (tokens.size() > most_words)
    throw input::InputError({file, 0, 0}, fmt::format("the script has more than {} words", most_words), "give a mesh (.msh) instead");
  Check(tokens, file)();
  return written(tokens);
}

}  // namespace snug::mesh
