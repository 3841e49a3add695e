#!/usr/bin/python3
"""resume.py UNDINE CHECK

    same_bits    every scheme, wall, integrator and gauge: a run that was ended half-way and resumed on other threads has the checksum and the
                 gauge files of one that was not
    refused      damaged, foreign and unknown checkpoints are refused with the reason, and the one before is taken
    signals      SIGINT and SIGTERM write a checkpoint and end with exit code 130
    intervals    checkpoints by simulated and by wall-clock time; the last two are kept"""
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from common import ONE_THREAD, checkpoints, checksum, require, small_case, text, undine

GAUGES = """
[[gauge]]
name = "probe"
type = "probe"
at = [0.05, 0.05]
[[gauge]]
name = "height"
type = "height"
at = [0.05, 0]
from = "0 m"
to = "0.3 m"
[[gauge]]
name = "front"
type = "front"
[[gauge]]
name = "extremes"
type = "extremes"
[[gauge]]
name = "leak"
type = "leak"
[[gauge]]
name = "wall_motion"
type = "wall_motion"
[[gauge]]
name = "coincidence"
type = "coincidence"
[[gauge]]
name = "mean_density"
type = "mean_density"
[[gauge]]
name = "centre_of_mass"
type = "centre_of_mass"
"""
FORCE = '[[gauge]]\nname = "wall_force"\ntype = "wall_force"\n'
WITHOUT_FORCE = ("none", "elastic", "distance")


def halves(program, folder, label, words, more):
    """Runs the case whole on one thread, and in two parts, the first on two threads and the second on three."""
    case = small_case(folder, end=0.02, spacing=0.025, energies=0.001, checkpoints=0.005, more=more, name=f"{label}.toml")
    whole, parts = os.path.join(folder, label + "_whole"), os.path.join(folder, label + "_parts")
    undine(program, "run", case, "--out", whole, "--quiet", "--threads", "1", *words)
    undine(program, "run", case, "--out", parts, "--quiet", "--threads", "2", *words, "--set", "time.end=0.009 s")
    undine(program, "run", case, "--out", parts, "--quiet", "--threads", "3", "--resume", *words)
    sums = [checksum(program, checkpoints(out)[-1]) for out in (whole, parts)]
    files = ["energies.csv", "steps.csv"] + [os.path.join("gauges", os.path.basename(f)) for f in glob.glob(os.path.join(whole, "gauges", "*.csv"))]
    other = [name for name in files if text(os.path.join(whole, name)) != text(os.path.join(parts, name))]
    require(sums[0] == sums[1] and not other, f"{label}: {sums[0]} whole, {sums[1]} in parts, {len(files)} series, different: {other}")
    for out in (whole, parts):
        shutil.rmtree(out)


def names(program, axis):
    return [entry["name"] for entry in json.loads(undine(program, "list", axis, "--json").stdout)]


def same_bits(program, folder):
    # Presets of other kinds of flow have cases of another form, and checks of their own.
    halves(program, folder, "recommended", [], GAUGES)
    halves(program, folder, "saalfeld", ["--set", "scheme.name=saalfeld", "--set", "time.step=0.2 ms", "--set",
                                      "fluid[0].eos.form=tait_sound_speed", "--set", "scheme.wall.treatment=adami", "--set",
                                      "scheme.wall.layers=0"], GAUGES)
    for integrator in names(program, "integrators"):
        halves(program, folder, integrator, ["--set", f"time.integrator={integrator}"], GAUGES + FORCE)
    for wall in names(program, "walls"):
        force = "" if wall in WITHOUT_FORCE else FORCE
        halves(program, folder, wall, ["--set", f"scheme.wall.treatment={wall}", "--set", "watchdog.active=false"], GAUGES + force)
    for form in ("summation", "normalised_summation"):
        halves(program, folder, form, ["--set", f"scheme.density.form={form}", "--set", "scheme.wall.treatment=wall_particles", "--set",
                                       "watchdog.active=false"], GAUGES)
    for form in names(program, "density_filter"):
        halves(program, folder, form, ["--set", f"scheme.density_filter.form={form}", "--set", "scheme.density_filter.every=3"], GAUGES)
    for label, key in (("law", "scheme.smoothing.law=density"), ("xsph", "scheme.xsph.form=xsph"), ("antuono", "scheme.density_diffusion.form=antuono"),
                       ("serial", "scheme.backend=serial"), ("reflect", "domain.on_escape=reflect")):
        halves(program, folder, label, ["--set", key], GAUGES)


