"""A folder as a run leaves it, with snapshots of any number of particles: a block of water with a dent, nothing computed.

    synthetic_run.py FOLDER PARTICLES
"""

import json
import os
import shutil
import sys

import h5py
import numpy


def write(folder, particles, times=1):
    """Writes run.json, the list of snapshots and snapshots that differ by a shift; replaces what is in the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    random = numpy.random.default_rng(1)
    side = round((2 * particles) ** (1 / 3) + 0.5)
    places = numpy.arange(particles)
    x = numpy.stack([places // (side * side), places // side % side, places % side], axis=1) / side
    x += random.uniform(-0.2, 0.2, x.shape) / side
    depth = 1 - x[:, 2]
    velocity = numpy.stack([x[:, 1] - 0.5, 0.25 - x[:, 0], 0 * depth], axis=1)
    chunk = min(particles, 65536)
    ids = random.permutation(particles).astype("i8")
    files = [{"name": f"particles_{k:06}.vtkhdf", "time": 0.1 * k} for k in range(times)]
    for name, time in ((each["name"], each["time"]) for each in files):
        with h5py.File(os.path.join(folder, name), "w", libver=("v110", "v110")) as file:
            grid = file.create_group("VTKHDF", track_order=True)
            grid.attrs["Version"] = numpy.array([1, 0], "i8")
            for key, text in (("Type", "UnstructuredGrid"), ("position", "x")):
                grid.attrs.create(key, numpy.bytes_(text), dtype=f"S{len(text)}")
            grid.attrs["time"], grid.attrs["step"], grid.attrs["dimensions"] = time, numpy.int64(0), numpy.int64(3)
            for key in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
                grid[key] = numpy.array([particles], "i8")
            packed = {"compression": 1, "shuffle": True}
            grid.create_dataset("Points", data=x + [time, 0, 0], chunks=(chunk, 3), **packed)
            data = grid.create_group("PointData")
            for key, unit, values in (("v", "m/s", velocity), ("rho", "kg/m^3", 1000 + depth), ("p", "Pa", 9810 * depth), ("m", "kg", numpy.full(particles, 1000 / side**3))):
                field = data.create_dataset(key, data=values.astype("f4"), chunks=(chunk, 3)[:values.ndim], **packed)
                field.attrs.create("unit", numpy.bytes_(unit), dtype=f"S{len(unit)}")
            data.create_dataset("id", data=ids, chunks=(chunk,), **packed)
            data.create_dataset("group", data=numpy.zeros(particles, "i4"), chunks=(chunk,), **packed)
    with open(os.path.join(folder, "particles.vtkhdf.series"), "w", encoding="utf-8") as file:
        json.dump({"file-series-version": "1.0", "files": files}, file)
    with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
        json.dump({"status": "finished", "case": "block.toml", "resolved": {"spacing": str(1 / side), "gravity": "[0, 0, -9.81]"},
                   "particles": {"fluid": particles, "wall": 0}, "time": 0.0, "steps": 0}, file)


if __name__ == "__main__":
    write(sys.argv[1], int(sys.argv[2]))
