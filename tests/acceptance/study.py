#!/usr/bin/python3
"""Acceptance checks of `undine study`: study.py CHECK UNDINE (STUDY or CASES). Each prints its criterion; exit 1 on failure."""
import csv
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time

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
    page = open(os.path.join(out, "study.md"), encoding="utf-8").read().split("\n| ", 1)[1]  # the first table of the page
    lines = page.split("\n\n", 1)[0].splitlines()[2:]
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


def again_and_jobs(program, cases, folder):
    """--again runs finished members once more; --jobs says how many run side by side."""
    study = write_study(folder, cases, SPACING)
    out = os.path.join(folder, "out")

    def events(*words):
        lines = undine(program, "study", study, "--out", out, "--json", *words).splitlines()
        return [(line["member"], line["status"]) for line in map(json.loads, lines)]

    alone = events("--jobs", "1")
    require([status for _, status in alone] == ["running", "finished"] * 2, f"--jobs 1: one after the other, {alone}")
    require(events() == [], "nothing is left to do")
    pair = events("--jobs", "2", "--again")
    require([status for _, status in pair] == ["running"] * 2 + ["finished"] * 2, f"--again --jobs 2: both at once, {pair}")
    require({name for name, _ in pair} == {"0.05_m", "0.025"}, "both members")


def interrupted(program, cases, folder):
    """SIGINT stops the members at a checkpoint, exit code 130; the next call goes on from there, to the same end."""
    study = write_study(folder, cases, """
[set]
time.end = "1.2 s"
[[axis]]
name = "dp"
key = "spacing"
values = ["0.025 m", "0.02 m"]
[[quantity]]
name = "front"
gauge = "front"
column = "front"
""")
    out, whole = os.path.join(folder, "out"), os.path.join(folder, "whole")
    with subprocess.Popen([program, "study", study, "--out", out, "--jobs", "2", "--json"], stdout=subprocess.PIPE, text=True) as running:
        while json.loads(running.stdout.readline())["member"] != "0.02_m":
            pass
        series = os.path.join(out, "0.02_m", "energies.csv")
        for _ in range(2000):  # until it is under way
            if os.path.exists(series) and len(open(series, encoding="ascii").readlines()) > 20:
                break
            time.sleep(0.005)
        running.send_signal(signal.SIGINT)
        running.communicate(timeout=60)
        require(running.returncode == 130, f"exit code {running.returncode}, expected 130")
    status = results(out)["0.02_m"]["status"]
    require(status == "interrupted", f"0.02_m: {status}")
    stopped = json.load(open(os.path.join(out, "0.02_m", "run.json"), encoding="utf-8"))["time"]
    require(0 < stopped < 1.2, f"stopped at {stopped:.3f} s of 1.2 s")
    undine(program, "study", study, "--out", out)
    require("--resume" not in open(os.path.join(out, "0.02_m", "errors.txt"), encoding="utf-8").read(), "no complaint of --resume")
    first = float(open(series, encoding="ascii").read().split("\n0,")[1].split(",")[0])
    undine(program, "study", study, "--out", whole)
    ends = [{name: row["front"] for name, row in results(place).items()} for place in (out, whole)]
    require(ends[0] == ends[1] and first == 0, f"resumed and in one go: {ends}")


LIMITS = """
[[quantity]]
name = "front"
gauge = "front"
column = "front - 0.5"
[[limit]]
quantity = "front"
at_most = 1
at_least = 0.9
metric = "way of the front"
source = "a test"
[[limit]]
quantity = "front"
dp = "0.025"
relative_to = { dp = "0.05 m" }
metric = "ratio"
at_most = 10
quick = true
[[limit]]
quantity = "front"
at_most = 1
worst = true
metric = "farthest"
[[limit]]
quantity = "front"
order_over = "dp"
[quick]
set = { time.end = "10 ms" }
"""


