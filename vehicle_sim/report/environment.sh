# shellcheck shell=bash
# For draw.sh and report.sh, which set here, their folder: `scripts`, where version.sh and python_environment.sh lie, and
# `environment`, where Python's packages are installed. In the sources that is build/; a flat folder for the lab's
# computers has it beside the programs; what is installed as a tree belongs to the system, and each user has a cache.
scripts=$here/../../launch_scripts environment=$here/../../build/report_environment
if [[ ! -e $scripts ]]; then
  scripts=$here/.. environment=$here/../report_environment
  if [[ ! -e $scripts/version.sh ]]; then
    scripts=$here/../../../lib/hlc/bin environment=${XDG_CACHE_HOME:-$HOME/.cache}/hlc/report_environment
  fi
fi
