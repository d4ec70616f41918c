#!/usr/bin/env python3
"""Simulates a rising smoke plume and writes plume.vdb.

A small gas solver on a periodic, collocated grid, y up:
  * MacCormack advection (limited) of velocity, smoke and heat,
  * buoyancy, vorticity confinement, a little divergence-free turbulence,
  * exact pressure projection by FFT,
  * a noisy, breathing inflow disc near the floor; damping near the walls.

Grids written (float, fog volume, voxels that do not matter pruned):
  density      smoke, dimensionless, peak 1
  temperature  kelvin above the ambient air, peak 1920, 0 outside the plume

Needs numpy, and pyopenvdb for writing (Debian: python3-openvdb). Deterministic.
  make_plume.py                     full size, writes plume.vdb next to the script
  make_plume.py --width 64 --npz F  other grid width; keep the raw fields in F
  make_plume.py --from F            skip the simulation, write from F
"""
import argparse
import os
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
POOL = ThreadPoolExecutor(2)
F = np.float32

SEED = 1729
ASPECT = 1.3125  # height / width
DURATION = 2.2  # seconds; the domain is one unit wide
CFL = 1.3  # cells per step at unit speed
SOURCE_RADIUS = 0.068
SOURCE_Y = 0.05
BUOYANCY = 5.5
COOLING = 0.55
FADING = 0.10
CONFINEMENT = 6.0
TURBULENCE = 1.0
PEAK_KELVIN = 1920.0
LEVELS = 256  # density steps kept in the file: a power of two leaves short mantissas, which compress
KELVIN_STEP = 16.0


class Advector:
    """Trilinear look-ups along one backward (or forward) trace, for many fields."""

    def __init__(self, vel, dt, h, shape):
        nx, ny, nz = shape
        idx, frac = [], []
        for a, n in enumerate(shape):
            g = np.arange(n, dtype=F).reshape([-1 if i == a else 1 for i in range(3)])
            p = g - vel[a] * F(dt / h)
            fl = np.floor(p)
            frac.append((p - fl).ravel())
            i0 = fl.astype(np.intp) % n
            idx.append((i0.ravel(), ((i0 + 1) % n).ravel()))
        self.shape = shape
        self.corner, self.weight = [], []
        for cx in (0, 1):
            wx = frac[0] if cx else 1 - frac[0]
            for cy in (0, 1):
                wxy = wx * (frac[1] if cy else 1 - frac[1])
                ixy = (idx[0][cx] * ny + idx[1][cy]) * nz
                for cz in (0, 1):
                    self.corner.append(ixy + idx[2][cz])
                    self.weight.append(wxy * (frac[2] if cz else 1 - frac[2]))

    def __call__(self, field, bounds=False):
        flat = field.ravel()
        out = np.zeros(flat.size, F)
        buf = np.empty(flat.size, F)
        lo = hi = None
        for c, w in zip(self.corner, self.weight):
            np.take(flat, c, out=buf, mode="clip")
            if bounds:
                lo = buf.copy() if lo is None else np.minimum(lo, buf, out=lo)
                hi = buf.copy() if hi is None else np.maximum(hi, buf, out=hi)
            buf *= w
            out += buf
        out = out.reshape(self.shape)
        return (out, lo.reshape(self.shape), hi.reshape(self.shape)) if bounds else out


def maccormack(fields, vel, dt, h):
    shape = fields[0].shape
    back, fore = POOL.map(lambda t: Advector(vel, t, h, shape), (dt, -dt))

    def one(f):
        new, lo, hi = back(f, bounds=True)
        again = fore(new)
        sharp = new + F(0.5) * (f - again)
        return np.where((sharp < lo) | (sharp > hi), new, sharp)

    return list(POOL.map(one, fields))


def ddx(f, axis, h):
    return (np.roll(f, -1, axis) - np.roll(f, 1, axis)) * F(0.5 / h)


