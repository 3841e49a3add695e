#!/usr/bin/env bash
# Sets up, builds, runs and tests Undine on a bare Debian 12 machine. `./quickstart.sh help` says how.
set -euo pipefail
exec </dev/null
cd -P "$(dirname "${BASH_SOURCE[0]}")"

main_case=cases/dam_break/spheric2.toml
build_packages=(g++ cmake ninja-build ccache libtomlplusplus-dev libcli11-dev libfmt-dev libhdf5-dev libeigen3-dev
  libgtest-dev libgmock-dev librapidcheck-dev nlohmann-json3-dev zlib1g-dev libcairo2-dev libcpp-httplib-dev pkg-config)
test_packages=(clang llvm libclang-rt-dev libomp-dev clang-format python3 python3-vtk9 python3-h5py python3-numpy chromium ffmpeg)
# Where another source brought npm with its nodejs, Debian's npm would not go with it.
if ! command -v npm >/dev/null; then test_packages+=(nodejs npm); fi
seconds_per_test=900
passed=0
failed=0
skipped=0
launcher=()  # goes before the commands that run what was built with sanitizers

usage() {
  cat <<'TEXT'
Usage: ./quickstart.sh [COMMAND]

  (none)  install what is missing, build build/undine, run the dam break of SPHERIC test 2 into out/spheric2
  build   install what is missing and build build/undine, no more
  test    install what is missing for the tests too, build everything, and run the format check, the structure check,
          all tests, a short bench into out/bench.json (not judged), and, with the address and undefined-behaviour
          sanitizers, the unit tests once more and half a minute of fuzzing; the last line is "N passed, N failed"
  help    this text

Packages are installed with apt-get, through sudo where the user is not root. Where nothing is missing, neither is called.
TEXT
}

