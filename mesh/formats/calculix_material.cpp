#include "mesh/formats/calculix_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh {

namespace {

ModelLaw hyperelastic_law(const FieldLine& card, const InpParameters& parameters) {
  if (parameters.contains("NEOHOOKE")) return ModelLaw::neo_hooke;
  if (parameters.contains("MOONEY-RIVLIN")) return ModelLaw::mooney_rivlin;
  if (parameters.contains("OGDEN")) return ModelLaw::ogden;
  if (parameters.contains("ARRUDA-BOYCE")) return ModelLaw::arruda_boyce;
  const std::string terms = value_of(parameters, "N");
  if (parameters.contains("YEOH") || (parameters.contains("REDUCEDPOLYNOMIAL") && (terms == "2" || terms == "3"))) return ModelLaw::yeoh;
  if (parameters.contains("REDUCEDPOLYNOMIAL") && (terms.empty() || terms == "1")) return ModelLaw::neo_hooke;
  const bool polynomial = parameters.contains("POLYNOMIAL") || parameters.size() == std::size_t{parameters.contains("N")};  // the form that Abaqus and CalculiX take where none is named
  if (polynomial && (terms.empty() || terms == "1")) return ModelLaw::mooney_rivlin;
  card.error(0, "this hyperelastic law is not taken over",
             "use NEO HOOKE, MOONEY-RIVLIN, POLYNOMIAL with N=1, REDUCED POLYNOMIAL up to N=3, YEOH, ARRUDA-BOYCE or OGDEN");
  return ModelLaw::none;
}

}  // namespace

InpConstants::InpConstants(const FieldLine& card, const InpParameters& parameters, bool elastic)
    : law_(elastic ? ModelLaw::elastic : hyperelastic_law(card, parameters)) {
  const std::string terms = value_of(parameters, "N"), type = value_of(parameters, "TYPE");
  if (elastic && !type.empty() && type.substr(0, 3) != "ISO") card.error(1, "the material is not isotropic", "use *ELASTIC with E and nu");
  if (parameters.contains("TESTDATAINPUT")) card.error(0, "the law is to be fitted to test data", "give its constants");
  const std::size_t n = static_cast<std::size_t>(std::clamp(integer_of(terms.empty() ? "1" : terms).value_or(1), 1, 6));
  switch (law_) {
    case ModelLaw::elastic: shape_ = 2; break;
    case ModelLaw::neo_hooke: shape_ = 1, volume_ = 1; break;
    case ModelLaw::mooney_rivlin: shape_ = 2, volume_ = 1; break;
    case ModelLaw::arruda_boyce: shape_ = 2, volume_ = 1; break;
    case ModelLaw::yeoh: shape_ = volume_ = parameters.contains("YEOH") ? 3 : n; break;
    case ModelLaw::ogden: shape_ = 2 * n, volume_ = n; break;
    case ModelLaw::compressible_neo_hooke:  // no keyword of these decks
    case ModelLaw::none: break;
  }
}

void InpConstants::take(const FieldLine& line, ModelMaterial& material) {
  if (law_ == ModelLaw::none) return;
  const std::size_t due = shape_ + volume_;
  if (values_.size() >= due) return line.error(0, "the constants depend on the temperature, or go on", "give them for one temperature");
  for (std::size_t f = 0; f < std::min<std::size_t>(line.fields.size(), 8) && values_.size() < due; ++f) values_.push_back(line.number_at(f));
  if (values_.size() < due && due > 8 && values_.size() % 8 == 0) return;  // goes on
  values_.resize(due, 0.0);
  set_law(line, material);
}

void InpConstants::set_law(const FieldLine& line, ModelMaterial& material) const {
  std::vector<double>& c = material.constants;
  material.law = law_;
  if (law_ == ModelLaw::arruda_boyce) material.volume = ModelVolume::barrier;  // U = (J^2 - 1 - 2 ln J)/(2 D) in both programs
  c.assign(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(shape_));
  if (law_ == ModelLaw::neo_hooke) c[0] *= 2.0;
  if (law_ == ModelLaw::ogden)
    for (std::size_t t = 0; t < shape_; t += 2) c[t] *= 2.0 / c[t + 1];
  for (std::size_t d = shape_ + 1; d < values_.size(); ++d)
    if (values_[d] != 0.0) line.error(0, fmt::format("D{} is {}: the volume has a law of higher order", d - shape_ + 1, values_[d]), "give D1 only");
  if (law_ == ModelLaw::yeoh) c.resize(3, 0.0);
  if (values_.size() > shape_) c.push_back(2.0 / values_[shape_]);
  for (const double value : c)
    if (!std::isfinite(value)) return line.error(0, "the material is perfectly incompressible or incomplete (D1 = 0)", "give D1 = 2/kappa");
}

}  // namespace snug::mesh
