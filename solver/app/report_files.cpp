#include "solver/app/report_files.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>

#include "cases/input/files.hpp"
#include "postproc/store.hpp"
#include "solver/app/data_directory.hpp"
#include "solver/app/result_list.hpp"
#include "solver/app/study/child_process.hpp"

namespace snug::app {

namespace fs = std::filesystem;

void write_page(const std::string& page, const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  check_may_add(folder, {file.filename().string()});
  input::write_file(file, page);
  add_to_result_list(folder, {file.filename().string()});
}

void write_report(const fs::path& out, const postproc::report::Pictures& pictures) {
  write_page(postproc::report::page(out, pictures), out / "report.html");
}

void write_report(const postproc::StoredRun& run, const fs::path& out, const postproc::report::Pictures& pictures) {
  write_page(postproc::report::page(run, pictures), out / "report.html");
}

postproc::report::Pictures draw_pictures(const fs::path& out) {
  const fs::path script = data_directory() / "scripts" / "picture.py";
  const std::string remedy = " python3-vtk9, xvfb and xauth (scripts/setup --pictures) draw them, `snug report` puts them in.";
  if (!fs::exists(script)) return {{}, script.string() + " is not there; snug is not installed as a whole."};
  const fs::path png = fs::temp_directory_path() / ("snug-picture-" + std::to_string(::getpid()) + ".png");
  const ChildOutcome outcome = run_child({"xvfb-run", "--auto-servernum", "/usr/bin/python3", "-B", script.string(),
                                          fs::absolute(out).string(), "--out", png.string(), "--palette", "viridis"},
                                         fs::temp_directory_path());
  std::ifstream file(png, std::ios::binary);
  postproc::report::Pictures pictures{{std::istreambuf_iterator<char>(file), {}}, {}};
  fs::remove(png);
  if (outcome.status == 0 && !pictures.png.empty()) return pictures;
  if (outcome.status == 127) return {{}, "xvfb-run or Python is not installed." + remedy};
  const std::size_t last = outcome.output.find_last_not_of(" \n");
  const std::string text = outcome.output.substr(0, last + 1);
  return {{}, "drawing them failed (" + text.substr(text.rfind('\n') + 1) + ")." + remedy};
}

}  // namespace snug::app
