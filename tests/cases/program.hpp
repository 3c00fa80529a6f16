// The built program, run in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace snug {

struct Outcome {
  int status = -1;
  std::string text;  ///< standard output and standard error together
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Program : public testing::Test {
 protected:
  /// Nothing reaches the library of whoever tests: it is looked for in the folder, and runs are not recorded.
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    ::setenv("SNUG_RECORD", "off", 1);
    ::setenv("SNUG_LIBRARY", (folder_ / "library.db").c_str(), 1);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// `before`: variables or a program that starts ours.
  Outcome snug(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + folder_.string() + "' && " + before + " '" + SNUG_BINARY + "' " + arguments + " 2>&1";
    Outcome outcome;
    FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> block;
    for (std::size_t n; (n = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
      outcome.text.append(block.data(), n);
    const int state = ::pclose(pipe);
    outcome.status = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
    return outcome;
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("snug-commands-" + std::to_string(::getpid()));
};

}  // namespace snug
