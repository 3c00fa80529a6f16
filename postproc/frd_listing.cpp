#include "postproc/frd_listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "cases/input/text.hpp"
#include "postproc/listing_numbers.hpp"

namespace snug::postproc {

namespace {

constexpr std::size_t value_width = 12;

std::string_view columns(std::string_view line, std::size_t first, std::size_t count) { return first < line.size() ? line.substr(first, count) : std::string_view(); }

int whole(std::string_view text, int otherwise = 0) {
  text = input::trimmed(text);
  int value = otherwise;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size() ? value : otherwise;
}

/// Ansys' names of the components that are read.
const std::map<std::string, std::vector<std::string>, std::less<>>& blocks() {
  static const std::map<std::string, std::vector<std::string>, std::less<>> labels = {{"DISP", {"UX", "UY", "UZ"}}, {"STRESS", {"SX", "SY", "SZ", "SXY", "SYZ", "SXZ"}}};
  return labels;
}

class FrdParser {
 public:
  FrdParser(std::string_view text, const std::string& file, input::Diagnostics& diagnostics) : rest_(text), file_(file), diagnostics_(diagnostics) {}

  std::vector<ListingTable> parse() {
    while (!rest_.empty() && errors_ < most_listing_errors) {
      ++number_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (line.ends_with('\r')) line.remove_suffix(1);
      take(line);
      if (binary_) break;  // what follows are bytes
    }
    if (!tables_.empty() && in_rows_) error("the file ends within a block", "let CalculiX finish, or take a complete copy");
    return std::move(tables_);
  }

 private:
  void take(std::string_view line) {
    const std::string_view key = columns(line, 0, 3);
    if (key == " -1" || key == " -2") return in_rows_ ? row(line, key == " -1") : void();
    if (key == " -3") return end_block();
    if (key == " -4") return begin_results(line);
    if (key == " -5") return component(line);
    const std::string_view head = columns(line, 0, 6);
    if (head == "    2C") begin_places(line);
    if (head == "    3C") end_block();
    if (columns(line, 0, 10) == "    1PSTEP") substep_ = whole(columns(line, 36, 12), 1), step_ = whole(columns(line, 48, 12), 1);
    if (columns(line, 0, 5) == "  100" && (line.size() < 6 || line[5] == 'C')) set_format(whole(columns(line, 73, 2), 1));
  }

  void set_format(int format) {
    binary_ = format > 1;
    node_width_ = format == 0 ? 5 : 10;
    if (binary_) error("the results are binary", "write them as text: *NODE FILE and *EL FILE instead of *NODE OUTPUT and *ELEMENT OUTPUT");
  }

  void begin_places(std::string_view line) {
    end_block();
    set_format(whole(columns(line, 73, 2), 1));
    begin("NODES", {"X", "Y", "Z"}, 3, 0, 0);
  }

  void begin_results(std::string_view line) {
    const std::string_view name = input::trimmed(columns(line, 5, 8));
    const auto known = blocks().find(name);
    end_block();
    if (known == blocks().end()) return;
    begin(name == "DISP" ? "NODAL DEGREE OF FREEDOM" : "NODAL STRESS", known->second, 0, step_, substep_);
  }
  void begin(const char* kind, const std::vector<std::string>& labels, std::size_t stored, int step, int substep) {
    ListingTable& table = tables_.emplace_back();
    table.kind = kind, table.labels = labels, table.load_step = step, table.substep = substep;
    in_rows_ = true, stored_ = stored;
  }
  /// Components that are not computed by the reader stand in the rows.
  void component(std::string_view line) {
    if (in_rows_ && whole(columns(line, 33, 5)) == 0) ++stored_;
  }

  void row(std::string_view line, bool first) {
    ListingTable& table = tables_.back();
    const std::size_t labels = table.labels.size();
    if (first) {
      check_complete();
      const int node = whole(columns(line, 3, node_width_));
      if (node < 1) return error(fmt::format("\"{}\" is no node number", input::trimmed(columns(line, 3, node_width_))), "nodes count from 1");
      table.rows.push_back({node, 0, 0, ShellSurface::none, number_});
      values_ = 0;
    }
    if (table.rows.empty()) return;
    for (std::size_t at = 3 + node_width_; at < line.size() && values_ < stored_; at += value_width, ++values_) {
      const std::string_view text = input::trimmed(columns(line, at, value_width));
      const ListingNumber found = scan_number(text);
      if (found.length != text.size() || text.empty()) return error(fmt::format("\"{}\" is no number", text), "give a number such as -2.30580E-05 in each 12 columns");
      if (values_ < labels) table.values.push_back(found.value);
    }
  }

  void check_complete() {
    ListingTable& table = tables_.back();
    const std::size_t due = table.rows.size() * table.labels.size();
    if (table.values.size() == due) return;
    error(fmt::format("node {} has fewer values than the block has components", table.rows.back().node), "let CalculiX finish, or take a complete copy");
    table.values.resize(due, std::numeric_limits<double>::quiet_NaN());
  }

  void end_block() {
    if (in_rows_) check_complete(), tables_.back().closed = true;
    in_rows_ = false;
  }

  void error(std::string found, std::string remedy) {
    ++errors_;
    diagnostics_.error({file_, number_, 1}, std::move(found), std::move(remedy));
  }

  std::string_view rest_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  std::vector<ListingTable> tables_;
  int number_ = 0, errors_ = 0, step_ = 1, substep_ = 1;
  std::size_t node_width_ = 10, stored_ = 0, values_ = 0;
  bool in_rows_ = false, binary_ = false;
};

}  // namespace

std::optional<std::vector<ListingTable>> frd_tables(std::string_view text, const std::string& shown_as, input::Diagnostics& diagnostics) {
  if (!text.starts_with("    1C") && !text.starts_with("    2C")) return std::nullopt;
  return FrdParser(text, shown_as, diagnostics).parse();
}

}  // namespace snug::postproc
