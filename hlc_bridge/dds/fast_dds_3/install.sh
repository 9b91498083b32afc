#!/usr/bin/env bash
# Installs Fast DDS 3 (wheels of PyPI) and its code generator (Debian 13) into a folder, beside Debian 12's Fast DDS.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scripts=$here/../../../launch_scripts

usage() {
  cat <<'TEXT'
usage: install.sh DIR
Installs the library into DIR/library and its generator into DIR/generator; does nothing if both are installed.
`build.sh --preset fast_dds_3` calls it.
Example:
  install.sh build/fast_dds_3
Exit codes: 0 success, 2 invalid input, 3 not possible here: no python3-venv, no PyPI, or no Debian 13, 4 installation failed
TEXT
}

fail() { echo "install.sh: $2" >&2; exit "$1"; } # exit code, message
case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --version) exec "$scripts/version.sh" install.sh ;;
esac
(($# == 1)) || fail 2 "$# arguments, must be a folder (see --help)"
[[ $1 != -* ]] || fail 2 "unknown flag $1 (see --help)"
dir=$1
mkdir -p "$dir" || exit 2
dir=$(realpath "$dir")
"$scripts/python_environment.sh" "$dir/library" "$here/requirements.txt" || exit
[[ ! -x $dir/generator/fastddsgen ]] || exit 0

# The generator of Debian 12 is for Fast DDS 2. That of Debian 13 is unpacked, not installed: it is for Java only, and
# this machine's packages stay those of one Debian.
fresh=$(mktemp -d "$dir/generator.XXXXXX") || exit 2
trap 'rm -rf "$fresh"' EXIT
log=$fresh/log
archive=$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Component: main' 'Codename: bookworm' | head -n 1)
[[ -n $archive ]] || fail 3 "no archive of Debian 12 in the list of apt, must be there to take Debian 13 from"
mkdir -p "$fresh"/apt/{lists,cache/archives}/partial
cat >"$fresh/apt/debian.sources" <<TEXT
Types: deb
URIs: $archive
Suites: trixie
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
TEXT
apt() {
  timeout 300 apt-get -o Dir::Etc::SourceList="$fresh/apt/debian.sources" -o Dir::Etc::SourceParts=- -o Dir::State::Lists="$fresh/apt/lists" \
    -o Dir::State::status=/dev/null -o Dir::Cache="$fresh/apt/cache" "$@" >"$log" 2>&1 || {
    tail -n 5 "$log" >&2
    return 1
  }
}
apt update --error-on=any || fail 3 "Debian 13 not reachable"
(cd "$fresh" && apt download fastddsgen libeprosima-idl-parser-java) || fail 4 "the generator could not be downloaded"
for package in "$fresh"/*.deb; do
  dpkg-deb -x "$package" "$fresh" || fail 4 "$package could not be unpacked"
done
# Its own start file names the parser by an absolute path, where that of Debian 12 is.
cat >"$fresh/fastddsgen" <<'TEXT'
#!/bin/sh
java=$(dirname "$0")/usr/share
exec java -cp "$java/java/eprosima-idl-parser.jar:$java/fastddsgen/fastddsgen.jar" com.eprosima.fastdds.fastddsgen "$@"
TEXT
chmod 755 "$fresh" "$fresh/fastddsgen"
"$fresh/fastddsgen" -version >"$log" 2>&1 || { tail -n 5 "$log" >&2; fail 4 "the generator does not start"; }
rm -rf "$fresh"/apt "$fresh"/*.deb "$dir/generator"
mv "$fresh" "$dir/generator" || fail 4 "$dir/generator cannot be replaced"
