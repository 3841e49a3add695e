#!/usr/bin/python3
"""resume.py UNDINE CHECK

    schemes, integrators, walls, gauges, terms
                 every entry of the lists: a run that was ended half-way and resumed on other threads has the checksum and the series of one
                 that was not. Each is run in every small case below that takes it, and there must be one.
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
from dataclasses import dataclass

from common import ONE_THREAD, SMALL, checkpoints, checksum, require, small_case, text, undine


@dataclass
class Form:
    """A kind of flow: a small case, how long it runs, and when its first half ends (s)."""
    name: str
    case: str
    end: float
    half: float


LIQUID = SMALL.format(spacing=0.025, end=0.02, snapshots=0.02, energies=0.001, checkpoints=0.005, more="")

CLOSED = """# A closed box under a moving lid.
dimensions = 2
spacing = 0.1
expected_speed = "1 m/s"
[scheme]
name = "confined"
[time]
end = "0.1 s"
[[fluid]]
density = 1
viscosity = "0.01 Pa s"
shape = { type = "box", low = [0, 0], high = [1, 1] }
[[wall]]
name = "box"
shape = { type = "box", low = [0, 0], high = [1, 1] }
slide = ["if(y > 1, 1, 0)", 0]
[output]
snapshots = 0
energies = "5 ms"
checkpoints = "25 ms"
report = false
"""

GAS = """# A shock tube, short and wide; its gas shears, so that every viscosity has something to do.
dimensions = 2
spacing = 0.05
[scheme]
name = "gas"
[scheme.wall]
treatment = "ghost_free_slip"
guard = true
[domain]
low = [-0.5, -0.5]
high = [1, 1]
[time]
end = "0.3 s"
[[fluid]]
name = "dense"
density = 1
viscosity = "1 mPa s"
pressure = 1
velocity = ["0.1 * sin(6 * y)", 0]
shape = { type = "box", low = [0, 0], high = [0.25, 0.5] }
eos = { form = "ideal_gas", gamma = 1.4 }
[[fluid]]
name = "thin"
density = 0.25
viscosity = "1 mPa s"
pressure = 0.2
shape = { type = "box", low = [0.25, 0], high = [0.5, 0.5] }
eos = { form = "ideal_gas", gamma = 1.4 }
[[wall]]
name = "tank"
shape = { type = "box", low = [0, 0], high = [0.5, 0.5] }
[output]
snapshots = 0
energies = "15 ms"
checkpoints = "75 ms"
report = false
"""

FORMS = [Form("liquid", LIQUID, 0.02, 0.009), Form("closed", CLOSED, 0.1, 0.045), Form("gas", GAS, 0.3, 0.14)]

# What a gauge cannot do without, where it needs more than its type; one text or another, as the cases differ.
GAUGE_KEYS = {
    "probe": ["at = [0.05, 0.05]"],
    "height": ['at = [0.05, 0]\nfrom = "0 m"\nto = "0.3 m"'],
    "profile": ['component = "y"\nfrom = [0.05, 0.05]\nto = [0.15, 0.05]\nfile = "profile.csv"\nplace = "s"\nvalue = "v"'],
    "error": ['exact = "riemann"\norigin = [0.25, 0]\nparameters = { rho_left = 1, p_left = 1, rho_right = 0.25, p_right = 0.2, gamma = 1.4 }',
              'exact = "hydrostatic_incompressible"\nparameters = { surface = 0.2 }'],
}

# What a word of a list cannot do without in these cases.
NEEDS = {"saalfeld": ["--set", "time.step=0.2 ms"]}  # its own step is too long for them


def write(folder, form, label, more=""):
    path = os.path.join(folder, f"{label}.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(form.case + more)
    return path


def takes(program, case, words):
    return undine(program, "check", case, *words, expect=None).returncode == 0


def halves(program, folder, form, label, words, more="", may_go_bad=False):
    """Runs the case whole on one thread, and in two parts, the first on two threads and the second on three. False where it goes bad, if
    it may."""
    case = write(folder, form, label, more)
    whole, parts = os.path.join(folder, label + "_whole"), os.path.join(folder, label + "_parts")
    done = undine(program, "run", case, "--out", whole, "--quiet", "--threads", "1", *words, expect=None if may_go_bad else 0)
    if done.returncode == 3:
        return False
    if done.returncode != 0:
        sys.exit(f"{label}: exit {done.returncode}\n{done.stderr}")
    undine(program, "run", case, "--out", parts, "--quiet", "--threads", "2", *words, "--set", f"time.end={form.half} s")
    undine(program, "run", case, "--out", parts, "--quiet", "--threads", "3", "--resume", *words)
    last = [checkpoints(out)[-1] for out in (whole, parts)]
    sums = [checksum(program, file) for file in last]
    files = ["energies.csv", "steps.csv"] + [os.path.join("gauges", os.path.basename(f)) for f in glob.glob(os.path.join(whole, "gauges", "*.csv"))]
    other = [name for name in files if text(os.path.join(whole, name)) != text(os.path.join(parts, name))]
    step = int(os.path.basename(last[0])[5:17])
    require(sums[0] == sums[1] and not other and step >= 3,
            f"{label}: {sums[0]} whole, {sums[1]} in parts, {step} steps, {len(files)} series, different: {other}")
    for out in (whole, parts):
        shutil.rmtree(out)
    return True


def names(program, axis):
    return [entry["name"] for entry in json.loads(undine(program, "list", axis, "--json").stdout)]


def every(program, folder, axis, key, forms=None, more=(), words_of_list=None):
    """Each word of a list as the value of a key, in every form that takes it."""
    for word in words_of_list or names(program, axis):
        words = [*more, "--set", f"{key}={word}", *NEEDS.get(word, [])]
        taking = [form for form in forms or FORMS if takes(program, write(folder, form, "asked"), words)]
        well = [form.name for form in taking if halves(program, folder, form, f"{axis}_{word}_{form.name}", words, may_go_bad=True)]
        require(bool(well), f"{axis} {word}: a case takes it and goes well: {well}")


# The watchdog is off, as an entry may do badly in a case that it is not made for: the bits must be the same nevertheless, as long as they are
# numbers.
OFF = ("--set", "watchdog.active=false")


def schemes(program, folder):
    every(program, folder, "schemes", "scheme.name", more=OFF)


def integrators(program, folder):
    every(program, folder, "integrators", "time.integrator", more=OFF)


def walls(program, folder):
    every(program, folder, "walls", "scheme.wall.treatment", more=OFF)
    niedoba = ("--set", "scheme.name=niedoba", *OFF)
    for word in ("ghost_free_slip", "repulsive"):
        halves(program, folder, FORMS[2], f"niedoba_{word}", ["--set", f"scheme.wall.treatment={word}", *niedoba])


def gauges(program, folder):
    """All gauges that a case takes at once; each in at least one."""
    with open(os.path.join(folder, "profile.csv"), "w", encoding="utf-8") as file:
        file.write("s,v\n0,0\n0.5,1\n1,0\n")
    taken = set()
    for form in FORMS:
        tables = []
        for gauge in names(program, "gauges"):
            for keys in GAUGE_KEYS.get(gauge, [""]):
                table = f'[[gauge]]\nname = "{gauge}"\ntype = "{gauge}"\n{keys}\n'
                if takes(program, write(folder, form, "asked", table), []):
                    tables.append(table)
                    taken.add(gauge)
                    break
        halves(program, folder, form, f"gauges_{form.name}", [], "".join(tables))
    left = set(names(program, "gauges")) - taken
    require(not left, f"every gauge is in a case; give the keys that these need in GAUGE_KEYS: {sorted(left)}")


def terms(program, folder):
    """What keeps a state of its own, or changes what is one: densities with every wall, laws of H, switches, dissipation."""
    for density in ("summation", "normalised_summation"):
        every(program, folder, "walls", "scheme.wall.treatment", more=("--set", f"scheme.density.form={density}", *OFF), forms=FORMS[:1])
    gas = FORMS[2:]
    every(program, folder, "density", "scheme.density.form", forms=gas, more=OFF)
    every(program, folder, "gas_density", "scheme.density.form", forms=gas, more=OFF)
    every(program, folder, "viscosity_switch", "scheme.viscosity_switch.form", forms=gas)
    every(program, folder, "conductivity", "scheme.conductivity.form", forms=gas)
    every(program, folder, "stress", "scheme.viscosity.form", forms=gas)
    every(program, folder, "laws", "scheme.smoothing.law", forms=gas, more=("--set", "scheme.density.form=continuity", *OFF),
          words_of_list=("constant", "density", "density_rate"))
    every(program, folder, "shifting", "scheme.shifting.form", forms=FORMS[1:2])
    every(program, folder, "density_diffusion", "scheme.density_diffusion.form", forms=FORMS[:2])
    every(program, folder, "density_filter", "scheme.density_filter.form", forms=FORMS[:1], more=("--set", "scheme.density_filter.every=3"))
    every(program, folder, "velocity_correction", "scheme.xsph.form", forms=FORMS[:1])
    for form, key in (("liquid", "scheme.smoothing.law=density"), ("liquid", "scheme.backend=serial"), ("gas", "scheme.backend=serial"),
                      ("gas", "scheme.precision=double"), ("liquid", "domain.on_escape=reflect"), ("gas", "domain.on_escape=remove")):
        halves(program, folder, next(each for each in FORMS if each.name == form), f"{form}_{key.split('=')[0]}_{key.split('=')[1]}", ["--set", key])


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
    fresh()
    done = undine(program, "run", case, "--out", out, "--quiet", "--resume")
    require(not done.stderr, f"on the same machine there is nothing to say: {done.stderr.strip() or 'nothing'}")


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
        checks = {check.__name__: check for check in (schemes, integrators, walls, gauges, terms, refused, signals, intervals)}
        checks[sys.argv[2]](sys.argv[1], place)
