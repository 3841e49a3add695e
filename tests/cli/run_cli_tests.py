#!/usr/bin/env python3
"""Runs the undine program on inputs that it must refuse, and checks what it says.

    run_cli_tests.py UNDINE [NAME...]   runs all of bad_input/*.toml, or the named ones
    run_cli_tests.py --self-test        runs made-up inputs through made-up programs, to check these checks

Each test is a file bad_input/NAME.toml. Its leading comment lines say what is expected; every line is optional but for one:

    # expect: WORDS      standard error must contain WORDS exactly; give as many lines as wanted
    # output: WORDS      standard output must contain WORDS exactly, such as a warning; at least one `expect` or `output`
    # exit: 2            the exit code; 2 (the input is at fault) unless said
    # line: 12           standard error must contain NAME.toml:12:
    # column: 5          standard error must contain NAME.toml:12:5:
    # args: --set a=b    more words for the command line, which is `undine check NAME.toml` unless `command` is given
    # command: run X     the words of the command line in its place; {file} stands for NAME.toml, {root} for the top folder
                         of Undine, so that `run {root}/cases/a/b.toml --set a=b` tests a shipped case

Other comments may stand among them, unless they look like a key (`# lowercase:`): that is an error, so that no misspelt
expectation is passed over. The program runs in an empty folder that holds a copy of NAME.toml and of all bad_input/NAME.*
beside it (meshes, tables), and must not leave anything else there. It must end by itself, quickly, with a short message.
"""

import os
import re
import shlex
import shutil
import stat
import subprocess
import sys
import tempfile
import time

LINES_ALLOWED = 24
SECONDS_ALLOWED = 20
HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
KEY = re.compile(r"#\s*([a-z_]+):\s*(.*?)\s*$")


class BadTest(Exception):
    """The test file itself is wrong."""


class Expectation:
    """What the leading comments of a test file ask for."""

    def __init__(self, text):
        self.expect, self.output, self.args = [], [], []
        self.command = self.line = self.column = None
        self.exit = 2
        seen = set()
        for comment in text.removeprefix("\ufeff").splitlines():
            if not comment.startswith("#"):
                break
            match = KEY.match(comment)
            if match:
                key, value = match.groups()
                if key in seen and key not in ("expect", "output"):
                    raise BadTest(f"key given twice: {key}")
                seen.add(key)
                self.read(key, value)
        if not self.expect and not self.output:
            raise BadTest("no '# expect: WORDS' or '# output: WORDS' line at its top")
        if self.column is not None and self.line is None:
            raise BadTest("'# column:' needs '# line:'")
        if self.command and self.args:
            raise BadTest("'# command:' and '# args:' exclude each other")

    def read(self, key, value):
        if not value:
            raise BadTest(f"no value for '# {key}:'")
        if key in ("expect", "output"):
            getattr(self, key).append(value)
        elif key in ("exit", "line", "column"):
            if not value.isdecimal():
                raise BadTest(f"'# {key}:' needs a whole number, not {value!r}")
            setattr(self, key, int(value))
        elif key in ("args", "command"):
            setattr(self, key, shlex.split(value))
        else:
            raise BadTest(f"unknown key '# {key}:' (keys: expect, output, exit, line, column, args, command)")

    def words(self, file):
        words = self.command or ["check", "{file}"] + self.args
        return [word.replace("{file}", file).replace("{root}", ROOT) for word in words]

    def wanted(self, file):
        """All that standard error must contain."""
        place = [] if self.line is None else [f"{file}:{self.line}:"]
        if self.column is not None:
            place = [f"{file}:{self.line}:{self.column}:"]
        return self.expect + place


def run(program, expectation, folder, file):
    """Runs the program; returns what is wrong, as lines, and its standard error."""
    before = set(os.listdir(folder))
    start = time.monotonic()
    try:
        done = subprocess.run([program] + expectation.words(file), cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=SECONDS_ALLOWED, check=False)
    except subprocess.TimeoutExpired as late:
        return [f"still running after {SECONDS_ALLOWED} s"], (late.stderr or b"").decode(errors="replace")
    except OSError as error:
        return [f"cannot be started: {error}"], ""
    seconds = time.monotonic() - start
    message = done.stderr.decode(errors="replace")
    wrong = []
    if done.returncode < 0:
        wrong.append(f"died by signal {-done.returncode}")
    elif done.returncode != expectation.exit:
        wrong.append(f"exit code {done.returncode}, expected {expectation.exit}")
    if seconds >= SECONDS_ALLOWED:
        wrong.append(f"took {seconds:.1f} s; less than {SECONDS_ALLOWED} s are allowed")
    wrong += [f"not in standard error: {words}" for words in expectation.wanted(file) if words not in message]
    printed = done.stdout.decode(errors="replace")
    wrong += [f"not in standard output: {words}" for words in expectation.output if words not in printed]
    count = len(message.splitlines())
    if count > LINES_ALLOWED:
        wrong.append(f"{count} lines in standard error; at most {LINES_ALLOWED} are allowed")
    wrong += [f"left behind: {name}" for name in sorted(set(os.listdir(folder)) - before)]
    return wrong, message


