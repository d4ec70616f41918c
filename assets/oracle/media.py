#!/usr/bin/env python3
"""Render the references of S7 and S8 with Mitsuba 3 (pip install mitsuba numpy).

S7: a cloud and a uniform medium overlap; here they are one grid that holds the sum of their extinctions, per colour channel.
S8: a ball of uniform medium with a small light inside and a dim environment.
Every colour channel is a grey scene of its own, without Russian roulette or depth limit. Writes reference.npy and stderr.npy,
16 x 16 block means as (1, 16, 16, 3) float32, from independent images with different seeds.

    media.py S7 --spp 64 --images 32
"""
import argparse
import numpy as np
import mitsuba as mi

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)
T = mi.ScalarTransform4f

CLOUD = [6.0, 12.0, 3.0]
HAZE = [0.5, 0.2, 1.5]
FOG = [0.6, 1.0, 0.3]


def camera(origin, fov):
    return {
        "type": "perspective", "fov": fov, "fov_axis": "x", "near_clip": 0.01,
        "to_world": T().look_at(origin=origin, target=[0, 0, 0], up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": 128, "height": 128, "rfilter": {"type": "box"},
                 "pixel_format": "rgb", "component_format": "float32"},
        "sampler": {"type": "independent", "sample_count": 16},
    }


def rectangle(center, target, size, radiance):
    return {
        "type": "rectangle", "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}},
        "to_world": T().look_at(origin=center, target=target, up=[0, 1, 0]) @ T().scale([size / 2, size / 2, 1]),
        "emitter": {"type": "area", "radiance": {"type": "rgb", "value": radiance}},
    }


def environment(radiance):
    return {"type": "constant", "radiance": {"type": "rgb", "value": radiance}}


def scene(name, channel):
    integrator = {"type": "volpath", "max_depth": -1, "rr_depth": 10**6}
    if name == "S7":
        density = np.load("S2/density.npy").astype(np.float32)
        total = CLOUD[channel] * density + HAZE[channel]
        grid = {"type": "gridvolume", "grid": mi.VolumeGrid(np.ascontiguousarray(total[..., None])),
                "to_world": T().translate([-0.5, -0.5, -0.5]), "filter_type": "trilinear", "wrap_mode": "clamp"}
        medium = {"type": "heterogeneous", "sigma_t": grid, "albedo": 0.9, "scale": 1.0,
                  "phase": {"type": "hg", "g": 0.3}, "has_spectral_extinction": False}
        return {
            "type": "scene", "integrator": integrator, "sensor": camera([1.2, 0.9, -2.6], 26.0),
            "box": {"type": "cube", "to_world": T().scale(0.5), "bsdf": {"type": "null"}, "interior": medium},
            "light": rectangle([1.4, 1.2, 0.2], [0, 0, 0], 1.0, 8.0), "sky": environment(0.5),
        }
    medium = {"type": "homogeneous", "sigma_t": FOG[channel], "albedo": 0.9,
              "phase": {"type": "hg", "g": 0.6}, "has_spectral_extinction": False}
    return {
        "type": "scene", "integrator": integrator, "sensor": camera([0.5, 0.8, -5.0], 36.0),
        "ball": {"type": "sphere", "center": [0, 0, 0], "radius": 1.5, "bsdf": {"type": "null"}, "interior": medium},
        "light": rectangle([0.4, 0.9, 0.2], [0, -0.5, 0], 0.4, 20.0) | {"exterior": medium, "interior": medium},
        "sky": environment(0.3),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", choices=["S7", "S8"])
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--images", type=int, default=32)
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
        print(a.scene, channel, means[0, ..., channel].mean(), (errors[0, ..., channel] / means[0, ..., channel]).mean())
    np.save(f"{a.scene}/reference.npy", means.astype(np.float32))
    np.save(f"{a.scene}/stderr.npy", errors.astype(np.float32))


if __name__ == "__main__":
    main()
