#!/usr/bin/env python3
"""Writes stress.json: scenes on which binary64 cancels, with answers computed in 60 digits (mpmath).

At that precision plain differences and edge sums do not cancel, so nothing here is centred or adaptive: convex subtraction
with exact signs, M_ij by the recursion with 30-point Gauss-Legendre on each arc, V = E[w^2] - E^2."""
import json, os, struct
from mpmath import mp, mpf, matrix, atan2, sqrt, cos, sin, pi, nstr
from mpmath.calculus.quadrature import GaussLegendre

mp.dps = 60
f32 = lambda v: struct.unpack("<f", struct.pack("<f", v))[0]
V = lambda p: tuple(mpf(f32(c)) for c in p)
add = lambda a, b: tuple(x + y for x, y in zip(a, b))
sub = lambda a, b: tuple(x - y for x, y in zip(a, b))
mul = lambda a, k: tuple(x * k for x in a)
dot = lambda a, b: sum(x * y for x, y in zip(a, b))
cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
norm = lambda a: sqrt(dot(a, a))
unit = lambda a: mul(a, 1 / norm(a))
TINY = mpf(10) ** -45
LUMINANCE = (mpf("0.2126"), mpf("0.7152"), mpf("0.0722"))


def legendre(n):
    nodes = []
    for k in range(n):
        x = cos(pi * (k + mpf(3) / 4) / (n + mpf(1) / 2))
        for _ in range(12):
            p, q = mpf(1), mpf(0)
            for j in range(1, n + 1):
                p, q = ((2 * j - 1) * x * p - (j - 1) * q) / j, p
            slope = n * (x * p - q) / (x * x - 1)
            x -= p / slope
        nodes.append(((1 - x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return nodes


NODES = legendre(30)


def cut(polygon, plane):
    front, back = [], []
    d = [dot(plane, v) for v in polygon]
    for i, v in enumerate(polygon):
        w, e = polygon[(i + 1) % len(polygon)], d[(i + 1) % len(polygon)]
        if d[i] >= -TINY: front.append(v)
        if d[i] <= TINY: back.append(v)
        if (d[i] > TINY and e < -TINY) or (d[i] < -TINY and e > TINY):
            at = add(v, mul(sub(w, v), d[i] / (d[i] - e)))
            front.append(at); back.append(at)
    return (front if max(d) > TINY else []), (back if min(d) < -TINY else [])


def subtract(pieces, planes):
    out = []
    for piece in pieces:
        kept, inside = [], piece
        for plane in planes:
            inside, outside = cut(inside, plane)
            if outside: kept.append(outside)
            if not inside: break
        out += kept if inside else [piece]
    return out


def cone(blocker, m, s):
    depth = [dot(m, p) - s for p in blocker]
    if min(depth) >= -TINY: return None
    n = cross(sub(blocker[1], blocker[0]), sub(blocker[2], blocker[0]))
    D = dot(n, blocker[0])
    sign = 1 if D > 0 else -1
    planes = [unit(mul(cross(blocker[i], blocker[(i + 1) % 3]), sign)) for i in range(3)]
    if max(depth) > TINY: planes.append(unit(mul(sub(mul(n, s), mul(m, D)), sign)))
    return planes


def moments(pieces, n, m):
    c = dot(n, m)
    B = {k: mpf(0) for k in ("10", "01", "20", "03", "12", "21", "23")}
    omega = mpf(0)
    for p in pieces:
        for i, v in enumerate(p):
            w = p[(i + 1) % len(p)]
            C = cross(v, w)
            if norm(C) < TINY: continue
            G, u = unit(C), unit(v)
            q, theta = cross(G, u), atan2(norm(C), dot(v, w))
            gn, gm = dot(G, n), dot(G, m)
            for x, weight in NODES:
                t = add(mul(u, cos(theta * x)), mul(q, sin(theta * x)))
                a, b, k = dot(n, t), dot(m, t), theta * weight
                B["10"] += k * gn; B["01"] += k * gm
                B["20"] += k * 2 * gn * a; B["03"] += k * 3 * gm * b * b
                B["12"] += k * (gn * b * b + 2 * gm * a * b); B["21"] += k * (2 * gn * a * b + gm * a * a)
                B["23"] += k * (2 * gn * a * b ** 3 + 3 * gm * a * a * b * b)
        a = unit(p[0])
        for i in range(1, len(p) - 1):
            b, d = unit(p[i]), unit(p[i + 1])
            omega += 2 * atan2(dot(a, cross(b, d)), 1 + dot(a, b) + dot(b, d) + dot(d, a))
    m10, m01 = B["10"] / 2, B["01"] / 2
    m03, m12, m21 = (6 * m01 + B["03"]) / 12, (4 * c * m01 + 2 * m10 + B["12"]) / 12, (2 * m01 + 4 * c * m10 + B["21"]) / 12
    return omega, m10, (2 * omega + B["20"]) / 6, (2 * m03 + 12 * c * m12 + 6 * m21 + B["23"]) / 30


def magnitude(points): return max(abs(c) for p in points for c in p)


def within(t, p, scale):
    n = cross(sub(t[1], t[0]), sub(t[2], t[0]))
    return abs(dot(n, sub(p, t[0]))) <= scale * norm(n) / 2 ** 22


def coplanar(a, b):
    scale = magnitude(a + b)
    return all(within(b, v, scale) for v in a) or all(within(a, v, scale) for v in b)


def solve(x, n, lights, blockers):
    x, n = V(x), unit(V(n))
    lights = [([tuple(map(V, t)) for t in ts], [mpf(f32(r)) for r in rgb], sides) for ts, rgb, sides in lights]
    everything = [t for ts, _, _ in lights for t in ts] + [tuple(map(V, t)) for t in blockers]
    Y = lambda rgb: sum(a * b for a, b in zip(LUMINANCE, rgb))
    area = lambda t: norm(cross(sub(t[1], t[0]), sub(t[2], t[0]))) / 2
    total = sum(area(t) for ts, _, _ in lights for t in ts)
    E = uni = cosine = second = solid = open_ = whole = mpf(0)
    projected = F = mpf(0)
    for ts, rgb, sides in lights:
        for t in ts:
            p = [sub(v, x) for v in t]
            m = unit(cross(sub(p[1], p[0]), sub(p[2], p[0])))
            s = dot(m, p[0])
            if s > 0 and sides == 1 or s == 0: continue
            if s < 0: m, s, p = mul(m, -1), -s, p[::-1]
            whole += moments([p], n, m)[0]
            top, _ = cut(p, n)
            if not top: continue
            free = moments([top], n, m)[1]
            pieces = [top]
            for b in everything:
                if within(b, x, magnitude(b + (x,))) or coplanar(b, t): continue
                planes = cone([sub(v, x) for v in b], m, s)
                if planes: pieces = subtract(pieces, planes)
            L = Y(rgb)
            omega, m10, m20, m23 = moments(pieces, n, m)
            E += L * m10; uni += 2 * pi * L * L * m20; cosine += pi * L * L * m10
            second += total * L * L * m23 / s ** 2; solid += L * L * m20; projected += L * L * m10
            open_ += L * free; F += free
    number = lambda v: float(nstr(v, 25)) if abs(v) > mpf(10) ** -40 else 0.0
    return {"irradiance": number(E), "unoccluded": number(open_), "variance": {
        "hemisphere/uniform": number(uni - E * E), "hemisphere/cosine": number(cosine - E * E), "area/uniform": number(second - E * E),
        "area/solid-angle": number(whole * solid - E * E), "area/projected-solid-angle": number(F * projected - E * E)}}


def quad(corner, u, v):
    a, b, c, d = corner, add(corner, u), add(add(corner, u), v), add(corner, v)
    return [(a, b, c), (a, c, d)]


def ceiling(x, y, z, w, d): return quad((x - w / 2, y - d / 2, z), (0, d, 0), (w, 0, 0))


GREY = (1, 1, 1)
SCENES = []


def scene(name, x, n, lights, blockers=()): SCENES.append((name, x, n, lights, list(blockers)))


UP = (0, 0, 1)
for h in (10, 100, 1000, 10000):
    scene("far %g" % h, (0, 0, 0), UP, [(ceiling(0, 0, h, 1, 1), GREY, 1)])
    scene("far aside %g" % h, (0.3 * h, 0.1 * h, 0), (0.25, 0.5, 1), [(ceiling(0, 0, h, 1, 1), GREY, 1)])
    scene("far half hidden %g" % h, (0, 0, 0), UP, [(ceiling(0, 0, h, 1, 1), GREY, 1)], quad((0, -9, 1), (9, 0, 0), (0, 18, 0)))
for s in (0.01, 1e-4, 1e-6):
    scene("under the light %g" % s, (0.125, 0.0625, 0), UP, [(ceiling(0, 0, s, 1, 1), GREY, 1)])
    scene("under its edge %g" % s, (0.5, 0.25, 0), UP, [(ceiling(0, 0, s, 1, 1), GREY, 1)])
    scene("beside its plane %g" % s, (2, 0.25, 0), (-1, 0, 0.125), [(ceiling(0, 0, s, 1, 1), GREY, 1)])
    scene("beside its plane, up %g" % s, (0.75, 0.25, 0), UP, [(ceiling(0, 0, s, 1, 1), GREY, 1)])
    scene("wall light %g" % s, (s, 0.5, 0), UP, [(quad((0, 0, 0), (0, 1, 0), (0, 0, 1)), GREY, 1)])
    scene("tiny light %g" % s, (0.2, -0.3, 0), (0.1, 0.2, 1), [(quad((0, 0, 1), (0, s, 0.25 * s), (s, 0, 0.5 * s)), GREY, 1)])
    scene("slit %g" % s, (0, 0, 0), UP, [(ceiling(0, 0, 2, 1, 1), GREY, 1)],
          quad((s, -3, 1), (3, 0, 0), (0, 6, 0)) + quad((-3, -3, 1), (3, 0, 0), (0, 6, 0)))
    scene("speck %g" % s, (0, 0, 0), UP, [(ceiling(0, 0, 2, 1, 1), GREY, 1)], quad((0.05, 0.07, 1), (s, 0, 0), (0, s, 0)))
    scene("dipping %g" % s, (0, 0, 0), UP, [(ceiling(0, 0, 1, 1, 1), GREY, 1)],
          quad((-0.4, -0.3, 1 - s), (0.5, 0, 2 * s), (0, 0.4, s)))
    scene("needles %g" % s, (0.01, 0.02, 0), UP, [(ceiling(0, 0, 1, 1, 1), GREY, 1)],
          [((-0.7 + 0.1 * k, -0.8, 0.5), (0.6 - 0.1 * k, 0.7, 0.6), (-0.7 + 0.1 * k + s, -0.8, 0.45)) for k in range(8)])
for s in (1e-3, 1e-5, 1e-7):
    scene("at a corner %g" % s, (3 * s, s, 0.2 * s), (-1, 0.5, 0.25), [([((0, 0, 0), (-0.4, 1, 0), (-1, 0.3, 0))], GREY, 1)])
    scene("at an edge %g" % s, (0.3, 0.2, -s), (0.3, -1, 0.5), [([((0, 0, 0), (-0.4, 1, 0), (0.6, 0.4, 0))], GREY, 1)], [((0.2, 0, -2 * s), (0.25, 0.1, -0.7 * s), (0.3, 0.4, -0.1))])
scene("slats", (0.1, 0.05, 0), UP, [(ceiling(0, 0, 1, 1, 1), GREY, 1)],
      [t for k in range(12) for t in quad((-0.6 + 0.1 * k, -1, 0.6), (0.03, 0, 0.05), (0, 2, 0))])
scene("crossed cards", (0.05, -0.02, 0), (0.1, 0, 1), [(ceiling(0, 0, 1, 1, 1), GREY, 1)],
      quad((-0.2, -0.2, 0.4), (0.4, 0, 0.2), (0, 0.4, 0)) + quad((-0.2, -0.2, 0.6), (0.4, 0, -0.2), (0, 0.4, 0)) + quad((0, -0.3, 0.3), (0, 0.6, 0.1), (0.05, 0, 0.4)))
scene("nested cards", (0, 0, 0), UP, [(ceiling(0, 0, 1, 1, 1), GREY, 1)],
      [t for k in range(6) for t in ceiling(0.01 * k, 0.02, 0.3 + 0.1 * k, 0.05 + 0.05 * k, 0.2)])
scene("fin on the light", (0.2, 0.1, 0), UP, [(ceiling(0, 0, 1, 1, 1), GREY, 1)], quad((-0.3, 0.05, 1), (0.6, 0.1, 0), (0, 0.05, -0.2)))
scene("stake through the light", (0.2, 0.1, 0), UP, [(ceiling(0, 0, 1, 1, 1), GREY, 1)], [((0, 0, 0.7), (0.1, 0.05, 1.4), (-0.2, 0.1, 1.3))])
scene("five lights", (0.1, 0.2, 0), (0.1, -0.2, 1), [
    (ceiling(0, 0, 2, 0.5, 0.5), (10, 5, 1), 1), (ceiling(1, 0, 1.5, 0.2, 0.3), (1, 20, 3), 1), (quad((-2, -1, 0.2), (0, 2, 0.3), (0.2, 0, 1)), (3, 2, 8), 2),
    ([((0, 1, 0.5), (0.5, 1.2, 0.7), (0.2, 1.1, 1.4))], (2, 2, 30), 2), (ceiling(0.2, 0.1, 1, 0.3, 0.1), (40, 1, 1), 1)],
    quad((-0.5, -0.5, 0.7), (0.6, 0, 0.1), (0, 0.5, 0)) + [((0.5, 0.1, 0.2), (0.6, 0.5, 0.9), (0.3, 0.8, 0.6))])
scene("low light through the horizon", (0, 0, 0), (0, 0, 1), [(quad((1, -0.5, -0.5), (0, 0, 1), (0, 1, 0)), GREY, 2)], quad((0.5, -0.2, -0.3), (0, 0.4, 0), (0.05, 0, 0.5)))
scene("shared diagonals", (0, 0, 0), UP, [(ceiling(0, 0, 2, 1, 1), GREY, 1)], ceiling(0, 0, 1, 0.5, 0.5))
scene("thousandth short of cover", (0, 0, 0), UP, [(ceiling(0, 0, 2, 1, 1), GREY, 1)], ceiling(0, 0, 1, 0.4995, 0.4995))

flat = lambda t: [f32(c) for p in t for c in p]
rows = []
for name, x, n, lights, blockers in SCENES:
    row = {"name": name, "x": [f32(c) for c in x], "n": [f32(c) for c in n],
           "lights": [{"rgb": [f32(c) for c in rgb], "sides": sides, "triangles": [flat(t) for t in ts]} for ts, rgb, sides in lights],
           "blockers": [flat(t) for t in blockers]}
    row.update(solve(x, n, lights, blockers))
    rows.append(json.dumps(row, separators=(",", ":")))
    print(name, row["irradiance"], row["variance"]["area/uniform"], flush=True)
provenance = "Computed by stress.py beside this file, in 60 decimal digits. Vertices are binary32 values, nine numbers a triangle."
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "stress.json"), "w") as file:
    file.write('{"provenance": %s,\n"scenes": [\n' % json.dumps(provenance) + ",\n".join(rows) + "\n]}\n")
