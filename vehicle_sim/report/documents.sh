#!/usr/bin/env bash
# Tables of EVALUATION.md and RECONFIGURATION.md from new rows; see --help.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
PYTHONPATH=$root/vehicle_sim PYTHONDONTWRITEBYTECODE=1 exec python3 -m report.documents "$@"
