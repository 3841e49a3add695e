#!/usr/bin/env bash
# Runs fuzz targets: run.sh FOLDER SECONDS [TARGET...]
# FOLDER is where they were built (BUILD/tests/fuzz); without targets all of them run, one after the other, each for
# SECONDS. What is found new goes to FOLDER/corpus/TARGET, which the next run starts from beside the seeds of the
# repository; an input that fails to FOLDER/found, and the script ends with an error.
set -euo pipefail
build=$(realpath "$1")
seconds=$2
shift 2
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
targets=("$@")
if ((${#targets[@]} == 0)); then targets=(case expression stl csv checkpoint snapshot); fi
export OMP_NUM_THREADS=1
# Where the kernel randomizes more address bits than the sanitizers of LLVM 14 allow for, they fail at start-up.
launcher=()
if setarch -R true 2>/dev/null; then launcher=(setarch -R); fi
failed=0
for target in "${targets[@]}"; do
  corpus=$build/corpus/$target
  mkdir -p "$corpus" "$build/found"
  options=(-max_total_time="$seconds" -timeout=25 -rss_limit_mb=2048 -malloc_limit_mb=1024 -max_len=16384
    -artifact_prefix="$build/found/$target-" -print_final_stats=1 -verbosity=0 -close_fd_mask=0)
  if [[ -f $here/$target.dict ]]; then options+=(-dict="$here/$target.dict"); fi
  echo "== $target"
  "${launcher[@]}" "$build/fuzz_$target" "${options[@]}" "$corpus" "$here/seeds/$target" || failed=1
done
exit "$failed"
