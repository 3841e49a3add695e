#!/usr/bin/env bash
# packages.sh NPM: installs what viewer/package-lock.json names, unless it is there already.
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")/../../viewer"
if cmp -s package-lock.json node_modules/.installed-lock.json; then
  echo "all packages are there"
  exit 0
fi
"$1" ci --ignore-scripts --no-audit --no-fund
cp package-lock.json node_modules/.installed-lock.json
