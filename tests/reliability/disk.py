#!/usr/bin/python3
"""disk.py UNDINE CHECK: what a run does when it cannot write: an error that says so, exit code 4, and everything written before as it was.

    full         the output folder is a small file system that fills up (where mounting one is not permitted: a limit on file sizes)
    read_only    the output folder cannot be written any more
    vanish       a series is removed under the run's hands, and the whole folder, also while a checkpoint is half written"""
import glob
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from common import ONE_THREAD, checkpoints, checksum, require, small_case, undine

MOUNTED = "--in-a-mount"


def sound(program, out):
    """All that stands in the folder under a final name is whole; returns how many snapshots and checkpoints."""
    files = glob.glob(os.path.join(out, "*.vtkhdf")) + checkpoints(out)
    for file in files:
        require(len(checksum(program, file)) == 16, f"{os.path.basename(file)} is whole")
    if os.path.exists(os.path.join(out, "run.json")):
        json.load(open(os.path.join(out, "run.json"), encoding="utf-8"))
    return len(files)


def complains(done, *words):
    require(done.returncode == 4, f"exit {done.returncode} (4: output could not be written)")
    for word in words:
        require(word in done.stderr, f"it says '{word}': {done.stderr.strip()[:300]}")
    require("internal error" not in done.stderr, "no internal error")


def can_mount():
    done = subprocess.run(["unshare", "--mount", "--map-root-user", "mount", "-t", "tmpfs", "tmpfs", tempfile.gettempdir()], capture_output=True,
                          check=False)
    return done.returncode == 0


def in_a_mount(program, check):
    """Runs the check again where it may mount what it likes."""
    done = subprocess.run(["unshare", "--mount", "--map-root-user", sys.executable, __file__, program, check, MOUNTED], env=ONE_THREAD, check=False)
    sys.exit(done.returncode)


def mount(out, *options):
    os.makedirs(out, exist_ok=True)
    subprocess.run(["mount", *options, "-t", "tmpfs", "tmpfs", out], check=True)


def full(program, folder, mounted):
    out = os.path.join(folder, "out")
    case = small_case(folder, snapshots=0.002)
    if mounted:
        mount(out, "-o", "size=400k")
        done = undine(program, "run", case, "--out", out, "--quiet", expect=None)
        complains(done, "No space left on device", "free some space")
    else:
        print("        mounting is not permitted: files may not grow beyond 40 kB instead")

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
        done = undine(program, "run", small_case(folder, snapshots=0.002, energies=0.0002), "--out", out, "--quiet", expect=None,
                      preexec_fn=limit)
        complains(done, "File too large")
    require(sound(program, out) > 3, "what was written before the disk was full is whole")
    require(not glob.glob(os.path.join(out, "*.tmp")), "nothing half written is left")
    if mounted:
        subprocess.run(["mount", "-o", "remount,size=40m", out], check=True)
    whole = os.path.join(folder, "whole")
    undine(program, "run", case, "--out", whole, "--quiet")
    undine(program, "run", case, "--out", out, "--quiet", "--resume")
    same = checksum(program, checkpoints(out)[-1]) == checksum(program, checkpoints(whole)[-1])
    require(same, "with room again, --resume ends with the checksum of an undisturbed run")


def interfere(program, folder, out, change, during="", checkpoints=0.02):
    """Starts a long run, changes something once it has written snapshots (and, if asked, while a file with that ending is there), and waits
    for its end."""
    case = small_case(folder, end=20, snapshots=0.005, checkpoints=checkpoints)
    process = subprocess.Popen([program, "run", case, "--out", out, "--quiet"], env=ONE_THREAD, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    while len(glob.glob(os.path.join(out, "*.vtkhdf"))) < 4 and process.poll() is None:
        time.sleep(0.01)
    while during and not any(name.endswith(during) for name in os.listdir(out)) and process.poll() is None:
        pass
    change()
    _, errors = process.communicate(timeout=60)
    return subprocess.CompletedProcess([], process.returncode, "", errors)


def read_only(program, folder, mounted):
    out = os.path.join(folder, "out")
    if mounted:
        mount(out, "-o", "size=40m")
        # A file system that is still written to cannot be made read-only; a lazy unmount and a read-only copy of it can.
        def change():
            copy = os.path.join(folder, "copy")
            for _ in range(50):  # files come and go while they are copied
                try:
                    shutil.rmtree(copy, ignore_errors=True)
                    shutil.copytree(out, copy, ignore=shutil.ignore_patterns("*.tmp", "*.checkpoint"))
                    break
                except (shutil.Error, OSError):
                    continue
            subprocess.run(["mount", "--bind", copy, out], check=True)
            subprocess.run(["mount", "-o", "remount,ro,bind", out], check=True)
    else:
        if os.geteuid() == 0:
            print("skipped: root may write everywhere, and mounting is not permitted")
            return
        def change():
            os.chmod(out, 0o555)
    done = interfere(program, folder, out, change)
    complains(done, "cannot")
    # Between a temporary file and its name the swap of the folder itself may be what is met.
    reasons = ("Read-only file system", "No such file or directory") if mounted else ("Permission denied",)
    require(any(reason in done.stderr for reason in reasons), f"it says why: {done.stderr.strip()[:300]}")
    require(sound(program, out) > 3, "what was written before is whole")


def vanish(program, folder, _):
    out = os.path.join(folder, "series")
    done = interfere(program, folder, out, lambda: os.remove(os.path.join(out, "energies.csv")))
    complains(done, "energies.csv' is gone", "--resume")
    require(sound(program, out) > 3, "what was written before is whole")
    out = os.path.join(folder, "folder")
    done = interfere(program, folder, out, lambda: os.rename(out, out + "_moved"))
    complains(done, "check that the folder exists" if "is gone" not in done.stderr else "is gone")
    require(sound(program, out + "_moved") > 3, "what was written before is whole")
    # Ten tries, as the moment between two system calls is met by chance.
    for number in range(10):
        out = os.path.join(folder, f"half_{number}")
        done = interfere(program, folder, out, lambda at=out: os.rename(at, at + "_moved"), during=".checkpoint.tmp", checkpoints=0.002)
        complains(done, "check that the folder exists" if "is gone" not in done.stderr else "is gone")
        require(sound(program, out + "_moved") > 3, "what was written before is whole")


if __name__ == "__main__":
    binary, name = sys.argv[1:3]
    inside = MOUNTED in sys.argv
    if name != "vanish" and not inside and can_mount():
        in_a_mount(binary, name)
    with tempfile.TemporaryDirectory(prefix="undine_disk_", ignore_cleanup_errors=True) as place:
        try:
            {"full": full, "read_only": read_only, "vanish": vanish}[name](os.path.abspath(binary), place, inside)
        finally:
            if inside:
                subprocess.run(["umount", "--lazy", "--recursive", os.path.join(place, "out")], check=False, capture_output=True)
