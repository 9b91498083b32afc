#!/usr/bin/env bash
# Installs what is missing, builds, runs all tests or those of one folder.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: run_tests.sh [FOLDER] [--sanitize] [--long] [--unit] [--filter REGEX] [--coverage]
                    [--preset NAME]
Installs what is missing, builds, and runs all tests or those of one folder.
  FOLDER          builds and runs only the tests of this folder and of those below it, named as the sources or as the
                  tests: planner/search or tests/planner/search
  --sanitize      then the same under the address and undefined behaviour sanitizers (preset asan), and the
                  unit tests of everything with threads under the thread sanitizer (preset tsan)
  --long          ten times as many seeds in property tests, and integration tests until one of five times fails
  --unit          only unit tests, no integration tests
  --filter REGEX  only tests whose name matches
  --preset NAME   instead of release: debug, or fast_dds_3, which installs Fast DDS 3 into build/fast_dds_3
  --coverage      instead builds with counters (preset coverage) and prints the line coverage of every folder;
                  details: build/coverage/html
Examples:
  run_tests.sh --sanitize
  run_tests.sh planner/search --filter 'CostToGo.*'
  run_tests.sh hlc_bridge/dds --unit --preset fast_dds_3
Exit codes: 0 all passed, 1 setup, build or a test failed, 2 invalid input, also a filter without matching test
TEXT
}

fail() { echo "run_tests.sh: $1" >&2; exit 2; }
cd "$root" || exit 1

# Folders of tests/ with tests, and their parents, named like the sources.
test_folders() {
  grep -rlE --include=CMakeLists.txt "add_test\(" tests | while read -r file; do
    folder=${file%/CMakeLists.txt}
    while [[ $folder == tests/* ]]; do
      echo "${folder#tests/}"
      folder=${folder%/*}
    done
  done | sort -u
}

presets=(release)
chosen="" # the flag that chose others
choose() { # flag, presets
  [[ -z $chosen || $chosen == "$1" ]] || fail "$1 with $chosen, must be without"
  chosen=$1
  presets=("${@:2}")
}
folder=""
filter=""
unit=false
long=false
while (($#)); do
  case "$1" in
    --sanitize) choose --sanitize release asan tsan ;;
    --coverage) choose --coverage coverage ;;
    --long) long=true ;;
    --unit) unit=true ;;
    --preset) (($# >= 2)) || fail "--preset needs a value"
      choose --preset "$2"; shift ;;
    --preset=*) choose --preset "${1#*=}" ;;
    --filter) (($# >= 2)) || fail "--filter needs a value"
      filter=$2; shift ;;
    --filter=*) filter=${1#*=} ;;
    -h | --help) usage; exit 0 ;;
    --version) exec "$root/launch_scripts/version.sh" run_tests.sh ;;
    -*) fail "unknown flag $1 (see --help)" ;;
    *) [[ -z $folder ]] || fail "FOLDER = $1, already given as $folder"
      folder=${1#"$root"/} folder=${folder#./} folder=${folder#tests/} folder=${folder%/}
      test_folders | grep -qxF -e "$folder" ||
        fail "FOLDER = $1, must be one of $(test_folders | paste -sd ' ' | sed 's/ /, /g')" ;;
  esac
  shift
done

case "${presets[0]}" in
  release | debug | coverage | fast_dds_3) ;;
  *) fail "--preset = ${presets[0]}, must be one of release, debug, fast_dds_3" ;;
esac
if $long; then export HLC_TEST_LONG=1; fi # tests/support/num_seeds.hpp
[[ -n $filter ]] || export HLC_TESTS_BY_SUITE=1 # tests/house/discover_tests.cmake
select=()
[[ -z $filter ]] || select+=(-R "$filter")
[[ -z $folder ]] || select+=(-L "^tests/$folder(/|\$)")
! $unit || select+=(-L '^unit')

# Sets for a preset the targets, the tests, and a description of both.
choose() {
  preset=$1
  build=(--preset "$preset")
  chosen=("${select[@]}")
  what=$preset
  if [[ $preset == tsan ]]; then
    # Fast DDS is not built for the thread sanitizer, and most folders have no threads (tests/README.md).
    chosen+=(-L '^unit_threads$')
    what+=", unit tests with threads"
  elif $unit; then
    what+=", unit tests"
  fi
  if [[ -n $folder ]]; then
    build+=(--tests_of "$folder")
    what+=", $folder"
  elif [[ $preset == tsan ]]; then
    build+=(--thread_tests)
  elif $unit; then
    build+=(--unit_tests)
  fi
  [[ -z $filter ]] || what+=", --filter = $filter"
}

# Both take CTEST_FLAG... in addition to those of the selection.
has_tests() { ctest --preset "$preset" -N "${chosen[@]}" "$@" | grep -q '^Total Tests: [1-9]'; }
run() {
  has_tests "$@" || return 0
  ctest --preset "$preset" -j "$(nproc)" "${chosen[@]}" "$@" && return
  code=1
  local name
  while IFS= read -r name; do
    failed+=("$preset: ${name#*:}")
  done < <(cat "build/$preset/Testing/Temporary/LastTestsFailed.log" 2>/dev/null)
}

# Runs in memory under faults: always the same ones, two minutes on 2 cores. With the whole test run, at the lowest
# priority.
campaign=""
campaign_log=build/release/Testing/fault_simulator.log
begin_campaign() {
  [[ $preset == release && -z $folder && -z $filter ]] && ! $unit || return 0
  nice -n 19 build/release/bin/fault_simulator --cars 0 --seed 1 --runs 4500 >"$campaign_log" 2>&1 &
  campaign=$!
}
end_campaign() {
  [[ -n $campaign ]] || return 0
  echo "Runs with faults (build/release/bin/fault_simulator)"
  wait "$campaign" || { code=1 failed+=("fault_simulator: see above, with the command that repeats it"); }
  cat "$campaign_log"
}

setup=()
[[ ${presets[0]} != coverage ]] || setup=(--coverage)
./launch_scripts/setup.sh "${setup[@]}" || exit 1
code=0
failed=() # repeated at the end: the sanitizers' output is long
for ((i = 0; i < ${#presets[@]}; i++)); do
  choose "${presets[i]}"
  ./launch_scripts/build.sh "${build[@]}" || exit 1
  if ! has_tests; then
    ((i > 0)) || fail "no test among: $what"
    echo "No matching test: $what"
    continue
  fi
  [[ $preset != coverage ]] || find build/coverage -name '*.gcda' -delete # counts of an earlier run
  echo "Testing ($what)"
  run -LE '^real_time$'
  # While cars drive in real time the machine is mostly idle: meanwhile simulate faults, and build the next preset at
  # low priority.
  begin_campaign
  next=""
  if has_tests -L '^real_time$' && ((i + 1 < ${#presets[@]})); then
    (choose "${presets[i + 1]}" && exec nice -n 19 ./launch_scripts/build.sh "${build[@]}") >/dev/null 2>&1 &
    next=$!
  fi
  HLC_REAL_TIME_TOGETHER=1 run -L '^real_time$' # tests/house/discover_tests.cmake
  if $long; then
    echo "Repeating ($what)"
    run -L '^integration$' --repeat until-fail:5
  fi
  [[ -z $next ]] || wait "$next" # its own turn reports a failure
done
end_campaign
[[ ${presets[0]} != coverage ]] || ./tests/house/coverage.sh "$folder" || exit 1
((${#failed[@]} == 0)) || printf 'failed: %s\n' "${failed[@]}" >&2
exit "$code"
