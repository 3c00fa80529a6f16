#include "mesh/pattern/json_values.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace snug::mesh {

namespace {

using input::Diagnostics;
using input::Location;
using input::Value;

/// Walks a text and tells outside how far it has come: the parser keeps no places.
class Walker {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Walker(const std::string& text, std::size_t at, std::size_t* seen) : text_(&text), at_(at), seen_(seen) {}
  reference operator*() const { return (*text_)[at_]; }
  Walker& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  Walker operator++(int) {
    Walker before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Walker& other) const { return at_ == other.at_; }
  bool operator!=(const Walker& other) const { return at_ != other.at_; }

 private:
  const std::string* text_;
  std::size_t at_;
  std::size_t* seen_;
};

/// Line and column of growing offsets.
class Places {
 public:
  Places(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}
  Location at(std::size_t offset) {
    for (; passed_ < std::min(offset, text_.size()); ++passed_)
      if (text_[passed_] == '\n') ++line_, begin_ = passed_ + 1;
    return {file_, line_, static_cast<int>(passed_ - begin_) + 1};
  }

 private:
  const std::string& text_;
  std::string file_;
  std::size_t passed_ = 0, begin_ = 0;
  int line_ = 1;
};

/// Builds values from the parser's events (the SAX interface of nlohmann::json).
class Builder {
 public:
  Builder(const std::string& text, const std::string& file, const std::size_t& seen)
      : text_(text), places_(text, file), seen_(seen) {}

  bool null() { return put(std::monostate{}); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(static_cast<long long>(value)); }
  bool number_unsigned(std::uint64_t value) {
    return value <= static_cast<std::uint64_t>(std::numeric_limits<long long>::max())
               ? put(static_cast<long long>(value))
               : put(static_cast<double>(value));
  }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(std::vector<std::uint8_t>&) { return false; }

  bool start_object(std::size_t) {
    input::Table table;
    table.where = place();
    return open(std::move(table));
  }
  bool start_array(std::size_t) { return open(std::vector<Value>{}); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    open_.back().key = name, open_.back().key_place = place();
    return true;
  }
  bool parse_error(std::size_t at, const std::string&, const nlohmann::detail::exception& error) {
    const std::string what = error.what();
    const auto colon = what.find(": ");
    fault_ = "no JSON: " + (colon == std::string::npos ? what : what.substr(colon + 2));
    fault_place_ = Places(text_, places_.at(0).file).at(at > 0 ? at - 1 : 0);
    return false;
  }

  const std::string& fault() const { return fault_; }
  const Location& fault_place() const { return fault_place_; }
  Value& root() { return root_; }

 private:
  struct Open {
    Value value;
    std::string key;
    Location key_place;
  };

  /// Of the token that has just been read: what stands after the one before it and the marks between.
  Location place() {
    const std::size_t token = std::min(text_.find_first_not_of(" \t\r\n,:", last_), text_.size());
    last_ = std::max(token + 1, seen_);
    return places_.at(token);
  }

  template <class Data>
  bool put(Data data) {
    Value value;
    value.where = place();
    value.data = std::move(data);
    return add(std::move(value));
  }

  template <class Data>
  bool open(Data data) {
    if (open_.size() >= 50) {
      fault_ = "brackets nested more than 50 deep", fault_place_ = place();
      return false;
    }
    Open one;
    if constexpr (std::is_same_v<Data, input::Table>)
      one.value.where = data.where;
    else
      one.value.where = place();
    one.value.data = std::move(data);
    open_.push_back(std::move(one));
    return true;
  }

  bool close() {
    last_ = std::max(last_, seen_);
    Value value = std::move(open_.back().value);
    open_.pop_back();
    return add(std::move(value));
  }

  bool add(Value value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return true;
    }
    Open& in = open_.back();
    if (auto* items = std::get_if<std::vector<Value>>(&in.value.data)) {
      items->push_back(std::move(value));
    } else {
      in.value.table()->entries.push_back({in.key, in.key_place, std::move(value)});
    }
    return true;
  }

  const std::string& text_;
  Places places_;
  const std::size_t& seen_;
  std::size_t last_ = 0;
  std::vector<Open> open_;
  Value root_;
  std::string fault_;
  Location fault_place_;
};

}  // namespace

input::Table parse_json(const std::string& text, const std::string& shown_as, Diagnostics& diagnostics) {
  std::size_t seen = 0;
  Builder builder(text, shown_as, seen);
  const std::string remedy = "write a JSON object, { \"pattern\": { ... } }";
  input::Table empty;
  empty.where.file = shown_as;
  if (!nlohmann::json::sax_parse(Walker(text, 0, &seen), Walker(text, text.size(), &seen), &builder)) {
    diagnostics.error(builder.fault_place(), builder.fault(), remedy);
    return empty;
  }
  if (input::Table* table = builder.root().table()) return std::move(*table);
  diagnostics.error({shown_as, 1, 1}, "the file holds " + builder.root().description(), remedy);
  return empty;
}

}  // namespace snug::mesh
