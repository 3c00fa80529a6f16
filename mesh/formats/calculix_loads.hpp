// Steps of the inputs of CalculiX and Abaqus: supports, forces, pressures, and the surfaces and frames that they act on.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/formats/calculix_sets.hpp"
#include "mesh/formats/nodal_frames.hpp"

namespace snug::mesh {

/// Of several steps the end of the chosen one is taken; what stands in later ones is passed over.
/// What later steps leave alone stays, what they set again takes the place of the earlier value (OP=MOD); OP=NEW begins anew.
class InpLoads {
 public:
  /// `sets` names what is loaded and outlives this.
  InpLoads(const InpSets& sets, const std::string& file, input::Diagnostics& diagnostics, int chosen_step)
      : sets_(sets), file_(file), diagnostics_(diagnostics), chosen_(chosen_step) {}

  /// Cards; each gives what reads its data lines. `name`: the card, in capitals without blanks.
  void step(const FieldLine& card, const InpParameters& parameters);
  InpData static_step();
  InpData amplitude(const InpParameters& parameters);
  InpData boundary(const FieldLine& card, const InpParameters& parameters);
  InpData forces(const FieldLine& card, const InpParameters& parameters);
  InpData pressures(const FieldLine& card, const InpParameters& parameters);
  InpData surface(const FieldLine& card, const InpParameters& parameters);
  InpData surface_pressures(const FieldLine& card, const InpParameters& parameters);
  InpData transform(const FieldLine& card, const InpParameters& parameters);

  int steps() const { return steps_; }
  /// Whether the present step comes after the chosen one.
  bool over() const { return chosen_ > 0 && steps_ > chosen_; }
  /// Line of the last step that counts.
  int step_line() const { return step_line_; }
  bool large_displacements() const { return large_displacements_; }

  /// Puts all of it into the model, whose nodes are there, in the global frame.
  void give(Model& model);

 private:
  struct SurfaceFace {
    int element, face;
    double sign;
  };
  /// Loads in the order of their cards, and where those of the present step begin.
  template <class Load>
  struct Loads {
    std::vector<Load> all;
    std::size_t first_of_step = 0;

    void clear() { all.clear(), first_of_step = 0; }
    void begin_step() { first_of_step = all.size(); }
    /// Adds a load, or puts its value in the place of that of an earlier step.
    template <class Same>
    void put(const Load& load, Same same) {
      const auto end = all.begin() + static_cast<std::ptrdiff_t>(first_of_step);
      const auto earlier = std::find_if(all.begin(), end, same);
      if (earlier != end) *earlier = load;
      else all.push_back(load);
    }
  };
  using Scaled = std::function<void(const FieldLine&, double)>;
  InpData scaled(const FieldLine& card, const InpParameters& parameters, Scaled take) const;
  void hold(const FieldLine& line, double by);
  void push(const FieldLine& line, double by);
  void press(const FieldLine& line, double by);
  void press_surface(const FieldLine& line, double by);
  void weigh(const FieldLine& line, double by);
  static void put(Loads<ModelPressure>& pressures, const ModelPressure& pressure);
  /// A pressure without a face acts on shells alone.
  void check_faces(const Model& model);
  /// Weight is that of solids whose density is known.
  void check_weights(const Model& model);
  NodalFrames frames(const Model& model);

  const InpSets& sets_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  std::map<std::string, std::vector<SurfaceFace>> surfaces_;
  std::map<std::string, std::vector<std::pair<double, double>>> amplitudes_;  ///< times and values
  std::map<int, input::Location> along_normal_;  ///< elements with a pressure that names no face, and where
  std::map<int, input::Location> weighed_;       ///< elements with a weight, and where
  std::vector<std::pair<std::string, FrameByPoints>> transforms_;             ///< of sets of nodes
  std::vector<ModelSupport> supports_;
  Loads<ModelForce> forces_;
  Loads<ModelPressure> pressures_, surface_pressures_;  ///< of *DLOAD and *DSLOAD
  Loads<ModelWeight> weights_;                          ///< of *DLOAD
  int chosen_, steps_ = 0, step_line_ = 0;
  double period_ = 1.0;  ///< of the step
  bool large_displacements_ = false;
};

}  // namespace snug::mesh
