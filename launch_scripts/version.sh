#!/usr/bin/env bash
# Output of every script for --version, in the format of the programs.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  echo "usage: version.sh [NAME]"
  echo "Prints NAME (default: hlc), the project's version and the revision of the sources."
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
release=$(sed -n 's/^project(hlc VERSION \([0-9.]*\) .*/\1/p' "$root/CMakeLists.txt")
revision=$(git -C "$root" describe --always --dirty 2>/dev/null || echo unknown)
echo "$name $release, revision $revision"
