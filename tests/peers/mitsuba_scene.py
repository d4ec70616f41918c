"""One of assets/oracle's scenes (S2, S3, S4) for Mitsuba 3, read from Majorant's own scene file."""
import tomllib
from pathlib import Path

import numpy as np


def normalised(v):
    return v / np.linalg.norm(v)


def looking(origin, target, up):
    """Columns right, up, forward and place of something that looks from `origin` to `target`."""
    forward = normalised(np.subtract(target, origin))
    right = normalised(np.cross(up, forward))
    return np.column_stack([right, np.cross(forward, right), forward, origin])


def rgb(value):
    return list(value["rgb"]) if isinstance(value, dict) else [float(value)] * 3


def to_mitsuba(folder, width, height):
    """The scene as a dictionary for `mi.load_dict`, under `volpathmis` without roulette (with it, it is biased)."""
    import mitsuba as mi

    folder = Path(folder)
    doc = tomllib.loads((folder / "scene.toml").read_text())
    medium, camera = doc["medium"], doc["camera"]
    transform = lambda columns: mi.ScalarTransform4f(mi.ScalarMatrix4f(np.vstack([columns, [0, 0, 0, 1]]).tolist()))

    density = np.load(folder / medium["density"]["file"]).astype(np.float32)
    # The placement maps the unit cube, whose longest side is the grid's longest axis.
    extent = np.array(density.shape[::-1]) / max(density.shape)
    place = medium["placement"]
    low = np.array(place["translate"], float)
    size = np.array(place["scale"], float) * extent
    box_from_unit = np.column_stack([np.diag(size), low])

    extinction = np.array(rgb(medium["extinction"]), np.float32) * medium.get("scale", 1.0)
    chromatic = bool(np.ptp(extinction) > 0)
    grid = density[..., None] * (extinction if chromatic else extinction[:1])
    phase = medium["phase"]
    hg = {"type": "hg", "g": phase["g"]} if phase["kind"] == "henyey-greenstein" else {"type": "isotropic"}
    volume = {
        "type": "gridvolume",
        "grid": mi.VolumeGrid(np.ascontiguousarray(grid)),
        "to_world": transform(box_from_unit),
        "filter_type": "trilinear",
        "wrap_mode": "clamp",
    }
    # Mitsuba's cube spans -1 to 1.
    box_from_cube = np.column_stack([np.diag(size / 2), low + size / 2])
    scene = {
        "type": "scene",
        "integrator": {"type": "volpathmis", "max_depth": -1, "rr_depth": 10**6, "hide_emitters": False},
        "sensor": {
            "type": "perspective",
            "fov": camera["fov_deg"],
            "fov_axis": "x",
            "near_clip": 0.01,
            "to_world": mi.ScalarTransform4f().look_at(camera["origin"], camera["target"], camera["up"]),
            "film": {
                "type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
                "pixel_format": "rgb", "component_format": "float32",
            },
            "sampler": {"type": "independent", "sample_count": 16},
        },
        "box": {
            "type": "cube", "to_world": transform(box_from_cube), "bsdf": {"type": "null"},
            "interior": {
                "type": "heterogeneous", "sigma_t": volume, "albedo": float(medium["albedo"]), "phase": hg,
                "has_spectral_extinction": chromatic,
            },
        },
    }
    for i, light in enumerate(doc["lights"]):
        radiance = {"type": "rgb", "value": rgb(light["radiance"])}
        if light["kind"] == "environment":
            scene[f"light{i}"] = {"type": "constant", "radiance": radiance}
        else:
            columns = looking(light["center"], light["target"], light["up"])
            columns[:, 0] *= light["size"][0] / 2
            columns[:, 1] *= light["size"][1] / 2
            scene[f"light{i}"] = {
                "type": "rectangle", "to_world": transform(columns), "emitter": {"type": "area", "radiance": radiance},
                "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}},
            }
    return scene
