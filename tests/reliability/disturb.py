#!/usr/bin/python3
"""disturb.py UNDINE CHECK

    folder       a second run in the folder of one that goes on is refused and harms nothing; when the first is gone it may
    alarm        a run that went bad and is resumed goes bad again, at the same step; without the watchdog it goes on, and nothing says any more that it
                 went bad; a particle list that is gone by then hides neither the alarm nor its exit code; SIGINT ends the way back early
    twice        a second SIGINT ends a run at once, within a long step, and leaves its checkpoint whole
    unheard      a run whose reader goes, or whose terminal does under nohup, goes on; one whose terminal is closed ends with a checkpoint; both with the same bits
    spinning     threads wait as the environment says, and briefly where it says nothing; signals and exit codes are those of one process"""
import fcntl
import os
import signal
import subprocess
import sys
import tempfile
import termios
import time

from common import ONE_THREAD, checkpoints, checksum, record, require, small_case, snapshots, text, undine


def start(program, *words, env=None, **more):
    return subprocess.Popen([program, *words, "--quiet"], env=env or ONE_THREAD, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **more)


def wait_for(holds, process, seconds=60):
    until = time.monotonic() + seconds
    while not holds():
        if process.poll() is not None or time.monotonic() > until:
            sys.exit(f"what was waited for did not come: exit {process.poll()}")
        time.sleep(0.01)


def folder(program, place):
    case, out, whole = small_case(place, end=2, checkpoints=0.02), os.path.join(place, "out"), os.path.join(place, "whole")
    undine(program, "run", case, "--out", whole, "--quiet")
    wanted = checksum(program, checkpoints(whole)[-1])
    first = start(program, "run", case, "--out", out)
    wait_for(lambda: len(checkpoints(out)) == 2, first)
    for mode in ("--resume", "--overwrite"):
        done = undine(program, "run", case, "--out", out, "--quiet", mode, expect=2)
        require("another run is writing to it" in done.stderr, f"{mode} is refused: {done.stderr.strip()}")
    require(first.poll() is None, "the first goes on meanwhile")
    require(first.wait(timeout=120) == 0 and checksum(program, checkpoints(out)[-1]) == wanted, "and ends as if nobody had come")
    require(text(os.path.join(out, "energies.csv")) == text(os.path.join(whole, "energies.csv")), "with the same series")
    first = start(program, "run", case, "--out", out, "--overwrite")
    wait_for(lambda: len(checkpoints(out)) == 2, first)
    first.kill()
    first.wait()
    undine(program, "run", case, "--out", out, "--quiet", "--resume")
    require(checksum(program, checkpoints(out)[-1]) == wanted, "one that was killed holds the folder no longer")


def bad_case(place, at):
    """Goes bad at that time (s), as its body force is no number from there on; its particles come from a list. Its only checkpoint is of the start."""
    with open(os.path.join(place, "list.csv"), "w", encoding="ascii") as rows:
        rows.write("x,y\n" + "".join(f"{0.01 + 0.02 * i:.2f},{0.01 + 0.02 * j:.2f}\n" for i in range(10) for j in range(10)))
    path = small_case(place, end=50, checkpoints=0, snapshots=0)
    case = text(path).replace('surface = "0.2 m"\nshape = { type = "box", low = [0, 0], high = [0.2, 0.2] }', 'particles = "list.csv"')
    with open(path, "w", encoding="utf-8") as file:
        file.write(case.replace("[time]", f'body_force = [0, "sqrt({at} - t)"]\n[time]', 1))
    return path


def alarm(program, place):
    case, out = bad_case(place, 0.2), os.path.join(place, "out")
    undine(program, "run", case, "--out", out, "--quiet", expect=3)
    first = record(out)["diagnosis"]
    undine(program, "run", case, "--out", out, "--quiet", "--resume", expect=3)
    again = record(out)["diagnosis"]
    require(first == again and first["cause"] == "body_force_not_finite", f"resumed, it goes bad again: step {again['step']}, {again['cause']}")
    undine(program, "run", case, "--out", out, "--quiet", "--resume", "--set", "time.end=0.1 s")
    left = [name for name in os.listdir(out) if name == "diagnosis.txt"] + os.listdir(os.path.join(out, "window"))
    require(record(out)["status"] == "finished" and "diagnosis" not in record(out) and not left, f"an end before it is sound, and nothing says otherwise: {left}")

    case, out = bad_case(place, 3), os.path.join(place, "gone")
    process = start(program, "run", case, "--out", out)
    wait_for(lambda: checkpoints(out), process)
    os.rename(os.path.join(place, "list.csv"), os.path.join(place, "list_2.csv"))
    _, errors = process.communicate(timeout=120)
    require(process.returncode == 3 and record(out)["status"] == "went bad", f"the particle list is gone by then: exit {process.returncode}")
    require("list.csv" in errors and "is not finite" in errors, f"both are told: {errors.strip()}")

    case, out = bad_case(place, 3), os.path.join(place, "way_back")
    process = start(program, "run", case, "--out", out)
    wait_for(lambda: os.path.isdir(os.path.join(out, "window")), process, 120)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=120)
    require(process.returncode == 3 and record(out)["diagnosis"]["cause"] == "body_force_not_finite",
            f"SIGINT on the way back: exit {process.returncode}, {record(out)['diagnosis']['cause']}")