def curl(v, h):
    return [
        ddx(v[2], 1, h) - ddx(v[1], 2, h),
        ddx(v[0], 2, h) - ddx(v[2], 0, h),
        ddx(v[1], 0, h) - ddx(v[0], 1, h),
    ]


class Projector:
    def __init__(self, shape):
        k = [np.fft.fftfreq(shape[0]), np.fft.fftfreq(shape[1]), np.fft.rfftfreq(shape[2])]
        self.k = [a.reshape([-1 if i == j else 1 for i in range(3)]) for j, a in enumerate(k)]
        k2 = sum(a * a for a in self.k)
        k2[0, 0, 0] = 1
        self.inv = 1 / k2
        self.kmag = np.sqrt(k2)
        # takes out what central differences cannot see (and would leave as a lattice)
        self.calm = np.exp(-1.5 * sum((2 * a) ** 6 for a in self.k))
        self.shape = shape

    def __call__(self, v, band=None):
        hat = list(POOL.map(np.fft.rfftn, v))
        div = sum(k * a for k, a in zip(self.k, hat)) * self.inv
        keep = self.calm if band is None else band
        return list(POOL.map(lambda i: np.fft.irfftn((hat[i] - self.k[i] * div) * keep, s=self.shape).astype(F), range(3)))


def smooth(a, b, x):
    t = np.clip((x - a) / (b - a), 0, 1)
    return t * t * (3 - 2 * t)


def noise(rng, shape, project, lo, hi):
    """Divergence-free noise with wavelengths between lo and hi (domain widths)."""
    n = shape[0]
    k = project.kmag * n
    band = (k > 1 / hi) & (k < 1 / lo)
    band = band * (k + 1e-9) ** -1.4
    v = project([rng.standard_normal(shape).astype(F) for _ in range(3)], band)
    rms = np.sqrt(sum(float((a * a).mean()) for a in v))
    return [(a / F(rms)).astype(F) for a in v]


