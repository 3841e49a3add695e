#!/usr/bin/python3
"""faults.py UNDINE faults|healthy [NAME...]: sick cases (tests/faults), each diagnosed with its cause; healthy ones (the shipped cases for some
steps, and tests/healthy) without an alarm.

The leading comments of a sick case say what the diagnosis must be:
    # cause: NAME       in `undine list causes`
    # alarm: A or B     what may stop the run"""
import glob
import math
import os
import re
import sys
import tempfile
import time

from common import ROOT, checkpoints, checksum, record, require, snapshots, undine

SHIPPED_END = "0.02 s"
COARSER = {"sedov": ["--set", "spacing=0.03125"]}  # an eighth of the particles


def expectations(path):
    wanted = dict(re.findall(r"^# (cause|alarm): (.*)$", open(path, encoding="utf-8").read(), re.M))
    return wanted["cause"], wanted["alarm"].split(" or ")


def fault(program, path, folder):
    """What is wrong with the diagnosis of a sick case; empty if nothing is."""
    cause, alarms = expectations(path)
    out = os.path.join(folder, os.path.basename(path)[: -len(".toml")])
    begun = time.monotonic()
    done = undine(program, "run", path, "--out", out, "--quiet", "--no-report", expect=None, timeout=120)
    seconds = time.monotonic() - begun
    if done.returncode != 3:
        return f"exit {done.returncode}, not 3: {done.stderr.strip()[:300]}"
    run = record(out)
    found = run.get("diagnosis")
    if run["status"] != "went bad" or not found:
        return f"status {run['status']}, diagnosis {found}: {done.stderr.strip()[:300]}"
    print(f"        {os.path.basename(out)}: {found['what']} -> {found['cause']} (also {', '.join(found['also']) or 'none'}), "
          f"{run['steps']} steps, {seconds:.1f} s")
    if found["cause"] != cause:
        return f"cause {found['cause']}, not {cause}: {found['because']}"
    if found["alarm"] not in alarms:
        return f"alarm {found['alarm']}, not one of {alarms}"
    told = open(os.path.join(out, "diagnosis.txt"), encoding="utf-8").read()
    if cause not in told or found["remedy"] not in told or found["remedy"] not in done.stderr:
        return "the diagnosis is not in diagnosis.txt and on standard error"
    good = checkpoints(out)
    if found["step"] > 0 and (not good or int(os.path.basename(good[-1])[5:17]) > found["step"] or len(checksum(program, good[-1])) != 16):
        return f"no good checkpoint from before the alarm: {good}"
    if not snapshots(os.path.join(out, "window")):
        return "no window of steps"
    sizes = [math.inf if term["acceleration"] is None else term["acceleration"] for term in found.get("terms", [])]
    # A state that never got as far as its rates has no terms.
    if "particle" in found and found["alarm"] != "residual" and (sizes != sorted(sizes, reverse=True) or not (sizes or found["step"] == 0)):
        return f"terms are not in order: {found['terms']}"
    return ""


def faults(program, names):
    paths = sorted(glob.glob(os.path.join(ROOT, "tests", "faults", "*.toml")))
    wrong, causes = [], set()
    with tempfile.TemporaryDirectory(prefix="undine_faults_") as folder:
        for path in paths:
            name = os.path.basename(path)[: -len(".toml")]
            if names and name not in names:
                continue
            causes.add(expectations(path)[0])
            reason = fault(program, path, folder)
            print(f"{'FAILED ' if reason else 'ok     '} {name}: {reason or expectations(path)[0]}", flush=True)
            wrong += [name] if reason else []
    require(not wrong, f"{len(causes)} causes, {len(wrong)} cases without the right diagnosis {wrong}")
    require(bool(names) or len(causes) >= 15, "at least 15 causes are planted")


def healthy(program, names):
    shipped = sorted(glob.glob(os.path.join(ROOT, "cases", "**", "*.toml"), recursive=True))
    small = sorted(glob.glob(os.path.join(ROOT, "tests", "healthy", "*.toml")))
    wrong, count = [], 0
    with tempfile.TemporaryDirectory(prefix="undine_healthy_") as folder:
        for number, path in enumerate(shipped + small):
            name = os.path.basename(path)[: -len(".toml")]
            if names and name not in names:
                continue
            count += 1
            words = ["--set", f"output.energies={SHIPPED_END}", "--set", "output.snapshots=0"] if path in shipped else []
            if path in shipped:
                words += ["--set", f"time.end={shipped_end(path)}", *COARSER.get(name, [])]
            done = undine(program, "run", path, "--out", os.path.join(folder, str(number)), "--quiet", "--no-report", *words, expect=None)
            steps = record(os.path.join(folder, str(number)))["steps"] if done.returncode == 0 else 0
            good = done.returncode == 0 and steps > 0
            print(f"{'ok     ' if good else 'FAILED '} {name}: {steps} steps {done.stderr.strip()[:300]}", flush=True)
            wrong += [] if good else [name]
    require(not wrong, f"{count} healthy cases, {len(wrong)} false alarms {wrong}")
    require(bool(names) or count >= 20, "at least 20 cases")


def shipped_end(path):
    """Some steps: few where they are dear."""
    dear = re.search(r'^dimensions = 3', open(path, encoding="utf-8").read(), re.M) or "dimensions" not in open(path, encoding="utf-8").read()
    return "2 ms" if dear else SHIPPED_END


if __name__ == "__main__":
    {"faults": faults, "healthy": healthy}[sys.argv[2]](sys.argv[1], sys.argv[3:])