def refused(program, folder):
    case, out, whole = small_case(folder, end=0.06), os.path.join(folder, "out"), os.path.join(folder, "whole")
    undine(program, "run", case, "--out", whole, "--quiet")
    wanted = checksum(program, checkpoints(whole)[-1])

    def fresh():
        shutil.rmtree(out, ignore_errors=True)
        undine(program, "run", case, "--out", out, "--quiet", "--set", "time.end=0.04 s")
        return checkpoints(out)

    for harm, reason in ((lambda file: os.truncate(file, 700), "not the size that was written"),
                         (lambda file: os.truncate(file, 0), "it is empty"),
                         (flip_a_byte, "does not match its checksum"),
                         (lambda file: open(file, "w").write("undine checkpoint\nformat 99\n"), "its format is 99"),
                         (lambda file: open(file, "w").write("hello"), "not a checkpoint")):
        before, newest = fresh()
        harm(newest)
        done = undine(program, "run", case, "--out", out, "--quiet", "--resume")
        require(reason in done.stderr and os.path.basename(newest) in done.stderr, f"refused, with the reason: {reason}")
        require(os.path.basename(before) in done.stderr, f"the one before is taken: {os.path.basename(before)}")
        require(checksum(program, checkpoints(out)[-1]) == wanted, "and the run ends with the same bits")
    for file in fresh():
        os.truncate(file, 700)
    done = undine(program, "run", case, "--out", out, "--quiet", "--resume", expect=2)
    require("no checkpoint can be resumed from" in done.stderr and done.stderr.count("not the size") == 2, "both are damaged: refused, with both reasons")
    fresh()
    done = undine(program, "run", case, "--out", out, "--quiet", "--resume", "--set", "scheme.artificial_viscosity.alpha=0.5", expect=2)
    require("artificial_viscosity.alpha was 0.02, is 0.5" in done.stderr, f"another case is refused, with what differs: {done.stderr.strip()}")
    require(len(checkpoints(out)) == 2, "and nothing is touched")
    os.makedirs(os.path.join(folder, "begun"))
    open(os.path.join(folder, "begun", ".undine"), "w").close()
    done = undine(program, "run", case, "--out", os.path.join(folder, "begun"), "--quiet", "--resume")
    require("before its first checkpoint" in done.stderr and checksum(program, checkpoints(os.path.join(folder, "begun"))[-1]) == wanted,
            "a run that was ended before its first checkpoint begins again")


def flip_a_byte(path):
    with open(path, "r+b") as file:
        file.seek(os.path.getsize(path) // 2)
        byte = file.read(1)
        file.seek(-1, os.SEEK_CUR)
        file.write(bytes([byte[0] ^ 4]))


def signals(program, folder):
    case, whole = small_case(folder, end=0.5, checkpoints=0), os.path.join(folder, "whole")
    undine(program, "run", case, "--out", whole, "--quiet")
    wanted = checksum(program, checkpoints(whole)[-1])
    for number in (signal.SIGINT, signal.SIGTERM):
        out = os.path.join(folder, str(int(number)))
        process = subprocess.Popen([program, "run", case, "--out", out, "--quiet"], env=ONE_THREAD)
        while len(glob.glob(os.path.join(out, "*.vtkhdf"))) < 3:
            time.sleep(0.005)
        process.send_signal(number)
        code = process.wait(timeout=30)
        status = json.load(open(os.path.join(out, "run.json"), encoding="utf-8"))["status"]
        require(code == 130 and status == "interrupted", f"{number.name}: exit {code}, status {status}")
        step = int(os.path.basename(checkpoints(out)[-1])[5:17])
        require(step > 0, f"{number.name}: a checkpoint at step {step}")
        undine(program, "run", case, "--out", out, "--quiet", "--resume")
        require(checksum(program, checkpoints(out)[-1]) == wanted, f"{number.name}: resumed, it ends with the same bits")


def intervals(program, folder):
    out = os.path.join(folder, "simulated")
    undine(program, "run", small_case(folder, end=0.1, checkpoints=0.03), "--out", out, "--quiet")
    require(len(checkpoints(out)) == 2, f"two are kept: {[os.path.basename(f) for f in checkpoints(out)]}")
    out = os.path.join(folder, "wall_clock")
    case = small_case(folder, end=50, snapshots=0, checkpoints=0, more='checkpoint_wall_time = "0.2 s"\n')
    process = subprocess.Popen([program, "run", case, "--out", out, "--quiet"], env=ONE_THREAD)
    seen, begun = set(), time.monotonic()
    while len(seen) < 4 and time.monotonic() - begun < 60:
        seen.update(checkpoints(out))
        time.sleep(0.02)
    process.kill()
    process.wait()
    require(len(seen) >= 4, f"{len(seen)} checkpoints in {time.monotonic() - begun:.1f} s, every 0.2 s on the clock")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="undine_resume_") as place:
        {"same_bits": same_bits, "refused": refused, "signals": signals, "intervals": intervals}[sys.argv[2]](sys.argv[1], place)
