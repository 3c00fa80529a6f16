"""Limbs that taper, bulge, hollow or bend inwards, with sleeves that friction, a hem or nothing holds: no exact answers, but
Laplace's estimate at each height."""
import math

import shapes
from case_files import N_m, Pa, Quantity, m
from scene import (BOTH, Scene, Sleeve, hems, linear_fabric, linear_tension, neo_hooke, rigid, spring_fabric, spring_tension,
                   stations, tube_pattern)


def body(layers, around=12, along=4, **more):
    return {"stations": "limb.csv", "layers": [rigid(), *layers], "cells_around": around, "cells_along": along, **more}


def tissue(shear_modulus, poisson_ratio=0.49, cells=1):
    return {"name": "tissue", "material": neo_hooke(shear_modulus, poisson_ratio), "cells": cells}


def skin(shear_modulus, thickness=0.0015):
    return {"name": "skin", "material": neo_hooke(shear_modulus), "thickness": m(thickness)}


def sleeve_scene(name, group, stresses, *, limb, girths, flat, position, length, k1=125.0, fabric=None, tension=None, held=(),
                 how="axis", friction=None, cell=0.0, laplace=True, seam=None, **more):
    garment = {"pattern": tube_pattern(flat, length), "fabric": fabric or spring_fabric(k1), "position": m(position)}
    if held:
        garment["held"] = hems(*held, how=how)
    if cell:
        garment["cell_size"] = m(cell)
    if seam is not None:
        garment["seam"] = f"{seam!r} deg"
    case = {"body": limb, "garment": garment, "contact": {} if friction is None else {"friction": friction}}
    estimate = Sleeve(tension or spring_tension(k1), flat, position, position + length) if laplace else None
    files = {"limb.csv": girths} if girths else {}
    return Scene(name, group, stresses, case, files | more.pop("files", {}), sleeve=estimate, **more)


# The tapering limb: radius 45 to 55 mm over 100 mm, 5 kPa; a sleeve of 42 mm from 10 to 90 mm: 0.2 to 0.5 kPa.
TAPER = stations([0.0, 0.05, 0.1], [0.045, 0.050, 0.055], 0.020)


def taper(name, group, stresses, nu=0.49, mu=5e3, rest=0.042, elements="Q2/P1", layers=None, along=4, around=12, position=0.01,
          length=0.08, girths=TAPER, **more):
    limb = body(layers or [tissue(mu, nu)], around, along, elements=elements)
    more.setdefault("base", "taper")
    return sleeve_scene(name, group, stresses, limb=limb, girths=girths, flat=2 * math.pi * rest, position=position, length=length, **more)


