#!/usr/bin/env python3
"""Runs `undine approximate` on fields that are known, and checks the files that it writes.

    approximate_test.py UNDINE
"""

import csv
import math
import os
import subprocess
import sys
import tempfile

failures = []


def check(good, message):
    print(f"{'ok' if good else 'not ok'} {message}")
    if not good:
        failures.append(message)


def run(program, folder, *words):
    return subprocess.run([program, "approximate", *words], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=120, check=False)


def read(folder, name):
    """Rows of a CSV file as dictionaries of numbers."""
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def write_points(path):
    """21 x 21 points in the unit square, every other one moved, with u = 2 + x - 3 y + x y and p of degree 1."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("# a test\nx,y,u,p,rho,m\n")
        for i in range(441):
            x, y = i % 21 / 20 + 0.01 * (i % 2), i // 21 / 20
            file.write(f"{x},{y},{2 + x - 3 * y + x * y},{5 * x - y},1000,2.5\n")


def near(a, b, tolerance=1e-9):
    return abs(a - b) <= tolerance


def main(program):
    with tempfile.TemporaryDirectory(prefix="undine_approximate_") as folder:
        write_points(os.path.join(folder, "points.csv"))

        done = run(program, folder, "points.csv", "--method", "mls", "--order", "2", "--support", "16 cm", "--grid", "5,3",
                   "--low", "-0.02,0", "--high", "1,1", "--fields", "u,p", "--out", "mls.csv")
        check(done.returncode == 0 and "exact to degree 2" in done.stdout and "15 queries: 15 ok" in done.stdout, "mls runs")
        rows = read(folder, "mls.csv")
        check(len(rows) == 15 and rows[0]["x"] == -0.02 and near(rows[1]["x"], -0.02 + 1.02 / 4) and rows[5]["y"] == 0.5, "the grid")
        for row in rows:
            x, y = row["x"], row["y"]
            check(near(row["u"], 2 + x - 3 * y + x * y) and near(row["du_dx"], 1 + y, 1e-7)
                  and near(row["du_dy"], x - 3, 1e-7) and near(row["d2u_dxdy"], 1, 1e-5) and near(row["laplacian_u"], 0, 1e-5)
                  and near(row["p"], 5 * x - y) and row["status"] == 0 and row["condition"] >= 1 and row["neighbours"] > 5,
                  f"u and p at ({x:.3g}, {y:.3g})")

        done = run(program, folder, "points.csv", "--method", "rkpm", "--support", "0.16", "--out", "rkpm.vtkhdf")
        check(done.returncode == 0 and "grad_u" in done.stdout and "441 queries" in done.stdout, "rkpm from m and rho, vtkhdf")
        done = run(program, folder, "rkpm.vtkhdf", "--method", "finite_differences", "--support", "0.16", "--fields",
                   "p,grad_u", "--at", "points.csv", "--out", "second.csv")
        check(done.returncode == 0, "a snapshot as input")
        row = read(folder, "second.csv")[220]
        check(near(row["p"], 5 * row["x"] - row["y"]) and near(row["dp_dx"], 5, 1e-7) and near(row["dp_dy"], -1, 1e-7),
              "a field went there and back")
        check(near(row["dgrad_ux_dy"], 1, 0.1), "components of a vector have names")

        done = run(program, folder, "points.csv", "--support", "0.07", "--grid", "2,1", "--low", "0.5,0.5", "--high", "9,0.5",
                   "--fields", "p", "--out", "far.csv")
        rows = read(folder, "far.csv")
        check(done.returncode == 0 and "1 of 2 queries" in done.stderr, "a query out of reach is warned of")
        check(rows[0]["status"] == 0 and rows[1]["status"] == 1 and math.isnan(rows[1]["p"]), "and has its status")

        done = run(program, folder, "points.csv", "--method", "sph", "--volume", "25 cm^2", "--support", "0.16", "--fields", "p",
                   "--threads", "1", "--out", "one.csv")
        again = run(program, folder, "points.csv", "--method", "sph", "--support", "0.16", "--fields", "p", "--threads", "2",
                    "--out", "two.csv")
        one, two = read(folder, "one.csv"), read(folder, "two.csv")
        check(done.returncode == 0 and again.returncode == 0 and all(near(a["p"], b["p"], 1e-12) for a, b in zip(one, two)),
              "--volume in cm^2 is m/rho")

        done = run(program, folder, "--consistency", "--set", "method=mls", "--set", "order=1", "--out", "study")
        table = read(os.path.join(folder, "study", "gauges"), "polynomials.csv")
        check(done.returncode == 0 and {row["dimensions"] for row in table} == {1, 2, 3} and len(table) == 36, "the measurement")
        check(all(row["value"] < 1e-10 and row["promised_value"] == 1 for row in table if row["degree"] < 2),
              "mls of order 1 is exact for linear fields everywhere")
        check(all(row["value"] > 1e-5 and row["promised_value"] == 0 for row in table if row["degree"] == 2 and row["disordered"] == 1),
              "and not beyond")
        ends = read(os.path.join(folder, "study", "gauges"), "end_of_support.csv")
        check(len(ends) == 11 and near(ends[0]["one"], 1), "the end of a row")
        done = run(program, folder, "--consistency", "--set", "dimensions=1", "--set", "queries=2", "--threads", "1")
        check(done.returncode == 0 and "finite_differences" in done.stdout and "sph" in done.stdout, "all methods, printed")
    print(f"{len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1])))
