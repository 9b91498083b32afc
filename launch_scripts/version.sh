#!/usr/bin/env bash
# Output of every script for --version, in the format of the programs.
set -euo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")

usage() {
  echo "usage: version.sh [NAME]"
  echo "Prints NAME (default: hlc), the project's version and the revision of the sources, or of the programs beside it."
  echo "Examples:"
  echo "  version.sh"
  echo "  version.sh run_lab.sh"
  echo "Exit codes: 0 success, 2 invalid input"
}

name=hlc
case "${1-}" in
  -h | --help) usage; exit 0 ;;
  --version | "") ;;
  -*) echo "version.sh: unknown flag $1 (see --help)" >&2; exit 2 ;;
  *) name=$1 ;;
esac
if [[ -x $here/show_scenario ]]; then # installed
  version=$("$here/show_scenario" --version)
  echo "$name ${version#* }"
  exit 0
fi
release=$(sed -n 's/^project(hlc VERSION \([0-9.]*\) .*/\1/p' "$here/../CMakeLists.txt")
revision=$(git -C "$here" describe --always --dirty 2>/dev/null || echo unknown)
echo "$name $release, revision $revision"
