# shellcheck shell=bash
# Locks of DDS domains, for run_lab.sh and vehicle.sh, which define fail; tests/support/domain_reservation.hpp takes the same.
#
# A lock file lies in a folder in which nobody else can write: $XDG_RUNTIME_DIR, or /tmp/hlc-<user id>. So nobody can
# replace it by a pipe or link, hold it, or leave it behind. Other users' runs, and programs without a lock, are seen by
# the UDP port on which every participant of a domain is discovered (7400 + 250 * domain).
# Limits: two users who start in the same second may take the same domains, therefore each user's search begins at
# another one; who binds the ports of a domain keeps others off it; a domain with shared memory alone (--transport lab,
# between middleware and controller) and clients of a discovery server have no such port.

is_private() { [[ -d $1 && ! -L $1 && -O $1 && $(stat -c %a -- "$1") == 700 ]]; }

lock_folder=""
find_lock_folder() {
  lock_folder=${XDG_RUNTIME_DIR-}
  [[ -n $lock_folder ]] && is_private "$lock_folder" && return
  lock_folder=/tmp/hlc-$EUID
  # Without the sticky bit others could rename the folder.
  [[ -k /tmp || $(stat -c %A /tmp) != ????????w? ]] && mkdir -m 700 -- "$lock_folder" 2>/dev/null
  is_private "$lock_folder" ||
    fail "$lock_folder: must be a folder of this user with mode 700, or XDG_RUNTIME_DIR one; it is for locks"
}

# Takes the lock of a domain until this shell and its children end; false if another process has it.
lock_domain() { # domain, --shared or --exclusive; sets lock
  [[ -n $lock_folder ]] || find_lock_folder
  { exec {lock}<>"$lock_folder/hlc_dds_domain_$1.lock"; } 2>/dev/null || return
  flock "$2" --nonblock "$lock" && return
  exec {lock}<&-
  return 1
}

# Whether a participant is on the domain: of whomever, or of another user.
domain_has() { # domain, anybody or others
  local port
  printf -v port '%04X' $((7400 + 250 * $1))
  awk -v port="$port" -v own="$EUID" -v which="$2" '
    FNR > 1 && substr($2, length($2) - 3) == port && (which == "anybody" || $8 != own) {found = 1}
    END {exit !found}' /proc/net/udp /proc/net/udp6 2>/dev/null
}
