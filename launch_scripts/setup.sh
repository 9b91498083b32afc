#!/usr/bin/env bash
# Installs the Debian packages that building and running need. Returns quickly if all are installed.
set -euo pipefail

packages=(
  cmake ninja-build g++ ccache git ca-certificates
  libfastrtps-dev libfastcdr-dev fastddsgen
  libeigen3-dev libnlopt-dev libnlopt-cxx-dev libompl-dev libboost-dev
  libspdlog-dev libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libtinyxml2-dev libssl-dev
  libgtest-dev libgmock-dev python3-venv python3-dev pybind11-dev
  procps util-linux iproute2
)

style=(clang-format-14 clang-tidy-14 python3)
coverage=(gcovr)

usage() {
  echo "usage: setup.sh [--style] [--coverage]"
  echo "Installs the Debian packages that building and running need, as root or with sudo. Returns at once if all are there."
  echo "  packages: ${packages[*]}"
  echo "  --style     also those for check_style.sh: ${style[*]}"
  echo "  --coverage  also those for run_tests.sh --coverage: ${coverage[*]}"
  echo "Examples:"
  echo "  setup.sh"
  echo "  setup.sh --style --coverage"
  echo "Exit codes: 0 success, 1 a package could not be installed, 2 invalid input"
}

while (($#)); do
  case "$1" in
    --style) packages+=("${style[@]}") ;;
    --coverage) packages+=("${coverage[@]}") ;;
    -h | --help) usage; exit 0 ;;
    --version) exec "$(dirname "${BASH_SOURCE[0]}")/version.sh" setup.sh ;;
    *) echo "setup.sh: unknown flag $1 (see --help)" >&2; exit 2 ;;
  esac
  shift
done

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [[ $status == "install ok installed" ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then exit 0; fi

echo "Installing packages: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: missing packages, and neither root nor sudo available: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
log=$(mktemp)
install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y --no-install-recommends "${missing[@]}"
}
if ! install >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "setup.sh: installation failed; full log: $log" >&2
  exit 1
fi
rm -f "$log"