def tapers():
    held = {"held": ("upper",), "friction": 0, "base": "taper frictionless"}
    loose = {"laplace": False}
    weight = {"weight": Quantity(0.2, "kg/m2"), "B": Quantity(1e-6, "N m")}
    yield taper("taper", "ordinary", "nothing: cone of half angle 6 degrees, default friction, no hem held", quick=True)
    yield taper("taper frictionless", "ordinary", "upper hem held, no friction", **held)
    yield taper("taper frictionless P2/P1", "ordinary", "tetrahedra", elements="P2/P1", **held)
    yield taper("taper frictionless Q1/P0", "ordinary", "linear hexahedra", elements="Q1/P0", **held)
    for elements in ("Q2/P1", "P2/P1", "Q1/P0"):
        base = "taper frictionless" + ("" if elements == "Q2/P1" else f" {elements}")
        yield taper(f"taper nu 0.4999999 {elements}", "volume", f"nu = 0.4999999, {elements}, hem pulls tissue along", 0.4999999,
                    elements=elements, quick=elements == "Q2/P1", **held | {"base": base})
    yield taper("taper both hems", "hems", "both hems held, no friction", held=BOTH, friction=0)
    yield taper("taper upper hem", "hems", "upper hem held, default friction", held=("upper",))
    yield taper("taper narrow hem", "hems", "hem at the narrow end held, default friction", held=("lower",))
    yield taper("taper hem fixed", "hems", "upper hem held in all directions", held=("upper",), how="all", laplace=False)
    yield taper("taper friction 0.01", "friction", "friction 0.01, no hem held: slides off", friction=0.01, right="slides", laplace=False)
    yield taper("taper friction 0", "friction", "no friction, no hem held: slides off", friction=0, right="slides", laplace=False)
    yield taper("taper friction 2", "friction", "friction 2, no hem held", friction=2)
    yield taper("taper friction 0.01, hem", "friction", "friction 0.01, upper hem held", friction=0.01, held=("upper",))
    # p = 4 mu: with a coefficient below 0.61 the hems run together, whatever the coefficient and the steps on the way down to it.
    for friction in (None, 0.55):
        yield taper("taper 100 Pa" + (f", friction {friction}" if friction else ""), "soft", "tissue of 100 Pa under 0.4 kPa: slides below a coefficient of 0.61",
                    mu=100.0, friction=friction, right="slides", least_friction=0.61, laplace=False)
    yield taper("taper 100 Pa, friction 0.7", "soft", "the same with a coefficient that holds", mu=100.0, friction=0.7)
    yield taper("taper fabric x100", "fabric", "fabric 100 times too stiff", k1=12.5e3)
    yield taper("taper fabric x1000", "fabric", "fabric 1000 times too stiff", k1=125e3)
    yield taper("taper foil", "fabric", "foil of 100 kN/m on a cone it does not fit", k1=1e5, rest=0.0458)
    yield taper("taper undersize 2 %", "undersize", "2 % undersize at the narrow hem", rest=0.0451)
    yield taper("taper undersize 70 %", "undersize", "70 % undersize, law in Green strain", rest=0.015,
                fabric=linear_fabric(125.0, 125.0), tension=linear_tension(125.0))
    yield taper("taper stiff along", "anisotropy", "fabric 1000 times stiffer along than round", fabric=linear_fabric(125e3, 125.0),
                tension=linear_tension(125.0))
    yield taper("taper shear nearly 0", "anisotropy", "shear stiffness a millionth of the tensile", fabric=spring_fabric(125.0, 1e-6))
    yield taper("taper skin on jelly", "contrast", "skin membrane of 1 MPa on tissue of 500 Pa", layers=[tissue(500.0), skin(1e6)])
    yield taper("taper touching", "loose", "sleeve of the narrow hem's girth: zero prestress there", rest=0.046)
    yield taper("partly loose", "loose", "sleeve of the middle's girth, upper hem held", rest=0.050, held=("upper",), **loose)
    yield taper("partly loose, free", "loose", "sleeve of the middle's girth, no hem held", rest=0.050, **loose)
    yield taper("partly loose, heavy", "loose", "the same with weight and bending", rest=0.050, held=("upper",),
                fabric=spring_fabric(125.0, **weight), **loose)
    yield taper("partly loose, frictionless", "loose", "the same without friction, both hems held", rest=0.050, held=BOTH, friction=0, **loose)
    yield taper("fully loose", "loose", "sleeve larger than the limb, upper hem held", rest=0.056, held=("upper",), **loose)
    yield taper("fully loose, heavy", "loose", "the same with weight and bending: hangs", rest=0.056, held=("upper",),
                fabric=spring_fabric(125.0, **weight), **loose)
    yield taper("fully loose, free", "loose", "sleeve larger than the limb, nothing held", rest=0.056, right="slides", **loose)
    yield taper("short sleeve", "length", "band of 4 mm on cells of 25 mm", position=0.05, length=0.004)
    yield taper("sleeve over the cuts", "length", "sleeve as long as the limb", position=0.0, length=0.1)
    for system in ("mm", "inch", "cgs"):
        yield taper(f"taper in {system}", "invariance", f"units: {system}", system=system, same_as="taper")
    raised = stations([1.0, 1.05, 1.1], [0.045, 0.050, 0.055], 0.020)
    yield taper("taper raised", "invariance", "heights count from 1 m below", girths=raised, position=1.01, same_as="taper")
    aside = stations([0.0, 0.05, 0.1], [0.045, 0.050, 0.055], 0.020, centre_x=2.0, centre_y=-3.0, bone_x=2.0, bone_y=-3.0)
    yield taper("taper aside", "invariance", "axis 3.6 m beside the origin", girths=aside, same_as="taper")


