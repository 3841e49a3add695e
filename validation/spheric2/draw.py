#!/usr/bin/python3
"""Draws the gauges of a SPHERIC 2 run beside the experiment: draw.py RUN_FOLDER GAUGES.png

Needs Debian's python3-numpy and python3-matplotlib.
"""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def table(path):
    with open(path, encoding="ascii") as lines:
        rows = [line for line in lines if not line.startswith("#")]
    return np.genfromtxt(rows, delimiter=",", names=True)


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
    gauges(sys.argv[1], sys.argv[2])
