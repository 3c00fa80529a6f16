#include "postproc/listing_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <tuple>

#include "cases/input/files.hpp"
#include "cases/input/text.hpp"
#include "postproc/column_table.hpp"
#include "postproc/febio_log.hpp"
#include "postproc/frd_listing.hpp"
#include "postproc/listing_numbers.hpp"

namespace snug::postproc {
namespace {

constexpr std::string_view blanks = " \t\r\f\v";

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool starts(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

/// The whole number after `key`, as in "LOAD STEP=     1", or `otherwise`.
int number_after(std::string_view text, std::string_view key, int otherwise) {
  const auto place = text.find(key);
  if (place == text.npos) return otherwise;
  const std::string_view rest = input::trimmed(text.substr(place + key.size()));
  int value = otherwise;
  std::from_chars(rest.data(), rest.data() + rest.size(), value);
  return value;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file, input::Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics) {}

  std::vector<ListingTable> parse() {
    while (!text_.empty() && errors_ < most_listing_errors) {
      ++line_number_;
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      line_ = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      take(input::trimmed(line_));
    }
    close();
    return std::move(tables_);
  }

 private:
  enum class Mode { between, rows, extrema };

  /// Decides what a line is by its first character.
  void take(std::string_view line) {
    if (line.empty()) return;
    const char c = line.front();
    if (input::is_digit(c) || c == '+' || c == '-' || c == '.') return take_numbers(line);
    if (c == '*' && line.find_first_not_of("* \t") == line.npos) return take_numbers(line);
    if (pending() && scan_number(line).length > 0) return take_values(line);  // NaN on a continuation line
    if (!is_letter(c) && std::none_of(line.begin(), line.end(), is_letter)) return;
    take_text(line);
  }

  void take_text(std::string_view line) {
    if (starts(line, "NODE") && line.size() > 4 && blanks.find(line[4]) != blanks.npos) return take_node_line(line);
    if (mode_ == Mode::extrema && starts(line, "VALUE") && !starts(line, "VALUES"))
      return take_extreme_values(line.substr(5));
    if ((starts(line, "MINIMUM") || starts(line, "MAXIMUM")) && line.find("VALUES") != line.npos)
      return begin_extreme(line);
    mode_ = Mode::between;
    if (starts(line, "displacements (vx,vy,vz)")) return begin_calculix(line);
    if (starts(line, "PRINT ") || starts(line, "LIST ALL")) begin_listing(line);
    const auto post = line.find("POST1 ");
    const auto listing = line.find(" LISTING");
    if (post != line.npos && listing != line.npos && listing > post) kind_ = line.substr(post + 6, listing - post - 6);
    load_step_ = number_after(line, "LOAD STEP=", load_step_);
    substep_ = number_after(line, "SUBSTEP=", substep_);
    if (starts(line, "ELEMENT=")) element_ = number_after(line, "ELEMENT=", 0);
    if (line.find("NODAL RESULTS ARE") != line.npos) take_place(line);
    take_frame(line);
  }

  /// RSYS and DSYS: "... RESULTS ARE IN COORDINATE SYSTEM  1", "X,Y,Z VALUES ARE IN GLOBAL COORDINATES", "DSYS=  1".
  void take_frame(std::string_view line) {
    if (const int system = number_after(line, "DSYS=", 0); system != 0) frame_ = fmt::format("COORDINATE SYSTEM {}", system);
    const auto in = line.find(" ARE IN ");
    if (in == line.npos || (line.find("RESULTS") == line.npos && line.find("VALUES") == line.npos)) return;
    const std::string_view named = input::trimmed(line.substr(in + 8));
    const bool global = named.find("GLOBAL") != named.npos || (starts(named, "COORDINATE SYSTEM") && number_after(named, "COORDINATE SYSTEM", 0) == 0);
    if (named.find("COORDINATE") == named.npos) return;
    frame_ = global ? "" : fmt::format("{}", fmt::join(words_of(named), " "));
  }

  /// A new command: what earlier ones said about material, element and surface is over.
  void begin_listing(std::string_view line) {
    close();
    kind_ = starts(line, "LIST ALL") ? "NODES" : "";
    element_ = material_ = 0;
    frame_.clear();
    surface_ = ShellSurface::none;
    both_ = false;
  }

  /// "displacements (vx,vy,vz) for set ALL and time  0.1000000E+01": several sets at one time are one table.
  void begin_calculix(std::string_view line) {
    const auto place = line.find("and time");
    const std::string_view text = place == line.npos ? std::string_view() : input::trimmed(line.substr(place + 8));
    const double time = scan_number(text).value;
    if (load_step_ == 0 || time != time_) ++load_step_;
    time_ = time;
    kind_ = "NODAL DEGREE OF FREEDOM";
    frame_.clear();
    begin_rows({"UX", "UY", "UZ"});
  }

  void take_place(std::string_view line) {
    material_ = number_after(line, "MATERIAL", 0);
    both_ = line.find("TOP/BOTTOM") != line.npos;
    surface_ = line.find("AT TOP") != line.npos      ? ShellSurface::top
               : line.find("AT MID") != line.npos    ? ShellSurface::middle
               : line.find("AT BOTTOM") != line.npos ? ShellSurface::bottom
                                                     : ShellSurface::none;
  }

  /// NODE UX UY ... heads a table; NODE 1151 452 ... belongs to the extrema.
  void take_node_line(std::string_view line) {
    const std::vector<std::string> labels = words_of(line.substr(4));
    if (labels.empty()) return;
    if (is_letter(labels.front().front())) return begin_rows(labels);
    if (mode_ != Mode::extrema) return;
    extreme().nodes.clear();
    take_extreme_nodes(line.substr(4));
  }

  void begin_rows(const std::vector<std::string>& labels) {
    mode_ = Mode::rows;
    if (!tables_.empty()) {
      const ListingTable& open = tables_.back();
      if (!open.closed && open.kind == kind_ && open.labels == labels && open.load_step == load_step_ &&
          open.substep == substep_ && open.frame == frame_)
        return;
    }
    close();
    ListingTable& table = tables_.emplace_back();
    table.kind = kind_;
    table.labels = labels;
    table.load_step = load_step_;
    table.frame = frame_;
    table.substep = substep_;
    seen_.clear();
  }

  void begin_extreme(std::string_view line) {
    if (tables_.empty()) return;
    check_complete();
    tables_.back().closed = true;
    mode_ = Mode::extrema;
    tables_.back().extrema.push_back({std::string(input::trimmed(line.substr(0, line.find("VALUES")))), {}, {}});
  }

  ListingExtreme& extreme() { return tables_.back().extrema.back(); }

  void take_extreme_nodes(std::string_view line) {
    for (line = input::trimmed(line); !line.empty(); line = input::trimmed(line)) {
      int node = 0;
      const auto result = std::from_chars(line.data(), line.data() + line.size(), node);
      if (result.ec != std::errc()) return error(line, "a node number is expected here", "give whole numbers");
      extreme().nodes.push_back(node);
      line.remove_prefix(result.ptr - line.data());
    }
  }

  void take_extreme_values(std::string_view line) {
    ListingExtreme& to = extreme();
    if (!scan_values(line, to.values)) return;
    if (to.values.size() > tables_.back().labels.size())
      error(line,
            fmt::format("{} values where the head names {} columns", to.values.size(), tables_.back().labels.size()),
            "give one value a column");
  }

  /// A line that begins with a number: a row, the continuation of one, or dots for rows left out.
  void take_numbers(std::string_view line) {
    if (line.find_first_not_of(". \t\r") == line.npos) {
      if (mode_ == Mode::rows && line.size() > 1) tables_.back().rows_left_out = true;
      return;
    }
    const ListingNumber first = scan_number(line);
    if (mode_ == Mode::extrema && !first.integer && extreme().values.size() < tables_.back().labels.size())
      return take_extreme_values(line);
    if (mode_ == Mode::extrema && first.integer && extreme().nodes.size() < tables_.back().labels.size())
      return take_extreme_nodes(line);
    if (mode_ != Mode::rows) return check_stray(line, first);
    if (first.integer && first.length == line.size()) return;  // the mark of a page
    if (first.integer) return take_row(line, first.length);
    if (pending()) return take_values(line);
    error(line, "values without a node number", "begin the row with the number of its node, or delete the line");
  }

  void take_row(std::string_view line, std::size_t length) {
    const std::string_view rest = line.substr(length);
    const std::string_view value = input::trimmed(rest);
    const bool separate = blanks.find(rest.front()) != blanks.npos || rest.front() == '-' || rest.front() == '+';
    if (!separate || (is_letter(value.front()) && scan_number(value).length == 0)) {
      if (std::any_of(line.begin(), line.end(), is_letter)) return take_text(line);  // a title, the banner
      return error(line, fmt::format("\"{}\" is no row", line.substr(0, 20)), "give a node number and its values");
    }
    check_complete();
    ListingTable& table = tables_.back();
    ListingRow row{0, element_, material_, surface_, line_number_};
    const auto parsed = std::from_chars(line.data(), line.data() + length, row.node);
    if (parsed.ec != std::errc() || row.node < 1 || parsed.ptr != line.data() + length)
      return error(line, fmt::format("\"{}\" is no node number", line.substr(0, length)), "nodes count from 1");
    if (both_) row.surface = next_surface(row);
    table.rows.push_back(row);
    take_values(rest);
  }

  /// Of a node that is printed at top and bottom: the first row is the top.
  ShellSurface next_surface(const ListingRow& row) {
    const int count = seen_[{row.material, row.element, row.node}]++;
    return count % 2 == 0 ? ShellSurface::top : ShellSurface::bottom;
  }

  /// Values of the last row.
  void take_values(std::string_view line) {
    ListingTable& table = tables_.back();
    const std::size_t due = table.rows.size() * table.labels.size();
    if (!scan_values(line, table.values)) return table.values.resize(due, no_value);
    if (table.values.size() <= due) return;
    error(line,
          fmt::format("node {} has {} values where the head names {} columns", table.rows.back().node,
                      table.values.size() + table.labels.size() - due, table.labels.size()),
          "give one value a column");
    table.values.resize(due);
  }

  bool scan_values(std::string_view line, std::vector<double>& to) {
    while (true) {
      const auto next = line.find_first_not_of(blanks);
      if (next == line.npos) return true;
      line.remove_prefix(next);
      const ListingNumber number = scan_number(line);
      if (number.length == 0 && input::trimmed(line) == "L") {  // CalculiX marks nodes with a *TRANSFORM so
        error(line, "the values of the node are along the axes of its own frame", "print them in the global one: *NODE PRINT, GLOBAL=YES, or take the .frd file");
        return false;
      }
      if (number.length == 0) {
        error(line,
              fmt::format("\"{}\" is no number", line.substr(0, std::min<std::size_t>(line.find_first_of(blanks), 20))),
              "give a number such as -0.23058E-04");
        return false;
      }
      for (int f = 0; f < number.fields; ++f) to.push_back(number.value);
      line.remove_prefix(number.length);
    }
  }

  /// Rows that a line of text has cut off from their head would be lost without a word.
  void check_stray(std::string_view line, const ListingNumber& first) {
    if (tables_.empty() || !first.integer) return;
    std::size_t count = 0;
    for (std::string_view rest = input::trimmed(line.substr(first.length)); !rest.empty(); rest = input::trimmed(rest)) {
      const ListingNumber number = scan_number(rest);
      if (number.length == 0) return;
      count += number.fields;
      rest.remove_prefix(number.length);
    }
    if (count == tables_.back().labels.size())
      error(line, "a row of values stands after text that is no head of a page",
            "put a line NODE with the labels before it, or delete the text");
  }

  bool pending() const {
    return !tables_.empty() && !tables_.back().closed &&
           tables_.back().values.size() < tables_.back().rows.size() * tables_.back().labels.size();
  }

  void check_complete() {
    if (!pending()) return;
    ListingTable& table = tables_.back();
    const std::size_t due = table.rows.size() * table.labels.size(), missing = due - table.values.size();
    ++errors_;
    diagnostics_.error({file_, table.rows.back().line, 1},
                       fmt::format("node {} has {} values where the head names {} columns", table.rows.back().node,
                                   table.labels.size() - missing, table.labels.size()),
                       "complete the row; its last values may stand on the next line");
    table.values.resize(due, no_value);
  }

  void close() {
    if (tables_.empty() || tables_.back().closed) return;
    check_complete();
    tables_.back().closed = true;
  }

  void error(std::string_view place, std::string found, std::string remedy) {
    ++errors_;
    const bool inside = place.data() >= line_.data() && place.data() <= line_.data() + line_.size();
    diagnostics_.error({file_, line_number_, inside ? static_cast<int>(place.data() - line_.data()) + 1 : 1},
                       std::move(found), std::move(remedy));
  }

  static constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

  std::string_view text_, line_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  int line_number_ = 0, errors_ = 0;
  Mode mode_ = Mode::between;
  std::vector<ListingTable> tables_;
  // What the heads said last.
  std::string kind_, frame_;
  double time_ = 0.0;  ///< of CalculiX
  int load_step_ = 0, substep_ = 0, element_ = 0, material_ = 0;
  ShellSurface surface_ = ShellSurface::none;
  bool both_ = false;                              ///< every node is printed twice: top, then bottom
  std::map<std::tuple<int, int, int>, int> seen_;  ///< rows a (material, element, node), where both are printed
};

}  // namespace

std::vector<ListingTable> parse_listing(std::string_view text, const std::string& shown_as,
                                        input::Diagnostics& diagnostics) {
  return Parser(text, shown_as, diagnostics).parse();
}

std::vector<ListingTable> read_listing(const std::filesystem::path& file) {
  const std::string text = input::read_file(file);
  input::Diagnostics diagnostics;
  std::vector<ListingTable> tables;
  if (auto results = frd_tables(text, file.string(), diagnostics)) tables = std::move(*results);
  else if (auto records = febio_records(text, file.string(), diagnostics)) tables = std::move(*records);
  else if (auto report = field_report(text, file.string(), diagnostics)) tables.push_back(std::move(*report));
  else if (auto table = column_table(text, file, diagnostics)) tables.push_back(std::move(*table));
  else tables = parse_listing(text, file.string(), diagnostics);
  if (tables.empty() && !diagnostics.any())
    diagnostics.error({file.string(), 0, 0}, "there is no nodal table in it",
                      "give a listing with a line such as NODE UX UY UZ USUM over its rows (PRNSOL, PRESOL or NLIST), a table with a column node, a .dat or .frd file of CalculiX (*NODE PRINT, *NODE FILE), a report of Abaqus (.rpt) at nodes, or records of FEBio named ux;uy;uz");
  diagnostics.throw_if_any();
  return tables;
}

}  // namespace snug::postproc