# The cylinder of 50 mm with a sleeve of 42 mm over the middle 60 of its 100 mm.
CYLINDER = stations([0.0, 0.05, 0.1], [0.050] * 3, 0.020)


def cylinder(name, group, stresses, elements="Q2/P1", **more):
    return sleeve_scene(name, group, stresses, limb=body([tissue(5e3)], elements=elements), girths=CYLINDER, flat=2 * math.pi * 0.042,
                        position=0.02, length=0.06, base="cylinder", **more)


def cylinders():
    yield cylinder("cylinder", "ordinary", "both hems held, no friction", held=BOTH, friction=0)
    yield cylinder("cylinder one hem", "hems", "upper hem held, default friction", held=("upper",), quick=True)
    yield cylinder("cylinder one hem P2/P1", "hems", "the same on tetrahedra", "P2/P1", held=("upper",))
    yield cylinder("cylinder no hem", "hems", "no hem held, default friction")
    yield cylinder("cylinder friction 0.03", "friction", "no hem held, friction 0.03", friction=0.03)
    yield cylinder("cylinder one hem, frictionless", "friction", "upper hem held, no friction: gathers at no cost", held=("upper",),
                   friction=0, right="slides")


# A calf: bulges to 365 mm at 180 mm.
CALF = stations([0.0, 0.08, 0.18, 0.27], [g / 2 / math.pi for g in (0.215, 0.262, 0.365, 0.335)], [b / 2 / math.pi for b in (0.09, 0.09, 0.1, 0.11)])


def calf(name, group, stresses, flat=0.230, position=0.07, length=0.18, mu=5e3, **more):
    limb = body([tissue(mu, 0.4757, 2), skin(8e3)], 16, 7)
    return sleeve_scene(name, group, stresses, limb=limb, girths=CALF, flat=flat, position=position, length=length, base="calf", **more)


def calves():
    yield calf("calf", "ordinary", "bulging limb, no hem held, default friction")
    yield calf("calf upper hem", "hems", "upper hem held above the bulge", held=("upper",))
    yield calf("calf lower hem", "hems", "lower hem held at the ankle", held=("lower",))
    yield calf("calf tight", "undersize", "170 mm on 215 to 365 mm from the ankle up", flat=0.170, position=0.005, length=0.22)
    yield calf("calf friction 2", "friction", "friction 2", friction=2)
    yield calf("calf 100 Pa", "soft", "tissue of 100 Pa: slides below a coefficient of 0.42", mu=100.0, right="slides", least_friction=0.42, laplace=False)
    yield calf("calf 100 Pa, friction 0.5", "soft", "the same with a coefficient that holds", mu=100.0, friction=0.5)
    yield calf("calf ankle band", "length", "band of 30 mm at the ankle", flat=0.190, position=0.03, length=0.03)


# A waist of ellipses: hollows from 960 to 700 mm and widens to 800 mm.
WAIST = stations([0.0, 0.12, 0.22, 0.34], [g / 2 / math.pi for g in (0.96, 0.82, 0.70, 0.80)], [0.0477, 0.0446, 0.0414, 0.0446], 1.35,
                 bone_y=-0.01, bone_width_to_depth=1.6)


def waist(name, group, stresses, **more):
    limb = body([tissue(8e3, 0.48, 2), skin(8e3)], 16, 8)
    return sleeve_scene(name, group, stresses, limb=limb, girths=WAIST, flat=0.640, position=0.08, length=0.22, base="waist", **more)


