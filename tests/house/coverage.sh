#!/usr/bin/env bash
# Line coverage of every folder after the tests of the preset coverage. Called by
# run_tests.sh --coverage. Lines of programs that were killed are not counted: they do not write their counters.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/coverage
folder=${1-} # of the sources; empty: all

filters=(--filter "$root/planner/" --filter "$root/hlc_bridge/" --filter "$root/vehicle_sim/")
[[ -z $folder || ! -d $root/$folder ]] || filters=(--filter "$root/$folder/")
mkdir -p "$build/html"
echo "Reading the counters ..."
cd "$root"
gcovr --root "$root" "${filters[@]}" --object-directory "$build" -j "$(nproc)" \
  --csv "$build/coverage.csv" --html-details "$build/html/index.html" "$build" >"$build/gcovr.log" 2>&1 ||
  { tail -n 20 "$build/gcovr.log" >&2; echo "coverage.sh: gcovr failed" >&2; exit 1; }
awk -F, 'NR > 1 && $2 > 0 {
    sub(/\/[^\/]*$/, "", $1)
    total[$1] += $2; covered[$1] += $3; all += $2; all_covered += $3
  }
  END {
    printf "%-40s %8s %8s %8s\n", "folder", "lines", "run", "share"
    for (folder in total)
      printf "%-40s %8d %8d %7.1f%%\n", folder, total[folder], covered[folder], 100 * covered[folder] / total[folder] | "sort"
    close("sort")
    if (all > 0) printf "%-40s %8d %8d %7.1f%%\n", "all", all, all_covered, 100 * all_covered / all
  }' "$build/coverage.csv"
echo "Lines: $build/html/index.html"
