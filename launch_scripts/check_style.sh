#!/usr/bin/env bash
# Checks the sources with .clang-format, and changed lines with .clang-tidy.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat <<'TEXT'
usage: check_style.sh [--since COMMIT] [--all] [--fix_format]
Checks every file with .clang-format. Checks the lines that differ from the last merged commit, committed or not,
with .clang-tidy; findings in older lines do not fail.
  --since COMMIT  compares with this commit (default: where HEAD left origin/main, without that the branch main; on
                  main itself, or without both, the first parent of HEAD)
  --all           clang-tidy checks all lines of all files (more than an hour)
  --fix_format    formats the files instead
Examples:
  check_style.sh
  check_style.sh --since HEAD~3 --fix_format
Exit codes: 0 clean, 1 a finding or setup failed, 2 invalid input
TEXT
}

fail() { echo "check_style.sh: $1" >&2; exit 2; }

since="" all=false fix=false
while (($#)); do
  case "$1" in
    --since)
      (($# >= 2)) || fail "--since needs a value"
      since=$2
      shift
      ;;
    --since=*) since=${1#*=} ;;
    --all) all=true ;;
    --fix_format) fix=true ;;
    -h | --help) usage; exit 0 ;;
    --version) exec "$root/launch_scripts/version.sh" check_style.sh ;;
    *) fail "unknown flag $1 (see --help)" ;;
  esac
  shift
done
cd "$root"
[[ -z $since ]] || git rev-parse --quiet --verify "$since^{commit}" >/dev/null || fail "--since = $since: no such commit"

# Upper bound of the number of files, those with the most changed lines first: a file takes eight seconds of a processor, and the check
# must take less than three minutes. Skipped files are counted.
most_files=30

./launch_scripts/setup.sh --style || exit 1
mapfile -d '' sources < <(git ls-files -z '*.cpp' '*.hpp')
if $fix; then
  clang-format-14 -i "${sources[@]}"
  exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
code=0

if ! clang-format-14 --dry-run -Werror "${sources[@]}" 2>"$work/format"; then
  grep 'error:' "$work/format" | cut -d: -f1,2 | sort -u
  echo "check_style.sh: these lines are not formatted; check_style.sh --fix_format formats them" >&2
  code=1
fi

# The last merged commit known to this clone.
last_landed() {
  local branch
  for branch in origin/main main; do
    git rev-parse --quiet --verify "$branch^{commit}" >/dev/null || continue
    [[ $(git rev-parse "$branch") != $(git rev-parse HEAD) ]] || continue
    git merge-base "$branch" HEAD && return
  done
  git rev-parse --quiet --verify HEAD^1
}
if ! $all; then
  [[ -n $since ]] || since=$(last_landed) || { echo "No commit before this one: clang-tidy has nothing to compare"; exit "$code"; }
  mapfile -t changed < <(git diff --numstat --diff-filter=d "$since" -- '*.cpp' '*.hpp' | sort -rn | awk '$1 > 0' | cut -f 3)
  if ((${#changed[@]} == 0)); then
    echo "Style: ${#sources[@]} files are formatted or listed above; no change since $(git describe --always "$since")"
    exit "$code"
  fi
fi

# clang-tidy parses every file separately, so it needs the commands of a build without unity files (preset tidy), and the
# generated headers.
{ cmake --preset tidy && cmake --build build/tidy --target generated; } >"$work/cmake" 2>&1 ||
  { cat "$work/cmake" >&2; exit 1; }
tidy=(-quiet -p=build/tidy -extra-arg=-Wno-unknown-warning-option -extra-arg=-Wno-pragma-once-outside-header)
if $all; then
  printf '%s\0' "${sources[@]}" | grep -z '\.cpp$' |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 "${tidy[@]}" >"$work/tidy" 2>/dev/null || true
  what="all files"
else
  looked_at=("${changed[@]:0:most_files}")
  git diff -U0 "$since" -- "${looked_at[@]}" | clang-tidy-diff-14.py -p1 -path build/tidy -j "$(nproc)" \
    -clang-tidy-binary clang-tidy-14 "${tidy[@]:0:1}" "${tidy[@]:2}" >"$work/tidy" 2>/dev/null || true
  what="${#looked_at[@]} files that changed since $(git describe --always "$since")"
  ((${#changed[@]} <= most_files)) ||
    echo "clang-tidy skips $((${#changed[@]} - most_files)) more files that changed; --all checks them"
fi
# A finding in a header is repeated for every file that includes it. Code that GCC compiles and clang 14 does not
# (clang-diagnostic-error: a lambda that captures a structured binding) is no finding.
findings=$(grep -E ': (error|warning): ' "$work/tidy" | grep -vF '[clang-diagnostic-error]' | sed "s|^$root/||" | sort -u || true)
if [[ -n $findings ]]; then
  echo "$findings"
  echo "check_style.sh: clang-tidy has $(wc -l <<<"$findings") findings in $what" >&2
  exit 1
fi
((code != 0)) || echo "Style: ${#sources[@]} files are formatted, no clang-tidy findings in $what"
exit "$code"