def twice(program, place):
    case, out = small_case(place, spacing=0.00025, end=1, checkpoints=0, snapshots=0, energies=1), os.path.join(place, "out")
    slow = ["--set", 'scheme.backend="checked"']
    process = start(program, "run", case, "--out", out, *slow)
    wait_for(lambda: checkpoints(out), process, 300)
    time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGINT)
    time.sleep(1.2)
    if process.poll() is not None:
        print("skipped: a step takes less than a second here")
        require(process.returncode == 130, f"two at once are one: exit {process.returncode}")
        return
    process.send_signal(signal.SIGINT)
    require(process.wait(timeout=5) == -signal.SIGINT, "two at once are one; a later one ends the run at once")
    require(len(checksum(program, checkpoints(out)[-1])) == 16, "its last checkpoint is whole")


def unheard(program, place):
    case, whole = small_case(place, end=0.5, checkpoints=0), os.path.join(place, "whole")
    undine(program, "run", case, "--out", whole, "--quiet")
    wanted = checksum(program, checkpoints(whole)[-1])

    # Talks a line to a pipe at its end, and before.
    out = os.path.join(place, "pipe")
    process = subprocess.Popen([program, "run", case, "--out", out], env=ONE_THREAD, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    process.stdout.close()
    code = process.wait(timeout=120)
    require(code == 0 and record(out)["status"] == "finished" and checksum(program, checkpoints(out)[-1]) == wanted, f"nobody reads its pipe: exit {code}")

    def in_terminal(name, hang_up, seconds):
        """Its terminal is closed after three snapshots."""
        out = os.path.join(place, name)
        control, terminal = os.openpty()

        def begin():
            os.setsid()
            fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)
            signal.signal(signal.SIGHUP, hang_up)

        process = subprocess.Popen([program, "run", case, "--out", out], env=ONE_THREAD, stdin=terminal, stdout=terminal, stderr=terminal, preexec_fn=begin)
        os.close(terminal)
        wait_for(lambda: len(snapshots(out)) >= 3, process)
        os.close(control)
        return out, process.wait(timeout=seconds)

    out, code = in_terminal("nohup", signal.SIG_IGN, 120)
    require(code == 0 and record(out)["status"] == "finished" and checksum(program, checkpoints(out)[-1]) == wanted, f"its terminal is closed under nohup: exit {code}")
    out, code = in_terminal("terminal", signal.SIG_DFL, 30)
    require(code == 130 and record(out)["status"] == "interrupted", f"its terminal is closed: exit {code}, {record(out)['status']}")
    undine(program, "run", case, "--out", out, "--quiet", "--resume")
    require(checksum(program, checkpoints(out)[-1]) == wanted, "resumed, it ends with the same bits")


def spinning(program, place):
    case = small_case(place, end=30, snapshots=0)
    plain = {key: value for key, value in os.environ.items() if not key.startswith(("OMP_", "GOMP_"))}
    # The environment in use is that of the process as it was last started.
    for given, wanted in (({}, "GOMP_SPINCOUNT=1000"), ({"GOMP_SPINCOUNT": "7"}, "GOMP_SPINCOUNT=7"), ({"OMP_WAIT_POLICY": "passive"}, "OMP_WAIT_POLICY=passive"),
                          ({"OMP_NUM_THREADS": "1"}, "OMP_NUM_THREADS=1")):
        out = os.path.join(place, wanted)
        process = start(program, "run", case, "--out", out, env={**plain, **given})
        wait_for(lambda: len(checkpoints(out)) == 2, process)
        with open(f"/proc/{process.pid}/environ", encoding="utf-8") as file:
            found = sorted(line for line in file.read().split("\0") if line.startswith(("OMP_", "GOMP_")))
        with open(f"/proc/{process.pid}/comm", encoding="utf-8") as file:
            name = file.read().strip()
        # On one core nobody waits.
        require(found == [wanted] or (not given and not found and len(os.sched_getaffinity(0)) == 1), f"given {given or 'nothing'}: {found}")
        process.send_signal(signal.SIGTERM)
        require(process.wait(timeout=60) == 130 and name == os.path.basename(program)[:15], f"'{name}' still ends with its exit code")
    done = subprocess.run([program, "run", os.path.join(place, "none.toml")], env=plain, capture_output=True, text=True, check=False)
    require(done.returncode == 2 and done.stderr.count("none.toml") == 1, f"bad input is told of once: {done.stderr.strip()}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="undine_disturb_") as here:
        {check.__name__: check for check in (folder, alarm, twice, unheard, spinning)}[sys.argv[2]](os.path.abspath(sys.argv[1]), here)
