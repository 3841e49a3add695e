#!/usr/bin/env python3
"""Checks that viewer/dist/page.html, which is checked in, was built from the sources in viewer/.

    check_fresh.py           compares the hash in the page with that of the sources; needs no npm
    check_fresh.py BUILT     also compares the page with one just built, byte by byte
"""

import hashlib
import os
import re
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "viewer")
SINGLE = ["index.html", "package.json", "package-lock.json", "tsconfig.json", "vite.config.ts", "colour_maps.json"]


def hash_of_sources():
    """As hashOfSources in viewer/vite.config.ts."""
    paths = list(SINGLE)
    for folder, _, names in os.walk(os.path.join(ROOT, "src")):
        paths += [os.path.relpath(os.path.join(folder, name), ROOT).replace(os.sep, "/") for name in names]
    total = hashlib.sha256()
    for path in sorted(paths):
        with open(os.path.join(ROOT, path), "rb") as file:
            data = file.read()
        total.update(f"{path} {len(data)}\n".encode() + data)
    return total.hexdigest()


def main(arguments):
    with open(os.path.join(ROOT, "dist", "page.html"), "rb") as file:
        page = file.read()
    found = re.search(rb'<meta name="undine-sources" content="([0-9a-f]{64})">', page)
    if not found:
        print("viewer/dist/page.html names no hash of its sources")
        return 1
    if found.group(1).decode() != hash_of_sources():
        print("viewer/dist/page.html is not the page of the sources in viewer/; run `npm ci && npm run build` there, "
              "and check in dist/page.html")
        return 1
    if arguments:
        with open(arguments[0], "rb") as file:
            if file.read() != page:
                print(f"{arguments[0]}, built from the same sources, differs from viewer/dist/page.html")
                return 1
    with open(os.path.join(ROOT, "package-lock.json"), encoding="utf-8") as file:
        if '"resolved"' in file.read():
            print("viewer/package-lock.json names the hosts that packages were fetched from; .npmrc there avoids it")
            return 1
    print(f"viewer/dist/page.html is fresh, {len(page)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
