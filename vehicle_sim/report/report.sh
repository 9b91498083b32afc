#!/usr/bin/env bash
# Tables, statistics and figures of a folder that evaluate or compare_priorities wrote.
set -uo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
# shellcheck source=SCRIPTDIR/environment.sh
source "$here/environment.sh"

usage() {
  cat <<'TEXT'
usage: report.sh OUT
Makes tables, statistics and figures of the rows that evaluate or compare_priorities wrote.
  OUT  a folder of evaluate or compare_priorities, with campaign.json, runs.csv and what belongs to them
Writes OUT/report.md, the page, and OUT/report/ with the data of every table and the figures.
Python's packages are installed once, into build/report_environment of the sources, or the user's cache (hlc/report_environment).
Examples:
  report.sh runs/table_2
  report.sh runs/priorities
Exit codes: 0 done, 2 invalid input or not writable, 3 Python's packages cannot be installed, 130 interrupted
TEXT
}

fail() { echo "report.sh: $1" >&2; exit 2; }
case "${1-}" in
  -h | --help) usage; exit 0 ;;
  --version) exec "$scripts/version.sh" report.sh ;;
  -*) fail "unknown flag $1, must be --help or a folder" ;;
esac
(($# == 1)) || fail "$# folders, must be one, see --help"

"$scripts/python_environment.sh" "$environment" "$here/requirements.txt" || exit 3
PYTHONPATH=$(dirname "$here") PYTHONDONTWRITEBYTECODE=1 exec "$environment/bin/python" -m report "$1"
