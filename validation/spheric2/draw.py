#!/usr/bin/python3
"""Draws snapshots of a SPHERIC 2 run, and its gauges beside the experiment: draw.py RUN_FOLDER PICTURE.png GAUGES.png

Needs Debian's python3-h5py, python3-numpy and python3-matplotlib.
"""
import os
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
OBSTACLE = ((0.6635, 0.8245), (0.295, 0.698), (0.0, 0.161))


def table(path):
    with open(path, encoding="ascii") as lines:
        rows = [line for line in lines if not line.startswith("#")]
    return np.genfromtxt(rows, delimiter=",", names=True)


def snapshots(run, picture):
    figure = plt.figure(figsize=(13, 7))
    for k, index in enumerate((8, 12, 18, 30)):
        with h5py.File(os.path.join(run, f"particles_{index:06}.vtkhdf")) as file:
            data = file["VTKHDF"]
            fluid = data["PointData"]["group"][:] == 0
            x = data["Points"][:][fluid]
            speed = np.linalg.norm(data["PointData"]["v"][:][fluid], axis=1)
        axes = figure.add_subplot(2, 2, k + 1, projection="3d", computed_zorder=False)
        order = np.argsort(x[:, 1])[::-1]
        shown = axes.scatter(*x[order].T, c=speed[order], s=1.6, cmap="viridis", vmin=0, vmax=3, linewidths=0, clip_on=False)
        (x0, x1), (y0, y1), (z0, z1) = OBSTACLE
        axes.bar3d(x0, y0, z0, x1 - x0, y1 - y0, z1 - z0, color="0.55", alpha=0.5, zorder=5, clip_on=False)
        axes.set(xlim=(0, 3.22), ylim=(0, 1), zlim=(0, 1), xlabel="x [m]", yticks=(), zticks=())
        axes.text2D(0.5, 0.86, f"t = {0.05 * index:.2f} s", transform=axes.transAxes, ha="center", fontsize=13)
        axes.set_box_aspect((3.22, 1, 1), zoom=1.6)
        axes.view_init(elev=22, azim=-72)
    figure.subplots_adjust(left=0.01, right=0.9, bottom=0.02, top=0.98, wspace=0.05, hspace=0.0)
    figure.colorbar(shown, cax=figure.add_axes((0.93, 0.25, 0.012, 0.5)), label="speed [m/s]")
    figure.savefig(picture, dpi=90)


def gauges(run, picture):
    reference = table(os.path.join(HERE, "kleefsman_0-7s_mean4.csv"))
    figure, axes = plt.subplots(2, 4, figsize=(17, 7))
    for axis, name in zip(axes.flat, ("H1", "H2", "H3", "H4", "P1", "P3", "P5", "P7")):
        ours = table(os.path.join(run, "gauges", name + ".csv"))
        time, value = (ours[column] for column in ours.dtype.names[:2])
        shown = reference["t_s"] <= time[-1]
        axis.plot(reference["t_s"][shown], reference[name + ("_m" if name[0] == "H" else "_Pa")][shown], "k", lw=1, label="experiment")
        axis.plot(time, value, "tab:orange", lw=0.8, label="undine")
        axis.set(title=name, xlabel="t [s]", ylabel="height [m]" if name[0] == "H" else "pressure [Pa]")
        if name[0] == "P":
            axis.set_ylim(-2000, 14000 if name in ("P1", "P3") else 4000)
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=80)


if __name__ == "__main__":
    snapshots(sys.argv[1], sys.argv[2])
    gauges(sys.argv[1], sys.argv[3])