def run_test(program, inputs, name):
    """Runs one test and prints its outcome; true if it passed."""
    file, message = name + ".toml", ""
    try:
        with open(os.path.join(inputs, file), encoding="utf-8", errors="replace") as source:
            expectation = Expectation(source.read())
        with tempfile.TemporaryDirectory(prefix="undine_cli_") as folder:
            for other in os.listdir(inputs):
                if other.startswith(name + "."):
                    shutil.copy(os.path.join(inputs, other), folder)
            wrong, message = run(program, expectation, folder, file)
    except (BadTest, OSError, ValueError) as error:
        wrong = [f"the test itself is wrong: {error}"]
    print(f"{'not ok' if wrong else 'ok'} {name}")
    for line in wrong:
        print(f"    {line}")
    if wrong and message:
        print("    standard error was:")
        for line in message.splitlines()[:40]:
            print(f"    | {line}")
    return not wrong


def run_all(program, inputs, names):
    """Returns the number of tests, and the names of those that failed."""
    if not names:
        names = sorted(name[: -len(".toml")] for name in os.listdir(inputs) if name.endswith(".toml"))
    failed = [name for name in names if not run_test(program, inputs, name)]
    print(f"{len(names) - len(failed)} passed, {len(failed)} failed")
    return len(names), failed


# ---- The check of the checks -----------------------------------------------------------------------------------------

GOOD_PROGRAM = 'echo "$2:3:5: unknown key \\"foo\\"" >&2; exit 2'
HEADER = "# expect: unknown key\n"
# name, test file, shell program, whether it must pass.
EXAMPLES = [
    ("good", HEADER + '# expect: "foo"\n# A word: of prose.\n# line: 3\n# column: 5\nfoo = 1\n', GOOD_PROGRAM, True),
    ("good_line", HEADER + "# line: 3\n", GOOD_PROGRAM, True),
    ("good_args", "# expect: [check] [good_args.toml] [--set] [a b]\n# args: --set 'a b'\n",
     'printf "[%s] " "$@" >&2; exit 2', True),
    ("good_command", "# expect: [run] [good_command.toml]\n# exit: 0\n# command: run {file}\n",
     'printf "[%s] " "$@" >&2', True),
    ("good_output", "# output: warning\n# output: slow\n# exit: 0\n", "echo warning: too slow", True),
    ("other_output", "# output: warning\n# exit: 0\n", "echo warning >&2", False),
    ("good_root", "# expect: LICENSE\n# command: list {root}\n", 'ls "$2" >&2; exit 2', True),
    ("other_words", "# expect: unknown value\n", GOOD_PROGRAM, False),
    ("other_words_second", HEADER + "# expect: bar\n", GOOD_PROGRAM, False),
    ("other_line", HEADER + "# line: 4\n", GOOD_PROGRAM, False),
    ("other_column", HEADER + "# line: 3\n# column: 6\n", GOOD_PROGRAM, False),
    ("other_exit", HEADER, "echo unknown key >&2; exit 3", False),
    ("wrong_stream", HEADER, "echo unknown key; exit 2", False),
    ("signal", HEADER, "echo unknown key >&2; kill -SEGV $$", False),
    ("leaves_folder", HEADER, "mkdir out; echo unknown key >&2; exit 2", False),
    ("long", HEADER, "for k in $(seq 25); do echo unknown key >&2; done; exit 2", False),
    ("not_long", HEADER, "for k in $(seq 24); do echo unknown key >&2; done; exit 2", True),
    ("slow", HEADER, "echo unknown key >&2; exec sleep 5", False),
    ("no_expectation", "foo = 1\n" + HEADER, GOOD_PROGRAM, False),
    ("misspelt", HEADER + "# lne: 4\n", GOOD_PROGRAM, False),
    ("column_alone", HEADER + "# column: 5\n", GOOD_PROGRAM, False),
    ("no_number", HEADER + "# line: three\n", GOOD_PROGRAM, False),
]


def self_test():
    global SECONDS_ALLOWED
    SECONDS_ALLOWED = 2
    surprises = []
    with tempfile.TemporaryDirectory(prefix="undine_cli_") as inputs:
        for name, text, script, must_pass in EXAMPLES:
            program = os.path.join(inputs, "program " + name)
            with open(program, "w", encoding="utf-8") as file:
                file.write("#!/bin/sh\n" + script + "\n")
            os.chmod(program, stat.S_IRWXU)
            with open(os.path.join(inputs, name + ".toml"), "w", encoding="utf-8") as file:
                file.write(text)
            if run_test(program, inputs, name) != must_pass:
                surprises.append(name)
        if run_test(os.path.join(inputs, "no such program"), inputs, "good"):
            surprises.append("no such program")
    print(f"{len(EXAMPLES) + 1} examples; wrongly judged: {', '.join(surprises) or 'none'}")
    return not surprises


def main(arguments):
    if arguments == ["--self-test"]:
        return 0 if self_test() else 1
    if not arguments or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    count, failed = run_all(os.path.abspath(arguments[0]), os.path.join(HERE, "bad_input"), arguments[1:])
    return 1 if failed or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
