"""Exact answers of the catalogue: a layered round limb on a rigid bone in plane strain under the pressure of a sleeve, and
a bar under the pressure on its end. SI throughout; plain Python, so that no package is needed.

Source of the equations: radial equilibrium dP_r/dR = (P_t - P_r)/R of nominal stresses in a cylinder with r' = lambda_r
(Ogden, Non-linear elastic deformations, 1984, 5.3), here along t = ln R, by Runge and Kutta's rule of fourth order.
"""
import math
from dataclasses import dataclass

STEPS = 400  # a layer; the answer's relative error is below 1e-9


@dataclass(frozen=True)
class Layer:
    """W = mu f(J^(-2/3) I1 - 3)/2 + kappa/4 (J^2 - 1 - 2 ln J); f(x) = x, or (exp(b x) - 1)/b with Fung's stiffening b."""
    inner: float  # m
    outer: float
    shear_modulus: float  # Pa
    poisson_ratio: float
    stiffening: float = 0.0

    @property
    def bulk_modulus(self):
        return 2 * self.shear_modulus * (1 + self.poisson_ratio) / (3 * (1 - 2 * self.poisson_ratio))

    def nominal(self, radial, hoop):
        """Nominal radial and hoop stress at the stretches (axial stretch 1) and the slope of the first by `radial`."""
        J = radial * hoop
        third = (radial**2 + hoop**2 + 1) / 3
        scale = J ** (-2 / 3)
        growth = math.exp(self.stiffening * (3 * scale * third - 3)) if self.stiffening else 1.0
        m = self.shear_modulus * scale * growth
        off = radial - third / radial
        kappa = self.bulk_modulus
        pressure = 0.5 * kappa * (J - 1 / J)
        slope = (-2 / 3 * m * off / radial + m * (1 / 3 + third / radial**2) + 2 * self.stiffening * m * scale * off**2
                 + 0.5 * kappa * (1 + 1 / J**2) * hoop**2)
        return m * off + pressure * hoop, m * (hoop - third / hoop) + pressure * radial, slope

    def radial_stretch(self, stress, hoop, guess):
        """The radial stretch at the nominal radial stress: Newton's rule, kept above zero."""
        x = guess
        for _ in range(200):
            found, _, slope = self.nominal(x, hoop)
            step = (stress - found) / slope
            x = x + step if step > -0.5 * x else 0.5 * x
            if abs(step) < 1e-15 * x:
                break
        return x


def march(layers, bone_stress):
    """Radius and nominal radial stress of the outer surface, from the nominal stress at the bone, which does not move."""
    r, stress, guess = layers[0].inner, bone_stress, 1.0
    for layer in layers:
        start = math.log(layer.inner)
        h = (math.log(layer.outer) - start) / STEPS

        def slope(t, r, stress):
            nonlocal guess
            R = math.exp(t)
            guess = layer.radial_stretch(stress, r / R, guess)
            return R * guess, layer.nominal(guess, r / R)[1] - stress

        for n in range(STEPS):
            t = start + n * h
            a = slope(t, r, stress)
            b = slope(t + h / 2, r + h / 2 * a[0], stress + h / 2 * a[1])
            c = slope(t + h / 2, r + h / 2 * b[0], stress + h / 2 * b[1])
            d = slope(t + h, r + h * c[0], stress + h * c[1])
            r += h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
            stress += h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
    return r, stress


@dataclass(frozen=True)
class LimbAnswer:
    pressure: float      # Pa
    displacement: float  # m, of the outer surface


def solve_limb(layers, load):
    """`load(r)`: pressure (Pa) on the deformed outer surface of radius r. Brackets the balance by the stress at the bone
    (none: the load wins), then the Illinois rule. Raises ArithmeticError where no bracket is found."""
    outer = layers[-1].outer

    def off(bone_stress):
        try:
            r, stress = march(layers, bone_stress)
        except (ArithmeticError, ValueError, TypeError):
            return -math.inf, math.nan
        return stress + load(r) * r / outer, r

    low, (f_low, r) = 0.0, off(0.0)
    if f_low == 0.0:
        return LimbAnswer(load(r), r - outer)
    high = -load(outer)
    for _ in range(60):
        f_high, r = off(high)
        if f_high <= 0:
            break
        low, f_low, high = high, f_high, 2 * high
    else:
        raise ArithmeticError("no stress at the bone balances the load")
    weight_low, weight_high = f_low, f_high
    for _ in range(300):
        middle = 0.5 * (low + high) if math.isinf(weight_high) else high - weight_high * (high - low) / (weight_high - weight_low)
        f, r = off(middle)
        if f > 0:
            low, weight_low, weight_high = middle, f, weight_high if math.isinf(weight_high) else 0.5 * weight_high
        else:
            high, weight_high, weight_low = middle, f, 0.5 * weight_low
        if abs(f) < 1e-11 * load(outer) or abs(high - low) < 1e-14 * abs(high):
            break
    return LimbAnswer(load(r), r - outer)


def bar_stretch(shear_modulus, poisson_ratio, tension):
    """Stretch of a free bar whose ends are pulled by `tension` (Pa) on their current area, so that it is the Cauchy stress:
    for W as above, sigma_a - sigma_t = mu J^(-5/3) (l^2 - s^2) = tension and sigma_t = 0, by nested bisection."""
    kappa = Layer(1, 2, shear_modulus, poisson_ratio).bulk_modulus

    def side(l):
        def lateral(s):
            J = l * s * s
            return shear_modulus * J ** (-5 / 3) * (s * s - l * l) / 3 + 0.5 * kappa * (J - 1 / J)
        return bisect(lateral, 1e-3, 1e3)

    def axial(l):
        s = side(l)
        return shear_modulus * (l * s * s) ** (-5 / 3) * (l * l - s * s) - tension
    return bisect(axial, 0.05, 50.0)


def hydrostatic_stretch(shear_modulus, poisson_ratio, pressure):
    """Stretch in every direction of a free block under pressure all round: kappa/2 (J - 1/J) = -pressure, J = l^3."""
    kappa = Layer(1, 2, shear_modulus, poisson_ratio).bulk_modulus
    return bisect(lambda l: 0.5 * kappa * (l**3 - l**-3) + pressure, 0.05, 1.0)


def bisect(f, low, high):
    """Root of an increasing function, to rounding; the bracket is halved in ratio."""
    for _ in range(200):
        middle = math.sqrt(low * high)
        if f(middle) < 0:
            low = middle
        else:
            high = middle
    return math.sqrt(low * high)
