#include "materials/database/json_reader.hpp"

#include <nlohmann/json.hpp>

#include <utility>
#include <vector>

namespace snug::materials {

namespace {

constexpr std::size_t deepest_json = 20;
constexpr const char* remedy = "write it as in {\"fabric\": {\"my knit\": {\"weight\": \"200 g/m2\"}}}";

/// Takes the events of the parser; what is open stands on a stack, so that nothing is looked up and nothing recurses.
class ValueBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit ValueBuilder(const input::Location& where) : where_(where) {}
  input::Value take() { return std::move(root_); }
  const std::string& fault() const { return fault_; }

  bool null() override { return add(std::string()); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add(static_cast<double>(value)); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override {
    input::Table table;
    table.where = where_;
    return open(std::move(table));
  }
  bool start_array(std::size_t) override { return open(std::vector<input::Value>()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    open_.back().key = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
    const std::string what = error.what();
    fault_ = "this is no JSON: " + what.substr(what.find("] ") == what.npos ? 0 : what.find("] ") + 2);
    return false;
  }

 private:
  struct Level {
    input::Value value;
    std::string key = {};  // of the member that comes next
  };
  template <class Data>
  input::Value value_of(Data data) const {
    input::Value value = input::value_without_place(std::move(data));
    value.where = where_;
    return value;
  }
  template <class Data>
  bool add(Data data) {
    return put(value_of(std::move(data)));
  }
  bool put(input::Value value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (input::Table* table = open_.back().value.table()) {
      table->entries.push_back({std::move(open_.back().key), where_, std::move(value)});
    } else {
      std::get<std::vector<input::Value>>(open_.back().value.data).push_back(std::move(value));
    }
    return true;
  }
  template <class Data>
  bool open(Data data) {
    if (open_.size() == deepest_json) fault_ = "JSON nested more than " + std::to_string(deepest_json) + " deep";
    if (open_.size() == deepest_json) return false;
    open_.push_back({value_of(std::move(data))});
    return true;
  }
  bool close() {
    input::Value value = std::move(open_.back().value);
    open_.pop_back();
    return put(std::move(value));
  }

  input::Location where_;
  std::vector<Level> open_;
  input::Value root_;
  std::string fault_ = "this JSON is no table of kinds";
};

}  // namespace

input::Table table_of_json(const std::string& text, const input::Location& where) {
  ValueBuilder builder(where);
  const bool whole = nlohmann::json::sax_parse(text, &builder);
  input::Value value = builder.take();
  if (!whole || !value.table()) throw input::InputError(where, builder.fault(), remedy);
  return std::move(*value.table());
}

}  // namespace snug::materials
