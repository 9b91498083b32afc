#!/usr/bin/env bash
# Runs the tests of vehicle_sim/python with the pinned packages of vehicle_sim/report.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)

usage() {
  cat <<'TEXT'
usage: run_python_tests.sh BUILD [ARGUMENT...]
Runs *_test.py of this folder with Python's unittest on the package of the build folder BUILD, for example build/release;
ARGUMENTs are for its command discover, as -v or -k NAME.
Exit codes: 0 all passed, 1 a test failed, 2 invalid input, 3 skipped: packages missing and PyPI not reachable, or the
package is for another version of Python, 4 installation failed
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --version) exec "$root/launch_scripts/version.sh" run_python_tests.sh ;;
esac
build=${1:-}
[[ -d $build/python/hlc ]] || { echo "run_python_tests.sh: BUILD = $build, must be a folder with the package" >&2; exit 2; }
shift
environment=$root/build/report_environment
"$root/launch_scripts/python_environment.sh" "$environment" "$root/vehicle_sim/report/requirements.txt" || exit
suffix=$("$environment/bin/python" -c 'import sysconfig; print(sysconfig.get_config_var("EXT_SUFFIX"))')
[[ -e $build/python/hlc/_core$suffix ]] || { echo "run_python_tests.sh: skipped, no _core$suffix" >&2; exit 3; }
build=$(cd "$build" && pwd)
export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$build/python MPLBACKEND=agg HLC_BUILD=$build
exec "$environment/bin/python" -m unittest discover -s "$here" -t "$here" -p '*_test.py' "$@"
