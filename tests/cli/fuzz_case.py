#!/usr/bin/env python3
"""Gives damaged copies of a case to `undine check`, which must answer each with exit code 0 or 2.

    fuzz_case.py UNDINE [--case FILE] [--count 200] [--seed 1]

Each copy has one to four random changes: bytes or lines removed, doubled, swapped or made up, numbers and words replaced
by ones that have broken programs before. The same seed gives the same copies. A copy fails if the program dies by a
signal, takes 20 s, uses more than 4 GiB, exits with another code, refuses it in silence, or leaves a file behind. Failed
copies are printed.
"""

import argparse
import os
import random
import re
import resource
import subprocess
import sys
import tempfile

SECONDS_ALLOWED = 20
BYTES_ALLOWED = 4 << 30
HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
WORD = re.compile(r"[a-z_]{3,}")
NUMBERS = ["0", "-1", "1e-9", "1e9", "1e300", "-1e300", "1e-320", "nan", "inf", "-inf", "9223372036854775807", "0x7f",
           "1_000", "007", "1e999", "2024-02-30", "", "[1, 2]", "{}", '"1 m"', "true"]
PIECES = ["[", "]", "{", "}", '"', "'", '"""', "=", ",", ".", "#", "\\", "\n", "\r", "\0", "\t", "[[", "]]", "\u00e9", "\ufeff",
          "a.b.c.", "(" * 300, "[" * 300, "x" * 5000, "\\u0000", "../" * 50, "%s%n", "1/0", "sqrt(-1)"]


def spans(pattern, text):
    return [found.span() for found in pattern.finditer(text)]


def replace(random_, text, pattern, make):
    """Replaces one match of the pattern, if there is any."""
    places = spans(pattern, text)
    if not places:
        return text
    begin, end = random_.choice(places)
    return text[:begin] + make(text[begin:end]) + text[end:]


def change_number(r, text):
    return replace(r, text, NUMBER, lambda old: r.choice(NUMBERS))


def scale_number(r, text):
    return replace(r, text, NUMBER, lambda old: repr(float(old) * 10 ** r.randint(-6, 6)))


def change_word(r, text):
    words = [text[begin:end] for begin, end in spans(WORD, text)] or ["word"]
    return replace(r, text, WORD, lambda old: r.choice(words))


def misspell(r, text):
    return replace(r, text, WORD, lambda old: old[:1] + r.choice("qxz_") + old[2:])


def insert_piece(r, text):
    at = r.randint(0, len(text))
    return text[:at] + r.choice(PIECES) + text[at:]


def change_character(r, text):
    at = r.randrange(max(1, len(text)))
    return text[:at] + chr(r.choice([r.randrange(128), r.randrange(0x80, 0x3000)])) + text[at + 1 :]


def cut(r, text):
    begin = r.randint(0, len(text))
    return text[:begin] + text[begin + r.randint(1, 80) :]


def cut_off(r, text):
    return text[: r.randint(0, len(text))]


def change_lines(r, text):
    lines = text.split("\n")
    a, b = r.randrange(len(lines)), r.randrange(len(lines))
    what = r.choice(["remove", "double", "swap"])
    if what == "remove":
        del lines[a]
    elif what == "double":
        lines.insert(b, lines[a])
    else:
        lines[a], lines[b] = lines[b], lines[a]
    return "\n".join(lines)


CHANGES = [change_number, change_number, scale_number, change_word, misspell, insert_piece, change_character, cut, cut_off,
           change_lines, change_lines]


def damaged(text, r):
    for _ in range(r.randint(1, 4)):
        text = r.choice(CHANGES)(r, text)
    return text


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES_ALLOWED, BYTES_ALLOWED))


def fault(program, folder, data):
    """What is wrong with the program's answer, and its exit code."""
    file = os.path.join(folder, "case.toml")
    with open(file, "wb") as target:
        target.write(data)
    try:
        # Two threads, so that stacks of many threads do not count against the memory.
        done = subprocess.run([program, "check", "case.toml", "--threads", "2"], cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=SECONDS_ALLOWED, check=False,
                              preexec_fn=limit_memory)
    except subprocess.TimeoutExpired:
        return f"still running after {SECONDS_ALLOWED} s", None
    message = done.stderr.decode(errors="replace")
    left = sorted(set(os.listdir(folder)) - {"case.toml"})
    if done.returncode < 0:
        return f"died by signal {-done.returncode}", None
    if done.returncode not in (0, 2):
        return f"exit code {done.returncode}: {message[:400]}", None
    if done.returncode == 2 and "case.toml" not in message:
        return f"the message does not name the file: {message[:400]}", None
    if left:
        return f"left behind: {', '.join(left)}", None
    return None, done.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("undine")
    parser.add_argument("--case", default=os.path.join(ROOT, "cases", "still_water_2d.toml"))
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with open(options.case, encoding="utf-8") as source:
        text = source.read()
    failed, codes = 0, {0: 0, 2: 0}
    with tempfile.TemporaryDirectory(prefix="undine_fuzz_") as folder:
        for k in range(options.count):
            data = damaged(text, random.Random(f"{options.seed} {k}")).encode("utf-8", errors="replace")
            wrong, code = fault(os.path.abspath(options.undine), folder, data)
            if wrong is None:
                codes[code] += 1
                continue
            failed += 1
            print(f"not ok, seed {options.seed}, copy {k}: {wrong}\n{data.decode(errors='replace')}\n----")
    print(f"{options.count} copies: {codes[2]} refused, {codes[0]} accepted, {failed} failed")
    return 1 if failed or options.count < 1 else 0


if __name__ == "__main__":
    sys.exit(main())
