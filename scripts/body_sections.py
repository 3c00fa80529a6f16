"""Sections of a surface of triangles by planes, in plain Python; used by standard-bodies and draft-vest.

Frame: x to the right of the person, y to the front, z up; metres.
"""
import math


def read_obj(path, turn=lambda p: p):
    """The first comment, the vertices after `turn`, the faces as the file has them (numbers from 0)."""
    comment, vertices, faces = "", [], []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            words = line.split()
            if line.startswith("#") and not comment:
                comment = line[1:].strip()
            elif words and words[0] == "v":
                vertices.append(turn(tuple(map(float, words[1:4]))))
            elif words and words[0] == "f":
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return comment, vertices, faces


def y_up(p):
    """From y up and z to the front."""
    return (-p[0], p[2], p[1])


def sub(a, b):
    return tuple(p - q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(p / length for p in a)


class Loop:
    """A closed line of a section."""

    def __init__(self, points):
        self.points = points
        pairs = list(zip(points, points[1:] + points[:1]))
        lengths = [math.dist(a, b) for a, b in pairs]
        self.girth = sum(lengths)
        self.middle = tuple(sum(w * (a[k] + b[k]) / 2 for w, (a, b) in zip(lengths, pairs)) / self.girth for k in range(3))

    def at_angle(self, degrees):
        """The outermost point that is seen from the middle under an angle about z: 0 = +x (right), 90 = front."""
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        best = None
        for a, b in zip(self.points, self.points[1:] + self.points[:1]):
            p, q = sub(a, self.middle), sub(b, self.middle)
            across = [c * r[1] - s * r[0] for r in (p, q)]
            if across[0] * across[1] > 0 or across[0] == across[1]:
                continue
            w = across[0] / (across[0] - across[1])
            x = tuple(a[k] + w * (b[k] - a[k]) for k in range(3))
            out = c * (x[0] - self.middle[0]) + s * (x[1] - self.middle[1])
            if out > 0 and (best is None or out > best[0]):
                best = (out, x)
        return best[1]


def hull(points):
    """The convex hull of points of a plane, counter-clockwise (Andrew's chains)."""
    points = sorted(set(points))

    def chain(way):
        out = []
        for p in way:
            while len(out) > 1 and (out[-1][0] - out[-2][0]) * (p[1] - out[-2][1]) <= (out[-1][1] - out[-2][1]) * (p[0] - out[-2][0]):
                out.pop()
            out.append(p)
        return out[:-1]

    return chain(points) + chain(reversed(points))


class Surface:
    """A closed surface of a standing person; what it is asked for by height is kept."""

    def __init__(self, vertices, faces):
        self.vertices = vertices
        self.triangles = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
        self.stature = max(v[2] for v in vertices) - min(v[2] for v in vertices)
        self.known = {}  # sections at heights
        self.by_height = {}  # triangles that reach into each centimetre
        for t in self.triangles:
            heights = [vertices[n][2] for n in t]
            for slot in range(math.floor(100 * min(heights)), math.floor(100 * max(heights)) + 1):
                self.by_height.setdefault(slot, []).append(t)

    def section(self, point, normal, triangles=None):
        triangles = self.triangles if triangles is None else triangles
        d = {n: dot(sub(self.vertices[n], point), normal) or 1e-12 for t in triangles for n in t}
        place, beside = {}, {}
        for t in triangles:
            cut = []
            for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
                if (d[a] > 0) == (d[b] > 0):
                    continue
                edge = (min(a, b), max(a, b))
                w = d[edge[0]] / (d[edge[0]] - d[edge[1]])
                p, q = self.vertices[edge[0]], self.vertices[edge[1]]
                place[edge] = tuple(p[k] + w * (q[k] - p[k]) for k in range(3))
                cut.append(edge)
            if cut:
                beside.setdefault(cut[0], []).append(cut[1])
                beside.setdefault(cut[1], []).append(cut[0])
        loops, seen = [], set()
        for start in beside:
            if start in seen:
                continue
            chain, at = [start], start
            seen.add(start)
            while at is not None:
                at = next((e for e in beside[at] if e not in seen), None)
                if at is not None:
                    seen.add(at)
                    chain.append(at)
            if len(chain) > 2:
                loops.append(Loop([place[e] for e in chain]))
        return loops

    def level(self, z):
        if z not in self.known:
            self.known[z] = self.section((0, 0, z), (0, 0, 1), self.by_height.get(math.floor(100 * z), []))
        return self.known[z]

    def trunk(self, z):
        """The loop about the middle plane, where there is one."""
        loops = [loop for loop in self.level(z) if abs(loop.middle[0]) < 0.02 and loop.girth > 0.25]
        return max(loops, key=lambda loop: loop.girth) if loops else None

    def changes(self, low, high, holds):
        """Where `holds` (true below) begins to fail, to 0.1 mm."""
        while high - low > 1e-4:
            middle = (low + high) / 2
            low, high = (middle, high) if holds(middle) else (low, middle)
        return low

    def extreme(self, low, high, value):
        """The height between two where a value is least, on a grid of 2 mm."""
        count = int((high - low) / 0.002)
        return min((low + 0.002 * i for i in range(count + 1)), key=value)

    def crotch(self):
        return self.changes(0.35 * self.stature, 0.55 * self.stature, lambda z: self.trunk(z) is None)

    def waist(self):
        return self.extreme(0.58 * self.stature, 0.70 * self.stature, lambda z: self.trunk(z).girth)

    def armpit(self, waist):
        """Where the arms grow together with the trunk."""
        return self.changes(waist, 0.82 * self.stature, lambda z: len([l for l in self.level(z) if l.girth > 0.15]) > 1)

    def neck(self):
        return self.extreme(0.82 * self.stature, 0.90 * self.stature, lambda z: self.trunk(z).girth)
