// Supports, forces and pressures of APDL commands, and the load steps that they make up.
#pragma once

#include <string>
#include <vector>

#include "mesh/formats/apdl_deck.hpp"
#include "mesh/formats/apdl_selection.hpp"

namespace snug::mesh {

/// Puts what the commands say into the deck; nodes are those that the selection names. SOLVE and LSWRITE end a load step; what comes after the chosen
/// one (0: the last) is passed over.
class ApdlLoads {
 public:
  ApdlLoads(ApdlDeck& deck, const ApdlSelection& selection, int chosen_step) : deck_(deck), selection_(selection), chosen_(chosen_step) {}

  /// Takes a command of loads or steps, by its short name; false when it is none.
  bool take(const std::string& name, const FieldLine& line);

  /// Load steps that the text ends; commands behind the last SOLVE or LSWRITE make up one more.
  int steps() const { return ended_ + (ended_ > 0 && changed_ ? 1 : 0); }
  /// Line of the last end of a step, 0 for none.
  int line() const { return line_; }

 private:
  /// D and DK: node, label, value, ..., end and step of a range, more labels.
  void support(const FieldLine& line, std::vector<ModelSupport>& supports) const;
  /// F and FK: node, label, value, ..., end and step of a range.
  void force(const FieldLine& line, std::vector<ModelForce>& forces) const;
  /// SFE,element,face,PRES,,value.
  void surface_load(const FieldLine& line) const;
  /// DDELE, FDELE: node, label, end and step of a range. SFEDELE: element, face, PRES. LSCLEAR: ALL or FE.
  void remove_supports(const FieldLine& line) const;
  void remove_forces(const FieldLine& line) const;
  void remove_pressures(const FieldLine& line) const;
  void clear(const FieldLine& line) const;
  void end_step(const std::string& name, int line);

  ApdlDeck& deck_;
  const ApdlSelection& selection_;
  int chosen_, ended_ = 0, line_ = 0;
  bool changed_ = false, written_ = false;  ///< since the last step ended; whether LSWRITE has ended steps
};

}  // namespace snug::mesh
