#!/usr/bin/env bash
# build.sh NPM PYTHON FOLDER: builds the page into FOLDER, types checked, and compares it with the one that is checked in.
set -euo pipefail
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$here/../../viewer"
"$1" run check
"$1" exec -- vite build --outDir "$3" --emptyOutDir
"$2" "$here/check_fresh.py" "$3/page.html"
