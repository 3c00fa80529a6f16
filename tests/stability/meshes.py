"""Scenes on meshes and scans of their own: turned, mirrored and shifted limbs, concave sections, noisy scans, blocks and
arches."""
import math

import shapes
from case_files import N_m, Pa, m
from exact import bar_stretch, hydrostatic_stretch
from limbs import sleeve_scene, tissue
from scene import BOTH, Exact, Scene, neo_hooke, rigid

SLIDING = [{"on": "lower", "z": m(0.0)}, {"on": "upper", "z": m(0.0)}]


def round_limb(angle, height, radius=0.045, slope=0.1, centre=(0.0, 0.0)):
    r = radius + slope * height
    return centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle)


def imported(layer, **more):
    return {"kind": "imported", "mesh": "limb.msh", "unit": m(1.0), "layers": [rigid(), layer], **more}


def turned(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda x: (c * x[0] - s * x[1], s * x[0] + c * x[1], x[2])


# The eccentric limb: a cone whose bone lies aside, so that it gives way more on one side. The seam, where the cloth's mesh begins,
# goes along: (what it stresses, the move, is it a mirror, the seam's angle).
MOVES = {
    "turned by 37 degrees": ("turned by 37 degrees, no multiple of a cell's", turned(37.0), False, 217.0),
    "turned by 30 degrees": ("turned by a cell's angle", turned(30.0), False, 210.0),
    "mirrored across": ("mirrored: x to -x", lambda x: (-x[0], x[1], x[2]), True, 0.0),
    "mirrored front to back": ("mirrored: y to -y", lambda x: (x[0], -x[1], x[2]), True, 180.0),
    "shifted": ("shifted by 3.7 m", lambda x: (x[0] + 3.0, x[1] - 2.0, x[2] + 1.0), False, 180.0),
}


def eccentric_mesh(move=lambda x: x, mirrored=False):
    bone = lambda angle, height: round_limb(angle, height, 0.020, 0.0, (0.008, 0.003))
    return shapes.limb_mesh(round_limb, bone, 0.1, 12, 1, 4, move, mirrored)


def moved():
    def sleeve(name, stresses, mesh, position=0.01, **more):
        return sleeve_scene(name, more.pop("group", "invariance"), stresses, limb=imported(tissue(5e3) | {}), girths=None,
                            files={"limb.msh": mesh}, flat=2 * math.pi * 0.042, position=position, length=0.08, base="mesh", laplace=False,
                            held=("upper",), **more)

    def with_ends(scene):
        return Scene(**{**scene.__dict__, "case": {**scene.case, "support": SLIDING}})

    def pressed(name, stresses, mesh, **more):
        case = {"body": imported(tissue(5e3)), "support": SLIDING, "load": {"skin_pressure": Pa(2.5e3)}}
        return Scene(name, more.pop("group", "invariance"), stresses, case, {"limb.msh": mesh}, base="mesh under pressure", **more)

    yield with_ends(sleeve("mesh", "imported hexahedra, eccentric bone, upper hem held", eccentric_mesh(), group="ordinary"))
    yield pressed("mesh under pressure", "imported hexahedra, skin pressure of half the shear modulus", eccentric_mesh(), group="ordinary")
    for name, (stresses, move, mirrored, seam) in MOVES.items():
        mesh = eccentric_mesh(move, mirrored)
        yield with_ends(sleeve(f"mesh {name}", stresses, mesh, position=1.01 if name == "shifted" else 0.01, seam=seam,
                               same_as="mesh"))
        if name != "turned by 30 degrees":
            yield pressed(f"pressure {name}", f"body alone, {stresses}", mesh, same_as="mesh under pressure")


def concave():
    section = shapes.peanut(0.06, 0.45)
    outline = lambda share: lambda angle, height: (share * section(angle) * math.cos(angle), share * section(angle) * math.sin(angle))
    mesh = shapes.limb_mesh(outline(1.0), outline(0.4), 0.1, 16, 2, 3)
    for name, stresses, more in (("concave section", "two hollows that the cloth bridges, default friction", {}),
                                 ("concave section, frictionless", "the same, both hems held, no friction", {"held": BOTH, "friction": 0})):
        scene = sleeve_scene(name, "section", stresses, limb=imported(tissue(1e4)), girths=None, files={"limb.msh": mesh}, flat=0.25,
                             position=0.02, length=0.06, base="mesh", **more)
        yield Scene(**{**scene.__dict__, "case": {**scene.case, "support": SLIDING}})


def scan(name, group, stresses, skin, noise, smoothing=0.0, around=12, along=4, flat=0.27, seed=1, **more):
    plane = lambda height, up: {"point": [m(0.0), m(0.0), m(height)], "normal": [0, 0, up]}
    body = {"kind": "scan", "layers": [rigid(), tissue(5e3, cells=2)], "cells_around": around, "cells_along": along,
            "scan": {"surface": "scan.obj", "unit": m(1.0), "lower": plane(0.02, -1), "upper": plane(0.12, 1), "bone": {"girth": m(0.1)}}}
    if smoothing:
        body["scan"]["smoothing_radius"] = m(smoothing)
    surface = shapes.scan_surface(skin, 0.14, 96, 48, noise, seed)
    return sleeve_scene(name, group, stresses, limb=body, girths=None, files={"scan.obj": surface}, flat=flat, position=0.03, length=0.08,
                        base="scan", laplace=False, **more)


def scans():
    oval = lambda angle, height: (1.1 * (0.045 + 0.05 * height) * math.cos(angle), 0.9 * (0.045 + 0.05 * height) * math.sin(angle))
    dent = shapes.peanut(0.055, 0.45)
    hollow = lambda angle, height: (dent(angle) * math.cos(angle), dent(angle) * math.sin(angle))
    yield scan("scan", "ordinary", "scanned limb without noise", oval, 0.0)
    yield scan("scan noise 0.5 mm", "scan", "noise of 0.5 mm, smoothed as shipped", oval, 0.0005)
    yield scan("scan noise 2 mm", "scan", "noise of 2 mm, smoothed as shipped", oval, 0.002)
    yield scan("scan rough", "overlap", "noise of 1 mm left in: smoothing 4 mm, cells of 13 mm", oval, 0.001, 0.004, around=24, along=8)
    yield scan("scan rough and tight", "overlap", "the same at 40 % undersize", oval, 0.001, 0.004, around=24, along=8, flat=0.18)
    yield scan("scan concave", "section", "concave scan", hollow, 0.0, flat=0.24)


def block(name, group, stresses, size, cells, layer, support, load, base="block", exact=None, place=lambda x: x, **more):
    body = {"kind": "imported", "mesh": "block.msh", "unit": m(1.0), "layers": [layer], **more}
    case = {"body": body, **({"support": support} if support else {}), "load": load}
    return Scene(name, group, stresses, case, {"block.msh": shapes.block(size, cells, place)}, base=base, exact=exact)


def symmetric():
    return [{"on": side + "0", side: m(0.0)} for side in "xyz"]


def blocks():
    """A bar of 10 x 10 x 40 mm pulled at its end by a pressure that follows it; the stretch is exact."""
    def bar(name, stresses, tension, nu=0.49, group="load", elements="Q2/P1", mu=1e6):
        load = {"pressure": [{"on": "z1", "value": Pa(-tension)}]}
        return block(name, group, stresses, (0.01, 0.01, 0.04), (2, 2, 8), tissue(mu, nu), symmetric(), load,
                     exact=Exact("stretch_along_z", lambda: bar_stretch(mu, nu, tension), 1e-4), elements=elements)

    yield bar("block", "bar pulled by half the shear modulus", 5e5, group="ordinary")
    yield bar("bar 2 mu", "follower tension 2 mu", 2e6)
    yield bar("bar 5 mu", "follower tension 5 mu: stretched threefold", 5e6)
    yield bar("bar 2 mu nu 0.4999999", "follower tension 2 mu, nu = 0.4999999", 2e6, 0.4999999)
    yield bar("bar pressed 2 mu", "pressed by 2 mu at its end, too stout to buckle", -2e6)
    sides = [{"on": f"{axis}{end}", "value": Pa(5e3)} for axis in "xyz" for end in (0, 1)]
    yield block("free block", "load", "pressure all round, nothing holds it: balanced and free to move", (0.01, 0.01, 0.01), (2, 2, 2),
                tissue(1e4, 0.3), [], {"pressure": sides}, exact=Exact("stretch_along_z", lambda: hydrostatic_stretch(1e4, 0.3, 5e3), 1e-4))


def arches():
    """A flat arch of 100 mm, 2 mm thick and clamped, pressed past the load at which it snaps through; deep below it hangs."""
    rise, span, thick = 0.008, 0.1, 0.002

    def arc(x):
        radius = (span**2 / 4 + rise**2) / (2 * rise)
        angle = (x[0] / span - 0.5) * 2 * math.asin(span / 2 / radius)
        return ((radius + x[2]) * math.sin(angle), x[1], (radius + x[2]) * math.cos(angle))

    def arch(name, stresses, load):
        clamped = [{"on": side, **{axis: m(0.0) for axis in "xyz"}} for side in ("x0", "x1")]
        plane = [{"on": side, "y": m(0.0)} for side in ("y0", "y1")]
        return block(name, "snap", stresses, (span, 0.004, thick), (16, 1, 1), tissue(1e6, 0.3), clamped + plane, load, place=arc)

    dead = lambda p: {"traction": [{"on": "z1", "value": [Pa(0.0), Pa(0.0), Pa(-p)]}]}
    follower = lambda p: {"pressure": [{"on": "z1", "value": Pa(p)}]}
    # walked in steps it stops near 95 Pa, where the force falls
    yield arch("arch below its limit", "two thirds of the limit load", dead(60.0))
    yield arch("arch just past its limit", "snap-through, 1.5 times the limit load", dead(150.0))
    yield arch("arch far past its limit", "snap-through, 16 times the limit load", dead(1500.0))
    yield arch("arch just past its limit, follower", "snap-through under a pressure that follows", follower(150.0))
    yield arch("arch far past its limit, follower", "snap-through, 16 times the limit pressure, which follows", follower(1500.0))


def all_scenes():
    for kind in (moved, concave, scans, blocks, arches):
        yield from kind()
