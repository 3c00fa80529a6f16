#include "solver/app/convert_fuzzy.hpp"

#include <filesystem>
#include <stdexcept>

#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/fuzzy_file.hpp"

namespace snug::app {

namespace fs = std::filesystem;

bool is_fuzzy_file(const std::string& file) {
  const fs::path ending = fs::path(file).extension();
  return ending == ".fll" || ending == ".fis";
}

void convert_fuzzy(const std::string& from, const std::string& to) {
  input::MaterialEntry asked;
  asked.name = from;
  asked.where.file = "snug convert";
  const postproc::FuzzySystem system = postproc::load_fuzzy(asked, {});
  try {
    postproc::write_fuzzy(system, to);
  } catch (const std::invalid_argument& fault) {
    throw input::InputError({to, 0, 0}, fault.what(),
                            "or begin with \"" + postproc::fuzzy_names().back() + "\", which FIS can hold");
  } catch (const std::runtime_error& error) {
    throw input::InputError({to, 0, 0}, error.what(), "name a place that can be written to");
  }
}

}  // namespace snug::app
