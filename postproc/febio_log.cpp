#include "postproc/febio_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "cases/input/text.hpp"
#include "postproc/listing_numbers.hpp"

namespace snug::postproc {

namespace {

constexpr std::string_view apart = " \t\r,;";

std::vector<std::string> lower_words(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const auto begin = text.find_first_not_of(apart);
    if (begin == text.npos) return words;
    const auto end = std::min(text.find_first_of(apart, begin), text.size());
    std::string& word = words.emplace_back(text.substr(begin, end - begin));
    std::transform(word.begin(), word.end(), word.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    text.remove_prefix(end);
  }
}

/// Ansys' labels of a record, empty for those of other variables.
std::vector<std::string> labels_of(std::string_view name) {
  std::vector<std::string> labels;
  const std::vector<std::string> words = lower_words(name);
  if (words.size() == 1 && (words[0].starts_with("displacement") || words[0] == "disp")) return {"UX", "UY", "UZ"};
  for (const std::string& word : words) {
    if (word != "ux" && word != "uy" && word != "uz") return {};
    labels.push_back(std::string("U") + static_cast<char>(word[1] - 32));
  }
  return labels;
}

/// The text behind "Step =" or "*Step  =".
std::optional<std::string_view> entry(std::string_view line, std::string_view key) {
  if (line.starts_with('*')) line.remove_prefix(1);
  if (!line.starts_with(key)) return std::nullopt;
  line = input::trimmed(line.substr(key.size()));
  return line.starts_with('=') ? std::optional(input::trimmed(line.substr(1))) : std::nullopt;
}

class Records {
 public:
  Records(std::string_view text, const std::string& file, input::Diagnostics& diagnostics) : rest_(text), file_(file), diagnostics_(diagnostics) {}

  std::optional<std::vector<ListingTable>> parse() {
    while (!rest_.empty() && errors_ < most_listing_errors) {
      ++number_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = input::trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      take(line);
    }
    return found_ ? std::optional(std::move(tables_)) : std::nullopt;
  }

 private:
  void take(std::string_view line) {
    if (const auto step = entry(line, "Step")) {
      std::from_chars(step->data(), step->data() + step->size(), step_);
      timed_ = false;
    } else if (entry(line, "Time")) {
      timed_ = true;
    } else if (const auto name = entry(line, "Data"); name && timed_) {
      begin(*name);
    } else if (in_rows_ && !line.empty()) {
      line.front() >= '0' && line.front() <= '9' ? row(line) : void(in_rows_ = false);
    } else if (line.empty() && in_rows_ && !tables_.back().rows.empty()) {
      in_rows_ = false;
    }
  }

  void begin(std::string_view name) {
    found_ = true;
    std::vector<std::string> labels = labels_of(name);
    in_rows_ = !labels.empty();
    if (!in_rows_) return;
    ListingTable& table = tables_.emplace_back();
    table.kind = "NODAL DEGREE OF FREEDOM", table.labels = std::move(labels), table.load_step = std::max(1, step_), table.substep = 1;
  }

  void row(std::string_view line) {
    ListingTable& table = tables_.back();
    const std::vector<std::string> words = lower_words(line);
    int node = 0;
    const auto parsed = std::from_chars(words[0].data(), words[0].data() + words[0].size(), node);
    if (parsed.ec != std::errc() || parsed.ptr != words[0].data() + words[0].size() || node < 1)
      return error(fmt::format("\"{}\" is no node number", words[0]), "nodes count from 1");
    if (words.size() != table.labels.size() + 1)
      return error(fmt::format("node {} has {} values where the record has {} variables", node, words.size() - 1, table.labels.size()), "let FEBio finish, or take a complete copy");
    table.rows.push_back({node, 0, 0, ShellSurface::none, number_});
    for (std::size_t w = 1; w < words.size(); ++w) {
      const ListingNumber value = scan_number(words[w]);
      if (value.length != words[w].size()) error(fmt::format("\"{}\" is no number", words[w]), "give a number such as -2.3058e-05");
      table.values.push_back(value.length == words[w].size() ? value.value : std::numeric_limits<double>::quiet_NaN());
    }
  }

  void error(std::string found, std::string remedy) {
    ++errors_;
    diagnostics_.error({file_, number_, 1}, std::move(found), std::move(remedy));
  }

  std::string_view rest_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  std::vector<ListingTable> tables_;
  int number_ = 0, errors_ = 0, step_ = 1;
  bool timed_ = false, in_rows_ = false, found_ = false;
};

}  // namespace

std::optional<std::vector<ListingTable>> febio_records(std::string_view text, const std::string& shown_as, input::Diagnostics& diagnostics) {
  return Records(text, shown_as, diagnostics).parse();
}

}  // namespace snug::postproc
