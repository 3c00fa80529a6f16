// Seeded mutation fuzzer of the readers (targets.hpp).
//
// usage: snug_fuzz SECONDS|COUNTx [SEED [READER]]     COUNTx, as 1000x: so many texts a reader instead of a time
//   exit status 1: a text was found, and kept in snug-fuzz-READER.txt
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>

#include "tests/fuzz/targets.hpp"

namespace snug::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// One to eight changes: bytes, pieces, cuts and repetitions.
std::string mutated(std::string text, const std::vector<std::string>& pieces, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t changes = 1 + below(8); changes > 0; --changes) {
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 200) + 1);
    switch (below(5)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, pieces[below(pieces.size())]);
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      default:
        if (at < text.size()) text[at] = "0123456789+-.E \n"[below(16)];
        break;
    }
  }
  return text.substr(0, longest);
}

// The text under test, for the handler of a crash or a hang.
std::string current_text, current_name;

void keep_text() { std::ofstream("snug-fuzz-" + current_name + ".txt", std::ios::binary) << current_text; }

void crashed(int signal) {
  keep_text();
  fmt::print(stderr, "{}: signal {} ({}), see snug-fuzz-{}.txt\n", current_name, signal,
             signal == SIGALRM ? "hang" : "crash", current_name);
  std::_Exit(1);
}

bool survives(const Target& target, const fs::path& file) {
  ::alarm(10);
  const auto start = Clock::now();
  std::string what;
  if (!takes(target, file, current_text, what)) {
    fmt::print(stderr, "{}: {}\n", target.name, what);
    return false;
  }
  ::alarm(0);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (seconds < 5.0) return true;
  fmt::print(stderr, "{}: {:.1f} s for {} bytes\n", target.name, seconds, current_text.size());
  return false;
}

int fuzz(double seconds, long most, unsigned seed, const std::string& only) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("snug-fuzz-{}", ::getpid()), file = folder / "text";
  fs::create_directories(folder);
  std::vector<Target> all = targets();
  std::erase_if(all, [&](const Target& target) { return !only.empty() && target.name != only; });
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGALRM, SIGBUS}) std::signal(signal, crashed);
  for (const Target& target : all) {
    std::mt19937 random(seed);
    std::vector<std::string> corpus = target.seeds;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds / static_cast<double>(all.size()));
    long count = 0;
    current_name = target.name;
    for (; most > 0 ? count < most : Clock::now() < end; ++count) {
      current_text = mutated(corpus[random() % corpus.size()], target.pieces, random);
      if (!survives(target, file)) {
        keep_text();
        return 1;
      }
      // Some mutants are mutated further, the seeds are kept.
      if (count % 50 == 0) {
        if (corpus.size() < 64)
          corpus.push_back(current_text);
        else
          corpus[target.seeds.size() + random() % (64 - target.seeds.size())] = current_text;
      }
    }
    fmt::print("{}: {} texts\n", target.name, count);
  }
  fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace snug::fuzz

int main(int argc, char** argv) {
  const std::string amount = argc > 1 ? argv[1] : "";
  if (std::atof(amount.c_str()) <= 0.0) {
    std::string names;
    for (const auto& target : snug::fuzz::targets()) names += " " + target.name;
    fmt::print(stderr, "usage: snug_fuzz SECONDS|COUNTx [SEED [READER]]     readers:{}\n", names);
    return 2;
  }
  const long most = amount.ends_with('x') ? std::atol(amount.c_str()) : 0;
  return snug::fuzz::fuzz(std::atof(amount.c_str()), most, argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1, argc > 3 ? argv[3] : "");
}
