#!/usr/bin/env python3
"""Writes srgb_basis_5nm.csv: three smooth spectra that split white into the
sRGB primaries (after the idea of Mallett and Yuksel, "Spectral Primary
Decomposition for Rendering with sRGB Reflectance", 2019; own optimisation).

    minimise    sum over R, G, B of |D2 s|^2 + EPS |D1 s|^2   (s sampled at 5 nm)
    subject to  R + G + B = 1 and R, G, B >= 0 at every wavelength,
                M XYZ(s D65) = (w_R,0,0), (0,w_G,0), (0,0,w_B) for s = R, G, B

where w = M XYZ(D65) is the colour of D65 itself, M the XYZ to sRGB matrix of
IEC 61966-2-1 and XYZ(.) an integral against the CIE 1931 2 degree table. With
the tables here w is (1,1,1) to about 1e-4; dividing by w (white = 1,1,1) makes
the three spectra exactly (1,0,0), (0,1,0), (0,0,1).

Integrals are trapezoid sums of the products on the 5 nm grid. (The exact
integral of the product of the three piecewise linear curves, which continuous
sampling of the wavelength converges to, is printed by the check for comparison;
it differs by up to 0.002. Both at once cannot be met within [0,1].)

Needs numpy only. Reads cie1931_2deg_5nm.csv and d65_5nm.csv. Deterministic.
`make_srgb_basis.py --check` checks the file without writing it.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
OUT = os.path.join(HERE, "srgb_basis_5nm.csv")
EPS = 0.02
DIGITS = 9
# XYZ -> linear sRGB, IEC 61966-2-1
M = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])


def load(name):
    return np.loadtxt(os.path.join(HERE, name), delimiter=",", skiprows=1)


def quadratures(lam, cmf, d65):
    """Two 3 x n matrices T with XYZ(s D65) = T s, each scaled so that Y(D65) = 1."""
    n, h = len(lam), lam[1] - lam[0]
    w = np.full(n, h)
    w[[0, -1]] = h / 2
    trapezoid = (cmf * (d65 * w)[:, None]).T
    exact = np.zeros((3, n))
    for i in range(n - 1):
        mid = 0.25 * (cmf[i] + cmf[i + 1]) * (d65[i] + d65[i + 1])
        exact[:, i] += h / 6 * (cmf[i] * d65[i] + 2 * mid)
        exact[:, i + 1] += h / 6 * (cmf[i + 1] * d65[i + 1] + 2 * mid)
    return [t / t[1].sum() for t in (trapezoid, exact)]


def solve_qp(H, A, b, x):
    """min x'Hx/2 subject to Ax = b, x >= 0: primal-dual interior point (Mehrotra)."""
    n, m = len(x), len(b)
    y, z = np.zeros(m), np.ones(n)
    x = np.maximum(x, 0.1)
    for it in range(100):
        rd, rp, mu = H @ x - A.T @ y - z, A @ x - b, x @ z / n
        if max(np.abs(rd).max(), np.abs(rp).max(), mu) < 1e-13:
            break

        def step(rc):
            K = np.block([[H + np.diag(z / x), -A.T], [A, np.zeros((m, m))]])
            s = np.linalg.solve(K, np.concatenate([-rd - rc / x, -rp]))
            return s[:n], s[n:], (-rc - z * s[:n]) / x

        def longest(v, dv):
            neg = dv < 0
            return min(1.0, (-v[neg] / dv[neg]).min()) if neg.any() else 1.0

        dx, dy, dz = step(x * z)
        mu_aff = (x + longest(x, dx) * dx) @ (z + longest(z, dz) * dz) / n
        dx, dy, dz = step(x * z + dx * dz - (mu_aff / mu) ** 3 * mu)
        a, c = 0.995 * longest(x, dx), 0.995 * longest(z, dz)
        a = c = min(a, c)
        x, y, z = x + a * dx, y + c * dy, z + c * dz
    print("interior point: %d iterations, residual %.1e, gap %.1e" % (it, np.abs(A @ x - b).max(), mu))
    return x


def solve(lam, T):
    n = len(lam)
    d1 = np.diff(np.eye(n), axis=0)
    d2 = np.diff(np.eye(n), 2, axis=0)
    H = np.kron(np.eye(3), d2.T @ d2 + EPS * d1.T @ d1)
    rows, rhs = [np.kron(np.ones(3), np.eye(n))], [np.ones(n)]
    white = M @ T.sum(1)
    for k in range(2):  # the third follows from the sum
        rows.append(np.kron(np.eye(3)[k], M @ T))
        rhs.append(white * np.eye(3)[k])
    x = solve_qp(H, np.vstack(rows), np.concatenate(rhs), np.full(3 * n, 1 / 3))
    return x.reshape(3, n)


def check(lam, s, quads):
    print("range [%.3g, %.6f], |R+G+B-1| <= %.1e" % (s.min(), s.max(), np.abs(s.sum(0) - 1).max()))
    ok = s.min() >= 0 and s.max() <= 1 and np.abs(s.sum(0) - 1).max() < 1e-12
    for name, T in zip(("trapezoid sum", "exact product"), quads):
        white = M @ T.sum(1)
        rgb = (M @ T @ s.T) / white[:, None]
        err = np.abs(rgb - np.eye(3)).max()
        ok &= err < 1e-6 or name != "trapezoid sum"
        print("%s: sRGB of D65 %s; basis against (1,0,0),(0,1,0),(0,0,1): %.1e" % (name, white.round(6), err))
    return ok


def main():
    cie, d65 = load("cie1931_2deg_5nm.csv"), load("d65_5nm.csv")
    lam = cie[:, 0]
    assert (lam == d65[:, 0]).all()
    quads = quadratures(lam, cie[:, 1:], d65[:, 1])
    if "--check" not in sys.argv:
        s = solve(lam, quads[0])
        scale = 10**DIGITS
        q = np.rint(np.clip(s, 0, 1) * scale).astype(np.int64)
        big = q.argmax(0)
        q[big, np.arange(len(lam))] += scale - q.sum(0)  # the sum stays exactly 1
        with open(OUT, "w") as f:
            f.write("lambda_nm,r,g,b\n")
            for i, w in enumerate(lam):
                f.write("%d,%s\n" % (w, ",".join("%.*f" % (DIGITS, v / scale) for v in q[:, i])))
    table = load("srgb_basis_5nm.csv")
    if not check(lam, table[:, 1:].T, quads):
        sys.exit("srgb_basis_5nm.csv: check FAILED")


if __name__ == "__main__":
    main()