def simulate(width):
    t0 = time.time()
    rng = np.random.default_rng(SEED)
    shape = (width, int(width * ASPECT), width)
    h = 1.0 / width
    dt = CFL * h
    steps = int(round(DURATION / dt))
    project = Projector(shape)
    x, y, z = np.meshgrid(*[(np.arange(n, dtype=F) + F(0.5)) * F(h) for n in shape], indexing="ij", sparse=True)
    x, z = x - F(0.5), z - F(0.5)
    turb = noise(rng, shape, project, 0.04, 0.2)
    gust = noise(rng, shape, project, 0.3, 1.2)
    lumps = noise(rng, shape, project, 0.04, 0.14)[1]
    v = [(a * F(0.06)).astype(F) for a in gust]
    smoke, heat = np.zeros(shape, F), np.zeros(shape, F)

    edge = np.maximum(np.abs(x), np.abs(z))
    wall = smooth(F(0.42), F(0.5), edge) + smooth(F(ASPECT - 0.10), F(ASPECT), y) + smooth(F(0.03), F(0.0), y)
    wall = np.clip(wall, 0, 1)
    keep = np.exp(-wall * F(dt * 14)).astype(F)

    rim = np.broadcast_to(edge > 0.44, shape)

    def still(a):
        return a[rim].mean(dtype=np.float64).astype(F)

    for s in range(steps):
        t = s * dt
        # inflow: a disc that wanders, breathes and is torn by noise
        cx, cz = 0.025 * np.sin(5.1 * t), 0.025 * np.cos(3.7 * t + 1)
        r = np.sqrt((x - F(cx)) ** 2 + (z - F(cz)) ** 2)
        churn = np.roll(lumps, (int(9 * t / h * 0.05), int(1.1 * t / h), int(-7 * t / h * 0.05)), (0, 1, 2))
        radius = SOURCE_RADIUS * (1 + 0.15 * np.sin(7.3 * t)) + 0.018 * churn
        disc = smooth(0.0, -0.025, r - radius) * np.exp(-(((y - SOURCE_Y) / 0.02) ** 2))
        disc = disc.astype(F)
        pulse = 0.8 + 0.2 * np.sin(11.0 * t) + 0.12 * np.sin(17.3 * t + 2)
        gain = np.clip(disc * F(dt * 22), 0, 1)
        smoke += gain * (F(pulse) * (1 + F(0.25) * churn) - smoke)
        heat += gain * (F(pulse) * (1 + F(0.35) * churn) - heat)
        np.clip(smoke, 0, 1.6, out=smoke)
        np.clip(heat, 0, 1.6, out=heat)

        # forces
        w = curl(v, h)
        mag = np.sqrt(w[0] ** 2 + w[1] ** 2 + w[2] ** 2)
        n = [ddx(mag, a, h) for a in range(3)]
        inv = 1 / (np.sqrt(n[0] ** 2 + n[1] ** 2 + n[2] ** 2) + F(1e-3 / h))
        n = [a * inv for a in n]
        inside = np.clip(smoke * F(3), 0, 1)
        e = F(CONFINEMENT * h * dt) * inside
        v[0] += e * (n[1] * w[2] - n[2] * w[1])
        v[1] += e * (n[2] * w[0] - n[0] * w[2])
        v[2] += e * (n[0] * w[1] - n[1] * w[0])
        up = int(0.55 * t / h)
        tf = F(TURBULENCE * dt) * inside
        for a in range(3):
            v[a] += tf * np.roll(turb[a], up, 1)
        v[1] += F(BUOYANCY * dt) * heat
        v[1] += gain * F(0.7)
        # a slow swirl near the source and a light breeze aloft
        v[0] += gain * (z * F(-4.0))
        v[2] += gain * (x * F(4.0))
        v[0] += F(0.10 * dt) * smooth(F(0.5), F(1.3), y) * inside

        for a in range(3):
            v[a] *= keep
        v = project(v)
        v[1] -= still(v[1])  # the periodic box would otherwise answer with a downdraught
        fields = maccormack(v + [smoke, heat], v, dt, h)
        v, smoke, heat = fields[:3], fields[3], fields[4]
        smoke *= F(np.exp(-FADING * dt))
        heat *= F(np.exp(-COOLING * dt))
        smoke *= keep
        heat *= keep
        if s % 20 == 19 or s == steps - 1:
            top = np.nonzero(smoke.max((0, 2)) > 0.05)[0].max() * h
            side = np.nonzero(smoke.max((1, 2)) > 0.05)[0] * h
            print("step %d/%d  t %.2f  top %.2f  x %.2f..%.2f  speed %.2f  %.0f s" % (s + 1, steps, t, top, side.min(), side.max(), float(v[1].max()), time.time() - t0), flush=True)
    return smoke, heat, h


