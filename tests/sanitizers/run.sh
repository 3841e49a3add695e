#!/usr/bin/env bash
# All unit tests, and one step of every shipped case and study, under sanitizers, built with clang:
#   run.sh address [BUILD]   addresses, leaks, undefined behaviour
#   run.sh thread [BUILD]    data races, on 4 threads; also some steps of small cases
# BUILD is the folder to build in (build-sanitized, build-threads). The last line says what failed.
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."
kind=${1:?address or thread}
here=$PWD/tests/sanitizers
export OMP_WAIT_POLICY=passive  # two tests at a time share the cores

# Where the kernel randomizes more address bits than the sanitizers of LLVM 14 allow for, they fail at start-up.
launcher=()
if setarch -R true 2>/dev/null; then launcher=(setarch -R); fi

build() {
  local folder=$1 sanitize=$2
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -gline-tables-only" \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DUNDINE_SANITIZE="$sanitize" -DUNDINE_ARCH= -DUNDINE_TESTS=ON
  "${launcher[@]}" cmake --build "$folder" --parallel "$(nproc)" --target undine undine_unit
}

run_tests() {
  "${launcher[@]}" ctest --test-dir "$1" --output-on-failure -j2 --timeout 1800 --tests-regex '^(unit|smoke)\.'
}

case $kind in
  address)
    folder=${2:-build-sanitized}
    build "$folder" ON
    export LSAN_OPTIONS=suppressions=$here/leaks.txt
    export UBSAN_OPTIONS=print_stacktrace=1
    run_tests "$folder"
    ;;
  thread)
    folder=${2:-build-threads}
    build "$folder" thread
    # Archer tells the sanitizer of the barriers and joins of LLVM's OpenMP; libraries that are not instrumented, OpenMP's
    # own among them, are left out.
    OMP_TOOL_LIBRARIES=$(find /usr/lib/llvm-*/lib -name libarcher.so -print -quit)
    if [[ -z $OMP_TOOL_LIBRARIES ]]; then echo "run.sh: no libarcher.so; install libomp-dev" >&2 && exit 1; fi
    export OMP_TOOL_LIBRARIES OMP_NUM_THREADS=4
    export TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1:second_deadlock_stack=1
    failed=0
    run_tests "$folder" || failed=1
    out=$(mktemp -d)
    trap 'rm -rf "$out"' EXIT
    for name in dam_break_2d still_water_2d viscous/taylor_green viscous/poiseuille gas/shock_tube gas/shock_tube_recommended; do
      echo "== cases/$name.toml"
      "${launcher[@]}" "$folder/undine" run "cases/$name.toml" --threads 4 --quiet --no-report --out "$out/$name" --set "time.end=1e-3 s" || failed=1
    done
    if ((failed)); then echo "data races or failures above"; else echo "no data race"; fi
    exit "$failed"
    ;;
  *)
    echo "run.sh: say address or thread" >&2
    exit 2
    ;;
esac
