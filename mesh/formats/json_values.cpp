#include "mesh/formats/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace snug::mesh {

namespace {

constexpr std::size_t deepest = 32;

/// Characters for the parser that tell how far it is.
class Counted {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Counted(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
  reference operator*() const { return *at_; }
  Counted& operator++() {
    *furthest_ = ++at_;
    return *this;
  }
  Counted operator++(int) {
    const Counted before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Counted& other) const { return at_ == other.at_; }
  bool operator!=(const Counted& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** furthest_;
};

/// Builds the values from the parser's events. A value begins at the first character after the event before it that is
/// no space, comma or colon.
class Builder : public nlohmann::json::json_sax_t {
 public:
  Builder(const std::string& text, std::string file)
      : text_(text), read_(text.data()), last_(text.data()), counted_(text.data()), file_(std::move(file)) {}
  const char** read() { return &read_; }
  input::Value take() { return std::move(root_); }

  bool null() override { return put(std::monostate{}); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(static_cast<long long>(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    if (value > static_cast<std::uint64_t>(std::numeric_limits<long long>::max()))
      return put(static_cast<double>(value));
    return put(static_cast<long long>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(input::Table{here(), {}}); }
  bool start_array(std::size_t) override { return open(std::vector<input::Value>{}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& key) override {
    key_ = key, key_where_ = here();
    if (open_.back()->table()->find(key))
      throw input::InputError(key_where_, fmt::format("\"{}\" is there twice", key), "keep one of the two");
    last_ = read_;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) override {
    last_ = text_.data() + std::min(position > 0 ? position - 1 : 0, text_.size());
    std::string reason = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: …"
    if (const auto colon = reason.find(": "); colon != std::string::npos) reason = reason.substr(colon + 2);
    throw input::InputError(place(last_), "no JSON: " + reason, "mend the text here");
  }

 private:
  template <class Data>
  input::Value valued(Data data) {
    input::Value value;
    value.where = here();
    value.data = std::move(data);
    return value;
  }
  input::Value& place_for(input::Value value) {
    last_ = read_;
    if (open_.empty()) return root_ = std::move(value);
    if (input::Table* table = open_.back()->table()) {
      table->entries.push_back({key_, key_where_, std::move(value)});
      return table->entries.back().value;
    }
    auto& array = std::get<std::vector<input::Value>>(open_.back()->data);
    return array.emplace_back(std::move(value));
  }
  template <class Data>
  bool put(Data data) {
    place_for(valued(std::move(data)));
    return true;
  }
  template <class Data>
  bool open(Data data) {
    if (open_.size() >= deepest)
      throw input::InputError(here(), fmt::format("nested deeper than {}", deepest), "write plain lists");
    open_.push_back(&place_for(valued(std::move(data))));
    return true;
  }
  bool close() {
    open_.pop_back();
    last_ = read_;
    return true;
  }

  input::Location here() {
    const char* at = last_;
    const char* end = text_.data() + text_.size();
    while (at != end && std::string_view(" \t\r\n,:").find(*at) != std::string_view::npos) ++at;
    return place(at);
  }
  /// Places are asked for in the order of the text: lines are counted on from the last one.
  input::Location place(const char* at) {
    for (; counted_ < at; ++counted_)
      if (*counted_ == '\n') ++line_, line_start_ = counted_ + 1;
    return {file_, line_, static_cast<int>(at - line_start_) + 1};
  }

  const std::string& text_;
  const char *read_, *last_, *counted_;
  const char* line_start_ = counted_;
  int line_ = 1;
  std::string file_, key_;
  input::Location key_where_;
  input::Value root_;
  std::vector<input::Value*> open_;
};

}  // namespace

input::Value parse_json(const std::string& text, const std::string& shown_as) {
  Builder builder(text, shown_as);
  const Counted begin(text.data(), builder.read()), end(text.data() + text.size(), builder.read());
  nlohmann::json::sax_parse(begin, end, &builder);
  return builder.take();
}

}  // namespace snug::mesh
