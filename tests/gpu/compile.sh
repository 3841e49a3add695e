#!/usr/bin/env bash
# Compiles every term and smoothing kernel, and the fused force pass, for a GPU, and prints the registers of each.
# Fails where one spills registers to memory, or calls what exists on the host only.
#   compile.sh NVCC FOLDER [ARCH]    writes FOLDER/force_pass and FOLDER/registers.txt
set -euo pipefail
nvcc=$1
folder=$2
arch=${3:-sm_90}
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$folder"

options=(-std=c++20 -O2 "-arch=$arch" --expt-relaxed-constexpr --extended-lambda
  -Werror cross-execution-space-call -Xptxas -v "-I$here/../../src" "-I$here/..")
log=$folder/ptxas.log
compile() {
  "$nvcc" "${options[@]}" "$@" >>"$log" 2>&1 || {
    cat "$log" >&2
    exit 1
  }
}
: >"$log"
compile -cubin "$here/every_term.cu" -o "$folder/every_term.cubin"
compile "$here/force_pass.cu" -o "$folder/force_pass"

# Of the report of ptxas: one line for each entry point with its registers, spilled bytes and name.
awk -F"'" '
  /Compiling entry function/ { name = $2 }
  /bytes spill stores/ { for (k = 1; k <= split($0, word, " "); ++k) if (word[k] == "spill") spilled += word[k - 2] }
  /Used [0-9]+ registers/ { match($0, /Used [0-9]+/); print substr($0, RSTART + 5, RLENGTH - 5), spilled + 0, name; spilled = 0 }
' "$log" | c++filt | sort -k1,1nr -k3 >"$folder/registers.txt"
awk '
  { entries++; spills += $2; if ($1 > most) most = $1 }
  / undine::gpu::sweep\(/ { pass = $1 }
  END {
    if (pass == 0 || entries < 3) { print "the report of ptxas was not understood"; exit 1 }
    # Of a pass that calls what only the host has, nvcc keeps neither the call nor anything that follows from it.
    if (pass < 48) { printf "the fused force pass has %d registers: its terms are gone\n", pass; exit 1 }
    printf "%d entry points, at most %d registers, %d bytes spilled; the fused force pass: %d registers\n", entries, most, spills, pass
    exit spills > 0
  }
' "$folder/registers.txt"
