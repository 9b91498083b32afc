#!/usr/bin/env bash
# Configures and builds one preset. Prints one line per stage; the compiler's output only if it fails.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: build.sh [--preset release|debug|asan|tsan|coverage|fast_dds_3]
                [--programs | --run_programs | --unit_tests | --thread_tests | --tests_of FOLDER]
Configures and builds one preset.
  --preset NAME   what to build (default release), into build/NAME; fast_dds_3: release with Fast DDS 3, which is installed
                  into build/fast_dds_3
  --programs      only the programs, no tests
  --run_programs  of these only what a run of run_lab.sh starts
  --unit_tests    only the single-process tests
  --thread_tests  the subset of these from folders with threads
  --tests_of FOLDER  only the tests in tests/FOLDER and their dependencies; with the preset tsan only those with threads
Examples:
  build.sh --programs
  build.sh --preset asan --tests_of planner/search
Exit codes: 0 success, 1 the build failed, 2 invalid input
TEXT
}

preset=release
targets=()
while (($#)); do
  case "$1" in
    --preset | --tests_of)
      (($# >= 2)) || { echo "build.sh: $1 needs a value" >&2; exit 2; }
      if [[ $1 == --preset ]]; then preset=$2; else targets=(--target "tests/$2/all"); fi
      shift
      ;;
    --preset=*) preset=${1#*=} ;;
    --tests_of=*) targets=(--target "tests/${1#*=}/all") ;;
    --programs | --run_programs | --unit_tests | --thread_tests) targets=(--target "${1#--}") ;;
    -h | --help) usage; exit 0 ;;
    --version) exec "$root/launch_scripts/version.sh" build.sh ;;
    *) echo "build.sh: unknown flag $1 (see --help)" >&2; exit 2 ;;
  esac
  shift
done
case "$preset" in
  release | debug | asan | tsan | coverage | fast_dds_3) ;;
  *) echo "build.sh: --preset = $preset, must be one of release, debug, asan, tsan, coverage, fast_dds_3" >&2; exit 2 ;;
esac

mkdir -p "$root/build/$preset"
log=$root/build/$preset/build.log
run() {
  if ! "$@" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "build.sh: preset $preset failed; full log: $log" >&2
    exit 1
  fi
}

cd "$root"
if [[ $preset == fast_dds_3 ]]; then
  hlc_bridge/dds/fast_dds_3/install.sh "build/$preset" || { echo "build.sh: preset $preset needs Fast DDS 3" >&2; exit 1; }
fi
: >"$log"
# The compiler's cache preprocesses a file that it does not know, to find what another clone compiled. While it is empty it
# need not, and the first build takes a fifth less time.
if [[ $(ccache --print-stats 2>/dev/null | awk '$1 == "files_in_cache" {print $2}') == 0 ]]; then
  export CCACHE_DEPEND=1
fi
start=$SECONDS
run cmake --preset "$preset"
# Not a pipe: with pipefail it would fail where grep has found its line and ends before the build tool does.
has_to_compile() { grep -q 'Building CXX' <(cmake --build --preset "$preset" "${targets[@]}" -- -n 2>&1); }
if [[ -t 1 ]]; then # one line that is rewritten
  progress() { awk '/^\[/ {printf "\r\033[KBuilding %s", $1; fflush()} END {printf "\r\033[K"}'; }
  build() { cmake --build --preset "$preset" "${targets[@]}" 2>&1 | tee -a "$log" | progress >&3; }
  run build 3>&1
else
  if has_to_compile; then echo "Building ($preset), the first time takes a few minutes ..."; fi
  run cmake --build --preset "$preset" "${targets[@]}"
fi
if ((SECONDS - start > 5)); then echo "Built ($preset) in $((SECONDS - start)) s"; fi
