#!/usr/bin/python3
"""Acceptance checks of the program: acceptance.py CHECK UNDINE CASES. Each prints its criterion and its number; exit 1 on failure."""
import csv
import glob
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def undine(program, *words, expect=0):
    done = subprocess.run([program, *words], capture_output=True, text=True, timeout=float(os.environ.get("UNDINE_TEST_SECONDS", "500")), check=False)
    if done.returncode != expect:
        sys.exit(f"{' '.join(words)}: exit {done.returncode}, expected {expect}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def read_csv(path):
    with open(path, encoding="ascii") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    names = [name.split(" [")[0] for name in rows[0]]
    return [dict(zip(names, map(float, row))) for row in rows[1:]]


def newest_checkpoint(folder):
    return sorted(glob.glob(os.path.join(folder, "*.checkpoint")))[-1]


def require(holds, text):
    print(("ok      " if holds else "FAILED  ") + text)
    if not holds:
        sys.exit(1)


def smoke(program, case, folder):
    """A shipped case is read, takes steps, and writes what it promises."""
    undine(program, "run", case, "--out", folder, "--quiet", "--set", "time.end=1e-5 s")
    record = json.load(open(os.path.join(folder, "run.json"), encoding="utf-8"))
    require(record["status"] == "finished" and record["steps"] >= 1, f"{record['steps']} step(s) of {record['particles']} particles")
    require(len(read_csv(os.path.join(folder, "energies.csv"))) >= 1, "energies are written")


def dam(program, cases, folder, *words):
    undine(program, "run", os.path.join(cases, "dam_break_2d.toml"), "--out", folder, "--quiet", *words)
    return undine(program, "checksum", newest_checkpoint(folder)).strip()


def same_bits_threads(program, cases, folder):
    """The checksum over all fields is the same for 1, 2 and 4 threads, in mixed and in double, for two integrators."""
    for precision in ("mixed", "double"):
        for integrator in ("leapfrog", "predictor_corrector"):
            sums = [dam(program, cases, os.path.join(folder, f"{precision}{integrator}{n}"), "--threads", str(n), "--set", "time.end=0.05 s",
                        "--set", f"scheme.precision={precision}", "--set", f"time.integrator={integrator}") for n in (1, 2, 4)]
            require(len(set(sums)) == 1, f"{precision}, {integrator}: 1, 2, 4 threads give {sums}")


def same_bits_resume(program, cases, folder):
    """A run resumed at half time ends with the checksum of the uninterrupted run, and with the same series."""
    for integrator in ("leapfrog", "predictor_corrector", "euler"):
        whole, halves = os.path.join(folder, "whole" + integrator), os.path.join(folder, "halves" + integrator)
        words = ("--set", f"time.integrator={integrator}", "--set", "output.energies=2 ms")
        once = dam(program, cases, whole, "--set", "time.end=0.08 s", *words)
        dam(program, cases, halves, "--set", "time.end=0.04 s", *words)
        twice = dam(program, cases, halves, "--set", "time.end=0.08 s", "--resume", "--threads", "1", *words)
        require(once == twice, f"{integrator}: {once} uninterrupted, {twice} resumed at half time")
        series = [open(os.path.join(f, "energies.csv"), encoding="ascii").read() for f in (whole, halves)]
        require(series[0] == series[1], f"{integrator}: the energy series are the same")


def same_bits_searches(program, cases, folder):
    """The checksum over all fields is the same for every search of `undine list searches`, in 2-D and in 3-D."""
    names = [entry["name"] for entry in json.loads(undine(program, "list", "searches", "--json"))]
    require(len(names) > 2 and "cell_grid" in names, f"{len(names)} searches")
    for case, end in (("dam_break_2d", "30 ms"), ("still_water", "2 ms")):
        sums = {}
        for name in names:
            out = os.path.join(folder, case + name)
            undine(program, "run", os.path.join(cases, case + ".toml"), "--out", out, "--quiet", "--set", f"time.end={end}", "--set",
                   f"scheme.search.name={name}")
            record = json.load(open(os.path.join(out, "run.json"), encoding="utf-8"))
            sums[name] = (record["steps"], undine(program, "checksum", newest_checkpoint(out)).strip())
        require(sums["cell_grid"][0] > 0, f"{case}: {sums['cell_grid'][0]} steps")
        for name in names:
            require(sums[name] == sums["cell_grid"], f"{case}, {name}: {sums[name]}, as cell_grid")


def still_water(program, cases, folder):
    """RMS pressure error over the depth at most 5 % of the bottom pressure, nothing outside, audit residual at most 1 %."""
    undine(program, "run", os.path.join(cases, "still_water_2d.toml"), "--out", folder, "--quiet", "--set", "scheme.wall.treatment=combined",
           "--set", "time.end=1 s", "--set", "output.snapshots=0.1 s")
    import h5py  # Debian's python3-h5py
    import numpy
    worst, outside = 0.0, 0
    for name in sorted(glob.glob(os.path.join(folder, "*.vtkhdf"))):
        data = h5py.File(name)["VTKHDF"]
        fluid = data["PointData"]["group"][:] == 0
        x, p = data["Points"][:][fluid], data["PointData"]["p"][:][fluid]
        worst = max(worst, float(numpy.sqrt(numpy.mean((p - 1000 * 9.81 * (0.5 - x[:, 1])) ** 2))) / (1000 * 9.81 * 0.5))
        outside += int(numpy.sum((x[:, 0] < 0) | (x[:, 0] > 0.5) | (x[:, 1] < 0)))
    residual = max(abs(row["residual_relative"]) for row in read_csv(os.path.join(folder, "energies.csv")))
    require(worst <= 0.05, f"largest RMS pressure error {worst:.4f} of the bottom pressure (limit 0.05)")
    require(outside == 0, f"{outside} particles outside")
    require(residual <= 0.01, f"largest audit residual {residual:.2e} of the initial potential energy (limit 1e-2)")


def ghosts_same_bits(program, cases, folder):
    """With ghosts: the same checksum for 1, 2 and 4 threads, and for a run resumed at half time."""
    for treatment in ("ghost_free_slip", "ghost_no_slip"):
        words = ("--set", f"scheme.wall.treatment={treatment}", "--set", "spacing=0.04 m")
        sums = [dam(program, cases, os.path.join(folder, f"{treatment}{n}"), "--threads", str(n), "--set", "time.end=0.08 s", *words) for n in (1, 2, 4)]
        halves = os.path.join(folder, "halves" + treatment)
        dam(program, cases, halves, "--set", "time.end=0.04 s", *words)
        sums.append(dam(program, cases, halves, "--set", "time.end=0.08 s", "--resume", "--threads", "1", *words))
        require(len(set(sums)) == 1, f"{treatment}: 1, 2, 4 threads and resumed give {sums}")


def ghosts_dam_break(program, cases, folder):
    """A dam break between ghosts to 1 s: no particle outside, snapshots without ghosts, audit residual at most 1 %."""
    import h5py
    import numpy
    for treatment in ("ghost_free_slip", "ghost_no_slip"):
        out = os.path.join(folder, treatment)
        dam(program, cases, out, "--set", "time.end=1 s", "--set", "spacing=0.025 m", "--set", f"scheme.wall.treatment={treatment}")
        outside, particles = 0, set()
        for name in sorted(glob.glob(os.path.join(out, "*.vtkhdf"))):
            x = h5py.File(name)["VTKHDF"]["Points"][:]
            outside += int(numpy.sum((x[:, 0] < 0) | (x[:, 0] > 2) | (x[:, 1] < 0)))
            particles.add(len(x))
        residual = max(abs(row["residual_relative"]) for row in read_csv(os.path.join(out, "energies.csv")))
        require(outside == 0 and particles == {400}, f"{treatment}: {outside} particles outside, {particles} in snapshots")
        require(residual <= 0.01, f"{treatment}: largest audit residual {residual:.2e} (limit 1e-2)")


def ghosts_still_water(program, cases, folder):
    """RMS pressure error over the depth at most 5 % of the bottom pressure, speeds at most 10 mm/s, force on the walls within 1 % of the weight."""
    import h5py
    import numpy
    case = os.path.join(folder, "case.toml")
    with open(os.path.join(cases, "still_water_2d.toml"), encoding="utf-8") as source, open(case, "w", encoding="utf-8") as copy:
        copy.write(source.read() + '\n[[gauge]]\nname = "force"\ntype = "wall_force"\n')
    out = os.path.join(folder, "out")
    undine(program, "run", case, "--out", out, "--quiet", "--set", "scheme.wall.treatment=ghost_free_slip", "--set", "spacing=0.025 m", "--set",
           "time.end=1 s", "--set", "output.snapshots=0.1 s")
    worst = 0.0
    for name in sorted(glob.glob(os.path.join(out, "*.vtkhdf"))):
        data = h5py.File(name)["VTKHDF"]
        x, p = data["Points"][:], data["PointData"]["p"][:]
        worst = max(worst, float(numpy.sqrt(numpy.mean((p - 1000 * 9.81 * (0.5 - x[:, 1])) ** 2))) / (1000 * 9.81 * 0.5))
    require(worst <= 0.05, f"largest RMS pressure error {worst:.4f} of the bottom pressure (limit 0.05)")
    speed = max(row["v_max"] for row in read_csv(os.path.join(out, "gauges", "extremes.csv")))
    require(speed <= 0.01, f"largest speed {speed:.4f} m/s (limit 0.01)")
    rows = read_csv(os.path.join(out, "gauges", "force.csv"))
    force = sum(row["fy"] for row in rows[len(rows) // 2:]) / len(rows[len(rows) // 2:])
    weight = 1000 * 9.81 * 0.25
    require(abs(force + weight) <= 0.01 * weight, f"mean force on the walls {force:.1f} N, weight {weight:.1f} N (limit 1 %)")


def thin_jet(program, cases, folder):
    """A sheet of water four particles thick falls on a floor and splashes, by the recommended scheme: no two particles nearer than 0.2 spacings,
    audit residual at most 1 % of the energy at the start, nothing behind the floor. With tension and without separation pairs coincide."""
    case = os.path.join(folder, "case.toml")
    with open(case, "w", encoding="utf-8") as out:
        out.write("""
dimensions = 2
spacing = "0.01 m"
gravity = [0, -9.81]
expected_speed = "3 m/s"
domain = { low = [-2, -1], high = [2, 2] }
scheme = { wall = { friction = false } }
time = { end = "0.4 s" }
[[fluid]]
velocity = [0, -3]
shape = { type = "box", low = [-0.02, 0.02], high = [0.02, 0.62] }
[[wall]]
name = "floor"
shape = { type = "box", low = [-1.5, 0], high = [1.5, 1] }
[[gauge]]
name = "coincidence"
type = "coincidence"
every = "2 ms"
[[gauge]]
name = "leak"
type = "leak"
""")
    closest = {}
    for name, words in {"recommended": (), "before": ("--set", "scheme.pressure.separation=0", "--set", "fluid[0].eos.tension=true")}.items():
        out = os.path.join(folder, name)
        undine(program, "run", case, "--out", out, "--quiet", "--threads", "1", *words)
        closest[name] = min(row["closest"] for row in read_csv(os.path.join(out, "gauges", "coincidence.csv")))
    out = os.path.join(folder, "recommended")
    rows = read_csv(os.path.join(out, "energies.csv"))
    start = rows[0]["kinetic"] + rows[0]["potential"]
    residual = max(abs(row["residual"]) for row in rows) / start
    leaked = max(row["fraction"] for row in read_csv(os.path.join(out, "gauges", "leak.csv")))
    require(closest["recommended"] >= 0.2, f"smallest distance {closest['recommended']:.3f} spacings (limit 0.2)")
    require(closest["before"] < 0.1, f"with tension and without separation {closest['before']:.3f} spacings: the case shows the fault")
    require(residual <= 0.01, f"largest audit residual {residual:.2e} of the energy at the start (limit 1e-2)")
    require(leaked == 0, f"{leaked} of the fluid behind the floor")


def vtk_reads_back(program, cases, folder):
    """VTK's own reader and h5py agree on every snapshot; the series names them all."""
    undine(program, "run", os.path.join(cases, "dam_break_2d.toml"), "--out", folder, "--quiet", "--set", "time.end=0.02 s", "--set",
           "output.snapshots=0.01 s")
    entries = json.load(open(os.path.join(folder, "particles.vtkhdf.series"), encoding="utf-8"))["files"]
    require(len(entries) == 3, f"{len(entries)} snapshots for 0, 0.01 and 0.02 s")
    for entry in entries:
        script = os.path.join(HERE, "..", "cli", "read_snapshot.py")
        done = subprocess.run(["/usr/bin/python3", script, os.path.join(folder, entry["name"])], capture_output=True, text=True, check=False)
        require(done.returncode == 0, f"{entry['name']}: {done.stdout.strip().splitlines()[:1]} {done.stderr.strip()}")


def gauges_compare(program, cases, folder):
    """Gauges write a row at each multiple of their interval, and a run ends with a table against reference data."""
    reference = os.path.join(folder, "reference.csv")
    with open(reference, "w", encoding="ascii") as out:
        out.write("t [s],front [m]\n0,1.0\n0.02,1.0\n0.04,1.0\n")
    case = os.path.join(folder, "case.toml")
    with open(os.path.join(cases, "dam_break_2d.toml"), encoding="utf-8") as source, open(case, "w", encoding="utf-8") as out:
        out.write(source.read() + '\n[[gauge]]\nname = "edge"\ntype = "front"\nevery = "10 ms"\nreference = { file = "reference.csv" }\n')
    text = undine(program, "run", case, "--out", os.path.join(folder, "out"), "--set", "time.end=0.04 s")
    require("rms" in text and "edge" in text, "the table against the reference is printed")
    rows = read_csv(os.path.join(folder, "out", "gauges", "edge.csv"))
    require(len(rows) == 5, f"{len(rows)} rows for 0, 10, 20, 30, 40 ms")


def overwrite_needs_asking(program, cases, folder):
    """A second run into the same folder is refused with exit code 2 and changes nothing; --overwrite replaces it."""
    case, out = os.path.join(cases, "dam_break_2d.toml"), os.path.join(folder, "out")
    words = ("run", case, "--out", out, "--quiet", "--set", "time.end=1 ms")
    undine(program, *words)
    before = open(os.path.join(out, "run.json"), encoding="utf-8").read()
    undine(program, *words, expect=2)
    require(open(os.path.join(out, "run.json"), encoding="utf-8").read() == before, "the first run is untouched")
    undine(program, *words, "--overwrite")
    require(True, "--overwrite runs")


if __name__ == "__main__":
    check, binary, place = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as scratch:
        target = os.path.join(scratch, "out") if check == "smoke" else scratch
        globals()[check](binary, place, target)
