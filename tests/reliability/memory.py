#!/usr/bin/python3
"""memory.py UNDINE [STEPS]: a run of many steps holds a constant memory. Its resident size is read from /proc while it goes on; after the first
twentieth of its steps it may not grow by more than a page cache of the allocator, 256 kB."""
import os
import subprocess
import sys
import tempfile
import time

from common import ONE_THREAD, require

# A column of liquid in 1-D that sloshes up and down, with output of every kind.
CASE = """# A column of liquid.
dimensions = 1
spacing = "0.05 m"
gravity = [-9.81]
[time]
end = "1e6 s"
step = "{step} s"
[[fluid]]
surface = "1.2 m"
shape = {{ type = "box", low = [0], high = [1] }}
[[wall]]
open = ["x+"]
shape = {{ type = "box", low = [0], high = [2] }}
[[gauge]]
name = "extremes"
type = "extremes"
every = "{energies} s"
[output]
snapshots = "{snapshots} s"
energies = "{energies} s"
checkpoints = "{snapshots} s"
report = false
"""
ALLOWED_KB = 256


def resident_kb(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as lines:
        return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS"))


def steps_done(out):
    """The step of the last row that is whole."""
    try:
        with open(os.path.join(out, "energies.csv"), "rb") as file:
            file.seek(0, os.SEEK_END)
            file.seek(max(0, file.tell() - 2000))
            rows = file.read().decode().split("\n")[1:-1]
        return int(float(rows[-1].split(",")[1])) if rows else 0
    except (FileNotFoundError, ValueError, IndexError):
        return 0


def main(program, steps):
    step = 4e-4
    with tempfile.TemporaryDirectory(prefix="undine_memory_") as folder:
        case, out = os.path.join(folder, "column.toml"), os.path.join(folder, "out")
        with open(case, "w", encoding="utf-8") as file:
            file.write(CASE.format(step=step, energies=step * max(1, steps // 1000), snapshots=step * max(1, steps // 100)))
        process = subprocess.Popen([program, "run", case, "--out", out, "--quiet", "--set", f"time.end={step * steps} s"], env=ONE_THREAD)
        sizes = {}
        while process.poll() is None:
            done = steps_done(out)
            if done >= steps // 20:
                try:
                    sizes[done] = resident_kb(process.pid)
                except (StopIteration, FileNotFoundError):
                    break
            time.sleep(0.01)
        require(process.wait() == 0, "the run finished")
        require(len(sizes) > 5, f"{len(sizes)} readings")
        first, last = min(sizes), max(sizes)
        # The last reading may fall into the end of the run; the one before does not.
        growth = max(sizes.values()) - sizes[first]
        require(growth <= ALLOWED_KB, f"resident {sizes[first]} kB at step {first}, {sizes[last]} kB at step {last}, at most {growth} kB more "
                                      f"(limit {ALLOWED_KB} kB)")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 200_000)
