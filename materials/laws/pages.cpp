// The pages of the laws.
#include "materials/laws/inputs.hpp"

namespace snug::materials {

LawPage NeoHookeInput::page() {
  return {.name = "neo-Hooke",
          .formula = "W = mu/2 (J^(-2/3) I1 - 3) + U(J)",
          .use = "soft tissue of which one modulus is known; strains up to about 50 %",
          .source =
              "Treloar, Trans. Faraday Soc. 39 (1943) 36-41; split: Simo & Miehe, Comput. Methods Appl. Mech. "
              "Engrg. 98 (1992) 41-104"};
}

LawPage MooneyRivlinInput::page() {
  return {.name = "Mooney-Rivlin",
          .formula = "W = C10 (J^(-2/3) I1 - 3) + C01 (J^(-4/3) I2 - 3) + U(J), shear modulus 2 (C10 + C01)",
          .use =
              "sets published in this form; with C01 = 0 it is neo-Hooke. Sets with a negative coefficient lose their "
              "stability at a finite stretch and are not taken: fit Ogden instead",
          .source = "Mooney, J. Appl. Phys. 11 (1940) 582-592; Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379-397"};
}

LawPage OgdenInput::page() {
  return {.name = "Ogden",
          .formula =
              "W = sum mu_p/alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) + U(J), l_a = J^(-1/3) lambda_a, "
              "shear modulus sum mu_p alpha_p/2. Sets written as 2 mu_p/alpha_p^2 (Abaqus) or c_p/m_p^2 (FEBio): "
              "multiply by 2/alpha_p or 1/m_p",
          .use =
              "tissue that stiffens in compression or stretch (fat, passive muscle, skin), from a fit over the strains "
              "that occur; slower than neo-Hooke",
          .source = "Ogden, Proc. R. Soc. A 326 (1972) 565-584"};
}

LawPage YeohInput::page() {
  return {.name = "Yeoh",
          .formula = "W = C10 x + C20 x^2 + C30 x^3 + U(J), x = J^(-2/3) I1 - 3, shear modulus 2 C10",
          .use = "skin, muscle and elastomers that stiffen with stretch, from sets published in this form; blind to what the second invariant tells",
          .source = "Yeoh, Rubber Chem. Technol. 66 (1993) 754-771"};
}

LawPage ArrudaBoyceInput::page() {
  return {.name = "Arruda-Boyce",
          .formula = "W = mu sum_i C_i/m^(2i-2) (I^i - 3^i) + U(J), I = J^(-2/3) I1, m = locking_stretch, C = 1/2, 1/20, 11/1050, 19/7000, 519/673750; shear modulus "
                     "mu (1 + 3/(5 m^2) + 99/(175 m^4) + 513/(875 m^6) + 42039/(67375 m^8))",
          .use = "elastomers up to where their chains are straight, from sets published in this form; blind to what the second invariant tells",
          .source = "Arruda & Boyce, J. Mech. Phys. Solids 41 (1993) 389-412"};
}

LawPage FungInput::page() {
  return {.name = "Fung",
          .formula = "W = mu/(2 b) (exp(b (J^(-2/3) I1 - 3)) - 1) + U(J), b = stiffening",
          .use = "skin and other collagenous tissue that stiffens exponentially, taken as isotropic",
          .source = "Demiray, J. Biomech. 5 (1972) 309-311, after Fung, Am. J. Physiol. 213 (1967) 1532-1544"};
}

LawPage CompressibleNeoHookeInput::page() {
  return {.name = "compressible-neo-Hooke",
          .formula = "W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2, lambda = kappa - 2/3 mu",
          .use = "compressible solids (foam, padding) in displacement-only elements; Poisson ratio at most 0.495",
          .source = "Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008), eq. 6.27"};
}

LawPage LinearElasticInput::page() {
  return {.name = "linear-elastic",
          .formula = "W = lambda/2 (tr E)^2 + mu E:E with the Green-Lagrange strain E: linear, and blind to rotation",
          .use = "bone and other stiff solids of small strain; not for soft tissue, it softens in compression",
          .source = "St. Venant-Kirchhoff: Holzapfel, Nonlinear Solid Mechanics (2000), eq. 6.151"};
}

}  // namespace snug::materials
