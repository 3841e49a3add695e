#!/usr/bin/python3
"""Draws Niedoba's figures 3.5 to 3.8, velocity, density, pressure and energy along the tube at 0.2 s, of the runs that
`undine verify shock_tube` left beside the exact solution: draw.py UNDINE out/verify/shock_tube PICTURE.png

Needs Debian's python3-h5py, python3-numpy and python3-matplotlib.
"""
import glob
import os
import subprocess
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

EXACT = ["--set", "rho_left=1", "--set", "p_left=1", "--set", "rho_right=0.25", "--set", "p_right=0.1795", "--set", "gamma=1.4"]
FIELDS = {"velocity [m/s]": "v", "density [kg/m^3]": "rho", "pressure [Pa]": "p", "energy [J/kg]": "e"}


def exact(undine, time):
    words = [undine, "exact", "riemann", *EXACT, "--from", "-0.4", "--to", "0.4", "--points", "801", "--time", str(time)]
    lines = subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    return dict(zip(rows[0], np.array(rows[1:], float).T))


def last_snapshot(run):
    with h5py.File(sorted(glob.glob(os.path.join(run, "particles_*.vtkhdf")))[-1]) as file:
        data = file["VTKHDF/PointData"]
        fluid = data["group"][:] == 0
        state = {name: data[name][:][fluid] for name in ("v", "rho", "p", "e")}
        state["v"] = state["v"][:, 0]
        return float(file["VTKHDF/FieldData/TimeValue"][0]), file["VTKHDF/Points"][:, 0][fluid], state


def main(undine, folder, picture):
    figure, axes = plt.subplots(3, 4, figsize=(17, 10), sharex=True)
    names = {"virtual": "published, virtual particles", "ghost": "published, ghosts", "recommended": "recommended"}
    for row, (name, title) in zip(axes, names.items()):
        time, x, state = last_snapshot(os.path.join(folder, name))
        right = exact(undine, time)
        for axis, (label, field) in zip(row, FIELDS.items()):
            axis.plot(x, state[field], ".", color="tab:orange", ms=2, label="particles")
            axis.plot(right["x [m]"], right[label], "k", lw=0.8, label="exact")
            axis.set(title=f"{title}: {label}", xlabel="x [m]" if name == "recommended" else "")
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=70)


if __name__ == "__main__":
    main(*sys.argv[1:4])
