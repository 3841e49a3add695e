#!/usr/bin/env python3
"""Checks the rules of layout that no compiler checks. Prints each violation as file:line: message; exits 1 if there is one.

    check_structure.py              checks the tree that this file lies in
    check_structure.py FOLDER       checks another tree
    check_structure.py --self-test  checks that each rule is really enforced
"""

import os
import re
import sys
import tempfile

# ---- The rules -------------------------------------------------------------------------------------------------------

PHYSICS = {"kernels", "materials", "terms", "walls", "gravity", "solids"}
EVERYTHING = {"*"}

# Folder of src/undine: the folders that it may include, besides itself. A folder that is not here is an error.
ARROWS = {
    "core": set(),
    **{folder: {"core"} for folder in PHYSICS},
    "geometry": {"core"},
    "integrators": {"core"},
    "search": {"core"},
    "backend": {"core", "search"},
    "engine": {"core", "search", "backend"},
    "schemes": {"core", "integrators", "engine"} | PHYSICS,
    "approximation": {"core", "search"},
    "io": {"core", "geometry", "search", "engine"},
    "analysis": {"core", "geometry", "io"},
    "app": EVERYTHING,
}

# (folder, included folder): why this arrow is allowed although the table above has it not.
ARROW_EXCEPTIONS = {
    ("engine", "kernels"): "the kernel is evaluated in the pair loop, once for all terms",
    ("schemes", "backend"): "which backend runs the sweeps is one of a scheme's options",
    ("backend", "kernels"): "the kernel is evaluated in the pair loop, once for all terms",
    ("approximation", "kernels"): "an approximation is made of a kernel and its corrections",
}

# Files of src/undine itself, and the folder whose rules they follow.
ROOT_FILES = {"fields.def": "core", "undine.hpp": "app"}

# Preprocessor lines other than #include and #pragma: all of them in these folders and in *.def files; #define and #undef
# also in a file that expands a list (that includes a *.def file); and all of them in the files named with a reason.
PREPROCESSOR_FOLDERS = {"core", "backend"}
PREPROCESSOR_FILES = {
    "src/undine/io/hdf5_file.cpp": "instantiates its members for each number type of HDF5",
    "src/undine/io/hdf5_write.cpp": "instantiates its members for each number type of HDF5",
    # "src/undine/folder/file.hpp": "reason",
}

LINES_WARNED, LINES_ALLOWED = 400, 800
LONG_FILES = {
    "src/undine/schemes/weakly_compressible_impl.hpp": "the moves, the plan and the accounts of one scheme",
    "tests/unit/kernels/kernel_test.cpp": "every property of every kernel, generated from the list",
    "tests/unit/terms/terms_test.cpp": "every property of every term, generated from the lists",
    "src/undine/engine/sweep_loop.hpp": "the pair loop from records to sums, which is compiled as one piece",
    # "src/undine/folder/file.hpp": "why it has more than LINES_WARNED lines" (no warning then; LINES_ALLOWED still holds)
}

SOURCE_SUFFIXES = (".hpp", ".cpp", ".cu", ".cuh", ".def", ".py", ".sh", ".ts", ".js")
HEADER_SUFFIXES = (".h", ".hpp", ".cuh")
TEXT_SUFFIXES = SOURCE_SUFFIXES + (".toml", ".txt", ".cmake", ".md", ".html", ".css", ".yml", ".yaml", ".json")
FOLDERS_PASSED_OVER = {".git", "__pycache__", "node_modules", "venv", ".venv"}
TOP_FOLDERS_PASSED_OVER = re.compile(r"build.*|out.*")
CASE_FOLDERS = ("cases/", "studies/")

FORBIDDEN = [
    (re.compile(r"(?<![\w.~*})\]>/-])/(?:work|root|home|Users|mnt|scratch)(?:/|\b)"), "absolute path: {}"),
    (re.compile(r"\b(?:TO" r"DO|FIX" r"ME)\b"), "unfinished work: {}; finish it, or describe it in the docs"),
]

# ---- The checks ------------------------------------------------------------------------------------------------------

QUOTED_INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')
ANY_INCLUDE = re.compile(r'\s*#\s*include\s*["<]([^">]+)[">]')
DIRECTIVE = re.compile(r"\s*#\s*([a-z]+)")


def folder_of(path):
    """The folder of src/undine whose rules the path (relative to src/undine) follows; None where no rule is known."""
    head, slash, _ = path.partition("/")
    if not slash:
        return ROOT_FILES.get(path)
    return head if head in ARROWS else None


