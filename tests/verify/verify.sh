#!/usr/bin/env bash
# Checks runs with CommonRoad's packages, and the recording of messages of one with MCAP's, in a virtual environment.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)

usage() {
  cat <<'TEXT'
usage: verify.sh [--bin DIR] [--environment DIR] [--xml FILE] [RUN_FOLDER...]
Checks runs with CommonRoad's packages: file, dynamics, collisions, lanes, goals. Without a run folder: drives
paper_three_cars and circle with the subgraphs A, B, C and D and both profiles in one process, the planning
problems of sample CommonRoad files, and paper_three_cars with real processes over DDS, checks all of them, and the
negative controls of two; checks the shipped scenarios against their schema; reads the recorded messages of the last
one with the package mcap and, where npm is installed, decodes them by the types in the file as Foxglove does, and
watches a run under way with its client.
  --bin DIR           the programs (default build/release/bin)
  --environment DIR   folder of the virtual environment, created if missing (default build/release/verify_environment)
  --xml FILE          a CommonRoad file of the one run folder, as written by export_commonroad; default: its export
Examples:
  verify.sh
  verify.sh runs/my_run --xml run.xml
Exit codes: 0 all accepted, 1 a run rejected or a negative control accepted, 2 invalid input,
            3 skipped: packages missing and PyPI not reachable, 4 installation or a drive failed
TEXT
}

fail() { echo "verify.sh: $1" >&2; exit 2; }

bin=$root/build/release/bin
environment=$root/build/release/verify_environment
xml=()
runs=()
while (($#)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --version) exec "$root/launch_scripts/version.sh" verify.sh ;;
    --bin=*) bin=${1#*=} ;;
    --environment=*) environment=${1#*=} ;;
    --xml=*) xml=(--xml "${1#*=}") ;;
    --xml)
      (($# >= 2)) || fail "$1 needs a value"
      xml=(--xml "$2")
      shift ;;
    --bin | --environment)
      (($# >= 2)) || fail "$1 needs a value"
      printf -v "${1#--}" '%s' "$2"
      shift ;;
    -*) fail "unknown flag $1 (see --help)" ;;
    *)
      [[ -d $1 ]] || fail "$1 is not a folder, must be run folders"
      runs+=("$1") ;;
  esac
  shift
done
if ((${#xml[@]} > 0)); then
  [[ -f ${xml[1]} ]] || fail "--xml ${xml[1]} is no file"
  ((${#runs[@]} == 1)) || fail "--xml with ${#runs[@]} run folders, must be one"
fi
[[ -x $bin/export_commonroad ]] || fail "no export_commonroad in $bin; build first, or give --bin"

"$root/launch_scripts/python_environment.sh" "$environment" "$here/requirements.txt" || exit
verify=(timeout 600 env PYTHONDONTWRITEBYTECODE=1 "$environment/bin/python" "$here/verify.py"
  --export "$bin/export_commonroad")

if ((${#runs[@]} > 0)); then
  "${verify[@]}" "${xml[@]}" "${runs[@]}"
  exit
fi

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
drive() { # what, command ...
  local what=$1
  shift
  "$@" >"$out/log" 2>&1 && return
  cat "$out/log" >&2
  echo "verify.sh: $what failed" >&2
  exit 4
}
# A run under way, watched by Foxglove's own client. In logical time, which waits for a machine that stands still.
watch_live() {
  local run address watched
  timeout 120 "$root/launch_scripts/run_lab.sh" --no_build --bin "$bin" --steps 2000 --page false --messages false \
    --view --out "$out/live" >"$out/log" 2>&1 &
  run=$!
  while kill -0 "$run" 2>/dev/null && [[ -z ${address-} ]]; do
    sleep 0.1
    address=$(grep -o 'http://[^ ]*' "$out/log")
  done
  timeout 120 node "$out/live.mjs" "$address"
  watched=$?
  wait "$run" || { cat "$out/log" >&2; return 1; }
  return "$watched"
}
echo "Driving"
drive "evaluate" timeout 120 "$bin/evaluate" --scenario paper_three_cars,circle --subgraphs A,B,C,D \
  --profile default,2022 --keep_runs --scenario_folder "$root/launch_scripts/scenarios" --out "$out/campaign"
drive "evaluate" timeout 120 "$bin/evaluate" --scenario obstacle_field --keep_runs \
  --scenario_folder "$root/launch_scripts/scenarios" --out "$out/obstacles"
# Planning problems of CommonRoad files.
problems=()
drive "write_commonroad_samples" "$bin/write_commonroad_samples" "$out"
for name in $(<"$out/log"); do
  drive "import_commonroad" "$bin/import_commonroad" --commonroad "$out/$name.xml" --like passenger_cars_in_town \
    --out "$out/$name.yaml"
  problems+=("$out/$name.yaml")
done
drive "evaluate" timeout 120 "$bin/evaluate" --scenario "$(IFS=,; echo "${problems[*]}")" --keep_runs --out "$out/problems"
drive "run_lab.sh" timeout 120 "$root/launch_scripts/run_lab.sh" --no_build --bin "$bin" --out "$out/processes"
timeout 60 env PYTHONDONTWRITEBYTECODE=1 "$environment/bin/python" "$here/scenario_schema.py" || exit 1
timeout 60 env PYTHONDONTWRITEBYTECODE=1 "$environment/bin/python" "$here/messages.py" "$out/processes" || exit 1
if command -v npm >/dev/null; then
  cp "$here/package.json" "$here/messages.mjs" "$here/live.mjs" "$out"
  if timeout 120 npm install --prefix "$out" --no-audit --no-fund --silent >"$out/log" 2>&1; then
    timeout 60 node "$out/messages.mjs" "$out/processes/run.mcap" || exit 1
    watch_live || exit 1
  else
    echo "verify.sh: types of messages and the live scene not checked, npm's packages not reachable" >&2
  fi
fi
for ((i = 0; i < 16; i++)); do runs+=("$out/campaign/runs/$i"); done
runs+=("$out/obstacles/runs/0")
for ((i = 0; i < ${#problems[@]}; i++)); do runs+=("$out/problems/runs/$i"); done
# Run 1 is paper_three_cars with subgraph B and the default profile; run 4, A with that of 2022, re-anchors plans.
"${verify[@]}" --controls "$out/campaign/runs/1" --controls_reanchored "$out/campaign/runs/4" "${runs[@]}" "$out/processes"
