#!/usr/bin/python3
"""Acceptance checks of `undine study`: study.py CHECK UNDINE (STUDY or CASES). Each prints its criterion; exit 1 on failure."""
import csv
import json
import os
import sys
import tempfile

from acceptance import require, undine


def results(folder):
    with open(os.path.join(folder, "results.csv"), encoding="utf-8") as lines:
        return {row["member"]: row for row in csv.DictReader(lines)}


def write_study(folder, cases, text):
    path = os.path.join(folder, "mini.toml")
    with open(path, "w", encoding="utf-8") as out:
        out.write(f'case = "{cases}/dam_break_2d.toml"\n' + text)
    return path


def smoke(program, study, folder):
    """Every member of a shipped study can be read; its [quick] members run to their end, and its files agree with each other."""
    out = os.path.join(folder, "out")
    undine(program, "study", study, "--dry-run", "--out", out)
    undine(program, "study", study, "--quick", "--out", out)
    rows = results(out)
    data = json.load(open(os.path.join(out, "study.json"), encoding="utf-8"))
    require(len(rows) >= 1 and len(rows) == len(data["members"]), f"{len(rows)} members in results.csv and study.json")
    for name, row in rows.items():
        require(row["status"] == "finished", f"{name}: {row['status']} {row['error']}")
    for member in data["members"]:
        require(list(member["axes"]) == [axis["name"] for axis in data["axes"]], f"{member['name']} has a value on each axis")
    lines = [line for line in open(os.path.join(out, "study.md"), encoding="utf-8") if line.startswith("| ")][2:]
    require(len(lines) == len(rows), f"{len(lines)} rows in study.md")
    for member in data["members"]:
        require(all(member["verdicts"].get(verdict["name"]) for verdict in data["verdicts"]), f"{member['name']} has each verdict")


SPACING = """
[set]
time.end = "20 ms"
[[axis]]
name = "dp"
key = "spacing"
values = ["0.05 m", 0.025]
"""


def table(program, cases, folder):
    """Numbers, verdicts, what was published and the order over an axis come out as the run's files say."""
    study = write_study(folder, cases, SPACING + """
[[quantity]]
name = "front"
gauge = "front"
column = "front - 0.5"
[[quantity]]
name = "gap"
formula = "abs(front) / dp"
[[verdict]]
name = "start"
rules = [{ when = "front > 0", says = "ahead" }, { says = "behind" }]
[[published]]
dp = "0.025"
verdicts = { start = "ahead" }
quantities = { front = 0.01 }
within = 0.1
[[order]]
quantity = "front"
axis = "dp"
""")
    out = os.path.join(folder, "out")
    undine(program, "study", study, "--out", out)
    rows = results(out)
    fronts = []
    for name, dp in (("0.05_m", 0.05), ("0.025", 0.025)):
        with open(os.path.join(out, name, "gauges", "front.csv"), encoding="ascii") as lines:
            last = float(lines.readlines()[-1].split(",")[1]) - 0.5
        fronts.append(last)
        require(abs(float(rows[name]["front"]) - last) < 1e-12, f"{name}: front {rows[name]['front']} is the gauge's last, {last}")
        require(abs(float(rows[name]["gap"]) - abs(last) / dp) < 1e-12, f"{name}: a formula of a quantity and an axis")
        require(rows[name]["start"] == ("ahead" if last > 0 else "behind"), f"{name}: verdict {rows[name]['start']}")
    data = json.load(open(os.path.join(out, "study.json"), encoding="utf-8"))
    fine = [member for member in data["members"] if member["axes"]["dp"] == "0.025"][0]
    require(fine["published"]["start"] == "ahead" and fine["agrees"]["start"] == (fronts[1] > 0), "published verdict is compared")
    require(fine["agrees"]["front"] == (abs(fronts[1] - 0.01) <= 0.001), "published number is compared")
    import math
    order = math.log(abs(fronts[0] / fronts[1])) / math.log(2)
    require(abs(data["orders"][0]["order"] - order) < 1e-9, f"order {data['orders'][0]['order']:.6f}, by hand {order:.6f}")


def resumes(program, cases, folder):
    """A second call runs nothing; a changed key runs that member again; --only leaves the others."""
    study = write_study(folder, cases, SPACING)
    out = os.path.join(folder, "out")
    undine(program, "study", study, "--out", out, "--only", "0.05*")
    require(results(out)["0.025"]["status"] == "not run", "--only ran one member")
    again = undine(program, "study", study, "--out", out)
    require("0.05_m: started" not in again and "0.025: started" in again, "the other one follows")
    require("started" not in undine(program, "study", study, "--out", out), "a finished study runs nothing")
    changed = undine(program, "study", study, "--out", out, "--set", "time.courant=0.3")
    require(changed.count(": started") == 2, "a changed key runs both again")


def failed_member(program, cases, folder):
    """A member that its case refuses and one that goes bad are rows with their message; the third finishes."""
    study = write_study(folder, cases, """
[set]
time.end = "50 ms"
spacing = 0.05
[[axis]]
name = "what"
[[axis.value]]
name = "overlap"
set = { "wall[0].shape.high" = [0.3, 1] }
[[axis.value]]
name = "breaks"
set = { time.step = "10 ms", time.end = "2 s" }
[[axis.value]]
name = "fine"
[[quantity]]
name = "bad_at"
run = "blow_up_time"
[[verdict]]
name = "stability"
rules = [{ when = "finished < 1", says = "unstable" }, { says = "stable" }]
""")
    out = os.path.join(folder, "out")
    undine(program, "study", study, "--out", out)
    rows = results(out)
    require(rows["overlap"]["status"] == "failed" and "overlap" in rows["overlap"]["error"], f"overlap: {rows['overlap']['error'][:90]}")
    require(rows["fine"]["status"] == "finished" and rows["fine"]["stability"] == "stable", "fine: finished, stable")
    breaks = rows["breaks"]
    require(breaks["status"] == "went bad" and breaks["stability"] == "unstable" and 0 < float(breaks["bad_at"]) < 2,
            f"breaks: {breaks['status']} at {breaks['bad_at']} s: {breaks['error'][:60]}")


def starts_from_another(program, cases, folder):
    """A member begins with the last particles of another: its first total of kinetic energy is the other's last."""
    study = write_study(folder, cases, """
[set]
time.end = "40 ms"
spacing = 0.05
output.snapshots = "40 ms"
output.energies = "1 ms"
[[axis]]
name = "part"
[[axis.value]]
name = "second"
from = "first"
[[axis.value]]
name = "first"
[[quantity]]
name = "begins"
column = "kinetic"
take = "first"
[[quantity]]
name = "ends"
column = "kinetic"
""")
    out = os.path.join(folder, "out")
    undine(program, "study", study, "--out", out)
    rows = results(out)
    ends, begins = float(rows["first"]["ends"]), float(rows["second"]["begins"])
    require(ends > 0 and abs(begins / ends - 1) < 1e-5, f"kinetic energy {ends:.6g} J at the end, {begins:.6g} J at the next beginning")


if __name__ == "__main__":
    check, binary, place = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as scratch:
        globals()[check](binary, place, scratch)