def without_comments(lines):
    """The lines with // and /* */ comments blanked; good enough for directives, which never stand in a string."""
    inside = False
    for line in lines:
        kept = ""
        while line:
            if inside:
                _, end, line = line.partition("*/")
                inside = not end
            else:
                match = re.search(r"//|/\*", line)
                kept += line[: match.start()] if match else line
                inside = bool(match) and match.group() == "/*"
                line = line[match.end():] if inside else ""
        yield kept


def check_includes(path, lines):
    inner = path.removeprefix("src/undine/")
    folder = folder_of(inner)
    if folder is None:
        yield 1, f"unknown place {inner}; every folder needs a line in ARROWS of check_structure.py"
        return
    allowed = ARROWS[folder] | {folder, "core"}
    for number, line in enumerate(lines, 1):
        quoted = QUOTED_INCLUDE.match(line)
        if quoted and not quoted.group(1).startswith("undine/"):
            yield number, f'write the include from src/: "undine/...", not "{quoted.group(1)}"'
        include = ANY_INCLUDE.match(line)
        if not include or not include.group(1).startswith("undine/"):
            continue
        target = folder_of(include.group(1).removeprefix("undine/"))
        if target is None:
            yield number, f"include from an unknown place: {include.group(1)}"
        elif target not in allowed and allowed.isdisjoint(EVERYTHING) and (folder, target) not in ARROW_EXCEPTIONS:
            yield number, f"{folder} may not include {target}; it may include {', '.join(sorted(allowed - {folder}))}"


def check_preprocessor(path, lines):
    inner = path.removeprefix("src/undine/")
    if inner.split("/")[0] in PREPROCESSOR_FOLDERS or path.endswith(".def") or path in PREPROCESSOR_FILES:
        return
    expands_list = any(match and match.group(1).endswith(".def") for match in map(ANY_INCLUDE.match, lines))
    for number, line in enumerate(lines, 1):
        directive = DIRECTIVE.match(line)
        if not directive or directive.group(1) in ("include", "pragma"):
            continue
        if expands_list and directive.group(1) in ("define", "undef"):
            continue
        yield number, (f"#{directive.group(1)} outside core/, backend/ and the expansion of a list; "
                       "use a template, a constant or if constexpr")


def check_length(path, lines):
    if len(lines) > LINES_ALLOWED:
        yield LINES_ALLOWED + 1, f"{len(lines)} lines; at most {LINES_ALLOWED} are allowed, split the file"


def check_words(path, lines):
    for number, line in enumerate(lines, 1):
        if number == 1 and line.startswith("#!"):
            continue
        for pattern, message in FORBIDDEN:
            for match in pattern.finditer(line):
                yield number, message.format(match.group())


def check_file(path, lines):
    """The violations of one file, as (line, message)."""
    if path.endswith(TEXT_SUFFIXES) or "." not in os.path.basename(path):
        yield from check_words(path, lines)
    if path.endswith(SOURCE_SUFFIXES):
        yield from check_length(path, lines)
    code = list(without_comments(lines))
    if path.startswith("src/undine/") and path.endswith(SOURCE_SUFFIXES + HEADER_SUFFIXES):
        yield from check_includes(path, code)
        yield from check_preprocessor(path, code)
    if path.endswith(HEADER_SUFFIXES) and not any(re.fullmatch(r"\s*#\s*pragma\s+once\s*", line) for line in code):
        yield 1, "no #pragma once"
    if path.startswith(CASE_FOLDERS) and path.endswith(".toml") and not (lines and lines[0].startswith("#")):
        yield 1, "a case file begins with a comment: what it shows, and its source"


def files_below(root):
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(set(folders) - FOLDERS_PASSED_OVER)
        if folder == root:
            folders[:] = [name for name in folders if not TOP_FOLDERS_PASSED_OVER.fullmatch(name)]
        for name in sorted(names):
            path = os.path.join(folder, name)
            if os.path.isfile(path) and (name.endswith(TEXT_SUFFIXES + HEADER_SUFFIXES) or "." not in name):
                yield os.path.relpath(path, root)


def check_tree(root):
    """All violations as lines of text, all warnings, and the number of files."""
    violations, warnings, count = [], [], 0
    for path in files_below(root):
        count += 1
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            lines = file.read().splitlines()
        violations += [f"{path}:{number}: {message}" for number, message in check_file(path, lines)]
        long = LINES_WARNED < len(lines) <= LINES_ALLOWED
        if long and path.endswith(SOURCE_SUFFIXES) and path not in LONG_FILES:
            warnings.append(f"{path}:{LINES_WARNED + 1}: warning: {len(lines)} lines; give the reason in LONG_FILES of "
                            "check_structure.py, or split the file")
    for path in list(LONG_FILES) + list(PREPROCESSOR_FILES):
        if not os.path.isfile(os.path.join(root, path)):
            violations.append(f"tests/structure/check_structure.py:1: the table names {path}, which is not there")
    return violations, warnings, count


