// Runs every shipped case that has an expected.toml with the built program and compares what it says.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cases/input/expected.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

using input::Expected;

double tolerance(const Expected& expected) {
  return expected.relative ? *expected.relative * std::abs(*expected.value) : *expected.absolute;
}

/// The entry of an object by its key, of an array by the `location` or `name` of its rows or by its place, from 0.
const nlohmann::json* step_into(const nlohmann::json& from, const std::string& key) {
  if (from.is_object()) return from.contains(key) ? &from.at(key) : nullptr;
  if (!from.is_array()) return nullptr;
  for (const nlohmann::json& row : from)
    for (const char* name : {"location", "name"})
      if (row.is_object() && row.value(name, "") == key) return &row;
  const bool place = key.size() == 1 && std::isdigit(static_cast<unsigned char>(key[0])) != 0;
  return place && from.size() > std::size_t(key[0] - '0') ? &from[std::size_t(key[0] - '0')] : nullptr;
}

const nlohmann::json* find(const nlohmann::json& summary, const std::string& dotted) {
  const nlohmann::json* at = &summary;
  std::istringstream path(dotted);
  for (std::string key; at && std::getline(path, key, '.');) at = step_into(*at, key);
  return at;
}

void compare(const Expected& expected, const nlohmann::json& summary) {
  SCOPED_TRACE(expected.where.file + ":" + std::to_string(expected.where.line) + ": " + expected.quantity + ", " +
               expected.source);
  const nlohmann::json* found = find(summary, expected.quantity);
  ASSERT_TRUE(found) << "summary.json has no such quantity";
  if (!expected.value) {
    EXPECT_EQ(found->get<std::string>(), expected.text);
    return;
  }
  ASSERT_TRUE(found->is_number()) << found->dump();
  EXPECT_NEAR(found->get<double>(), *expected.value, tolerance(expected));
}

std::vector<std::string> cases_with_expectations() {
  std::vector<std::string> names;
  const fs::path folder = fs::path(SNUG_SOURCE_DIR) / "cases";
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename() == "expected.toml")
      names.push_back(entry.path().parent_path().lexically_relative(folder).generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedCase : public testing::TestWithParam<std::string> {
 protected:
  ~ShippedCase() override { fs::remove_all(out_); }
  const fs::path out_ = fs::temp_directory_path() / ("snug-expected-" + std::to_string(::getpid()));
};

TEST_P(ShippedCase, GivesWhatItExpects) {
  // A shipped case, run as a user runs it, gives the numbers of its expected.toml within their tolerances.
  const fs::path directory = fs::path(SNUG_SOURCE_DIR) / "cases" / GetParam();
  const std::string command =
      std::string(SNUG_BINARY) + " run '" + directory.string() + "' --quiet --no-record --out '" + out_.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(out_ / "summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file);
  for (const Expected& expected : input::read_expected(directory / "expected.toml")) compare(expected, summary);
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, ShippedCase, testing::ValuesIn(cases_with_expectations()), test_name);

}  // namespace
}  // namespace snug
