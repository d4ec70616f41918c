#!/usr/bin/env python3
"""Render the references of S12, S13 and S14 with Mitsuba 3 (pip install mitsuba numpy).

S12: a smooth glass sphere filled with a scattering medium, on a diffuse floor.
S13: a rough glass box and a rough metal sphere in a room lit by a rectangle.
S14: a mirror, a thin pane and a lantern behind it, in fog inside a large sphere.
Every colour channel is a grey scene of its own, without Russian roulette or depth limit. Writes reference.npy and stderr.npy,
16 x 16 block means as (1, 16, 16, 3) float32, from independent images with different seeds.

    materials.py S12 --spp 64 --images 16
"""
import argparse
import numpy as np
import mitsuba as mi
from shapes import camera, diffuse, area, environment, rectangle, mesh, uniform, turned, T

MILK = [2.0, 1.0, 3.0]
FLOOR = [0.7, 0.5, 0.3]
IOR = [1.3, 1.5, 1.7]
ETA = [0.2, 0.5, 1.4]
K = [3.5, 2.3, 1.9]
FOG = [0.15, 0.25, 0.1]
JELLY = [0.5, 1.5, 1.0]


def twosided(bsdf):
    return {"type": "twosided", "nested": bsdf}


def scene(name, channel):
    base = {"type": "scene", "integrator": {"type": "volpath", "max_depth": -1, "rr_depth": 10**6}}
    floor = lambda y, size: rectangle([0, y, 0], [0, 1, 0.0001], size) | {"bsdf": twosided(diffuse(FLOOR[channel]))}
    if name == "S12":
        glass = {"type": "dielectric", "int_ior": IOR[channel], "ext_ior": 1.0}
        return base | {
            "sensor": camera([0.6, 1.0, -3.2], [0, 0, 0], 30.0),
            "ball": {"type": "sphere", "center": [0, 0, 0], "radius": 0.6, "bsdf": glass, "interior": uniform(MILK[channel], 0.95, 0.4)},
            "floor": floor(-0.62, 4.0),
            "sky": environment(0.8),
        }
    if name == "S13":
        glass = {"type": "roughdielectric", "int_ior": IOR[channel], "ext_ior": 1.0, "alpha": 0.3, "distribution": "ggx"}
        metal = {"type": "roughconductor", "eta": ETA[channel], "k": K[channel], "alpha": 0.25, "distribution": "ggx"}
        return base | {
            "sensor": camera([0.8, 1.1, -3.2], [0, 0, 0], 32.0),
            "box": {"type": "cube", "to_world": turned([0.45, 0.0, 0.0], y=30.0) @ T().scale([0.3, 0.5, 0.3]), "bsdf": glass,
                    "interior": uniform(JELLY[channel], 0.8, 0.0)},
            "ball": {"type": "sphere", "center": [-0.5, -0.1, 0.1], "radius": 0.4, "bsdf": metal},
            "floor": floor(-0.52, 4.0),
            "light": rectangle([0.5, 2.0, -1.0], [0, 0, 0], 1.2) | {"bsdf": diffuse(0.0), "emitter": area(5.0)},
            "sky": environment(0.3),
        }
    medium = uniform(FOG[channel], 0.9, 0.5)
    mirror = {"type": "conductor", "material": "none", "specular_reflectance": {"type": "rgb", "value": 0.8}}
    pane = {"type": "thindielectric", "int_ior": IOR[channel], "ext_ior": 1.0}
    return base | {
        "sensor": camera([0.4, 0.5, -2.6], [0, 0, 0], 50.0) | {"medium": medium},
        "ball": {"type": "sphere", "center": [0, 0, 0], "radius": 3.0, "bsdf": {"type": "null"}, "interior": medium},
        "mirror": rectangle([0.6, 0.0, 0.8], [0.0, 0.1, -1.0], 1.4) | {"bsdf": twosided(mirror)},
        "pane": rectangle([-0.5, 0.1, -0.3], [-0.1, 0.1, -2.0], 0.9) | {"bsdf": pane},
        "lantern": mesh("S10/lantern.obj", turned([-0.5, 0.2, 0.3], x=20.0)) | {"bsdf": diffuse(0.4), "emitter": area(5.0), "interior": medium, "exterior": medium},
        "sky": environment(0.2),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", choices=["S12", "S13", "S14"])
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--images", type=int, default=16)
    a = parser.parse_args()
    means, errors = np.zeros((1, 16, 16, 3)), np.zeros((1, 16, 16, 3))
    for channel in range(3):
        loaded = mi.load_dict(scene(a.scene, channel))
        blocks = []
        for seed in range(a.images):
            image = np.array(mi.render(loaded, spp=a.spp, seed=100 * channel + seed))[..., 0].astype(float)
            blocks.append(image.reshape(16, 8, 16, 8).mean((1, 3)))
        blocks = np.array(blocks)
        means[0, ..., channel] = blocks.mean(0)
        errors[0, ..., channel] = blocks.std(0, ddof=1) / np.sqrt(a.images)
        print(a.scene, channel, means[0, ..., channel].mean(), (errors[0, ..., channel] / means[0, ..., channel]).mean(), flush=True)
    np.save(f"{a.scene}/reference.npy", means.astype(np.float32))
    np.save(f"{a.scene}/stderr.npy", errors.astype(np.float32))


if __name__ == "__main__":
    main()
