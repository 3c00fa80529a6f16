#include "materials/database/items.hpp"

#include <unordered_map>

namespace snug::materials {

const std::vector<Item>& usual_items() {
  using enum Kind;
  using B = Block;
  static const std::vector<Item> items = {
      // table 2.1, and the items of KES-F tests
      {fabric, B::general, "source", "", "text", "where the numbers come from"},
      {fabric, B::general, "fabric type", "", "text", "woven, knitted, nonwoven"},
      {fabric, B::general, "structure", "", "text", "weave or knit"},
      {fabric, B::general, "composition", "", "text", "fibres and their shares"},
      {fabric, B::general, "company", "", "text", "who makes or sells it"},
      {fabric, B::general, "price", "", "", "as printed"},
      {fabric, B::general, "picture", "", "text", "a figure, or the number of one"},
      {fabric, B::structural, "finishing", "", "text", "condition of finishing"},
      {fabric, B::structural, "length", "", "m", "of the piece"},
      {fabric, B::structural, "width", "", "m", "of the piece"},
      {fabric, B::structural, "thickness", "h", "m", "thickness"},
      {fabric, B::structural, "weight", "", "kg/m2", "mass per area"},
      {fabric, B::structural, "density", "", "kg/m3", "mass per volume"},
      {fabric, B::structural, "warp cover factor", "", "", "as printed"},
      {fabric, B::structural, "weft cover factor", "", "", "as printed"},
      {fabric, B::structural, "warp count", "", "", "of the yarn, in the system that the source names"},
      {fabric, B::structural, "weft count", "", "", "of the yarn, in the system that the source names"},
      {fabric, B::structural, "ends", "", "1/m", "warp yarns per width"},
      {fabric, B::structural, "picks", "", "1/m", "weft yarns per length"},
      {fabric, B::structural, "warp crimp", "", "", "yarn over cloth length, less one"},
      {fabric, B::structural, "weft crimp", "", "", "yarn over cloth length, less one"},
      {fabric, B::mechanical, "EA", "E_1", "Pa",
       "tensile modulus over the thickness: warp in table 2.1, weft in section 2.3.2"},
      {fabric, B::mechanical, "EB", "E_2", "Pa", "tensile modulus over the thickness: weft in table 2.1"},
      {fabric, B::mechanical, "GAB", "", "Pa", "shear modulus over the thickness"},
      {fabric, B::mechanical, "poisson_BA", "", "", "Poisson ratio"},
      {fabric, B::mechanical, "poisson", "", "",
       "coupling of warp and weft by the smallest stiffness, as the laws read it"},
      {fabric, B::mechanical, "warp", "", "N/m", "stiffness along the warp"},
      {fabric, B::mechanical, "weft", "", "N/m", "stiffness along the weft"},
      {fabric, B::mechanical, "shear", "", "N/m", "shear stiffness of the linear and cubic laws"},
      {fabric, B::mechanical, "LT", "", "", "linearity of the tensile curve"},
      {fabric, B::mechanical, "WT", "", "J/m2", "tensile work"},
      {fabric, B::mechanical, "RT", "", "", "tensile resilience", "%"},
      {fabric, B::mechanical, "EMT", "", "", "elongation at the largest force", "%"},
      {fabric, B::mechanical, "Fm", "", "N/m", "largest force of the tensile test"},
      {fabric, B::mechanical, "G", "", "N/(m rad)", "shear stiffness"},
      {fabric, B::mechanical, "2HG", "", "N/m", "hysteresis of shear at 0.5 degrees"},
      {fabric, B::mechanical, "2HG5", "", "N/m", "hysteresis of shear at 5 degrees"},
      {fabric, B::mechanical, "B", "", "N m", "bending stiffness per width"},
      {fabric, B::mechanical, "B_weft", "", "N m", "bending stiffness per width of the weft"},
      {fabric, B::mechanical, "2HB", "", "N", "hysteresis of bending"},
      {fabric, B::mechanical, "LC", "", "", "linearity of the compression curve"},
      {fabric, B::mechanical, "WC", "", "J/m2", "work of compression"},
      {fabric, B::mechanical, "RC", "", "", "resilience of compression", "%"},
      {fabric, B::mechanical, "T0", "", "m", "thickness at 0.5 gf/cm2"},
      {fabric, B::mechanical, "Tm", "", "m", "thickness at the largest pressure of the compression test"},
      {fabric, B::mechanical, "Pm", "", "Pa", "largest pressure of the compression test; 50 gf/cm2 where it is not given"},
      {fabric, B::mechanical, "compression modulus", "", "Pa", "through the thickness"},
      {fabric, B::mechanical, "twisting rigidity", "", "N m", "per width"},
      {fabric, B::mechanical, "MIU", "", "", "mean coefficient of friction"},
      {fabric, B::mechanical, "MMD", "", "", "mean deviation of MIU"},
      {fabric, B::mechanical, "SMD", "", "m", "roughness"},
      {fabric, B::mechanical, "weft tensile test", "", "N/m",
       "force per width over elongation: a value, a table or a figure"},
      {fabric, B::physical, "surface volume ratio", "S_v", "1/m", "inner surface per volume"},
      {fabric, B::physical, "vapour fraction", "eps_a", "", "volume fraction of water vapour"},
      {fabric, B::physical, "porosity", "eps", "", "volume fraction of the pores"},
      {fabric, B::physical, "fibre fraction", "eps_f", "", "volume fraction of the fibres"},
      {fabric, B::physical, "liquid fraction", "eps_l", "", "volume fraction of the liquid phase"},
      {fabric, B::physical, "liquid exponent", "m", "", "of delta"},
      {fabric, B::physical, "liquid share", "delta", "", "(eps_l/eps)^m"},
      {fabric, B::physical, "fibre radius", "R_f", "m", "radius of the fibres"},
      {fabric, B::physical, "saturated vapour concentration", "C_sat", "kg/m3", "C* of the source"},
      {fabric, B::physical, "absorptivity", "", "", "of the outer surface, for radiation"},
      {fabric, B::physical, "thermal conductivity", "", "W/(m K)", "through the thickness"},
      {fabric, B::physical, "thermal capacity", "", "J/(m3 K)", "per volume"},
      {fabric, B::physical, "vapour diffusivity", "", "m2/s", "of water vapour"},
      {fabric, B::physical, "liquid diffusivity", "", "m2/s", "of liquid water"},
      // table 2.2
      {fibre, B::general, "fibre type", "", "text", "natural, regenerated, synthetic"},
      {fibre, B::structural, "diameter", "d", "m", "of the fibre"},
      {fibre, B::structural, "count", "", "kg/m", "mass per length"},
      {fibre, B::structural, "contact angle", "", "rad", "between the surface and water"},
      {fibre, B::mechanical, "tensile modulus", "E", "Pa", "along the fibre"},
      {fibre, B::mechanical, "flexural rigidity", "", "N m2", "of the fibre"},
      {fibre, B::mechanical, "shear modulus", "", "Pa", "of the fibre"},
      {fibre, B::mechanical, "torsional rigidity", "", "N m2", "of the fibre"},
      {fibre, B::mechanical, "friction factor", "", "", "of fibre on fibre"},
      {fibre, B::physical, "heat of liquid sorption", "", "J/kg", "differential"},
      {fibre, B::physical, "heat of vapour sorption", "", "J/kg", "differential"},
      {fibre, B::physical, "integral heat of sorption", "", "J/kg", "from dry to saturated"},
      {fibre, B::physical, "radiation absorption", "", "1/m", "absorption constant"},
      {fibre, B::physical, "specific heat", "", "J/(kg K)", "of the fibre"},
      {fibre, B::physical, "diffusivity", "", "m2/s", "in the fibre"},
      // yarns of table 2.4
      {yarn, B::mechanical, "bending rigidity", "", "N m2", "of the yarn"},
      {yarn, B::mechanical, "relaxation time", "", "s", "of the yarn"},
      {yarn, B::structural, "twist", "", "1/m", "turns per length"},
      // table 2.3
      {body, B::structural, "stature", "", "m", "height of the person"},
      {body, B::structural, "shoulder", "", "m", "width"},
      {body, B::structural, "breast", "", "m", "girth"},
      {body, B::structural, "waist", "", "m", "girth"},
      {body, B::structural, "hip", "", "m", "girth"},
      {body, B::structural, "arm", "", "m", "length"},
      {body, B::structural, "leg", "", "m", "length"},
      {body, B::structural, "neck", "", "m", "girth"},
      {body, B::structural, "body mass", "", "kg", "weight of the person"},
      {body, B::physiological, "skin thickness", "", "m", "of the whole skin"},
      {body, B::physiological, "skin density", "", "kg/m3", "of the skin"},
      {body, B::physiological, "skin tensile modulus", "", "Pa", "of the skin"},
      {body, B::physiological, "bone density", "", "kg/m3", "of the bone"},
      {body, B::physiological, "bone modulus", "", "Pa", "of the bone"},
      {body, B::physiological, "soft tissue thickness", "", "m", "from skin to bone"},
      {body, B::physiological, "soft tissue density", "", "kg/m3", "between skin and bone"},
      {body, B::physiological, "soft tissue shear modulus", "", "Pa", "between skin and bone"},
      {body, B::material, "conductance of tissue", "", "W/(m2 K)", "of the body's tissue"},
      {body, B::material, "specific heat of blood", "", "J/(kg K)", "at constant pressure"},
      {body, B::material, "specific heat of skin", "", "J/(kg K)", "at constant pressure"},
      {body, B::material, "emissivity", "", "", "of the skin"},
      {body, B::material, "skin area", "", "m2", "after Du Bois"},
      // tissues as the laws read them
      {tissue, B::mechanical, "law", "", "text", "form of the law (snug list)"},
      {tissue, B::mechanical, "shear_modulus", "", "Pa", "initial shear modulus"},
      {tissue, B::mechanical, "youngs_modulus", "", "Pa", "initial Young's modulus"},
      {tissue, B::mechanical, "bulk_modulus", "", "Pa", "initial bulk modulus"},
      {tissue, B::mechanical, "poisson_ratio", "", "", "initial Poisson ratio"},
      // table 2.4
      {garment, B::general, "commercial name", "", "text", "as sold"},
      {garment, B::general, "style", "", "text", "kind of garment"},
      {garment, B::general, "size", "", "text", "as labelled"},
      {garment, B::general, "pattern", "", "text", "file of the pattern"},
      {project, B::general, "designer", "", "text", "who designs"},
      {project, B::general, "purpose", "", "text", "what the design is for"},
      {project, B::general, "state", "", "text", "how far it is"},
  };
  return items;
}

namespace {

using Index = std::unordered_map<std::string, const Item*>;

const Item* in(const Index& index, const std::string& key) {
  const auto found = index.find(key);
  return found == index.end() ? nullptr : found->second;
}

Index index_by(const char* Item::*key) {
  Index index;
  for (const Item& item : usual_items())
    if (*(item.*key)) index.emplace(item.*key, &item);
  return index;
}

}  // namespace

const Item* usual_item(const std::string& name) {
  static const Index index = index_by(&Item::name);
  return in(index, name);
}

const Item* usual_symbol(const std::string& symbol) {
  static const Index index = index_by(&Item::symbol);
  return in(index, symbol);
}

}  // namespace snug::materials
