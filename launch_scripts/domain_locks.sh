# shellcheck shell=bash
# Locks of DDS domains, for run_lab.sh and vehicle.sh, which define fail; tests/support/domain_reservation.hpp takes the same.
#
# A lock file lies in a folder in which nobody else can write: /tmp/hlc-<user id>, or $XDG_RUNTIME_DIR if somebody else
# made that one. So nobody can replace it by a pipe or link, hold it, or leave it behind. ($XDG_RUNTIME_DIR is set in some
# shells of a user only, and ends with the last login, while a run may go on.) Other users' runs, and programs without a
# lock, are seen by the UDP port on which every participant of a domain is discovered (7400 + 250 * domain).
# Limits: two users who start in the same second may take the same domains, therefore each user's search begins at
# another one; who binds the ports of a domain keeps others off it; a domain with shared memory alone (--transport lab,
# between middleware and controller) and clients of a discovery server have no such port.

lock_root=/tmp
udp_sockets=(/proc/net/udp /proc/net/udp6) # the second one is absent where IPv6 is off

is_private() { [[ $(LC_ALL=C stat -c '%F %u %a' -- "$1" 2>/dev/null) == "directory $EUID 700" ]]; }

lock_folder=""
find_lock_folder() {
  lock_folder=$lock_root/hlc-$EUID
  # Without the sticky bit others could rename the folder.
  [[ -k $lock_root || $(stat -c %A -- "$lock_root") != ????????w? ]] && mkdir -m 700 -- "$lock_folder" 2>/dev/null
  is_private "$lock_folder" && return
  is_private "${XDG_RUNTIME_DIR-}" && lock_folder=$XDG_RUNTIME_DIR && return
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
    substr($2, length($2) - 3) == port && (which == "anybody" || $8 != own) {found = 1}
    END {exit !found}' < <(cat -- "${udp_sockets[@]}" 2>/dev/null)
}
