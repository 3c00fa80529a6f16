// What the commands call: the plan of a scene and its solution.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/body/scan_report.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "mesh/placement/dress_form.hpp"
#include "postproc/result.hpp"
#include "solver/scene/model.hpp"

namespace snug::solver {

/// Starts PETSc and MPI for the life of the object; one in main. With several ranks each one's BLAS gets its share of
/// the cores, unless OPENBLAS_NUM_THREADS says otherwise.
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;

 private:
  struct Runtime;
  std::unique_ptr<Runtime> runtime_;
};

/// What has started this process beside others to work with: mpirun, srun or another launcher, by what it sets for its processes.
struct Launcher {
  bool there = false;
  int processes = 0;  ///< 0: it does not say before MPI has started
};
Launcher launcher();

/// The rank of this process and how many there are; rank 0 alone speaks and writes.
struct Rank { int number = 0, of = 1; };
Rank this_rank();
/// Ends every rank at once with an exit status: what one rank does not survive, the others cannot wait for.
[[noreturn]] void end_all_ranks(int status);

/// "openblas", "reference" or "unknown": which BLAS the process has loaded.
std::string loaded_blas();

/// Meshes of a case; what the case does not name is absent (empty cells, no garments). What garments were placed on is the limb, or the
/// form of a body that branches.
struct Meshes {
  mesh::Limb limb;
  std::unique_ptr<mesh::DressForm> form = {};
  mesh::BodyMesh body;
  std::vector<mesh::GarmentMesh> garments;  ///< in the order of the case
  mesh::ScanReport scan;                    ///< of a body of tetrahedra from a scan
};

/// Parts of the scene with their unknowns, known before anything is solved.
struct Plan {
  std::string tier;
  std::vector<std::string> parts_in;       ///< "body: soft tissue, neo-Hooke, Q2/P1 hexahedra", ...
  std::vector<std::string> parts_out;      ///< "friction: not in the case", ...
  std::map<std::string, long> unknowns;    ///< "body", "garment", "contact"; parts left out do not appear
  double memory_bytes = 0.0, seconds = 0.0;  ///< expected
  double disk_bytes = 0.0;                   ///< of temporary files, where the factor of the matrix is written to disk
};
/// `memory`: bytes that the run may take; 0: there is no bound. Where it would take more the factor goes to disk.
Plan plan(const Model& model, const Meshes& meshes, double memory = 0.0);

/// Bytes that a run takes.
struct Need {
  double memory = 0.0;                     ///< all of it
  double memory_beside_disk = 0.0;         ///< with the factor of the matrix on disk,
  double disk = 0.0;                       ///< where it takes this
};
/// By its unknowns, on the rigid skin (garments and contacts) and of a body that deforms.
Need need_of_run(double rigid, double body);

struct Progress {
  std::string phase;                 ///< "rigid skin", "body", ...
  int increment = 0, iteration = 0;
  double load = 0.0, residual = 0.0; ///< s; relative residual
  int contact_nodes = 0;
  double elapsed = 0.0, expected = 0.0;  ///< s
  int attempt = 1;                   ///< at this increment: 2 after one that failed and was cut
};
using Observer = std::function<void(const Progress&)>;

/// States of the load path for those who want to see it; none are kept and nothing is spent on them by default.
struct KeptStates {
  int steps = 0;  ///< a stage of the path (tightening, giving way) goes in as many steps at least; 0: keep none
  /// Called with the way so far (a stage counts 1) and the result there, the placed garment first.
  std::function<void(double, const postproc::RunResult&)> keep;
};

/// Asked after every iteration, on all ranks alike; true: the running step is given up and the last converged state is the
/// result, with the status "partial".
using Stop = std::function<bool()>;

class Journal;

/// Solves the scene of the case. Never throws for lack of convergence: the last converged state comes back with its status.
/// With a journal (solver/stepping/journal.hpp) it goes on from what is recorded there and records more.
/// `memory`: bytes that it may take on all ranks together; a factor that would take more is written to disk (0: there is no bound).
/// Throws input::InputError when the scene cannot have an equilibrium or names parts that do not fit together.
postproc::RunResult solve(const Model& model, const Meshes& meshes, const Observer& observer = {},
                          const KeptStates& kept = {}, const Stop& stop = {}, Journal* journal = nullptr, double memory = 0.0);

}  // namespace snug::solver