def limits(program, cases, folder):
    """`undine verify` scores limits: bounds, ratios, the worst of all, orders; the exit code says whether one was missed."""
    studies, out = os.path.join(folder, "studies"), os.path.join(folder, "out")
    os.mkdir(studies)
    os.rename(write_study(folder, cases, SPACING + LIMITS), os.path.join(studies, "mini.toml"))
    with open(os.path.join(studies, "without.toml"), "w", encoding="utf-8") as other:
        other.write(f'case = "{cases}/dam_break_2d.toml"\n')
    table = json.loads(undine(program, "verify", "--files", studies, "--out", out, "--json", expect=5))
    rows = {(row["metric"], row["bound"]): row for row in table}
    require(all(row["case"] == "mini" for row in table) and len(table) == 7, f"{len(table)} lines of the one study with limits")
    fronts = {name: float(row["front"]) for name, row in results(os.path.join(out, "mini")).items()}
    for name, member in (("0.05 m", "0.05_m"), ("0.025", "0.025")):
        upper, lower = rows[(f"way of the front (dp {name})", "at most")], rows[(f"way of the front (dp {name})", "at least")]
        require(upper["value"] == fronts[member] and upper["limit"] == 1 and upper["pass"] is True, f"{name}: {upper}")
        require(lower["limit"] == 0.9 and lower["pass"] is False and lower["source"] == "a test", f"{name}: {lower}")
    ratio = rows[("ratio (dp 0.025)", "at most")]
    require(abs(ratio["value"] - fronts["0.025"] / fronts["0.05_m"]) < 1e-12 and ratio["pass"] is True, f"ratio {ratio['value']}")
    worst = [row for row in table if row["metric"].startswith("farthest")]
    require(len(worst) == 1 and worst[0]["value"] == max(fronts.values()), f"the worst is one line: {worst}")
    order = [row for row in table if "observed order" in row["metric"]]
    require(len(order) == 1 and order[0]["limit"] is None and order[0]["pass"] is None and order[0]["value"] is not None, f"order: {order}")
    again = subprocess.run([program, "verify", "--files", studies, "--out", out], capture_output=True, text=True, check=False)
    require(again.returncode == 5 and ": finished" not in again.stderr and "of 6 limits kept" in again.stdout, "a second call runs nothing")
    require(again.stdout.count(" NO") == 2, "two limits are missed")
    quick = json.loads(undine(program, "verify", "mini", "--files", studies, "--out", out + "-quick", "--json", "--quick"))
    require([row["metric"] for row in quick] == ["ratio (dp 0.025)"], "--quick judges what is meant for it")
    listing = undine(program, "verify", "--list", "--files", studies)
    require("mini" in listing and "without" not in listing, "--list names it")


def verify_quick(program, _cases, folder):
    """The shipped verifications: all can be read, and the short part gives a number for every line, in less than a minute of one core."""
    listing = undine(program, "verify", "--list")
    names = [line.split()[0] for line in listing.splitlines()[1:-1]]
    require({"still_water", "sound_wave", "poiseuille", "couette", "taylor_green", "martin_moyce", "gate", "spheric2", "consistency", "noh",
             "double_shock", "strong_blast", "niedoba_cavity"} <= set(names),
            f"listed: {names}")
    out = os.path.join(folder, "out")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "verify", "--quick", "--json", "--out", out], capture_output=True, text=True, timeout=550, check=False)
    require(done.returncode in (0, 5), f"exit code {done.returncode}: {done.stderr[-500:]}")
    table = json.loads(done.stdout)
    for row in table:
        require({"case", "metric", "value", "limit", "pass"} <= set(row) and row["value"] is not None,
                f"{row['case']}: {row['metric']} = {row['value']}, limit {row['limit']}, {row['pass']}")
    missed = [row["case"] for row in table if row["pass"] is False]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    require((done.returncode == 5) == bool(missed), f"{len(table)} lines, {len(missed)} limits missed")
    require(seconds < 60, f"{seconds:.0f} s of CPU time")


if __name__ == "__main__":
    check, binary, place = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as scratch:
        globals()[check](binary, place, scratch)
