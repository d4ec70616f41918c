#!/usr/bin/env python3
"""Times Mitsuba 3 on a scene of assets/oracle and prints one line of JSON, in the units of `majorant bench`.

    python3 -m venv peer && peer/bin/pip install mitsuba numpy
    peer/bin/python tests/peers/time_mitsuba.py assets/oracle/S3

Mitsuba 3.6.4 is the last version whose volpathmis weighs wavelengths: use it for S4. It needs an LLVM (Debian's
libllvm19; DRJIT_LIBLLVM_PATH names the library). relMSE is the mean of ((I - R)^2 - se^2) / (R^2 + 0.01) against
reference.exr, efficiency 1 / (relMSE * CPU seconds of all threads).
"""
import argparse
import json
import time

import numpy as np

from mitsuba_scene import to_mitsuba


def reference(mi, path):
    bitmap = mi.Bitmap(path)
    names = [field.name for field in bitmap.struct_()]
    data = np.array(bitmap, dtype=float)
    channels = lambda wanted: data[..., [names.index(name) for name in wanted]]
    return channels("RGB"), channels([f"stderr.{c}" for c in "RGB"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="folder with scene.toml and reference.exr")
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()

    import mitsuba as mi

    mi.set_variant(options.variant)
    mi.set_log_level(mi.LogLevel.Error)
    truth, error = reference(mi, f"{options.scene}/reference.exr")
    height, width, _ = truth.shape
    scene = mi.load_dict(to_mitsuba(options.scene, width, height))
    np.array(mi.render(scene, spp=1, seed=999))  # compiles before the clock starts

    rows = []
    for seed in range(options.repeats):
        wall, cpu = time.perf_counter(), time.process_time()
        image = np.array(mi.render(scene, spp=options.spp, seed=4242 + seed))
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        relmse = float(np.mean(((image - truth) ** 2 - error**2) / (truth**2 + 0.01)))
        rows.append((wall, cpu, relmse, float(image.mean() / truth.mean())))
    wall, cpu, relmse, mean = np.mean(rows, axis=0)
    print(json.dumps({
        "renderer": f"Mitsuba {mi.__version__} {options.variant}", "scene": options.scene, "spp": options.spp,
        "wall_seconds": wall, "cpu_seconds": cpu, "relmse": relmse, "efficiency": 1 / (relmse * cpu),
        "mean_over_reference": mean,
    }))


if __name__ == "__main__":
    main()
