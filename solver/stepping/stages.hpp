// The load path as data: ways from the placed garment to the answer, each a list of stages (docs/architecture.md).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "solver/stepping/load_path.hpp"

namespace snug::solver {

/// Where a stage has ended.
struct Standing {
  std::shared_ptr<Scene> scene;
  State state;
};
/// The ends of the stages of a way so far.
using Trail = std::vector<Standing>;

/// One try at a stage.
struct Attempt {
  std::string rows;                    ///< name of its iterations in the history
  Homotopy change;
  std::optional<int> failures = {};    ///< halvings in a row before giving up; 0 where half of it is no easier; empty: as usual
  double first_step = 1.0;
};

/// A load that may have a largest value follows its curve of equilibria instead of a homotopy.
struct Curve {
  bool from_the_start = false;  ///< otherwise where increments of the load end
};

/// What is reported of a stage that has not come to its end.
enum class Fallback {
  here,                     ///< how far it has come
  before_if_nothing,        ///< that, or the stage before where nothing of it converged
  before,                   ///< the stage before
};

struct Stage {
  std::string name;                                ///< as the run tells it
  const Model* model = nullptr;                    ///< whose scene is solved
  Skin skin = Skin::rigid;
  std::function<std::vector<Attempt>(const Trail&)> attempts;  ///< the first that comes to its end counts
  std::optional<Curve> curve = {};
  bool leads_on = false;                           ///< its end is no answer and need not be better than any other state
  double residual = NewtonSettings{}.residual;     ///< of its end
  double intermediate_residual = PathSettings{}.intermediate_residual;
  Fallback fallback = Fallback::here;
  /// Why its end, though in balance, is no answer; empty: it is one. May be no function.
  std::function<std::string(const Standing& end)> objection = {};
  /// What is told of a stage that stopped on its way, beside where: `reported` is what the fallback says. May be no function.
  std::function<void(const Trail&, const Standing& reported, postproc::RunResult&)> tell = {};
  int posture = 0;                                 ///< that it moves the body to, counted from 1; 0: the garment is put on
  bool spreads = false;                            ///< other ways of putting on start where this stage ends
};

struct Way {
  double release = 1.0;  ///< of friction where it starts: 0 sticks
  std::vector<Stage> stages;
};

/// The ways on which a scene's answer is looked for, the cheapest first; another one only where the one before comes to nothing.
/// Empty: tier L0, there is nothing to solve. The stages point to `model` and `worn`, the same with the friction that holds
/// garments on the way; `every_step`: states on the way are wanted.
std::vector<Way> ways_of(const Model& model, const Model& worn, const Meshes& meshes, bool every_step);

/// Goes on from the end of a way through the postures of the case, a stage each, on the scene that the way ends with. `movement` outlives the way.
void add_postures(const Movement& movement, Way& way);

}  // namespace snug::solver
