#!/usr/bin/python3
"""Lid-driven cavity by finite volumes: OpenFOAM's icoFoam on case/, both centre lines written to profiles.csv.

    run.py [--cells 128] [--step 0.005] [--out FOLDER] [RE...]

Needs Debian's package openfoam (1912); neither the build nor the tests do. The folder of the run (a temporary one unless --out names it)
keeps the log of each Reynolds number.
"""
import argparse
import os
import re
import shutil
import subprocess
import tempfile
import time

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
ENVIRONMENT = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}


def foam(program, folder):
    with open(os.path.join(folder, program + ".log"), "w", encoding="ascii") as log:
        subprocess.run([program], cwd=folder, env=ENVIRONMENT, stdout=log, stderr=subprocess.STDOUT, check=True)


def version(folder):
    with open(os.path.join(folder, "icoFoam.log"), encoding="ascii", errors="replace") as log:
        return re.search(r"OPENFOAM=(\d+)", log.read()).group(1)


def last_time(folder):
    return max((name for name in os.listdir(folder) if re.fullmatch(r"[0-9.]+(e[-+]?\d+)?", name)), key=float)


def velocities(path, cells):
    """u and v of the cells as arrays [row from below, column from the left]."""
    with open(path, encoding="ascii") as lines:
        text = lines.read()
    inside = text.split("internalField")[1].split("(", 1)[1].split("\n)", 1)[0]
    values = numpy.array([line.strip("() ").split() for line in inside.strip().splitlines()], dtype=float)
    return values[:, 0].reshape(cells, cells), values[:, 1].reshape(cells, cells)


def profiles(u, v, cells):
    """s, u(0.5, s), v(s, 0.5): the centre lines are faces, where the mean of the two cells is second-order; walls are given."""
    half = cells // 2
    s = (numpy.arange(cells) + 0.5) / cells
    across = 0.5 * (u[:, half - 1] + u[:, half])
    along = 0.5 * (v[half - 1, :] + v[half, :])
    return numpy.concatenate([[0], s, [1]]), numpy.concatenate([[0], across, [1]]), numpy.concatenate([[0], along, [0]])


def run(reynolds, arguments, folder):
    shutil.copytree(os.path.join(HERE, "case"), folder)
    with open(os.path.join(folder, "parameters"), "w", encoding="ascii") as out:
        out.write(f"viscosity {1 / reynolds};\ncells {arguments.cells};\nstep {arguments.step};\nlargest_time 150;\n")
    foam("blockMesh", folder)
    start = time.time()
    foam("icoFoam", folder)
    seconds = time.time() - start
    with open(os.path.join(folder, "icoFoam.log"), encoding="ascii", errors="replace") as log:
        courant = [float(value) for value in re.findall(r"Courant Number mean: \S+ max: (\S+)", log.read())]
    end = last_time(folder)
    u, v = velocities(os.path.join(folder, end, "U"), arguments.cells)
    return {"end": float(end), "seconds": seconds, "courant": max(courant), "steps": len(courant), "lines": profiles(u, v, arguments.cells)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=128)
    parser.add_argument("--step", type=float, default=0.005)
    parser.add_argument("--out")
    parser.add_argument("reynolds", type=float, nargs="*", default=[100, 400, 1000])
    arguments = parser.parse_args()
    scratch = arguments.out or tempfile.mkdtemp()
    found = {reynolds: run(reynolds, arguments, os.path.join(scratch, f"{reynolds:g}")) for reynolds in arguments.reynolds}
    first = os.path.join(scratch, f"{arguments.reynolds[0]:g}")
    with open(os.path.join(HERE, f"profiles_{arguments.cells}.csv"), "w", encoding="ascii") as out:
        out.write("# Lid-driven square cavity by finite volumes: u on x = 0.5 over s = y, v on y = 0.5 over s = x; unit side and lid speed.\n")
        out.write(f"# OpenFOAM {version(first)} (Debian), icoFoam, {arguments.cells} x {arguments.cells} cells, step {arguments.step}; run.py in this folder.\n")
        for reynolds, result in found.items():
            out.write(f"# Re {reynolds:g}: steady after {result['end']:g} time units, {result['steps']} steps, {result['seconds']:.0f} s, "
                      f"largest Courant number {result['courant']:.2f}.\n")
        out.write("Re,s,u,v\n")
        for reynolds, result in found.items():
            for s, u, v in zip(*result["lines"]):
                out.write(f"{reynolds:g},{s:.7f},{u:.6f},{v:.6f}\n")


if __name__ == "__main__":
    main()
