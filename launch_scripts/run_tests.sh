#!/usr/bin/env bash
# Installs what is missing, builds, runs all tests.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: run_tests.sh [--sanitize] [--long] [--unit] [--filter REGEX]
  --sanitize      then the same under the address and undefined behaviour sanitizers (preset asan), and the
                  unit tests of everything that has threads under the thread sanitizer (preset tsan)
  --long          ten times as many seeds in property tests, and integration tests until one of five times fails
  --unit          only unit tests, no processes
  --filter REGEX  only tests whose name matches
Exit codes: 0 all passed, 1 setup, build or a test failed, 2 bad input
TEXT
}

presets=(release)
select=()
unit=false
long=false
while (($#)); do
  case "$1" in
    --sanitize) presets=(release asan tsan) ;;
    --long) long=true ;;
    --unit) unit=true ;;
    --filter) (($# >= 2)) || { echo "run_tests.sh: --filter needs a value" >&2; exit 2; }
      select+=(-R "$2"); shift ;;
    --filter=*) select+=(-R "${1#*=}") ;;
    -h | --help) usage; exit 0 ;;
    *) echo "run_tests.sh: unknown flag $1 (see --help)" >&2; exit 2 ;;
  esac
  shift
done

cd "$root" || exit 1
if $long; then export HLC_TEST_LONG=1; fi # tests/support/num_seeds.hpp

# run PRESET CTEST_FLAG...
run() {
  local preset=$1
  shift
  ctest --preset "$preset" -j "$(nproc)" "${select[@]}" "$@" && return
  code=1
  local name
  while IFS= read -r name; do
    failed+=("$preset: ${name#*:}")
  done < <(cat "build/$preset/Testing/Temporary/LastTestsFailed.log" 2>/dev/null)
}

./launch_scripts/setup.sh || exit 1
code=0
failed=() # said again at the end: the sanitizers' output is long
for preset in "${presets[@]}"; do
  if [[ $preset == tsan ]]; then
    # Fast DDS is not built for the thread sanitizer, and most rooms have no threads (tests/README.md).
    ./launch_scripts/build.sh --preset tsan --thread_tests || exit 1
    echo "Testing (tsan, unit tests of what has threads)"
    run tsan --no-tests=error -L unit_threads
  elif $unit; then
    ./launch_scripts/build.sh --preset "$preset" --unit_tests || exit 1
    echo "Testing ($preset, unit tests)"
    run "$preset" --no-tests=error -L unit
  else
    ./launch_scripts/build.sh --preset "$preset" || exit 1
    echo "Testing ($preset)"
    run "$preset" --no-tests=error
    if $long; then
      echo "Repeating ($preset)"
      run "$preset" -L integration --repeat until-fail:5
    fi
  fi
done
((${#failed[@]} == 0)) || printf 'failed: %s\n' "${failed[@]}" >&2
exit "$code"
