#!/usr/bin/env python3
"""Render the references of S9, S10 and S11 with Mitsuba 3 (pip install mitsuba numpy), and write their meshes.

S9:  a diffuse torus inside a cloud.
S10: a ring of uniform medium, bounded by a mesh, above a diffuse floor, beside a lantern that is a mesh.
S11: fog inside a large sphere, around the camera, a lantern that is a mesh and a diffuse sphere.
Every colour channel is a grey scene of its own, without Russian roulette or depth limit. Writes reference.npy and stderr.npy,
16 x 16 block means as (1, 16, 16, 3) float32, from independent images with different seeds.

    shapes.py S9 --spp 64 --images 16
"""
import argparse
import math
import numpy as np
import mitsuba as mi

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)
T = mi.ScalarTransform4f

CLOUD = [6.0, 12.0, 3.0]
FLOOR = [0.7, 0.5, 0.3]
RING = [4.0, 2.0, 6.0]
FOG = [0.15, 0.25, 0.1]


def torus(radius, tube, around, across):
    """Vertices and quadrilaterals of a torus about the y axis, counter-clockwise from outside."""
    vertices, faces = [], []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = radius + tube * math.cos(b)
            vertices.append((r * math.cos(a), tube * math.sin(b), r * math.sin(a)))
    at = lambda i, j: (i % around) * across + j % across
    for i in range(around):
        for j in range(across):
            faces.append((at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)))
    return vertices, faces


def lantern():
    """An octahedron, stretched along y."""
    vertices = [(0.2, 0, 0), (-0.2, 0, 0), (0, 0.35, 0), (0, -0.35, 0), (0, 0, 0.2), (0, 0, -0.2)]
    faces = [(0, 2, 4), (4, 2, 1), (1, 2, 5), (5, 2, 0), (4, 3, 0), (1, 3, 4), (5, 3, 1), (0, 3, 5)]
    return vertices, faces


def write_obj(name, vertices, faces):
    with open(name, "w") as f:
        for v in vertices:
            f.write("v %.6f %.6f %.6f\n" % v)
        for face in faces:
            f.write("f " + " ".join(str(i + 1) for i in face) + "\n")


def camera(origin, target, fov):
    return {
        "type": "perspective", "fov": fov, "fov_axis": "x", "near_clip": 0.01,
        "to_world": T().look_at(origin=origin, target=target, up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": 128, "height": 128, "rfilter": {"type": "box"},
                 "pixel_format": "rgb", "component_format": "float32"},
        "sampler": {"type": "independent", "sample_count": 16},
    }


def diffuse(value):
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": value}}


def area(value):
    return {"type": "area", "radiance": {"type": "rgb", "value": value}}


def environment(radiance):
    return {"type": "constant", "radiance": {"type": "rgb", "value": radiance}}


def rectangle(center, target, size):
    return {"type": "rectangle",
            "to_world": T().look_at(origin=center, target=target, up=[0, 1, 0]) @ T().scale([size / 2, size / 2, 1])}


def mesh(file, to_world):
    return {"type": "obj", "filename": file, "face_normals": True, "to_world": to_world}


def uniform(sigma_t, albedo, g):
    return {"type": "homogeneous", "sigma_t": sigma_t, "albedo": albedo, "phase": {"type": "hg", "g": g},
            "has_spectral_extinction": False}


def turned(translate, x=0.0, y=0.0, z=0.0):
    return T().translate(translate) @ T().rotate([0, 0, 1], z) @ T().rotate([0, 1, 0], y) @ T().rotate([1, 0, 0], x)


def scene(name, channel):
    base = {"type": "scene", "integrator": {"type": "volpath", "max_depth": -1, "rr_depth": 10**6}}
    if name == "S9":
        density = CLOUD[channel] * np.load("S2/density.npy").astype(np.float32)
        grid = {"type": "gridvolume", "grid": mi.VolumeGrid(np.ascontiguousarray(density[..., None])),
                "to_world": T().translate([-0.5, -0.5, -0.5]), "filter_type": "trilinear", "wrap_mode": "clamp"}
        medium = {"type": "heterogeneous", "sigma_t": grid, "albedo": 0.9, "scale": 1.0,
                  "phase": {"type": "hg", "g": 0.3}, "has_spectral_extinction": False}
        return base | {
            "sensor": camera([1.2, 0.9, -2.6], [0, 0, 0], 26.0),
            "box": {"type": "cube", "to_world": T().scale(0.5), "bsdf": {"type": "null"}, "interior": medium},
            "torus": mesh("S9/torus.obj", turned([0.05, 0.0, -0.05], x=50.0, z=20.0) @ T().scale(0.25)) | {"bsdf": diffuse(FLOOR[channel])},
            "light": rectangle([1.4, 1.2, 0.2], [0, 0, 0], 1.0) | {"bsdf": diffuse(0.0), "emitter": area(8.0)},
            "sky": environment(0.5),
        }
    if name == "S10":
        medium = uniform(RING[channel], 0.9, 0.3)
        return base | {
            "sensor": camera([1.5, 1.4, -3.0], [0, -0.1, 0], 34.0),
            "ring": mesh("S9/torus.obj", turned([0.0, 0.1, 0.0], x=30.0, z=15.0) @ T().scale([0.55, 0.7, 0.55])) | {"bsdf": {"type": "null"}, "interior": medium},
            "floor": rectangle([0, -0.55, 0], [0, 1, 0.0001], 3.0) | {"bsdf": {"type": "twosided", "nested": diffuse(FLOOR[channel])}},
            "lantern": mesh("S10/lantern.obj", turned([-0.9, 0.1, -0.2], z=25.0)) | {"bsdf": diffuse(0.0), "emitter": area(6.0)},
            "sky": environment(0.3),
        }
    medium = uniform(FOG[channel], 0.9, 0.5)
    return base | {
        "sensor": camera([0.4, 0.5, -2.6], [0, 0, 0], 50.0) | {"medium": medium},
        "ball": {"type": "sphere", "center": [0, 0, 0], "radius": 3.0, "bsdf": {"type": "null"}, "interior": medium},
        "lantern": mesh("S10/lantern.obj", turned([-0.5, 0.3, 0.1], x=20.0)) | {"bsdf": diffuse(0.4), "emitter": area(5.0), "interior": medium, "exterior": medium},
        "stone": {"type": "sphere", "center": [0.5, -0.3, 0.4], "radius": 0.4, "bsdf": diffuse(FLOOR[channel])},
        "sky": environment(0.2),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", choices=["meshes", "S9", "S10", "S11"])
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--images", type=int, default=16)
    a = parser.parse_args()
    if a.scene == "meshes":
        write_obj("S9/torus.obj", *torus(1.0, 0.4, 16, 8))
        write_obj("S10/lantern.obj", *lantern())
        return
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
