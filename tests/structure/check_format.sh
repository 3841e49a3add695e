#!/usr/bin/env bash
# Checks every C++ and CUDA file of src, tests and bench against .clang-format. To mend what it names: clang-format -i FILE.
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."

# Other versions lay out a few constructs differently; Debian 12 has version 14.
formatter=$(command -v clang-format-14 || command -v clang-format) || {
  echo "check_format.sh: no clang-format; install it, or run ./quickstart.sh test, which does" >&2
  exit 1
}

files=()
while IFS= read -r -d '' file; do files+=("$file"); done < <(
  for folder in src tests bench; do
    if [[ -d $folder ]]; then
      find "$folder" -type f \( -name '*.hpp' -o -name '*.cpp' -o -name '*.cu' -o -name '*.cuh' \) -print0
    fi
  done | sort -z
)
if ((${#files[@]} == 0)); then
  echo "check_format.sh: found no files" >&2
  exit 1
fi
"$formatter" --version
"$formatter" --dry-run -Werror "${files[@]}"
echo "${#files[@]} files are well formatted"
