#!/usr/bin/env bash
# Tables of EVALUATION.md and RECONFIGURATION.md from new rows; see --help.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
[[ ${1-} != --version ]] || exec "$root/launch_scripts/version.sh" documents.sh

environment=$root/build/report_environment
"$root/launch_scripts/python_environment.sh" "$environment" "$root/vehicle_sim/report/requirements.txt" || exit 3
PYTHONPATH=$root/vehicle_sim PYTHONDONTWRITEBYTECODE=1 exec "$environment/bin/python" -m report.documents "$@"
