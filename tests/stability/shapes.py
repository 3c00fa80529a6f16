"""Bodies that are not tables of girths: meshes of 27-node hexahedra (gmsh), scanned surfaces (OBJ), blocks (CalculiX)."""
import math
import random


def peanut(radius, waist):
    """A section with two hollows: the radius falls by `waist` of itself on the y axis; concave where waist is above 0.2."""
    return lambda angle: radius * (1 - waist * math.sin(angle) ** 2 + 0.25 * waist * math.sin(2 * angle) ** 2)


# gmsh's 27-node hexahedron: corners, mid-edges, mid-faces, centre, by steps of half a cell (its manual, "Node ordering").
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
FACES = [(0, 1, 2, 3), (0, 1, 5, 4), (0, 3, 7, 4), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]
FACE_OF = {"bone": (0, 1, 5, 4), "skin": (3, 2, 6, 7), "lower": (0, 1, 2, 3), "upper": (4, 5, 6, 7)}


def middle(ids):
    return tuple(sum(CORNERS[i][k] for i in ids) // len(ids) for k in range(3))


HEXAHEDRON = CORNERS + [middle(e) for e in EDGES] + [middle(f) for f in FACES] + [(1, 1, 1)]


def quadrilateral(corners):
    sides = [(corners[i], corners[(i + 1) % 4]) for i in range(4)]
    return [CORNERS[i] for i in corners] + [middle(s) for s in sides] + [middle(corners)]


def limb_mesh(skin, bone, length, around, through, along, move=lambda x: x, mirrored=False):
    """A limb of hexahedra in gmsh's format 2.2. `skin(angle, height)` and `bone(angle, height)` give points (x, y); `move`
    takes each node's place; `mirrored` turns the cells inside out again after a move that mirrors."""
    nodes = {}

    def node(i, j, k):
        return nodes.setdefault((i % (2 * around), j, k), len(nodes) + 1)

    def place(i, j, k):
        angle, height, t = math.pi * i / around, length * k / (2 * along), j / (2 * through)
        inner, outer = bone(angle, height), skin(angle, height)
        return move((inner[0] + t * (outer[0] - inner[0]), inner[1] + t * (outer[1] - inner[1]), height))

    flip = (lambda p: (2 - p[0], p[1], p[2])) if mirrored else (lambda p: p)
    elements = []

    def add(kind, group, points, cell):
        elements.append((kind, group, [node(*(2 * c + flip(p)[n] for n, c in enumerate(cell))) for p in points]))

    for i in range(around):
        for j in range(through):
            for k in range(along):
                cell = (i, j, k)
                # angle, outwards and up are right-handed only as (outwards, angle, up): exchange the first two
                add(12, 1, [(p[1], p[0], p[2]) for p in HEXAHEDRON], cell)
                on = {"bone": j == 0, "skin": j == through - 1, "lower": k == 0, "upper": k == along - 1}
                for group, name in enumerate(FACE_OF, 2):
                    if on[name]:
                        add(10, group, quadrilateral(FACE_OF[name]), cell)
    names = ['3 1 "tissue"', *(f'2 {n} "{name}"' for n, name in enumerate(FACE_OF, 2))]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(nodes)), *(f"{n} {x:.17g} {y:.17g} {z:.17g}" for (x, y, z), n in ((place(*key), n) for key, n in nodes.items()))]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{n} {kind} 2 {group} {group} " + " ".join(map(str, ids)) for n, (kind, group, ids) in enumerate(elements, 1)]
    return "\n".join(lines + ["$EndElements"]) + "\n"


def scan_surface(skin, length, around, along, noise=0.0, seed=1):
    """A closed surface (OBJ, m) of a limb whose points stray by `noise` (standard deviation, m) across the axis."""
    stray = random.Random(seed)
    lines = []
    for k in range(along + 1):
        for i in range(around):
            x, y = skin(2 * math.pi * i / around, length * k / along)
            grow = 1 + stray.gauss(0, noise) / math.hypot(x, y)
            lines.append(f"v {x * grow:.6f} {y * grow:.6f} {length * k / along:.6f}")
    lines += ["v 0 0 0", f"v 0 0 {length:.6f}"]
    bottom, top = around * (along + 1) + 1, around * (along + 1) + 2
    for i in range(around):
        j = (i + 1) % around
        for k in range(along):
            a, b, c, d = (1 + around * k + i, 1 + around * k + j, 1 + around * (k + 1) + j, 1 + around * (k + 1) + i)
            lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
        lines += [f"f {bottom} {1 + j} {1 + i}", f"f {top} {1 + around * along + i} {1 + around * along + j}"]
    return "\n".join(lines) + "\n"


def block(size, cells, place=lambda x: x):
    """A block of linear hexahedra in gmsh's format 2.2 with its six sides as surfaces x0, x1, y0, y1, z0, z1."""
    count = [c + 1 for c in cells]

    def node(i, j, k):
        return 1 + i + count[0] * (j + count[1] * k)

    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "7", '3 1 "tissue"']
    sides = [f"{axis}{end}" for axis in "xyz" for end in (0, 1)]
    lines += [f'2 {n} "{side}"' for n, side in enumerate(sides, 2)] + ["$EndPhysicalNames"]
    points = [place(tuple(size[a] * p[a] / cells[a] for a in range(3)))
              for p in ((i, j, k) for k in range(count[2]) for j in range(count[1]) for i in range(count[0]))]
    lines += ["$Nodes", str(len(points)), *(f"{n} {x:.17g} {y:.17g} {z:.17g}" for n, (x, y, z) in enumerate(points, 1)), "$EndNodes"]
    elements = []
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                c = [node(i + a, j + b, k + d) for a, b, d in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]
                elements.append((5, 1, c))
                faces = [(i == 0, (0, 4, 7, 3)), (i == cells[0] - 1, (1, 2, 6, 5)), (j == 0, (0, 1, 5, 4)),
                         (j == cells[1] - 1, (3, 7, 6, 2)), (k == 0, (0, 3, 2, 1)), (k == cells[2] - 1, (4, 5, 6, 7))]
                elements += [(3, n, [c[v] for v in face]) for n, (at, face) in enumerate(faces, 2) if at]
    lines += ["$Elements", str(len(elements))]
    lines += [f"{n} {kind} 2 {group} {group} " + " ".join(map(str, ids)) for n, (kind, group, ids) in enumerate(elements, 1)]
    return "\n".join(lines + ["$EndElements"]) + "\n"
