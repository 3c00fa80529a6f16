// The typed content of a case directory: plain structs, every value in SI, every error already reported.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/body_spec.hpp"
#include "cases/input/choice.hpp"
#include "cases/input/diagnostics.hpp"
#include "cases/input/garment_spec.hpp"
#include "cases/input/load_spec.hpp"
#include "cases/input/material_entry.hpp"
#include "cases/input/posture_spec.hpp"
#include "cases/input/reference_spec.hpp"
#include "cases/input/study_spec.hpp"
#include "cases/input/tool_spec.hpp"

namespace snug::input {

/// Test functions of the weighted gap.
enum class GapTests { hat, dual };
constexpr auto texts_of(GapTests) { return std::array{"hat", "dual"}; }

/// How much is solved: nothing (law of Laplace), the garment on the rigid skin, the layered body; or how the garment falls on the
/// rigid skin, as particles.
enum class Tier { L0, L1, L4, particle };
constexpr auto texts_of(Tier) { return std::array{"L0", "L1", "L4", "particle"}; }

/// How the load of a body without a garment grows.
enum class LoadPath { load, arc_length };
constexpr auto texts_of(LoadPath) { return std::array{"load", "arc length"}; }

/// Surfaces that touch: a garment and what lies under it, or two surfaces of the body.
struct ContactSpec {
  std::string slave;               ///< a garment, or a surface of the body; empty: every garment that no other contact names
  std::string master;              ///< of a garment: "skin", or a garment under it; empty: all that it lies on. Else a surface of the body
  GapTests basis = GapTests::hat;
  std::optional<double> friction;  ///< coefficient; see solver/scene/friction_choice
  bool spread = false;             ///< what other ways of putting the garment on would change
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "slave",
                .meaning = "what touches: the name of a garment, or a surface of the body made of quadratic tetrahedra; left out: "
                           "every garment that no other contact names"},
          self.slave);
    field(Field{.key = "master",
                .meaning = "what it touches. Of a garment: the garment that it lies on, and beyond its edges what lies under that and the skin; "
                           "skin: the skin alone; left out: the garments listed before it where it lies over them, else the skin. Of a surface "
                           "of the body: another one"},
          self.master);
    field(Field{.key = "basis", .meaning = "test functions of the weighted gap"}, self.basis);
    field(Field{.key = "friction",
                .meaning = "coefficient of friction; left out: of a garment on what it lies on the fabric's own (MIU), else 0.3; of two "
                           "surfaces of the body none. 0: none, for verification",
                .bound = between(0.0, 2.0)},
          self.friction);
    field(Field{.key = "spread",
                .meaning = "also shows, on the rigid skin, what other ways of putting the garment on would change: friction "
                           "over the last half of the tightening and over its last nine tenths"},
          self.spread);
  }
};

struct ComfortSpec {
  MaterialEntry curves;                   ///< shipped set, TOML or CSV file of the case
  MaterialEntry fuzzy;                    ///< shipped system, .fll or .fis file; empty: table 5.4 over the locations
  std::vector<MaterialEntry> thresholds;  ///< sets of pressure bands
  int samples = 1000;                         ///< of the ratings, for the interval of the score; 0: none
  int seed = 1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "curves",
                .meaning = "sensation against pressure by location: a shipped set (snug list curves), a TOML file of "
                           "curves or a CSV file of ratings",
                .required = true},
          self.curves);
    field(Field{.key = "fuzzy",
                .meaning = "system that joins the ratings: \"wear trial 2002\", \"wear trial 2002, single terms\", or a "
                           ".fll or .fis file; left out: the rules of the first one for the locations that have ratings"},
          self.fuzzy);
    field(Field{.key = "thresholds",
                .meaning = "named ranges that the pressures are held against: shipped sets (snug list curves) or TOML "
                           "files"},
          self.thresholds);
    field(Field{.key = "samples",
                .meaning = "draws of the ratings about their curves for the interval of the score; 0: no interval",
                .bound = between(0, 1000000)},
          self.samples);
    field(Field{.key = "seed", .meaning = "of the draws", .bound = non_negative()}, self.seed);
  }
};

struct SolverSpec {
  Tier tier = Tier::L4;
  LoadPath path = LoadPath::load;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "tier",
                .meaning = "L0: tension times curvature on the undeformed skin; L1: rigid skin; "
                           "L4: nonlinear layered body; particle: the shape in which one garment hangs on the rigid skin by its weight, without "
                           "pressures"},
          self.tier);
    field(Field{.key = "path",
                .meaning = "how the load of a body without a garment grows. load: in increments; where a largest load ends "
                           "them, along the curve of equilibria, which goes on with less load. arc length: along that curve "
                           "from a twentieth of the load on"},
          self.path);
  }
};

/// A case directory, read.
struct Case {
  std::string title;
  std::filesystem::path directory;
  std::optional<BodySpec> body;
  std::vector<GarmentSpec> garments;
  std::vector<ContactSpec> contacts;
  std::optional<ComfortSpec> comfort;
  std::optional<LoadSpec> load;
  std::vector<SupportSpec> support;
  SolverSpec solver;
  std::optional<ReferenceSpec> reference;
  std::optional<StudySpec> study;
  std::vector<ToolSpec> tools;
  std::vector<MovingBoneSpec> bones;
  std::vector<PostureSpec> postures;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "title", .meaning = "one line that names the case in results", .required = true}, self.title);
    field(Field{.key = "body", .meaning = "the body: layers, mesh, locations"}, self.body);
    field(Field{.key = "garment", .meaning = "the garment: pattern, fabric, placement; several as [[garment]], each with its name, the first next to the skin",
                .one_or_more = true},
          self.garments);
    field(Field{.key = "contact", .meaning = "contact of a garment with what it lies on, or of two surfaces of the body; several as [[contact]]",
                .one_or_more = true},
          self.contacts);
    field(Field{.key = "comfort", .meaning = "sensation by location and overall comfort"}, self.comfort);
    field(Field{.key = "load", .meaning = "loads on the body beside a garment"}, self.load);
    field(Field{.key = "support", .meaning = "surfaces of the body that are held or moved"}, self.support);
    field(Field{.key = "tool", .meaning = "a rigid tool that is moved into the body; several as [[tool]]", .one_or_more = true}, self.tools);
    field(Field{.key = "bone", .meaning = "a rigid part of the body's core that postures move; several as [[bone]]", .one_or_more = true}, self.bones);
    field(Field{.key = "posture", .meaning = "a position that the body takes when the garment is on; several as [[posture]] are a movement, in their order", .one_or_more = true}, self.postures);
    field(Field{.key = "solver", .meaning = "how much of the body is solved"}, self.solver);
    field(Field{.key = "reference", .meaning = "nodal tables that the result is compared with"}, self.reference);
    field(Field{.key = "study", .meaning = "what snug study compares: meshes, variants, exact answer"}, self.study);
  }
};

struct ReadOptions {
  std::vector<std::string> overrides;  ///< "section.key=value", as of --set
  bool allow_outside = false;
  std::filesystem::path bodies = {};  ///< folder of the standard bodies; empty: none are known
};

/// Reads DIR/case.toml. Throws InputError with every error of the case together.
Case read_case(const std::filesystem::path& directory, const ReadOptions& options = {});

}  // namespace snug::input