# step NAME COMMAND...: names the step, runs the command, says how many seconds it took, and returns its status.
# Inside the command `set -e` has no effect (its status is asked for), so step functions chain with && and return.
step() {
  local name=$1 start=${EPOCHREALTIME//[!0-9]/} status=0
  shift
  printf '\n== %s\n' "$name"
  "$@" || status=$?
  local tenths=$(((${EPOCHREALTIME//[!0-9]/} - start) / 100000)) verdict=""
  if ((status != 0)); then verdict=", failed (status $status)"; fi
  printf -- '-- %s: %d.%d s%s\n' "$name" $((tenths / 10)) $((tenths % 10)) "$verdict"
  return "$status"
}

as_root() {
  if ((EUID == 0)); then "$@"; else sudo "$@"; fi
}

# Installs those of the named packages that are missing. Where that cannot be done, says so and goes on: the libraries may
# be there by another way, and the configure step names what it does not find.
install_packages() {
  local package missing=()
  for package in "$@"; do
    if [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then missing+=("$package"); fi
  done
  if ((${#missing[@]} == 0)); then
    echo "nothing is missing"
    return 0
  fi
  echo "missing: ${missing[*]}"
  if ! command -v apt-get >/dev/null; then
    echo "warning: this machine has no apt-get; install their like by hand if the configure step asks for them" >&2
  elif ((EUID != 0)) && ! command -v sudo >/dev/null; then
    echo "warning: no sudo; as root, run: apt-get install --no-install-recommends ${missing[*]}" >&2
  elif ! { as_root apt-get update -q &&
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"; }; then
    echo "warning: apt-get could not install: ${missing[*]}" >&2
  fi
  return 0
}

# As many compilers at once as there are cores, but no more than fit into memory at 2 GiB each.
compile_jobs() {
  local cores fit
  cores=$(nproc)
  fit=$(awk '/^MemAvailable:/ { print int($2 / 2097152) }' /proc/meminfo)
  if ((fit < 1)); then fit=1; fi
  echo $((fit < cores ? fit : cores))
}

# configure FOLDER CMAKE_ARGUMENT...; a folder that was made for another place or generator is configured afresh.
configure() {
  local folder=$1
  shift
  local options=(-S . -B "$folder" -G Ninja "$@")
  if command -v ccache >/dev/null && [[ -w ${HOME:-/nonexistent} ]]; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  local cache=$folder/CMakeCache.txt
  if [[ -f $cache ]] && ! { grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache" &&
    grep -qx "CMAKE_GENERATOR:INTERNAL=Ninja" "$cache"; }; then
    options+=(--fresh)
  fi
  cmake "${options[@]}"
}

# build FOLDER [TARGET...]
build() {
  local folder=$1
  shift
  if (($# == 0)); then set -- all; fi
  "${launcher[@]}" cmake --build "$folder" --parallel "$(compile_jobs)" --target "$@"
}

build_program() {
  step "packages" install_packages "${build_packages[@]}"
  step "configure" configure build -DCMAKE_BUILD_TYPE=Release -DUNDINE_SANITIZE=OFF -DUNDINE_TESTS=OFF
  step "build" build build undine
}

run_main_case() {
  local out=out/spheric2 number=2
  while [[ -e $out ]]; do
    out=out/spheric2-$number
    number=$((number + 1))
  done
  step "run $main_case" build/undine run "$main_case" --out "$out" --threads "$(nproc)"
  printf '\nThe results are in %s\n' "$out"
}

count_pass() { passed=$((passed + 1)); }
count_fail() { failed=$((failed + 1)); }

# check NAME COMMAND...: a step that counts as one test.
check() {
  if step "$@"; then count_pass; else count_fail; fi
}

# run_ctest FOLDER CTEST_ARGUMENT...: runs the tests and adds up what CTest's JUnit file says of them.
run_ctest() {
  local folder=$1 status=0 key
  shift
  local report=$PWD/$folder/ctest.xml
  rm -f "$report"
  "${launcher[@]}" ctest --test-dir "$folder" -j2 --timeout "$seconds_per_test" --output-on-failure --no-tests=error \
    --output-junit "$report" "$@" || status=$?
  local -A count=([tests]=0 [failures]=0 [disabled]=0 [skipped]=0)
  if [[ -f $report ]]; then
    for key in "${!count[@]}"; do
      count[$key]=$(sed -n "s/^.*\b$key=\"\([0-9]*\)\".*\$/\1/p" "$report" | head -n 1)
    done
  fi
  local left_out=$((count[disabled] + count[skipped]))
  passed=$((passed + count[tests] - count[failures] - left_out))
  failed=$((failed + count[failures]))
  skipped=$((skipped + left_out))
  if ((status != 0 && count[failures] == 0)); then count_fail; fi
  return "$status"
}

# A short bench, for the record: a shared machine is too noisy to judge by.
short_bench() {
  mkdir -p out && build/undine bench --quick --json >out/bench.json && echo "the figures are in out/bench.json"
}

run_tests() {
  export OMP_WAIT_POLICY=passive  # two tests at a time share the cores
  step "packages" install_packages "${build_packages[@]}" "${test_packages[@]}"
  check "format" bash tests/structure/check_format.sh
  check "structure" /usr/bin/python3 tests/structure/check_structure.py
  if step "configure" configure build -DCMAKE_BUILD_TYPE=Release -DUNDINE_SANITIZE=OFF -DUNDINE_TESTS=ON &&
    step "build" build build; then
    step "tests" run_ctest build --exclude-regex '^structure$' || true
    step "short bench" short_bench || true
  else
    count_fail
  fi
  # Where the kernel randomizes more address bits than the sanitizers of g++ 12 allow for, they crash at random at start-up.
  if setarch -R true 2>/dev/null; then launcher=(setarch -R); fi
  # No vector instructions beyond the compiler's default and little optimization: what is looked for is errors, not speed.
  if step "configure with sanitizers" configure build-sanitized -DCMAKE_BUILD_TYPE=Debug \
    "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -gline-tables-only" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DUNDINE_SANITIZE=ON -DUNDINE_FUZZ=ON -DUNDINE_ARCH= -DUNDINE_TESTS=ON &&
    step "build with sanitizers" build build-sanitized undine_unit undine_fuzz; then
    step "unit tests and fuzzing with sanitizers" run_ctest build-sanitized --tests-regex '^(unit|fuzz)\.' || true
  else
    count_fail
  fi
  if ((skipped > 0)); then printf '\n%d skipped' "$skipped"; fi
  printf '\n%d passed, %d failed\n' "$passed" "$failed"
  ((failed == 0))
}

if (($# > 1)); then
  usage >&2
  exit 2
fi
case ${1:-run} in
  run)
    build_program
    run_main_case
    ;;
  build) build_program ;;
  test) run_tests ;;
  help | -h | --help) usage ;;
  *)
    printf 'quickstart.sh: unknown command "%s"\n\n' "$1" >&2
    usage >&2
    exit 2
    ;;
esac
