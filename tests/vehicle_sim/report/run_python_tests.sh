#!/usr/bin/env bash
# Runs the tests of vehicle_sim/report with its pinned packages.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)

usage() {
  cat <<'TEXT'
usage: run_python_tests.sh [ARGUMENT...]
Runs *_test.py of this folder with Python's unittest; ARGUMENTs are for its command discover, as -v or -k NAME.
Exit codes: 0 all passed, 1 a test failed, 3 skipped: packages missing and PyPI not reachable, 4 installation failed
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --version) exec "$root/launch_scripts/version.sh" run_python_tests.sh ;;
esac
environment=$root/build/report_environment
"$root/launch_scripts/python_environment.sh" "$environment" "$root/vehicle_sim/report/requirements.txt" || exit
export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/vehicle_sim MPLBACKEND=agg
exec "$environment/bin/python" -m unittest discover -s "$here" -t "$here" -p '*_test.py' "$@"
