#!/usr/bin/python3
"""Acceptance of viscous flow in the preset `confined`: viscous.py CHECK UNDINE CASES. Each check prints its criteria and numbers; exit 1 on failure."""
import math
import os
import sys
import tempfile

from acceptance import newest_checkpoint, read_csv, require, undine

QUIET = ["--set", "output.snapshots=0", "--set", "output.report=false", "--set", "output.checkpoints=0"]


def run(program, case, folder, *words):
    undine(program, "run", case, "--threads", "1", "--out", folder, *QUIET, *words)
    return folder


def error(folder, gauge, column, row=-1):
    return read_csv(os.path.join(folder, "gauges", gauge + ".csv"))[row][column]


def channel(program, cases, folder):
    """Poiseuille and Couette flow at t nu/L^2 = 0.22 with 10 and 20 particles across: errors and their order."""
    for name in ["poiseuille", "couette"]:
        case = os.path.join(cases, "viscous", name + ".toml")
        errors = []
        for spacing in ["100 um", "50 um"]:
            out = run(program, case, os.path.join(folder, name + spacing.split()[0]), "--set", f"spacing={spacing}", "--set", "time.end=0.23 s")
            errors.append(error(out, "flow", "vx_L2_relative"))
        order = math.log2(errors[0] / errors[1])
        require(errors[1] <= 0.01, f"{name}: relative L2 error at most 1 % with 20 across: {100 * errors[1]:.2f} %")
        require(order >= 1.7, f"{name}: second order within 0.3: {order:.2f}")


def vortices(program, cases, folder):
    """Taylor-Green vortices to 0.5 s with 50 particles across, where plain schemes err by 6 %; the audit closes."""
    out = run(program, os.path.join(cases, "viscous", "taylor_green.toml"), folder, "--set", "time.end=0.5 s")
    found = error(out, "flow", "v_L2_relative")
    require(found <= 0.01, f"relative L2 error of the velocity at most 1 %: {100 * found:.2f} %")
    energies = read_csv(os.path.join(out, "energies.csv"))
    residual = max(abs(row["residual"]) for row in energies) / energies[0]["kinetic"]
    require(residual <= 0.01, f"residual of the audit at most 1 % of the kinetic energy at the start: {residual:.2g}")


def cavity_resume(program, cases, folder):
    """The cavity stopped and gone on with has the bits of an unbroken run; profiles are written."""
    case = os.path.join(cases, "viscous", "cavity.toml")
    whole, halves = os.path.join(folder, "whole"), os.path.join(folder, "halves")
    run(program, case, whole, "--set", "time.end=0.2 s")
    run(program, case, halves, "--set", "time.end=0.1 s")
    run(program, case, halves, "--set", "time.end=0.2 s", "--resume")
    sums = {undine(program, "checksum", newest_checkpoint(out)).strip() for out in (whole, halves)}
    require(len(sums) == 1, f"both end with the hash {sums}")
    for gauge in ["u_ghia", "v_ghia", "u_grid", "v_grid"]:
        require(math.isfinite(error(whole, gauge, "L2_relative")), f"{gauge} has a number")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        globals()[sys.argv[1]](sys.argv[2], sys.argv[3], scratch)
