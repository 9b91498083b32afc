#!/usr/bin/env bash
# Builds the program `fuzz`, makes its corpus and runs libFuzzer on each target.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

usage() {
  cat <<'TEXT'
usage: run.sh [--time_s N | --runs N] [--target NAME]
Feeds the readers of messages, datagrams and files with inputs that libFuzzer varies.
  --time_s N     each target so many seconds (default 60)
  --runs N       each target so many inputs
  --target NAME  only this one
Prints a line per target: inputs, inputs per second, peak memory, result. Corpus, logs and inputs that failed:
build/fuzz/corpus, build/fuzz/logs, build/fuzz/failed. Needs the Debian package libclang-rt-14-dev (libFuzzer).
Examples:
  run.sh --time_s 600
  run.sh --runs 100000 --target scenario
Exit codes: 0 no fault, 1 build or setup failed, or a fault was found, 2 invalid input
TEXT
}

fail() { echo "run.sh: $1" >&2; exit 2; }
number() { [[ $2 =~ ^[1-9][0-9]{0,8}$ ]] || fail "$1 = $2, must be a whole number >= 1"; }

limit=(-max_total_time=60)
only=""
while (($#)); do
  if [[ $1 == --seconds ]]; then # up to the last release
    echo "run.sh: --seconds is now --time_s" >&2
    set -- --time_s "${@:2}"
  fi
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --version) exec "$root/launch_scripts/version.sh" run.sh ;;
    --time_s | --runs | --target) (($# >= 2)) || fail "$1 needs a value" ;;&
    --time_s) number "$1" "$2"; limit=("-max_total_time=$2"); shift ;;
    --runs) number "$1" "$2"; limit=("-runs=$2"); shift ;;
    --target) only=$2; shift ;;
    *) fail "unknown flag $1 (see --help)" ;;
  esac
  shift
done

cd "$root" || exit 1
build=build/fuzz
mkdir -p "$build"/{corpus,logs,failed}
{ cmake --preset fuzz && nice cmake --build "$build" --target fuzz -j "$(nproc)"; } >"$build/logs/build.log" 2>&1 ||
  { echo "run.sh: building failed, see $build/logs/build.log" >&2; exit 1; }
export ASAN_OPTIONS=new_delete_type_mismatch=0:allocator_may_return_null=0 # see hlc_bridge/dds/library.cpp
"$build/bin/fuzz" "--write_samples=$build/corpus" >"$build/logs/targets" || exit 1
[[ -z $only ]] || grep -qxF -e "$only" "$build/logs/targets" ||
  fail "--target = $only, must be one of $(paste -sd ' ' "$build/logs/targets" | sed 's/ /, /g')"

code=0
while read -r target; do
  [[ -z $only || $target == "$only" ]] || continue
  log=$build/logs/$target.log
  "$build/bin/fuzz" "--target=$target" "${limit[@]}" -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=1024 -max_len=65536 \
    -print_final_stats=1 "-artifact_prefix=$build/failed/${target}_" "$build/corpus/$target" >"$log" 2>&1 </dev/null
  result=$?
  stat() { sed -n "s/^stat::$1: *//p" "$log"; }
  if ((result == 0)); then text="no fault"; else text="FAULT, see $log" code=1; fi
  printf '%-14s %9s inputs %7s/s %5s MB  %s\n' "$target" "$(stat number_of_executed_units)" \
    "$(stat average_exec_per_sec)" "$(stat peak_rss_mb)" "$text"
done <"$build/logs/targets"
exit "$code"
