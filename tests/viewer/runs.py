#!/usr/bin/env python3
"""Makes the runs that the tests of reports and pictures look at.

    runs.py UNDINE FOLDER
"""

import json
import os
import shutil
import subprocess
import sys

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases")
PLANE = os.path.join(CASES, "dam_break_2d.toml")

# One number per time, and a column that the gauge has: what a page compares must be there to be seen.
REFERENCE = "time [s],front [m]\n0,0.48\n0.1,0.52\n0.2,0.66\n0.3,0.86\n"


def run(undine, case, out, *words):
    done = subprocess.run([undine, "run", case, "--out", out, "--threads", "1", *words], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"the run of {case} failed:\n{done.stdout}")
    return done.stdout


def study(folder, spacings):
    """study.json as `undine study` writes it, over the runs in the folder; the errors are made up, of second order."""
    members = []
    for k, spacing in enumerate(spacings):
        name = f"spacing_{spacing}"
        error = 4.0 * spacing**2
        members.append({
            "name": name, "folder": name, "axes": {"spacing": f"{spacing} m"}, "status": "finished", "error": "",
            "seconds": 0.5 * 4**k, "particles": 100 * 4**k, "steps": 50 * 2**k, "quantities": {"rms": error, "peak": 1.0},
            "verdicts": {"small": "yes" if error < 0.02 else "no"}, "published": {"peak": "1.02", "small": "yes"},
            "agrees": {"peak": True, "small": error < 0.02}, "reasons": [] if error < 0.02 else ["coarse"]})
    members.append({
        "name": "broken", "folder": "broken", "axes": {"spacing": "0.001 m"}, "status": "failed", "error": "<b>the step collapsed</b>",
        "seconds": None, "particles": None, "steps": None, "quantities": {}, "verdicts": {}, "published": {}, "agrees": {}})
    record = {
        "title": "Still water </script><script>alert(1)</script>", "file": "still.toml",
        "axes": [{"name": "spacing", "values": [f"{spacing} m" for spacing in spacings] + ["0.001 m"]}],
        "quantities": [{"name": "rms", "unit": "m", "meaning": "difference from rest"}, {"name": "peak", "unit": "Pa", "meaning": "pressure"}],
        "verdicts": [{"name": "small", "rule": "rms < 0.02 m"}], "members": members,
        "orders": [{"quantity": "rms", "axis": "spacing", "group": {}, "order": 2.0}]}
    with open(os.path.join(folder, "study.json"), "w", encoding="utf-8") as file:
        json.dump(record, file, indent=1)


def main(undine, folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "study"))
    reference = os.path.join(folder, "front.csv")
    with open(reference, "w", encoding="utf-8") as file:
        file.write(REFERENCE)
    said = run(undine, PLANE, os.path.join(folder, "flat"), "--set", "spacing=0.05", "--set", "time.end=0.3",
               "--set", f"gauge[0].reference.file={reference}")
    if "report.html" not in said:
        sys.exit(f"the run does not say where its report is:\n{said}")
    run(undine, os.path.join(CASES, "dam_break", "spheric2.toml"), os.path.join(folder, "spatial"), "--set", "spacing=0.1",
        "--set", "time.end=0.3", "--set", "output.snapshots=0.1", "--quiet")
    spacings = (0.1, 0.05)
    for k, spacing in enumerate(spacings):
        out = os.path.join(folder, "study", f"spacing_{spacing}")
        run(undine, PLANE, out, "--set", f"spacing={spacing}", "--set", "time.end=0.05", *(["--no-report"] if k else []))
        if os.path.exists(os.path.join(out, "report.html")) == bool(k):
            sys.exit(f"{out}: a report is to be there, but for --no-report")
    study(os.path.join(folder, "study"), spacings)


if __name__ == "__main__":
    main(*sys.argv[1:])
