// Cases and files of hostile or unlucky kinds, and the program run on them.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "tests/cases/program.hpp"

namespace snug {

class Attack : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::filesystem::create_directories(temporary_);
    ::setenv("TMPDIR", temporary_.c_str(), 1);  // of the program alone: others use the common one at the same time
  }
  void TearDown() override {
    ::unsetenv("TMPDIR");
    std::filesystem::remove_all(temporary_);
    Program::TearDown();
  }
  const std::filesystem::path temporary_ = folder_.string() + "-temporary";

  using Path = std::filesystem::path;
  static constexpr const char* coarse = " --quiet --set body.cells_around=8 --set body.cells_along=1 ";

  void put(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write(name, text);
  }
  std::string text(const Path& file) const {
    std::ifstream in(folder_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool there(const Path& file) const { return std::filesystem::exists(std::filesystem::symlink_status(folder_ / file)); }

  /// Names in a directory, sorted.
  std::vector<std::string> names(const Path& directory) const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / directory)) found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
  }

  /// The files of a directory that a second run must give again to the byte: all but those that tell times.
  std::map<std::string, std::string> tables(const Path& out) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / out)) {
      const std::string name = entry.path().filename().string();
      if (name != "summary.json" && name != "report.html") files[name] = text(out / name);
    }
    return files;
  }

  /// Runs what has to end soon, whatever the input.
  Outcome bounded(const std::string& arguments) const {
    const auto start = std::chrono::steady_clock::now();
    Outcome outcome = snug(arguments);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20.0) << arguments;  // of a machine that does more
    return outcome;
  }

  /// Starts the program in the test's folder and gives its process.
  pid_t start(const std::vector<std::string>& words) const {
    std::vector<char*> arguments = {const_cast<char*>(SNUG_BINARY)};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child != 0) return child;
    const int log = ::open((folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(log, 1), ::dup2(log, 2);
    if (::chdir(folder_.c_str()) == 0) ::execv(SNUG_BINARY, arguments.data());
    ::_exit(127);
  }

  static int end(pid_t child) {
    int state = 0;
    ::waitpid(child, &state, 0);
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
  }

  /// Waits until it is true, a minute at most.
  template <class Condition>
  static bool eventually(Condition condition) {
    for (int n = 0; n < 6000 && !condition(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }

  bool is_solving(const Path& directory) const {
    for (const std::string& name : names(directory))
      if (name.starts_with("out.tmp-")) return true;
    return false;
  }
};

}  // namespace snug
