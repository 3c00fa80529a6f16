// Parameters, loops and conditions of APDL texts: evaluated, and nothing else; no file, program or picture is reached from here.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

/// Runs what steers the text itself: NAME=value, *SET, *DO and *ENDDO, *IF, *ELSEIF, *ELSE and *ENDIF. Values are numbers, or
/// texts in quotes. What depends on something that is not known here (*GET, arrays) is reported where it is used.
class ApdlScript {
 public:
  /// True when the command was one of the script, or is passed over by a condition. Loops put `source` back to their first line.
  bool take(const FieldLine& line, LineSource& source);
  /// The fields with the values of parameters and expressions; they live until the next call.
  std::vector<TextField> evaluated(const std::vector<TextField>& fields);
  /// Reports conditions and loops without an end.
  void finish(const std::string& file, input::Diagnostics& diagnostics) const;

 private:
  struct Loop {
    std::string name;
    double value, last, step;
    LineSource begin;
    std::size_t conditions;  ///< open when it began
    int line;
  };
  struct Condition {
    bool met;    ///< one of its branches has been taken
    bool taken;  ///< the present branch
    bool within; ///< lines around are taken
    int line;
  };
  bool skipping() const { return skipped_loops_ > 0 || (!conditions_.empty() && !conditions_.back().taken); }
  void assign(const FieldLine& line, std::string name, std::string_view value, std::size_t field);
  void begin_condition(const FieldLine& line);
  void otherwise(const FieldLine& line, bool with_test);
  void begin_loop(const FieldLine& line, const LineSource& source);
  void end_loop(const FieldLine& line, LineSource& source);
  bool test(const FieldLine& line);
  std::optional<double> value_of(std::string_view text) const;

  std::map<std::string, double> numbers_;
  std::map<std::string, std::string> texts_;
  std::vector<Condition> conditions_;
  std::vector<Loop> loops_;
  int skipped_loops_ = 0;  ///< nested ones that do not run
  long turns_ = 0;
  std::deque<std::string> kept_;
};

/// The value of an arithmetic expression: + - * / **, parentheses, and SIN COS TAN ASIN ACOS ATAN (radians) SQRT ABS EXP LOG LOG10 NINT.
/// Nothing where it is none, or names what `names` does not have.
std::optional<double> apdl_value(std::string_view expression, const std::map<std::string, double>& names);

}  // namespace snug::mesh
