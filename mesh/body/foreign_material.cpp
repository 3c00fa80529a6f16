#include "mesh/body/foreign_material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mesh/formats/fields.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

const char* volume_name(ModelVolume volume) {
  switch (volume) {
    case ModelVolume::quadratic: return "quadratic";
    case ModelVolume::logarithmic: return "logarithmic";
    case ModelVolume::barrier: break;
  }
  return "barrier";
}

/// The inline table that describes the law; `stress` and `density` are the units of the file in SI.
std::string law_table(const ModelMaterial& material, double stress, double density) {
  const std::vector<double>& c = material.constants;
  const auto pascal = [&](double value) { return fmt::format("\"{:.17g} Pa\"", stress * value); };
  const std::string volume = c.empty() ? "" : fmt::format("bulk_modulus = {}, volumetric = \"{}\"", pascal(c.back()), volume_name(material.volume));
  std::string law;
  switch (material.law) {
    case ModelLaw::none: break;
    case ModelLaw::elastic:
      law = fmt::format("law = \"linear-elastic\", youngs_modulus = {}, poisson_ratio = {:.17g}", pascal(c[0]), c[1]);
      break;
    case ModelLaw::compressible_neo_hooke:
      law = fmt::format("law = \"compressible-neo-Hooke\", shear_modulus = {}, poisson_ratio = {:.17g}", pascal(0.5 * c[0] / (1.0 + c[1])), c[1]);
      break;
    case ModelLaw::neo_hooke:
      law = fmt::format("law = \"neo-Hooke\", shear_modulus = {}, {}", pascal(c[0]), volume);
      break;
    case ModelLaw::mooney_rivlin:
      law = fmt::format("law = \"Mooney-Rivlin\", C10 = {}, C01 = {}, {}", pascal(c[0]), pascal(c[1]), volume);
      break;
    case ModelLaw::yeoh:
      law = fmt::format("law = \"Yeoh\", C10 = {}, C20 = {}, C30 = {}, {}", pascal(c[0]), pascal(c[1]), pascal(c[2]), volume);
      break;
    case ModelLaw::arruda_boyce:
      law = fmt::format("law = \"Arruda-Boyce\", mu = {}, locking_stretch = {:.17g}, {}", pascal(c[0]), c[1], volume);
      break;
    case ModelLaw::ogden: {
      std::vector<std::string> terms;
      for (std::size_t t = 0; t + 1 < c.size(); t += 2)
        terms.push_back(fmt::format("{{ mu = {}, alpha = {:.17g} }}", pascal(c[t]), c[t + 1]));
      law = fmt::format("law = \"Ogden\", terms = [{}], {}", fmt::join(terms, ", "), volume);
      break;
    }
  }
  if (material.density > 0.0) law += fmt::format(", density = \"{:.17g} kg/m3\"", density * material.density);
  return "{ " + law + " }";
}

std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> names;
  for (const ModelMaterial& material : model.materials) names.push_back(material.name);
  return names;
}

}  // namespace

std::vector<Layer> foreign_layers(const Model& model, const input::BodySpec& spec) {
  const double stress = spec.force_unit / (spec.unit * spec.unit);
  const double density = spec.force_unit / std::pow(spec.unit, 4);  // force s2/length^4: the unit of time is the second
  std::vector<Layer> layers;
  for (const ModelMaterial& material : model.materials) {
    const auto given = std::find_if(spec.layers.begin(), spec.layers.end(), [&](const input::LayerSpec& layer) {
      return upper_case(layer.name) == upper_case(material.name);
    });
    if (given != spec.layers.end()) {
      layers.push_back({given->name, given->material});
    } else if (material.law == ModelLaw::none) {
      throw InputError({spec.mesh.string(), 0, 0}, fmt::format("\"{}\" has no elastic constants", material.name),
                       fmt::format("give them there, or add {{ name = \"{}\", material = ... }} to body.layers", material.name));
    } else {
      const input::Location where{spec.mesh.string(), 0, 0};
      layers.push_back({material.name, {"", input::table_of(law_table(material, stress, density), where), where}});
    }
  }
  for (const input::LayerSpec& layer : spec.layers) {
    if (layer.form != input::LayerForm::solid && layer.form != input::LayerForm::shell)
      throw InputError(layer.where, fmt::format("layer \"{}\" is {}", layer.name, text_of(layer.form)),
                       "the layers of an APDL or CalculiX file are solid or shells by their elements; hold nodes with [[support]]");
    if (std::none_of(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == layer.name; }))
      throw InputError(layer.where, fmt::format("{} has no material \"{}\"", spec.mesh.string(), layer.name),
                       fmt::format("its materials are: {}", fmt::join(names_of(model), ", ")));
  }
  return layers;
}

}  // namespace snug::mesh