# ---- The check of the checks -----------------------------------------------------------------------------------------

# path, contents, what the violation must say and its line (None: there must be no violation).
ONCE = "#pragma once\n"
EXAMPLES = [
    ("src/undine/terms/viscosity/a.hpp", ONCE + '#include "undine/core/vec.hpp"\n', None),
    ("src/undine/terms/b.hpp", ONCE + '#include "undine/engine/sweep.hpp"\n', "2: terms may not include engine"),
    ("src/undine/terms/c.hpp", ONCE + '#include "undine/kernels/wendland.hpp"\n', "2: terms may not include kernels"),
    ("src/undine/engine/d.hpp", ONCE + "#include <undine/terms/b.hpp>\n", "2: engine may not include terms"),
    ("src/undine/engine/e.hpp", ONCE + '#include "undine/kernels/a.hpp"\n#include "undine/backend/a.hpp"\n', None),
    ("src/undine/search/f.hpp", ONCE + '#include "undine/schemes/a.hpp"\n', "2: search may not include schemes"),
    ("src/undine/io/g.cpp", '// x\n#  include "undine/walls/a.hpp"\n', "2: io may not include walls"),
    ("src/undine/schemes/h.cpp", '#include "undine/terms/a.hpp"\n#include "undine/engine/a.hpp"\n', None),
    ("src/undine/app/i.cpp", '#include "undine/terms/a.hpp"\n#include "undine/io/a.hpp"\n', None),
    ("src/undine/core/j.hpp", ONCE + '#include "undine/fields.def"\n', None),
    ("src/undine/core/k.hpp", ONCE + '#include "undine/io/a.hpp"\n', "2: core may not include io"),
    ("src/undine/novel/l.cpp", "\n", "1: unknown place"),
    ("src/undine/io/m.cpp", '#include "undine/novel/a.hpp"\n', "1: include from an unknown place"),
    ("src/undine/io/n.cpp", '#include "../io/a.hpp"\n', "1: write the include from src/"),
    ("src/undine/io/o.cpp", '// #include "undine/terms/a.hpp"\n/* a\n#define X\n*/\n', None),
    ("src/undine/io/p.cpp", "int x;\n#ifdef X\n#endif\n", "2: #ifdef outside"),
    ("src/undine/io/q.cpp", "#define FIELD(x) x\n#include \"undine/fields.def\"\n#undef FIELD\n", None),
    ("src/undine/io/r.cpp", "#include \"undine/fields.def\"\n# if X\n# endif\n", "2: #if outside"),
    ("src/undine/core/s.cpp", "#ifdef X\n#define Y\n#endif\n", None),
    ("src/undine/io/t.hpp", "int x;\n// #pragma once\n", "1: no #pragma once"),
    ("tests/unit/u.hpp", "int x;\n", "1: no #pragma once"),
    ("src/undine/io/v.cpp", "\n" * 801, "801: 801 lines; at most 800"),
    ("src/undine/io/w.cpp", "\n" * 800, None),
    ("tests/unit/x.cpp", 'auto f = "/' 'root/a";\n', "1: absolute path"),
    ("docs/y.md", "\nin /" "work/main\n", "2: absolute path"),
    ("docs/z.md", "https://example.org/home/a, cases/work/b, force/work, ../root\n", None),
    ("src/undine/io/aa.cpp", "\n// TO" "DO: more\n", "2: unfinished work"),
    ("cases/a/bb.toml", "x = 1\n", "1: a case file begins with a comment"),
    ("cases/a/cc.toml", "# Source\nx = 1\n", None),
    ("build-x/dd.cpp", "// TO" "DO\n", None),
    ("src/undine/io/output/ee.cpp", "// TO" "DO\n", "1: unfinished work"),
]


def self_test():
    failures = 0
    with tempfile.TemporaryDirectory() as root:
        for path, contents, _ in EXAMPLES:
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(contents)
        violations, _, _ = check_tree(root)
    for path, _, expected in EXAMPLES:
        found = [violation for violation in violations if violation.startswith(path + ":")]
        good = (len(found) >= 1 and found[0].startswith(f"{path}:{expected}")) if expected else not found
        if not good:
            failures += 1
            print(f"self-test: {path}: expected {expected or 'no violation'}, found {found or 'none'}")
    print(f"{len(EXAMPLES)} examples, {failures} failed")
    return failures == 0


def main(arguments):
    if arguments == ["--self-test"]:
        return 0 if self_test() else 1
    root = arguments[0] if arguments else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
    violations, warnings, count = check_tree(root)
    for line in warnings + violations:
        print(line)
    print(f"{count} files, {len(violations)} violations, {len(warnings)} warnings")
    return 1 if violations or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
