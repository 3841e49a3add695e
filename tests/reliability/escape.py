#!/usr/bin/python3
"""escape.py UNDINE: a drop flies out of the domain. on_escape = "stop" ends the run, "remove" takes it out, "reflect" sends it back: there, mirrored
at the domain's end, with its energy."""
import csv
import os
import sys
import tempfile

from common import record, require, undine

CASE = """# A drop flies to the right; the domain ends at x = 0.5 m.
dimensions = 2
spacing = "0.02 m"
expected_speed = "1 m/s"
[domain]
low = [-0.5, -0.5]
high = [0.5, 0.5]
on_escape = "{on_escape}"
[time]
end = "0.8 s"
[[fluid]]
shape = {{ type = "box", low = [-0.01, -0.01], high = [0.01, 0.01] }}
velocity = [1, 0]
[output]
snapshots = 0
energies = "0.8 s"
report = false
[[gauge]]
name = "centre"
type = "centre_of_mass"
every = "0.8 s"
"""


def last_row(path):
    with open(path, encoding="ascii") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return dict(zip((name.split(" [")[0] for name in rows[0]), map(float, rows[-1])))


def run(program, folder, on_escape, expect):
    case, out = os.path.join(folder, "drop.toml"), os.path.join(folder, on_escape)
    with open(case, "w", encoding="utf-8") as file:
        file.write(CASE.format(on_escape=on_escape))
    return undine(program, "run", case, "--out", out, "--quiet", expect=expect), out


def main(program, folder):
    done, out = run(program, folder, "stop", 3)
    require(record(out)["diagnosis"]["cause"] == "domain_too_small" and abs(record(out)["time"] - 0.5) < 0.02,
            f"stop: at {record(out)['time']:.4f} s, {record(out)['diagnosis']['cause']}")
    _, out = run(program, folder, "remove", 0)
    require(record(out)["particles"]["fluid"] == 0, "remove: nothing is left")
    _, out = run(program, folder, "reflect", 0)
    end, energy = last_row(os.path.join(out, "gauges", "centre.csv")), last_row(os.path.join(out, "energies.csv"))
    # The particle, alone, starts at 0 and is at t after t seconds, mirrored at 0.5: 1 - t.
    require(abs(end["x"] - (1 - end["time"])) < 1e-9 and abs(end["y"]) < 1e-12, f"reflect: x = {end['x']:.6f} m at t = {end['time']:.6f} s, mirrored at 0.5 m")
    kinetic = 0.5 * 1000 * 0.02**2
    require(abs(energy["kinetic"] - kinetic) < 1e-12 * kinetic and abs(energy["residual"]) < 1e-12 * kinetic,
            f"reflect: kinetic energy {energy['kinetic']:.6g} J, residual {energy['residual']:.1e} J")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="undine_escape_") as place:
        main(sys.argv[1], place)
