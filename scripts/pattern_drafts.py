"""What the drafting commands share: splines through measures, shares by height."""


def natural_spline(x, y):
    """The natural cubic spline through points, as a function (tridiagonal system of its second derivatives)."""
    n = len(x)
    below, main, above, right = [0.0] * n, [1.0] * n, [0.0] * n, [0.0] * n
    for i in range(1, n - 1):
        h0, h1 = x[i] - x[i - 1], x[i + 1] - x[i]
        below[i], main[i], above[i] = h0, 2 * (h0 + h1), h1
        right[i] = 6 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0)
    for i in range(1, n):
        factor = below[i] / main[i - 1]
        main[i] -= factor * above[i - 1]
        right[i] -= factor * right[i - 1]
    second = [0.0] * n
    for i in range(n - 1, -1, -1):
        second[i] = (right[i] - (above[i] * second[i + 1] if i < n - 1 else 0.0)) / main[i]

    def at(t):
        i = max(k for k in range(n - 1) if x[k] <= t or k == 0)
        h = x[i + 1] - x[i]
        a = (x[i + 1] - t) / h
        b = 1 - a
        return a * y[i] + b * y[i + 1] + ((a**3 - a) * second[i] + (b**3 - b) * second[i + 1]) * h * h / 6

    return at


def by_height(text):
    """A share, or "height:share" pairs between which it changes linearly."""
    if ":" not in text:
        return lambda z: float(text)
    pairs = sorted(tuple(map(float, pair.split(":"))) for pair in text.split(","))

    def at(z):
        if z <= pairs[0][0]:
            return pairs[0][1]
        for (z0, a), (z1, b) in zip(pairs, pairs[1:]):
            if z <= z1:
                return a + (b - a) * (z - z0) / (z1 - z0)
        return pairs[-1][1]

    return at
