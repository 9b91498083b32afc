#!/usr/bin/env bash
# Installs what is missing, builds, runs all tests.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: run_tests.sh [--sanitize] [--unit] [--filter REGEX]
  --sanitize      also build and run the presets asan and tsan
  --unit          only unit tests, no processes
  --filter REGEX  only tests whose name matches
Exit codes: 0 all passed, 1 setup, build or a test failed, 2 bad input
TEXT
}

presets=(release)
select=()
while (($#)); do
  case "$1" in
    --sanitize) presets=(release asan tsan) ;;
    --unit) select+=(-L unit) ;;
    --filter) (($# >= 2)) || { echo "run_tests.sh: --filter needs a value" >&2; exit 2; }
      select+=(-R "$2"); shift ;;
    --filter=*) select+=(-R "${1#*=}") ;;
    -h | --help) usage; exit 0 ;;
    *) echo "run_tests.sh: unknown flag $1 (see --help)" >&2; exit 2 ;;
  esac
  shift
done

"$root/launch_scripts/setup.sh" || exit 1
code=0
for preset in "${presets[@]}"; do
  "$root/launch_scripts/build.sh" --preset "$preset" || exit 1
  echo "Testing ($preset)"
  scope=()
  # Fast DDS itself is not built for the thread sanitizer: processes are tested with asan.
  [[ $preset != tsan ]] || scope=(-L unit)
  (cd "$root" && ctest --preset "$preset" --no-tests=error -j "$(nproc)" "${select[@]}" "${scope[@]}") || code=1
done
exit "$code"
