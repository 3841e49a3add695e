"""What the checks of reliability share."""
import glob
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}

# A dam break of a few hundred particles, which every check here runs.
SMALL = """# A small dam break.
dimensions = 2
spacing = "{spacing} m"
gravity = [0, -9.81]
[time]
end = "{end} s"
[[fluid]]
surface = "0.2 m"
shape = {{ type = "box", low = [0, 0], high = [0.2, 0.2] }}
[[wall]]
name = "tank"
open = ["y+"]
shape = {{ type = "box", low = [0, 0], high = [0.4, 0.3] }}
[output]
snapshots = "{snapshots} s"
energies = "{energies} s"
checkpoints = "{checkpoints} s"
report = false
{more}"""


def small_case(folder, *, spacing=0.02, end=0.2, snapshots=0.02, energies=0.002, checkpoints=0.01, more="", name="small.toml"):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(SMALL.format(spacing=spacing, end=end, snapshots=snapshots, energies=energies, checkpoints=checkpoints, more=more))
    return path


def undine(program, *words, expect=0, timeout=300, **more):
    done = subprocess.run([program, *words], capture_output=True, text=True, timeout=timeout, check=False, env=ONE_THREAD, **more)
    if expect is not None and done.returncode != expect:
        sys.exit(f"{' '.join(words)}: exit {done.returncode}, expected {expect}\n{done.stdout}\n{done.stderr}")
    return done


def checkpoints(folder):
    return sorted(glob.glob(os.path.join(folder, "*.checkpoint")))


def snapshots(folder):
    return sorted(glob.glob(os.path.join(folder, "*.vtkhdf")))


def checksum(program, file):
    return undine(program, "checksum", file).stdout.strip()


def record(folder):
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
        return json.load(file)


def text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def require(holds, words):
    print(("ok      " if holds else "FAILED  ") + words, flush=True)
    if not holds:
        sys.exit(1)
