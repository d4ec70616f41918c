#!/usr/bin/env python3
"""Models a cumulus cloud and writes cloud.vdb.

A tree of spheres (big ones on a flat base, smaller ones budding from their
upper sides, three generations) gives a signed distance. Worley and Perlin
noise displace it into cauliflower tops, a tilted, wavy floor flattens the base,
and eroding noise opens wisps where the cloud is thin. y is up.

Grid written (float, fog volume):
  density  dimensionless, peak 1, 0 outside

Needs numpy, and pyopenvdb for writing (Debian: python3-openvdb). Deterministic.
"""
import argparse
import os

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
F = np.float32
SEED = 271
SHAPE = (204, 136, 188)
STEP = 1.0 / 192  # of the modelling domain, whose unit is a little more than the cloud's width
LEVELS = 256


def smooth(a, b, x):
    t = np.clip((x - a) / (b - a), 0, 1)
    return t * t * (3 - 2 * t)


def buds(rng):
    """(centre, radius) of every sphere; units of cloud width, base near y = 0."""
    trunk = [
        ((-0.02, 0.18, 0.00), 0.185),
        ((0.10, 0.15, 0.06), 0.150),
        ((-0.17, 0.12, 0.05), 0.135),
        ((0.04, 0.31, -0.03), 0.150),
        ((-0.07, 0.27, 0.06), 0.130),
        ((0.22, 0.10, -0.04), 0.115),
        ((-0.28, 0.09, -0.03), 0.100),
        ((-0.36, 0.05, 0.03), 0.060),
        ((0.02, 0.11, -0.18), 0.130),
        ((-0.05, 0.09, 0.20), 0.115),
        ((0.33, 0.07, 0.05), 0.085),
        ((-0.13, 0.10, -0.15), 0.105),
        ((0.16, 0.09, 0.17), 0.095),
        ((0.07, 0.42, -0.01), 0.100),
    ]
    out = [(np.array(c), r) for c, r in trunk]
    parents = list(out)
    for count, lo, hi in ((10, 0.32, 0.55), (6, 0.30, 0.5)):
        children = []
        for c, r in parents:
            for _ in range(count):
                d = rng.standard_normal(3)
                d[1] = abs(d[1]) * 1.1 - 0.25
                d /= np.linalg.norm(d)
                cr = r * rng.uniform(lo, hi)
                children.append((c + d * (r * rng.uniform(0.80, 1.0)), cr))
        out += children
        parents = children
    return out


def distance(grid, spheres, k):
    """Smooth union of spheres (each only where it matters)."""
    x, y, z = grid
    step = x[1, 0, 0] - x[0, 0, 0]
    d = np.full((x.size, y.size, z.size), 0.4, F)
    for c, r in sorted(spheres, key=lambda s: -s[1]):
        reach = r + 0.10
        sl = tuple(slice(max(0, int((c[i] - reach - g.ravel()[0]) / step)), max(0, int((c[i] + reach - g.ravel()[0]) / step) + 2)) for i, g in enumerate(grid))
        s = np.sqrt((x[sl[0]] - F(c[0])) ** 2 + (y[:, sl[1]] - F(c[1])) ** 2 + (z[:, :, sl[2]] - F(c[2])) ** 2) - F(r)
        old = d[sl]
        kk = F(k * min(1.0, r / 0.08))
        hgt = np.clip(0.5 + 0.5 * (old - s) / kk, 0, 1)
        d[sl] = old * (1 - hgt) + s * hgt - kk * hgt * (1 - hgt)
    return d


def perlin(rng, p, period=32):
    g = rng.standard_normal((period,) * 3 + (3,)).astype(F)
    g /= np.linalg.norm(g, axis=-1, keepdims=True)
    i = [np.floor(a).astype(np.intp) for a in p]
    f = [(a - b).astype(F) for a, b in zip(p, i)]
    u = [a * a * a * (a * (a * 6 - 15) + 10) for a in f]
    out = 0
    for cx in (0, 1):
        for cy in (0, 1):
            for cz in (0, 1):
                gr = g[(i[0] + cx) % period, (i[1] + cy) % period, (i[2] + cz) % period]
                dot = gr[..., 0] * (f[0] - cx) + gr[..., 1] * (f[1] - cy) + gr[..., 2] * (f[2] - cz)
                out = out + dot * (u[0] if cx else 1 - u[0]) * (u[1] if cy else 1 - u[1]) * (u[2] if cz else 1 - u[2])
    return out


def worley(rng, p, period=32):
    """Distance to the nearest jittered point, in cells."""
    pts = rng.random((period,) * 3 + (3,)).astype(F)
    i = [np.floor(a).astype(np.intp) for a in p]
    f = [(a - b).astype(F) for a, b in zip(p, i)]
    best = np.full(i[0].shape, 9, F)
    for ox in (-1, 0, 1):
        for oy in (-1, 0, 1):
            for oz in (-1, 0, 1):
                q = pts[(i[0] + ox) % period, (i[1] + oy) % period, (i[2] + oz) % period]
                d = (q[..., 0] + ox - f[0]) ** 2 + (q[..., 1] + oy - f[1]) ** 2 + (q[..., 2] + oz - f[2]) ** 2
                np.minimum(best, d, out=best)
    return np.sqrt(best)