def waists():
    yield waist("waist", "ordinary", "hollowing trunk of ellipses, no hem held, default friction")
    yield waist("waist upper hem", "hems", "upper hem held", held=("upper",))
    yield waist("waist both hems", "hems", "both hems held, no friction", held=BOTH, friction=0)


# Sections: 4:1 ellipse of 600 mm girth.
ELLIPSE = stations([0.0, 0.06, 0.12], [0.6 / 2 / math.pi] * 3, 0.03, 4.0, bone_width_to_depth=4.0)


def ellipse(name, group, stresses, flat=0.5, around=16, position=0.02, length=0.08, **more):
    limb = body([tissue(1e4, cells=2)], around, 3)
    return sleeve_scene(name, group, stresses, limb=limb, girths=ELLIPSE, flat=flat, position=position, length=length, base="ellipse 4:1", **more)


def sections():
    yield ellipse("ellipse 4:1", "section", "ellipse 4:1, default friction, no hem held")
    yield ellipse("ellipse 4:1 frictionless", "section", "ellipse 4:1, both hems held, no friction", held=BOTH, friction=0)
    yield ellipse("ellipse 4:1, coarse cloth", "overlap", "chords of 60 mm cut 12 mm into the skin as placed", around=32, cell=0.06)
    yield ellipse("ellipse 4:1 touching", "overlap", "sleeve of just the girth, cloth of 40 mm", flat=0.6, cell=0.04, laplace=False)
    rib = stations([0.0, 0.05, 0.1], [0.050] * 3, 0.0204, bone_width_to_depth=6.0, bone_x=0.0185)
    yield sleeve_scene("sharp rib", "core", "edge of bone 1 mm round the corner, 1.5 mm under the skin", limb=body([tissue(2e3, 0.45, 2)], 16, 3),
                       girths=rib, flat=2 * math.pi * 0.04, position=0.02, length=0.06, held=BOTH, friction=0, base="cylinder")
    near = stations([0.0, 0.05, 0.1], [0.050] * 3, 0.020, bone_x=0.0298)
    yield sleeve_scene("bone 0.2 mm under one side", "core", "tissue of 0.2 mm on one side, 60 mm on the other",
                       limb=body([tissue(5e3, 0.49, 2)], 16, 3), girths=near, flat=2 * math.pi * 0.042, position=0.02, length=0.06, base="cylinder")


# A thigh from the knee to the fold: 400 to 620 mm over 300 mm; a whole leg: to 700 mm.
THIGH = stations([0.0, 0.1, 0.2, 0.3], [g / 2 / math.pi for g in (0.40, 0.47, 0.54, 0.60)], 0.016, 0.93, bone_x=0.002, bone_y=0.006)
LEG = stations([0.0, 0.1, 0.2, 0.4, 0.5, 0.6, 0.75],
               [g / 2 / math.pi for g in (0.22, 0.28, 0.36, 0.38, 0.43, 0.52, 0.62)], 0.015)


def thigh(name, group, stresses, k1=125.0, position=0.06, length=0.16, flat=0.42, girths=THIGH, along=6, **more):
    limb = body([tissue(5.5e3, 0.4757, 2), skin(8e3)], 12, along)
    more.setdefault("held", ("upper",))
    return sleeve_scene(name, group, stresses, limb=limb, girths=girths, k1=k1, flat=flat, position=position, length=length, base="thigh", **more)


def thighs():
    yield thigh("thigh", "ordinary", "tapering thigh, upper hem held, default friction")
    yield thigh("thigh fabric x100", "fabric", "fabric 100 times too stiff", 12.5e3)
    yield thigh("thigh fabric x1000", "fabric", "fabric 1000 times too stiff", 125e3)
    yield thigh("whole thigh", "length", "sleeve over the whole thigh", position=0.005, length=0.29)
    yield thigh("whole leg", "length", "stocking of 740 mm from ankle to fold, no hem held", position=0.005, length=0.74, flat=0.2,
                girths=LEG, along=14, held=())


def all_scenes():
    for kind in (tapers, cylinders, calves, waists, sections, thighs):
        yield from kind()
