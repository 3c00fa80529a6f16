// The readers under libFuzzer: one is chosen with --reader=NAME; what they throw but InputError with a place is a crash.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;

// libFuzzer calls functions and hands nothing through.
std::optional<snug::fuzz::Target> chosen;
fs::path file;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string option = "--reader=";
  for (int n = 1; n < *argc; ++n)
    for (const snug::fuzz::Target& target : snug::fuzz::targets())
      if ((*argv)[n] == option + target.name) chosen = target;
  if (!chosen) {
    fmt::print(stderr, "name a reader, {}NAME; the usage of snug_fuzz lists them\n", option);
    std::exit(2);
  }
  const fs::path folder = fs::temp_directory_path() / fmt::format("snug-libfuzzer-{}", ::getpid());
  fs::create_directories(folder);
  file = folder / "text";
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  std::string what;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (snug::fuzz::takes(*chosen, file, text, what)) return 0;
  fmt::print(stderr, "{}: {}\n", chosen->name, what);
  std::abort();
}
