// Constants of materials in the inputs of CalculiX and Abaqus.
#pragma once

#include <vector>

#include "mesh/formats/calculix_words.hpp"
#include "mesh/formats/fields.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// The lines of constants after *ELASTIC and *HYPERELASTIC: C10, D1; C10, C01, D1; C10, C20, C30, D1, D2, D3; mu_1, alpha_1, ..., D_1, ...,
/// eight a line; kappa = 2/D1, Ogden's mu are our mu alpha/2.
class InpConstants {
 public:
  /// Reports laws that are not taken over, orthotropy and test data.
  InpConstants(const FieldLine& card, const InpParameters& parameters, bool elastic);

  /// Takes a line; when the constants are complete the material has its law. Reports more lines, incompressible and incomplete materials.
  void take(const FieldLine& line, ModelMaterial& material);

 private:
  void set_law(const FieldLine& line, ModelMaterial& material) const;

  ModelLaw law_ = ModelLaw::none;
  std::size_t shape_ = 0, volume_ = 0;  ///< numbers of constants
  std::vector<double> values_;
};

}  // namespace snug::mesh