def model():
    rng = np.random.default_rng(SEED)
    nx, ny, nz = SHAPE
    step = STEP
    gx = ((np.arange(nx) - (nx - 1) / 2) * step).astype(F).reshape(-1, 1, 1)
    gy = ((np.arange(ny) + 0.5) * step - 0.045).astype(F).reshape(1, -1, 1)
    gz = ((np.arange(nz) - (nz - 1) / 2) * step).astype(F).reshape(1, 1, -1)
    d = distance((gx, gy, gz), buds(rng), 0.03)

    p = [np.broadcast_to(a, SHAPE) for a in (gx, gy, gz)]
    scaled = lambda s, q=p: [a * F(s) + F(50.0) for a in q]
    warp = [perlin(rng, scaled(6)) * F(0.035) + perlin(rng, scaled(14)) * F(0.012) for _ in range(3)]
    q = [a + b for a, b in zip(p, warp)]
    lumps = 0.046 * (worley(rng, scaled(11, q)) - 0.45) + 0.028 * (worley(rng, scaled(23, q)) - 0.45) + 0.016 * (worley(rng, scaled(43, q)) - 0.45) + 0.009 * (worley(rng, scaled(83, q), 64) - 0.45)
    height = smooth(0.02, 0.16, p[1])
    d = d + lumps * (0.45 + 0.75 * height)
    floor = 0.008 * perlin(rng, scaled(7)) + 0.010 * perlin(rng, scaled(17)) + 0.02 * p[0]
    base = -(p[1] - 0.012 - floor)
    k = 0.03
    h = np.clip(0.5 + 0.5 * (d - base) / k, 0, 1)
    d = base * (1 - h) + d * h + k * h * (1 - h)

    # density: crisp on the tops, loose at the base; hollowed a little by soft noise
    soft = 0.011 + 0.034 * (1 - height)
    rho = smooth(0.0, 1.0, -d / soft)
    body = 0.78 + 0.22 * smooth(0.0, 0.10, -d)
    fbm = sum(perlin(rng, scaled(s, q)) * w for s, w in ((9, 0.5), (19, 0.27), (39, 0.16), (77, 0.09)))
    wisp = 0.38 * worley(rng, scaled(27, q)) + 0.2 * worley(rng, scaled(61, q)) + 0.9 * fbm + 0.1
    erode = np.clip(wisp, 0, 1) * (0.75 - 0.25 * height)
    rho = np.clip((rho - erode * (1 - rho) ** 0.7) / (1 - 0.25 * erode), 0, 1)
    rho = rho * body * (0.94 + 0.25 * fbm)
    # a breath of haze around it
    haze = 0.05 * smooth(0.035, 0.0, d) * smooth(0.08, 0.30, fbm + 0.12) * smooth(-0.02, 0.03, p[1] - floor)
    rho = np.maximum(rho, haze)
    edge = np.minimum.reduce([np.broadcast_to(np.minimum(np.arange(n), np.arange(n)[::-1]).reshape([-1 if i == a else 1 for i in range(3)]), SHAPE) for a, n in enumerate(SHAPE)])
    rho = np.clip(rho * smooth(1.0, 6.0, edge), 0, None)
    rho = rho / np.quantile(rho[rho > 0.2], 0.999)
    rho = np.clip(rho, 0, 1)
    dither = np.random.default_rng(SEED + 1).random(SHAPE) - 0.5
    quant = np.rint(rho * LEVELS + 0.5 * dither * (rho < 0.5)) / LEVELS
    return np.where((rho > 2e-3) & (quant > 0), quant, 0).astype(F)


def write(path, density):
    import pyopenvdb as vdb

    used = np.argwhere(density > 0)
    lo, hi = used.min(0), used.max(0)
    voxel = 1.0 / float(max(hi[0] - lo[0], hi[2] - lo[2]) + 1)
    shift = tuple(-(lo + hi) / 2.0 * voxel)  # index (i, j, k) is the centre of a voxel
    g = vdb.FloatGrid()
    g.copyFromArray(np.ascontiguousarray(density), tolerance=0.0)
    g.name = "density"
    g.gridClass = vdb.GridClass.FOG_VOLUME
    g.saveFloatAsHalf = False
    tr = vdb.createLinearTransform(voxelSize=voxel)
    tr.translate(shift)
    g.transform = tr
    g["unit"] = "1 (peak 1)"
    g["creator"] = "make_cloud.py"
    g.prune()
    mn, mx = g.evalActiveVoxelBoundingBox()
    on = density[density > 0]
    print("density: class %s, bbox %s..%s, active %d, mean %.4f, max %.4f, map %s" % (g.gridClass, mn, mx, g.activeVoxelCount(), on.mean(), on.max(), g.transform.typeName))
    print("  voxel %.8f, world %s .. %s" % (voxel, [round((mn[i] - 0.5) * voxel + shift[i], 4) for i in range(3)], [round((mx[i] + 0.5) * voxel + shift[i], 4) for i in range(3)]))
    vdb.write(path, grids=[g], metadata={"title": "Majorant cumulus", "licence": "MIT OR Apache-2.0"})
    print("%s: %d bytes" % (path, os.path.getsize(path)))


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("--out", default=os.path.join(HERE, "cloud.vdb"))
    write(ap.parse_args().out, model())


if __name__ == "__main__":
    main()
