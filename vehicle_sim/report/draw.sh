#!/usr/bin/env bash
# Draws for the programs of the planner.
set -euo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
# shellcheck source=SCRIPTDIR/environment.sh
source "$here/environment.sh"

usage() {
  cat <<'TEXT'
usage: draw.sh KIND DATA OUT
Draws what a program of the planner wrote (build_automaton, pareto_front, plan_problem, show_scenario --plot).
  KIND  automaton, pareto, problem, scenario or sheet
  DATA  JSON
  OUT   SVG, PDF or PNG by its extension, otherwise SVG
Examples:
  draw.sh scenario scenario.json scenario.svg
  draw.sh pareto front.json front.pdf
Exit codes: 0 drawn, 2 invalid input or OUT cannot be written, 3 Python's packages are missing
TEXT
}

case "${1-}" in
  -h | --help) usage; exit 0 ;;
  --version) exec "$scripts/version.sh" draw.sh ;;
  -*) echo "draw.sh: unknown flag $1 (see --help)" >&2; exit 2 ;;
esac
(($# == 3)) || { echo "draw.sh: $# values, must be KIND DATA OUT (see --help)" >&2; exit 2; }
if ! reason=$("$scripts/python_environment.sh" "$environment" "$here/requirements.txt" 2>&1); then
  echo "draw.sh: $3 is not drawn, Python's packages of $here/requirements.txt are missing: ${reason##*$'\n'}" >&2
  exit 3
fi
PYTHONPATH=$(dirname "$here") PYTHONDONTWRITEBYTECODE=1 exec "$environment/bin/python" -m report.draw "$@"