def finish(smoke, heat, h):
    """Grades the raw fields: crisp but not hard edges, soft borders, quantised."""
    shape = smoke.shape
    x, y, z = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in shape], indexing="ij", sparse=True)
    border = smooth(0.0, 0.05, np.minimum(np.minimum(x, 1 - x), np.minimum(z, 1 - z)))
    border = border * smooth(0.0, 0.04, 1 - y) * smooth(SOURCE_Y / ASPECT * 0.3, SOURCE_Y / ASPECT * 1.7, y)
    d = smoke.astype(np.float64)
    calm = [d]
    for axis in range(3):
        calm.append(0.5 * calm[-1] + 0.25 * (np.roll(calm[-1], 1, axis) + np.roll(calm[-1], -1, axis)))
    low, high = np.minimum.reduce(calm), np.maximum.reduce(calm)
    wide = calm[-1]
    for _ in range(2):
        for axis in range(3):
            wide = 0.5 * wide + 0.25 * (np.roll(wide, 1, axis) + np.roll(wide, -1, axis))
    d = 0.5 * (d + calm[-1]) + 0.9 * (calm[-1] - wide)  # bring out the billows, not the grid
    d = np.clip(d, 0.6 * low, 1.25 * high)
    d = np.clip(d - 0.012, 0, None)
    ref = np.quantile(d[d > 0.05], 0.97)
    d = 1.12 * (1 - np.exp(-1.7 * (d / ref) ** 1.3)) / (1 - np.exp(-1.7))
    d = np.clip(d, 0, 1)
    for axis in range(3):  # no jump from smoke to nothing within one voxel
        d = 0.7 * d + 0.15 * (np.roll(d, 1, axis) + np.roll(d, -1, axis))
    d *= border
    d /= d.max()
    t = heat.astype(np.float64) * border
    t = np.clip(t / np.quantile(t[t > 0.01], 0.9995), 0, 1) * PEAK_KELVIN

    rng = np.random.default_rng(SEED + 1)
    dither = rng.random(shape) - 0.5
    q = np.rint(d * LEVELS + 0.6 * dither) / LEVELS
    q = np.where((d > 2e-3) & (q > 0), q, 0)
    tq = np.rint(t / KELVIN_STEP + 0.5 * dither) * KELVIN_STEP
    tq = np.where((q > 0) & (tq > 0), tq, 0)
    return q.astype(F), tq.astype(F)


def write(path, density, temperature):
    import pyopenvdb as vdb

    used = np.argwhere(density > 0)
    lo, hi = used.min(0), used.max(0)
    voxel = 1.0 / float(max(hi[0] - lo[0], hi[2] - lo[2]) + 1)
    # index (i, j, k) is the centre of a voxel; the box is centred in x and z, its floor at y = 0
    centre = (lo + hi) / 2.0
    shift = (-centre[0] * voxel, (0.5 - lo[1]) * voxel, -centre[2] * voxel)
    grids = []
    for name, a, unit in (
        ("density", density, "1 (peak 1)"),
        ("temperature", temperature, "K above ambient"),
    ):
        g = vdb.FloatGrid()
        g.copyFromArray(np.ascontiguousarray(a), tolerance=0.0)
        g.name = name
        g.gridClass = vdb.GridClass.FOG_VOLUME
        g.saveFloatAsHalf = False
        tr = vdb.createLinearTransform(voxelSize=voxel)
        tr.translate(shift)
        g.transform = tr
        g["unit"] = unit
        g["creator"] = "make_plume.py"
        g.prune()
        grids.append(g)
        mn, mx = g.evalActiveVoxelBoundingBox()
        on = a[a > 0]
        print("%s: class %s, bbox %s..%s, active %d, mean %.4f, max %.4f, map %s" % (name, g.gridClass, mn, mx, g.activeVoxelCount(), on.mean(), on.max(), g.transform.typeName))
        print("  voxel %.8f, world %s .. %s" % (voxel, [round((mn[i] - 0.5) * voxel + shift[i], 4) for i in range(3)], [round((mx[i] + 0.5) * voxel + shift[i], 4) for i in range(3)]))
    vdb.write(path, grids=grids, metadata={"title": "Majorant smoke plume", "licence": "MIT OR Apache-2.0"})
    print("%s: %d bytes" % (path, os.path.getsize(path)))


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("--width", type=int, default=144)
    ap.add_argument("--npz")
    ap.add_argument("--from", dest="source")
    ap.add_argument("--out", default=os.path.join(HERE, "plume.vdb"))
    a = ap.parse_args()
    if a.source:
        f = np.load(a.source)
        smoke, heat, h = f["smoke"], f["heat"], float(f["h"])
    else:
        smoke, heat, h = simulate(a.width)
        if a.npz:
            np.savez(a.npz, smoke=smoke, heat=heat, h=h)
    density, temperature = finish(smoke, heat, h)
    write(a.out, density, temperature)


if __name__ == "__main__":
    main()
