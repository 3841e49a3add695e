#!/usr/bin/env python3
"""Runs `undine bench` on few particles and checks its JSON, and bench/compare on that and on damaged copies.

    bench_test.py UNDINE
"""

import json
import math
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COMPARE = os.path.join(ROOT, "bench", "compare")
failures = []


def check(good, message):
    print(f"{'ok' if good else 'not ok'} {message}")
    if not good:
        failures.append(message)


def run(words, folder):
    return subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, check=False)


def compare(folder, first, second):
    return run([sys.executable, COMPARE, first, second], folder)


def check_rows(rows):
    """The figures of a row, and that they fit each other."""
    check(sorted({(row["name"], row["state"]) for row in rows}) ==
          sorted((name, state) for name in ("force pass", "step", "step leapfrog") for state in ("block", "splash")),
          "every row of both states")
    for row in rows:
        what = f"{row['name']}, {row['state']}"
        check(row["threads"] == 1 and row["precision"] == "mixed" and 800 <= row["particles"] <= 1200, f"{what}: labels")
        check(20 < row["neighbours"] <= row["neighbours_bulk"] + 10 < 100, f"{what}: neighbours")
        pairs = row["particle_steps_per_s"] * row["neighbours"]
        check(abs(row["pairs_per_s"] / pairs - 1) < 1e-6, f"{what}: pairs")
        check(row["particle_steps_per_s_slowest"] <= row["particle_steps_per_s"] <= row["particle_steps_per_s_fastest"],
              f"{what}: median between slowest and fastest")
        seconds = row["seconds_per_step"]
        parts = sum(seconds[part] for part in ("sort", "list", "sweep", "update"))
        check(abs(parts / seconds["total"] - 1) < 1e-6, f"{what}: phases add up")
        check(row["builds_per_step"] == 0 if row["name"] == "force pass" else 0.1 <= row["builds_per_step"] <= 0.3,
              f"{what}: list builds")
    share = [row["peak_share"] for row in rows if row["name"] == "force pass"]
    check(all(0 < value < 1 for value in share), "share of the peak")


def check_compare(folder, rows):
    def write(name, content):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(content if isinstance(content, str) else json.dumps(content))

    write("a.json", rows)
    done = compare(folder, "a.json", "a.json")
    check(done.returncode == 0 and f"{len(rows)} rows compared, 0 differ" in done.stdout, "a file equals itself")

    changed = [dict(row) for row in rows[:-1]]
    changed[0]["particle_steps_per_s"] *= 0.9
    write("b.json", changed)
    done = compare(folder, "a.json", "b.json")
    check(done.returncode == 0 and done.stdout.count("SLOWER") == 1 and " 0.900" in done.stdout, "a slower row is marked")
    check("only in A: " + rows[-1]["name"] in done.stdout, "a missing row is named")

    for name, content, message in (("broken.json", "[{]", "broken.json:1:3: not JSON"),
                                   ("object.json", "{}", "object.json: not an array"),
                                   ("number.json", "[1]", "number.json: row 1 is not an object"),
                                   ("bare.json", [{"name": "step"}], "bare.json: row 1 has no 'precision'"),
                                   ("rate.json", [dict(rows[0], particle_steps_per_s=None)], "row 1 has no number"),
                                   ("twice.json", [rows[0], rows[0]], "row 2 has the labels of an earlier one"),
                                   ("missing.json", None, "missing.json: cannot be read")):
        if content is not None:
            write(name, content)
        done = compare(folder, "a.json", name)
        check(done.returncode == 2 and message in done.stderr and "Traceback" not in done.stderr, f"says: {message}")


def check_search(program, folder):
    """`undine bench search`: every search of the list, the same pairs, exponents that belong to the figures."""
    names = [entry["name"] for entry in json.loads(run([program, "list", "searches", "--json"], folder).stdout)]
    done = run([program, "bench", "search", "--json", "--particles", "4000,500,2000", "--repeats", "3"], folder)
    check(done.returncode == 0, "bench search --json runs")
    rows = json.loads(done.stdout)
    check({(row["name"], row["set"]) for row in rows} == {(name, place) for name in names for place in ("uniform", "clustered")},
          "every search on both sets")
    check(len(rows) == 6 * len(names), "three sizes each")
    for key in {(row["set"], row["particles"]) for row in rows}:
        found = {row["neighbours"] for row in rows if (row["set"], row["particles"]) == key}
        check(len(found) == 1 and 20 < min(found) < 80, f"{key}: every search finds {found} neighbours")
    for name, place in {(row["name"], row["set"]) for row in rows}:
        mine = sorted((row for row in rows if (row["name"], row["set"]) == (name, place)), key=lambda row: row["particles"])
        good = all(row["build_s"] >= 0 and row["query_s"] > 0 and row["bytes"] >= 0 and row["threads"] == 1 for row in mine)
        for column, exponent in (("build_s", "exponent_build"), ("query_s", "exponent_query"), ("bytes", "exponent_bytes")):
            fits = [row[exponent] for row in mine]
            if all(row[column] > 0 for row in mine):
                good = good and len(set(fits)) == 1 and abs(fits[0] - slope(mine, column)) < 1e-6
            else:
                good = good and fits == [None] * 3
        check(good, f"{name}, {place}: figures and fits")
    check(all(row["bytes"] > 20 * row["particles"] for row in rows if row["name"] != "all_pairs"), "memory of all but all_pairs")
    done = run([program, "bench", "search", "--quick", "--search", "octree,cell_grid", "--set", "clustered"], folder)
    check(done.returncode == 0 and "exponents of growth" in done.stdout and "uniform" not in done.stdout, "its table")
    for words in (["--search", "oktree"], ["--set", "clumped"], ["--particles", "0"]):
        done = run([program, "bench", "search"] + words, folder)
        check(done.returncode == 2 and words[0] in done.stderr, f"{' '.join(words)} is refused")


def slope(rows, column):
    """Of log column over log particles, by least squares."""
    x = [math.log(row["particles"]) for row in rows]
    y = [math.log(row[column]) for row in rows]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def main(program):
    with tempfile.TemporaryDirectory(prefix="undine_bench_") as folder:
        few = ["--particles", "1000", "--neighbours", "74", "--threads", "1", "--precision", "mixed", "--repeats", "1"]
        done = run([program, "bench", "--json"] + few, folder)
        check(done.returncode == 0, "bench --json runs")
        check(os.listdir(folder) == [], "and leaves nothing behind")
        rows = json.loads(done.stdout)
        check_rows(rows)
        check_compare(folder, rows)
        done = run([program, "bench", "--state", "block"] + few, folder)
        check(done.returncode == 0 and "step leapfrog" in done.stdout, "the table")
        done = run([program, "bench", "--state", "blok"], folder)
        check(done.returncode == 2 and "block" in done.stderr, "an unknown state is refused")
        check_search(program, folder)
    print(f"{len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1])))
