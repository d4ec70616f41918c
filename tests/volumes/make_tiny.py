#!/usr/bin/python3
"""Writes the tiny_*.vdb volumes, and their ground truth into truth-small.json.

Needs Debian's python3-openvdb (OpenVDB's own C++, module pyopenvdb) and NumPy.
truth-small.json already holds the entries of the other files.
"""
import json
import math
import pathlib

import numpy
import pyopenvdb as vdb

HERE = pathlib.Path(__file__).parent


def ball(radius):
    """Values that differ in every voxel, so that a swap of axes or neighbours shows."""
    n = 2 * radius + 1
    x, y, z = numpy.mgrid[-radius : radius + 1, -radius : radius + 1, -radius : radius + 1]
    inside = x * x + y * y + z * z <= radius * radius
    ramp = numpy.arange(n**3, dtype=numpy.float32).reshape(n, n, n) / n**3 + 0.125
    return numpy.where(inside, ramp, 0).astype(numpy.float32)


def float_grid(array, origin=(0, 0, 0)):
    grid = vdb.FloatGrid()
    grid.copyFromArray(array, ijk=origin)
    grid.name, grid.gridClass = "density", "fog volume"
    return grid


def affine():
    grid = float_grid(ball(5), (3, 4, 5))
    a = math.radians(30)
    rows = [[2 * math.cos(a), 2 * math.sin(a), 0, 0], [-math.sin(a), math.cos(a), 0, 0], [0, 0, 3, 0], [7, 8, 9, 1]]
    grid.transform = vdb.createLinearTransform(rows)
    return [grid]


def vector():
    array = numpy.stack([ball(4), 2 * ball(4), -ball(4)], axis=-1)
    grid = vdb.Vec3SGrid(background=(0.5, 0, 0))
    grid.copyFromArray(array)
    grid.name, grid.saveFloatAsHalf = "velocity", True
    return [grid]


def root_tile():
    grid = float_grid(ball(3), (-20, -20, -20))
    grid.fill((0, 0, 0), (4095, 4095, 4095), 0.5)
    grid.fill((-4096, 0, 0), (-4096 + 127, 127, 127), 0.25)
    return [grid]


def instance():
    grid = float_grid(ball(4))
    shared = grid.copy()  # shares the tree, and is saved as an instance
    shared.name = "temperature"
    shared.transform = vdb.createLinearTransform(voxelSize=0.25)
    return [grid, shared]


def level_set():
    grid = vdb.createLevelSetSphere(radius=6, center=(10, 10, 10), voxelSize=0.5, halfWidth=2)
    grid.name, grid.saveFloatAsHalf = "surface", True
    return [grid]


def truth(grid, compression):
    low, high = grid.evalActiveVoxelBoundingBox()
    values = [(item.value, item.count) for item in grid.iterOnValues()]
    # A vector counts as the sum of its components.
    sums = [(sum(v) if isinstance(v, tuple) else v, n) for v, n in values]
    background = grid.background
    vector = isinstance(background, tuple)
    return {
        "name": grid.name,
        "type": f"Tree_{'vec3s' if vector else 'float'}_5_4_3",
        "class": grid.gridClass,
        "half": grid.saveFloatAsHalf,
        "map": grid.transform.typeName,
        "i2w0": grid.transform.indexToWorld((0, 0, 0)),
        "i2w123": grid.transform.indexToWorld((1, 2, 3)),
        "fcomp": compression,
        "active": grid.activeVoxelCount(),
        "min": min(v for v, _ in sums),
        "max": max(v for v, _ in sums),
        "mean": sum(v * n for v, n in sums) / sum(n for _, n in sums),
        "bbox": [*low, *high],
        "background": "[" + ", ".join(f"{v:g}" for v in background) + "]" if vector else f"{background:g}",
    }


def main():
    target = HERE / "truth-small.json"
    files = [f for f in json.loads(target.read_text()) if not f["file"].startswith("tiny_")]
    for make in (affine, vector, root_tile, instance, level_set):
        name = f"tiny_{make.__name__}.vdb"
        vdb.write(str(HERE / name), grids=make())
        # Read back: half floats are rounded when they are written.
        grids = [vdb.read(str(HERE / name), g.name) for g in vdb.readAllGridMetadata(str(HERE / name))]
        files.append({"file": name, "grids": [truth(g, "blosc + active values") for g in grids]})
    target.write_text(json.dumps(files, indent=1) + "\n")


main()
