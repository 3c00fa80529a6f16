// A library in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "materials/database/library.hpp"
#include "materials/database/named.hpp"

namespace snug::testing {

class LibraryTest : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  materials::Library open(const std::string& who = "tester") const {
    return materials::Library(materials::library_settings(file_, who));
  }
  /// Without what ships.
  materials::Library open_empty(const std::string& who = "tester") const {
    return materials::Library({.file = file_, .who = who});
  }

  /// An entity from the lines of its table.
  static materials::Entity entity(materials::Kind kind, const std::string& id, const std::string& toml) {
    materials::UnitBook units;
    input::Diagnostics diagnostics;
    std::vector<materials::LibraryFile> files;
    const auto none = [](const std::string&, const input::Location&) { return std::string(); };
    const materials::Entity entity =
        materials::entity_of(kind, id, input::table_of(toml, {"test.toml", 1, 1}), none, units, files, diagnostics);
    diagnostics.throw_if_any();
    return entity;
  }
  static materials::Entity fabric(const std::string& id, const std::string& toml) {
    return entity(materials::Kind::fabric, id, toml);
  }
  static void add(materials::Library& library, const materials::Entity& entity) {
    library.change([&](materials::Stroke& stroke) { stroke.put(entity, "added"); });
  }
  static std::string error_of(auto&& action) {
    try {
      action();
    } catch (const input::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("snug-library-" + std::to_string(::getpid()));
  const std::filesystem::path file_ = folder_ / "library.db";
};

}  // namespace snug::testing
