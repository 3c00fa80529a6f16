"""Laplace's estimate: cloth of hoop tension T presses on a closed ring of skin with 2 pi T in all, whatever its section."""
import csv
import math

COLUMNS = ("x", "y", "z", "ux", "uy", "uz", "pressure")


def hull_length(points):
    """Perimeter of the convex hull: the cloth bridges hollows."""
    points = sorted(set(points))
    if len(points) < 3:
        return 0.0

    def half(sequence):
        chain = []
        for p in sequence:
            while len(chain) > 1 and cross(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    hull = half(points) + half(points[::-1])
    return sum(math.dist(a, b) for a, b in zip(hull, hull[1:] + hull[:1]))


def cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def rings(path):
    """height -> rows of skin.csv, undeformed heights to a micrometre."""
    found = {}
    with path.open() as file:
        for row in csv.DictReader(file):
            row = {key.split(" ")[0]: float(value) for key, value in row.items() if key.split(" ")[0] in COLUMNS}
            found.setdefault(round(row["z"], 6), []).append(row)
    return dict(sorted(found.items()))


def ring_force(rows):
    """Integral of the pressure along the deformed ring (trapezoidal rule), N/m, and the cloth's length on it."""
    places = [(r["x"] + r["ux"], r["y"] + r["uy"], r["pressure"]) for r in rows]
    cx, cy = (sum(p[n] for p in places) / len(places) for n in (0, 1))
    places.sort(key=lambda p: math.atan2(p[1] - cy, p[0] - cx))
    force = sum(0.5 * (a[2] + b[2]) * math.dist(a[:2], b[:2]) for a, b in zip(places, places[1:] + places[:1]))
    return force, hull_length([p[:2] for p in places])


def ratio(path, sleeve):
    """Mean over the rings two rings inside the hems (of what touches, where the sleeve has gone elsewhere) of pressure times
    girth over 2 pi T; None where no ring is left."""
    if not path.is_file():
        return None
    found = rings(path)
    inside = [z for z in found if sleeve.lower < z < sleeve.upper and len(found[z]) > 8]
    inside = inside[1:-1] if len(inside) > 2 else inside
    ratios = []
    for z in inside:
        force, girth = ring_force(found[z])
        tension = sleeve.tension(girth / sleeve.flat)
        if girth > 1.01 * sleeve.flat:
            ratios.append(force / (2 * math.pi * tension))
    return sum(ratios) / len(ratios) if ratios else None
