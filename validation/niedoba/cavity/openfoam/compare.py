#!/usr/bin/python3
"""Compares profiles_*.csv with Ghia et al. (1982) and with the independent solution; writes comparison.csv and prints it as a table.

Errors over the points of a line: rms of the difference over the lid's speed, the same over the rms of the reference, the largest. Ghia's
points are those corrected in validation/cavity; walls do not count. Profiles are interpolated by cubics through four points.
"""
import csv
import glob
import os

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
REFERENCE = os.path.join(HERE, "..", "..", "..", "cavity")


def rows(path):
    with open(path, encoding="ascii") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def ghia(component):
    """Reynolds number -> points and values."""
    found = {}
    for row in rows(os.path.join(REFERENCE, f"lid_driven_cavity_{component}.csv")):
        place = float(row["y" if component == "u" else "x"])
        if row[component + "_ghia_recommended"] and 0 < place < 1:
            found.setdefault(float(row["Re"]), []).append((place, float(row[component + "_ghia_recommended"])))
    return {reynolds: numpy.array(points).T for reynolds, points in found.items()}


def own(component):
    found = {}
    for row in rows(os.path.join(REFERENCE, "lid_driven_cavity_own_profiles.csv")):
        if 0 < float(row["s"]) < 1:
            found.setdefault(float(row["Re"]), []).append((float(row["s"]), float(row[component])))
    return {reynolds: numpy.array(points).T for reynolds, points in found.items()}


def cubic(x, y, at):
    """Through the four points around each place."""
    values = []
    for place in at:
        first = min(max(int(numpy.searchsorted(x, place)) - 2, 0), len(x) - 4)
        near = range(first, first + 4)
        values.append(sum(y[i] * numpy.prod([(place - x[j]) / (x[i] - x[j]) for j in near if j != i]) for i in near))
    return numpy.array(values)


def main():
    lines = []
    for path in sorted(glob.glob(os.path.join(HERE, "profiles_*.csv")), key=lambda name: int(name.rsplit("_", 1)[1][:-4])):
        cells = int(path.rsplit("_", 1)[1][:-4])
        table = rows(path)
        for name, reference in (("Ghia", ghia), ("independent", own)):
            for component in ("u", "v"):
                known = reference(component)
                for reynolds in sorted({float(row["Re"]) for row in table}):
                    line = [row for row in table if float(row["Re"]) == reynolds]
                    s, ours = (numpy.array([float(row[key]) for row in line]) for key in ("s", component))
                    at, wanted = known[reynolds]
                    difference = cubic(s, ours, at) - wanted
                    rms = numpy.sqrt(numpy.mean(difference**2))
                    lines.append((cells, f"{reynolds:g}", name, component, f"{rms:.5f}", f"{rms / numpy.sqrt(numpy.mean(wanted**2)):.5f}",
                                  f"{numpy.max(numpy.abs(difference)):.5f}"))
    head = ("cells", "Re", "reference", "component", "L2", "L2_relative", "Linf")
    with open(os.path.join(HERE, "comparison.csv"), "w", encoding="ascii", newline="\n") as out:
        out.write("# compare.py: finite-volume profiles against references; L2 and Linf over the lid's speed\n" + ",".join(head) + "\n")
        out.writelines(",".join(map(str, line)) + "\n" for line in lines)
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for line in lines:
        print("| " + " | ".join(map(str, line)) + " |")


if __name__ == "__main__":
    main()
