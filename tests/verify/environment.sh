#!/usr/bin/env bash
# Creates the virtual environment of the verifier, once per requirements.txt.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage() {
  cat <<'TEXT'
usage: environment.sh DIR
Installs CommonRoad's packages (requirements.txt) into the virtual environment DIR; does nothing if they are installed.
Exit codes: 0 success, 2 invalid input, 3 not possible here: no python3-venv, or no PyPI, 4 installation failed
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "" | -*) echo "environment.sh: ${1:-no folder}, must be one folder (see --help)" >&2; exit 2 ;;
esac
dir=$1
wanted=$(sha256sum <"$here/requirements.txt")
[[ $(cat "$dir/installed" 2>/dev/null) != "$wanted" ]] || exit 0
if [[ -e $dir && ! -e $dir/pyvenv.cfg && -n $(ls -A "$dir" 2>/dev/null) ]]; then
  echo "environment.sh: $dir contains other files, must be a new folder or a virtual environment" >&2
  exit 2
fi
python3 -c 'import venv, ensurepip' 2>/dev/null || {
  echo "environment.sh: skipped, python3 has no venv here (Debian: python3-venv)" >&2
  exit 3
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
fail() { # exit code, message
  [[ $1 == 3 ]] || tail -n 5 "$log" >&2
  echo "environment.sh: $2" >&2
  exit "$1"
}
mkdir -p "$(dirname "$dir")" || exit 2
exec {lock}>"$dir.lock" || exit 2
flock -w 600 "$lock" || fail 4 "timeout of another installation"
[[ $(cat "$dir/installed" 2>/dev/null) != "$wanted" ]] || exit 0
rm -rf "$dir"
timeout 300 python3 -m venv "$dir" >"$log" 2>&1 || fail 4 "python3 -m venv failed in $dir"
pip=("$dir/bin/python" -m pip --disable-pip-version-check --no-input --retries 1 --timeout 15)
install=(install --quiet --only-binary :all: --no-deps)
# The smallest package first, to check whether PyPI is reachable.
timeout 120 "${pip[@]}" "${install[@]}" commonroad-vehicle-models==3.0.2 >"$log" 2>&1 ||
  fail 3 "skipped, PyPI not reachable"
echo "environment.sh: installing CommonRoad's packages into $dir" >&2
timeout 400 "${pip[@]}" "${install[@]}" -r "$here/requirements.txt" >"$log" 2>&1 || fail 4 "installation failed"
echo "$wanted" >"$dir/installed"
