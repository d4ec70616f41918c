#!/usr/bin/env python3
"""Writes two small pictures, the noise of one, and what independent programs say of their difference.

Needs NumPy (2.4.6 was used) and flip_evaluator 1.7, the evaluator of FLIP's authors (PyPI, BSD licence). The
pictures are made here, by formula and NumPy's PCG64 under a fixed seed; nothing is anybody else's.

  picture.npy, reference.npy, stderr.npy   48 × 36 pixels, linear sRGB float32
  flip.npy, flip_ldr.npy                   FLIP of every pixel; LDR of the pictures clamped to [0, 1]
  measures.json                            means over the whole and over one region
"""
import json
import pathlib

import flip_evaluator
import numpy as np

HERE = pathlib.Path(__file__).parent
WIDTH, HEIGHT = 48, 36
REGION = {"x0": 7, "y0": 5, "x1": 31, "y1": 22}
EPSILON = 0.01


def pictures():
    rng = np.random.Generator(np.random.PCG64(20))
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH] / np.array([HEIGHT, WIDTH]).reshape(2, 1, 1)
    # A coloured gradient, a bright soft blob, a hard-edged dark square, a black strip.
    truth = np.stack([0.1 + 0.6 * x, 0.3 + 0.3 * y, 0.7 - 0.5 * x * y], axis=-1)
    truth += 6 * np.exp(-((x - 0.7) ** 2 + (y - 0.3) ** 2) / 0.01)[..., None] * np.array([1, 0.8, 0.5])
    truth[20:30, 8:18] = [0.02, 0.05, 0.01]
    truth[:, 40:44] = 0
    stderr = 0.03 * np.sqrt(truth)
    reference = np.maximum(truth + stderr * rng.standard_normal(truth.shape), 0)
    noise = 0.2 * np.sqrt(truth) * rng.standard_normal(truth.shape)
    # Left of it almost converged, so that small differences count as well.
    noise[:, :16] *= 0.05
    picture = np.maximum(truth + noise, 0)
    for row, column, value in [(4, 5, 3), (17, 25, 12), (25, 12, 1), (33, 42, 0.5)]:
        picture[row, column] = value * np.array([1, 0.9, 0.6])
    return [a.astype("<f4") for a in (picture, reference, stderr)]


def numpy_measures(a, r, s):
    a, r, s = (v.astype(np.float64) for v in (a, r, s))
    squares = (a - r) ** 2
    scatter = squares.mean(axis=-1)
    return {
        "mse": squares.mean(),
        "rmse": np.sqrt(squares.mean()),
        "relmse": (squares / (r**2 + EPSILON)).mean(),
        "mae": np.abs(a - r).mean(),
        "smape": (np.abs(a - r) / (np.abs(a) + np.abs(r) + EPSILON)).mean(),
        "mse_error": scatter.std(ddof=1) / np.sqrt(scatter.size),
        "mse_share": (s**2).mean(),
        "relmse_share": (s**2 / (r**2 + EPSILON)).mean(),
    }


def main():
    picture, reference, stderr = pictures()
    part = np.s_[REGION["y0"] : REGION["y1"], REGION["x0"] : REGION["x1"]]
    whole = numpy_measures(picture, reference, stderr)
    region = numpy_measures(picture[part], reference[part], stderr[part])
    flip, mean, used = flip_evaluator.evaluate(reference, picture, "HDR", applyMagma=False)
    # Linear input, since the inner function takes what the display emits.
    clamped = [np.clip(v, 0, 1) for v in (reference, picture)]
    ldr, ldr_mean, _ = flip_evaluator.evaluate(*clamped, "LDR", inputsRGB=False, applyMagma=False)
    whole["flip"], region["flip"] = mean, flip[part].astype(np.float64).mean()
    whole["flip_ldr"] = ldr_mean
    arrays = {"picture": picture, "reference": reference, "stderr": stderr, "flip": flip, "flip_ldr": ldr}
    for name, array in arrays.items():
        np.save(HERE / f"{name}.npy", array.astype("<f4"))
    exposures = {k: used[k] for k in ("ppd", "startExposure", "stopExposure", "numExposures")}
    truth = {"region_of": REGION, "whole": whole, "region": region, "exposures": exposures}
    (HERE / "measures.json").write_text(json.dumps(truth, indent=1) + "\n")


main()
