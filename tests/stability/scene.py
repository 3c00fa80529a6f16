"""What a scene of the catalogue is, and the parts that scenes share."""
import math
from dataclasses import dataclass, field

from case_files import N_m, Pa, Table, m


@dataclass(frozen=True)
class Exact:
    """Of a key of summary.json's numbers: |ours / value - 1| <= tolerance, or |ours - value| <= tolerance scale where a
    scale is given."""
    key: str
    value: object          # a function without arguments: solved only when asked for
    tolerance: float
    scale: float = 0.0


@dataclass(frozen=True)
class Sleeve:
    """What Laplace's estimate needs: the tension (N/m) at a hoop stretch, the girth as cut, and where it lies."""
    tension: object
    flat: float            # m
    lower: float           # m, as placed
    upper: float


@dataclass(frozen=True)
class Scene:
    name: str
    group: str
    stresses: str
    case: dict
    files: dict = field(default_factory=dict)
    base: str = ""                 # the ordinary scene of its kind: time and iterations are held against it
    same_as: str = ""              # invariance: the scene whose mean pressure it must have
    exact: Exact | None = None
    sleeve: Sleeve | None = None
    right: str = "converged"       # slides: no equilibrium exists, and the run must say so
    least_friction: float = 0.0    # of a scene that slides: the coefficient below which there is no equilibrium, to a tenth
    system: str = "SI"
    quick: bool = False


def rigid():
    return {"name": "bone", "material": "rigid"}


def neo_hooke(shear_modulus, poisson_ratio=0.49):
    return {"law": "neo-Hooke", "shear_modulus": Pa(shear_modulus), "poisson_ratio": poisson_ratio}


def spring_fabric(k1, shear=0.3, **more):
    """Nominal tension k1 (l - 1); shear stiffness as a share of it."""
    return {"law": "cubic", "k1": N_m(k1), "k3": N_m(0.0), "shear": N_m(shear * k1), "data_end": 10.0, **more}


def spring_tension(k1):
    """Nominal tension by stretch l: k1 (l - 1) up to where the slope of the second Piola-Kirchhoff stress over Green's strain,
    k1 / l^3, is a twentieth of k1; from there that stress goes on straight (TensionCurve, materials/fabric)."""
    cut = 20.0 ** (1.0 / 3.0)

    def tension(stretch):
        if stretch <= cut:
            return k1 * (stretch - 1.0)
        return stretch * k1 * ((cut - 1.0) / cut + 0.05 * (stretch**2 - cut**2) / 2.0)

    return tension


def linear_fabric(warp, weft, shear=None, **more):
    """Second Piola-Kirchhoff tension per Green strain."""
    return {"law": "linear", "warp": N_m(warp), "weft": N_m(weft), "shear": N_m(0.3 * min(warp, weft) if shear is None else shear), **more}


def linear_tension(k):
    return lambda l: k * l * (l * l - 1) / 2


def stations(heights, radii, bone, ratio=1.0, **columns):
    """Sections of the girths 2 pi radii; `columns`: more of them, values one a height or one for all."""
    per_row = lambda v: list(v) if isinstance(v, (list, tuple)) else [v] * len(heights)
    table = {"height": ("m", heights), "girth": ("m", [2 * math.pi * r for r in radii]),
             "bone_girth": ("m", [2 * math.pi * b for b in per_row(bone)]), "width_to_depth": ("", per_row(ratio))}
    lengths = {"centre_x", "centre_y", "bone_x", "bone_y"}
    table |= {name: ("m" if name in lengths else "", per_row(v)) for name, v in columns.items()}
    return Table(table)


def tube_pattern(flat, length):
    return {"kind": "tube", "flat_circumference": m(flat), "length": m(length)}


def hems(*held, how="axis"):
    return [{"edge": edge, "held": how} for edge in held]


BOTH = ("upper", "lower")
