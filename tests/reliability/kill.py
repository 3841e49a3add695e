#!/usr/bin/python3
"""kill.py UNDINE [KILLS] [SEED]: kills a run with SIGKILL at random moments, resumes it each time, kills every second one once more while it goes on, and compares
its end with that of a run that nobody killed: the checksum over all fields of the last checkpoint, and every series. Prints how many were lost."""
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

from common import ONE_THREAD, checkpoints, checksum, require, small_case, text, undine


def start(program, case, out, *words):
    return subprocess.Popen([program, "run", case, "--out", out, "--quiet", *words], env=ONE_THREAD, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


def killed(program, case, out, delay):
    """Whether the run was still going when it was killed; a run begins when its folder is marked."""
    process = start(program, case, out)
    while not os.path.exists(os.path.join(out, ".undine")) and process.poll() is None:
        time.sleep(0.001)
    time.sleep(delay)
    process.kill()
    return process.wait() == -9


def main(program, kills, seed):
    random.seed(seed)
    with tempfile.TemporaryDirectory(prefix="undine_kill_") as folder:
        case, whole = small_case(folder), os.path.join(folder, "whole")
        begun = time.monotonic()
        undine(program, "run", case, "--out", whole, "--quiet")
        length = time.monotonic() - begun
        wanted = checksum(program, checkpoints(whole)[-1])
        series = [text(os.path.join(whole, name)) for name in ("energies.csv", "steps.csv", "particles.vtkhdf.series")]
        lost, done, before, late, twice = 0, 0, 0, 0, 0
        while done < kills:
            out = os.path.join(folder, "run")
            shutil.rmtree(out, ignore_errors=True)
            if not killed(program, case, out, random.uniform(0, length)):
                late += 1
                if late > 20 * kills:
                    sys.exit("the run is always over before it can be killed")
                continue
            done += 1
            before += not checkpoints(out)
            if done % 2:  # at its opening or soon after, where it cuts series back
                process = start(program, case, out, "--resume")
                time.sleep(random.uniform(0, 0.5 * length))
                process.kill()
                twice += process.wait() == -9
            undine(program, "run", case, "--out", out, "--quiet", "--resume", expect=None)
            same = [text(os.path.join(out, name)) for name in ("energies.csv", "steps.csv", "particles.vtkhdf.series")] == series
            left = [name for name in os.listdir(out) if name.endswith(".tmp")]
            if not checkpoints(out) or checksum(program, checkpoints(out)[-1]) != wanted or not same or left:
                lost += 1
                print(f"lost: kill {done}, {sorted(os.listdir(out))}")
        require(lost == 0, f"{kills} kills at random moments of a run of {length:.2f} s ({before} of them before its first checkpoint, {twice} once more after "
                           f"--resume): {lost} lost")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 50, int(sys.argv[3]) if len(sys.argv) > 3 else 1)
