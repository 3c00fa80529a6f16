#include "solver/app/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "cases/input/choice.hpp"
#include "cases/input/echo.hpp"
#include "cases/input/files.hpp"
#include "solver/app/hash.hpp"
#include "solver/app/provenance.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view first_line = "snug checkpoint 3\n";

template <class T>
std::string_view bytes_of(const std::vector<T>& list) {
  return {reinterpret_cast<const char*>(list.data()), sizeof(T) * list.size()};
}

std::string hash_line(std::string_view bytes) { return fmt::format("{:016x}\n", fnv1a(bytes)); }

constexpr std::size_t hash_length = 17;

/// What a run computes: program, ranks, case with its files, and meshes. A run goes on only from a checkpoint of the same.
std::string identity_of(const PreparedCase& prepared) {
  const solver::Meshes& meshes = prepared.meshes;
  std::string text = fmt::format("ranks {}\n", solver::this_rank().of) + input::echo_text(prepared.description);
  for (const auto& [file, hash] : provenance_of(prepared).input_hashes) text += hash;
  text += hash_line(bytes_of(meshes.body.nodes));
  for (const mesh::GarmentMesh& garment : meshes.garments) text += hash_line(bytes_of(garment.placed)) + hash_line(bytes_of(garment.pattern));
  return hash_line(text + hash_line(input::read_file("/proc/self/exe")));
}

}  // namespace

Checkpoint::Checkpoint(const fs::path& target, double interval) : file_((target / "").lexically_normal().parent_path()), interval_(interval) {
  file_ += ".checkpoint";
}

bool Checkpoint::there() const { return fs::exists(file_); }

Unfinished Checkpoint::read(const PreparedCase& prepared) const {
  const auto wrong = [&](const std::string& what, const std::string& remedy) { return input::InputError({file_.string(), 0, 0}, what, remedy); };
  const std::string whole = input::read_file(file_, {.missing = "run without --resume"});
  const std::string_view text = whole;
  const std::size_t head = first_line.size() + hash_length;
  if (!text.starts_with(first_line) || text.size() < head + hash_length ||
      hash_line(text.substr(0, text.size() - hash_length)) != text.substr(text.size() - hash_length))
    throw wrong("this is no whole checkpoint of snug", "remove it and run from the beginning, without --resume");
  if (text.substr(first_line.size(), hash_length) != identity_of(prepared))
    throw wrong("the case, its meshes, the program or the number of ranks is another than that of the checkpoint",
                "put back what the run began with, or run from the beginning, without --resume");
  const std::size_t end = std::min(text.find('\n', head), text.size() - hash_length);
  const auto csv = input::choice_of<postproc::CsvStyle>(std::string(text.substr(head, end - head)));
  if (!csv) throw wrong("the checkpoint does not say how its tables are written", "run from the beginning, without --resume");
  try {
    return {solver::Journal::of_bytes(text.substr(end + 1, text.size() - hash_length - end - 1)), *csv};
  } catch (const std::runtime_error& error) {
    throw wrong(std::string("the checkpoint cannot be read: ") + error.what(), "run from the beginning, without --resume");
  }
}

void Checkpoint::keep(const solver::Journal& journal, postproc::CsvStyle csv, const PreparedCase& prepared, const fs::path& aside) {
  if (std::chrono::duration<double>(Clock::now() - last_).count() < interval_) return;
  try {
    std::string text = std::string(first_line) + identity_of(prepared) + input::text_of(csv) + "\n" + journal.bytes();
    text += hash_line(text);
    input::write_file(aside / "checkpoint", text);
    fs::rename(aside / "checkpoint", file_);
  } catch (const std::exception& error) {
    if (!said_) fmt::print(stderr, "snug: warning: the run cannot be gone on from where it is: {}\n", error.what());
    said_ = true;
  }
  last_ = Clock::now();
}

void Checkpoint::remove() const {
  std::error_code none;
  fs::remove(file_, none);
}

}  // namespace snug::app
