// snug animate OUT: the load path of a run as a film.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "cases/input/diagnostics.hpp"
#include "cases/input/units.hpp"
#include "postproc/animation/film.hpp"
#include "solver/app/command.hpp"
#include "solver/app/data_directory.hpp"
#include "solver/app/result_list.hpp"
#include "solver/app/study/child_process.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

class Animate : public Command {
 public:
  std::string name() const override { return "animate"; }
  std::string summary() const override { return "pressure and shape over the load path of a run made with --states"; }

  void declare(CLI::App& app) override {
    app.add_option("OUT", out_, "directory that a run with --states wrote")->required();
    app.add_option("--frames", settings_.most, "frames at most (60)")->check(CLI::Range(2, 2000));
    app.add_option("--step", step_, "no point moves farther between two frames: --step \"0.5 mm\"")
        ->type_name("LENGTH");
    app.add_flag("--gif", gif_, "also draw animation.gif");
    app.add_flag("--mp4", mp4_, "also draw animation.mp4");
  }

  int execute() override {
    if (!step_.empty()) settings_.step = length(step_);
    const fs::path folder = fs::path(out_) / "animation";
    std::vector<std::string> films;
    if (gif_) films.push_back("animation.gif");
    if (mp4_) films.push_back("animation.mp4");
    check_may_add(out_, {films.begin(), films.end()});
    const postproc::animation::Film film = postproc::animation::make_film(out_, folder, settings_);
    console().print("{}: {} frames from {} states, {:.3g} mm at most between two\n", folder.string(), film.frames, film.keys,
               1e3 * film.widest);
    ResultList written(films.begin(), films.end());
    for (const std::string& file : files_below(folder)) written.insert("animation/" + file);
    for (std::string& film : films) film = (fs::absolute(out_) / film).string();
    if (!films.empty()) draw(films);
    add_to_result_list(out_, written);
    return done;
  }

 private:
  static double length(const std::string& text) {
    const input::Quantity metres = input::to_si(text, "m");
    if (!metres.ok() || !(metres.value > 0.0))
      throw input::InputError({"--step", 0, 0}, fmt::format("\"{}\" is no length above zero", text),
                              "write for example --step \"0.5 mm\"");
    return metres.value;
  }

  /// Drawn by VTK in a process of its own under a virtual display, joined by ffmpeg.
  void draw(const std::vector<std::string>& films) const {
    std::vector<std::string> words = {"xvfb-run", "--auto-servernum", "/usr/bin/python3", "-B"};
    words.push_back((data_directory() / "scripts" / "film.py").string());
    words.push_back((fs::absolute(out_) / "animation").string());
    words.insert(words.end(), films.begin(), films.end());
    const ChildOutcome outcome = run_child(words, fs::temp_directory_path());
    const std::string why = outcome.status == 127 ? "xvfb-run is not installed" : outcome.output;
    if (outcome.status != 0)
      throw input::InputError({films.front(), 0, 0}, fmt::format("the film cannot be drawn: {}", why),
                              "install what draws it: python3-vtk9, xvfb, xauth, ffmpeg (scripts/setup --pictures)");
    for (const std::string& film : films) console().print("{}\n", film);
  }

  std::string out_, step_;
  postproc::animation::FilmSettings settings_;
  bool gif_ = false, mp4_ = false;
};

}  // namespace

std::unique_ptr<Command> make_animate() { return std::make_unique<Animate>(); }

}  // namespace snug::app
