#!/usr/bin/env bash
# Creates a virtual environment with pinned Python packages, once per list of requirements.
set -uo pipefail

usage() {
  cat <<'TEXT'
usage: python_environment.sh DIR REQUIREMENTS
Installs the packages of the file REQUIREMENTS into the virtual environment DIR; does nothing if they are installed. The
list has every package with its version, dependencies too; the first one is small and shows whether PyPI is reachable.
Examples:
  python_environment.sh build/report_environment vehicle_sim/report/requirements.txt
  python_environment.sh build/release/verify_environment tests/verify/requirements.txt
Exit codes: 0 success, 2 invalid input, 3 not possible here: no python3-venv, or no PyPI, 4 installation failed
TEXT
}

invalid() { echo "python_environment.sh: $1" >&2; exit 2; }
case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --version) exec "$(dirname "${BASH_SOURCE[0]}")/version.sh" python_environment.sh ;;
esac
(($# == 2)) || invalid "$# arguments, must be a folder and a list of requirements (see --help)"
[[ $1 != -* ]] || invalid "unknown flag $1 (see --help)"
dir=$1
requirements=$2
[[ -f $requirements ]] || invalid "$requirements is no file, must be a list of requirements"
wanted=$(sha256sum <"$requirements")
[[ $(cat "$dir/installed" 2>/dev/null) != "$wanted" ]] || exit 0
if [[ -e $dir && ! -e $dir/pyvenv.cfg && -n $(ls -A "$dir" 2>/dev/null) ]]; then
  invalid "$dir contains other files, must be a new folder or a virtual environment"
fi
python3 -c 'import venv, ensurepip' 2>/dev/null || {
  echo "python_environment.sh: skipped, python3 has no venv here (Debian: python3-venv)" >&2
  exit 3
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
fail() { # exit code, message
  [[ $1 == 3 ]] || tail -n 5 "$log" >&2
  echo "python_environment.sh: $2" >&2
  exit "$1"
}
mkdir -p "$(dirname "$dir")" || exit 2
exec {lock}>"$dir.lock" || exit 2
flock -w 600 "$lock" || fail 4 "timeout of another installation"
[[ $(cat "$dir/installed" 2>/dev/null) != "$wanted" ]] || exit 0
# An older environment stays until the new one is whole.
fresh=$(mktemp -d "$dir.XXXXXX") || exit 2
trap 'rm -rf "$log" "$fresh"' EXIT
timeout 300 python3 -m venv "$fresh" >"$log" 2>&1 || fail 4 "python3 -m venv failed in $fresh"
pip=("$fresh/bin/python" -m pip --disable-pip-version-check --no-input --retries 1 --timeout 15)
install=(install --quiet --only-binary :all: --no-deps)
first=$(grep -m 1 == "$requirements")
timeout 120 "${pip[@]}" "${install[@]}" "$first" >"$log" 2>&1 || fail 3 "skipped, PyPI not reachable"
echo "python_environment.sh: installing the packages of $(basename "$(dirname "$requirements")") into $dir" >&2
timeout 400 "${pip[@]}" "${install[@]}" -r "$requirements" >"$log" 2>&1 || fail 4 "installation failed"
echo "$wanted" >"$fresh/installed"
chmod 755 "$fresh"
rm -rf "$dir"
mv "$fresh" "$dir" || fail 4 "$dir cannot be replaced"
