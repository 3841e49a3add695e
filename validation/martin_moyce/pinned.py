#!/usr/bin/python3
"""The front of runs against Martin & Moyce (1952): as it stands, with the best shift in time, and with both clocks set to T = 0.80 at 1.44 widths,
where all known runs of the record have been set: pinned.py WIDTH_IN_M RUN_FOLDER..."""
import csv
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PIN_TIME, PIN_FRONT, LAST = 0.80, 1.44, 3.0


def columns(path):
    with open(path, encoding="ascii") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return [(float(row[0]), float(row[1])) for row in rows[1:]]


def at(line, x):
    """The line through the points, at x; None outside."""
    for (x0, y0), (x1, y1) in zip(line, line[1:]):
        if x0 <= x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0) if x1 > x0 else y1
    return None


def first_at(line, y):
    return next(x0 + (x1 - x0) * (y - y0) / (y1 - y0) for (x0, y0), (x1, y1) in zip(line, line[1:]) if y0 <= y < y1)


def deviation(line, record, shift):
    """RMS over the range of the record, our clock put back by the shift."""
    ours = [(at(line, time - shift), front) for time, front in record]
    squares = [(value - front) ** 2 for value, front in ours if value is not None]
    fronts = [front for _, front in record]
    return math.sqrt(sum(squares) / len(squares)) / (max(fronts) - min(fronts))


def main(width, runs):
    record = [point for point in columns(os.path.join(HERE, "front_square_column.csv")) if point[0] <= LAST]
    print("run | as it stands | best shift | with it | pinned shift | with it")
    for run in runs:
        scale = math.sqrt(9.81 / width)
        line = [(time * scale, front / width) for time, front in columns(os.path.join(run, "gauges", "front.csv"))]
        best = min((deviation(line, record, k * 0.005), k * 0.005) for k in range(-60, 61))
        pin = PIN_TIME - first_at(line, PIN_FRONT)
        print(f"{run} | {deviation(line, record, 0):.4f} | {best[1]:.3f} | {best[0]:.4f} | {pin:.3f} | {deviation(line, record, pin):.4f}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(float(sys.argv[1]), sys.argv[2:])
