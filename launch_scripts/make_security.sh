#!/usr/bin/env bash
# Makes the identities and rights of a run's processes for DDS security.
set -euo pipefail
umask 077
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")

usage() {
  cat <<'TEXT'
usage: make_security.sh --vehicle_ids N,N,... --out DIR [--days N]
Makes what the processes of a run with these vehicles need for --security DIR: an authority, and for each process a key,
a certificate of the authority, and the topics that it may publish and read. All others are refused.
  --vehicle_ids N,N,...  vehicles, 1 ... 30 each
  --out DIR              a new or an empty folder
  --days N               the certificates are valid for so long, 1 ... 3650 (default 30)
A machine needs of DIR: authority.pem, governance.p7s, and the folders of its own processes. authority.key makes further
identities: keep it where no car's programs can read it.
Examples:
  make_security.sh --vehicle_ids 1,2,3 --out security
  make_security.sh --vehicle_ids 7 --out security_of_a_day --days 1
Exit codes: 0 success, 1 openssl failed, 2 invalid input
TEXT
}

fail() { echo "make_security.sh: $1" >&2; exit 2; }

vehicle_ids="" out="" days=30
while (($#)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --version) exec "$here/version.sh" make_security.sh ;;
    --*=*) name=${1%%=*} value=${1#*=} ;;
    --*) name=$1 value=${2-} ;;
    *) fail "unexpected argument $1 (see --help)" ;;
  esac
  case "$name" in
    --vehicle_ids | --out | --days) printf -v "${name#--}" '%s' "$value" ;;
    *) fail "unknown flag $name (see --help)" ;;
  esac
  if [[ $1 != *=* ]]; then
    (($# >= 2)) || fail "$name needs a value"
    shift
  fi
  shift
done
[[ $vehicle_ids =~ ^[0-9]{1,2}(,[0-9]{1,2})*$ ]] || fail "--vehicle_ids = $vehicle_ids, must be numbers in 1 ... 30"
ids=()
for id in ${vehicle_ids//,/ }; do
  id=$((10#$id))
  ((id >= 1 && id <= 30)) || fail "--vehicle_ids = $vehicle_ids, must be numbers in 1 ... 30"
  [[ " ${ids[*]-} " != *" $id "* ]] || fail "--vehicle_ids = $vehicle_ids, must be different numbers"
  ids+=("$id")
done
[[ $days =~ ^[0-9]{1,4}$ ]] && ((10#$days >= 1 && 10#$days <= 3650)) || fail "--days = $days, must be in 1 ... 3650"
days=$((10#$days))
[[ -n $out ]] || fail "--out is missing"
[[ $out == /* ]] || out=$PWD/$out
[[ ! -e $out || -d $out ]] || fail "--out = $out, must be a new or an empty folder"
[[ -z $(ls -A -- "$out" 2>/dev/null) ]] || fail "--out = $out is not empty, must be a new or an empty folder"
command -v openssl >/dev/null || fail "no program openssl, must be installed (Debian package openssl)"
mkdir -p -- "$out" 2>/dev/null && cd -- "$out" || fail "--out = $out, must be a folder that can be created"

log=$(mktemp)
trap 'code=$?; ((code == 0)) || tail -n 5 "$log" >&2; rm -f "$log"' EXIT
ssl() { openssl "$@" 2>>"$log"; }

topics() { # publish or subscribe, topics
  local kind=$1 topic
  shift
  (($# > 0)) || return 0
  echo "        <$kind><topics>"
  for topic in "$@"; do echo "          <topic>$topic</topic>"; done
  echo "        </topics></$kind>"
}

sign() { # file without .xml
  ssl smime -sign -in "$1.xml" -text -out "$1.p7s" -signer authority.pem -inkey authority.key
  rm "$1.xml"
}

# Of one process; what it publishes, --, what it reads.
make_identity() {
  local name=$1 publish=()
  shift
  while [[ $1 != -- ]]; do publish+=("$1"); shift; done
  shift
  mkdir "$name"
  ssl ecparam -name prime256v1 -genkey -noout -out "$name/key.pem"
  ssl req -new -key "$name/key.pem" -subj "/CN=$name" |
    ssl x509 -req -CA authority.pem -CAkey authority.key -CAcreateserial -days "$days" -out "$name/certificate.pem"
  {
    echo '<?xml version="1.0" encoding="UTF-8"?>'
    echo '<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
    echo '     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">'
    echo "  <permissions><grant name=\"$name\">"
    echo "      <subject_name>CN=$name</subject_name>"
    echo "      <validity><not_before>$from</not_before><not_after>$until</not_after></validity>"
    echo "      <allow_rule>"
    echo "        <domains><id_range><min>0</min><max>232</max></id_range></domains>"
    topics publish "${publish[@]}"
    topics subscribe "$@"
    echo "      </allow_rule>"
    echo "      <default>DENY</default>"
    echo "  </grant></permissions>"
    echo "</dds>"
  } >"$name/permissions.xml"
  sign "$name/permissions"
}

from=$(date -u -d yesterday +%Y-%m-%dT%H:%M:%S)
until=$(date -u -d "$days days" +%Y-%m-%dT%H:%M:%S)
ssl ecparam -name prime256v1 -genkey -noout -out authority.key
ssl req -x509 -new -key authority.key -subj "/CN=authority" -days "$days" -out authority.pem

cat >governance.xml <<'TEXT'
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules><domain_rule>
      <domains><id_range><min>0</min><max>232</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>NONE</discovery_protection_kind>
      <liveliness_protection_kind>NONE</liveliness_protection_kind>
      <rtps_protection_kind>ENCRYPT</rtps_protection_kind>
      <topic_access_rules><topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>false</enable_discovery_protection>
          <enable_liveliness_protection>false</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>NONE</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
      </topic_rule></topic_access_rules>
  </domain_rule></domain_access_rules>
</dds>
TEXT
sign governance

# What each role publishes and reads: hlc_bridge/dds/README.md.
of_vehicles() { # name of a topic, for the vehicles $2 ...
  local name=$1 id
  shift
  for id in "$@"; do echo "vehicle/$id/$name"; done
}
make_vehicle() { # name, ids
  local name=$1
  shift
  mapfile -t published < <(of_vehicles vehicleState "$@"; of_vehicles vehicleObservation "$@")
  mapfile -t read < <(of_vehicles "vehicleCommand*" "$@")
  make_identity "$name" "${published[@]}" readyStatus parameterRequest log -- \
    "${read[@]}" parameter systemTrigger logLevel
}
make_middleware() { # name, ids
  local name=$1
  shift
  mapfile -t published < <(of_vehicles "vehicleCommand*" "$@")
  mapfile -t read < <(of_vehicles vehicleState "$@"; of_vehicles vehicleObservation "$@")
  make_identity "$name" "${published[@]}" vehicleStateList systemTrigger readyStatus parameterRequest stopRequest \
    commonroad_dds_goal_states log -- \
    "${read[@]}" "vehicle/*/vehicleState" "vehicle/*/vehicleObservation" "vehicleCommand*" readyStatus systemTrigger parameter stopRequest \
    commonroad_dds_goal_states logLevel
}
make_identity lab_control systemTrigger parameter log logLevel hlc/run_state -- \
  readyStatus parameterRequest stopRequest "vehicle/*/vehicleState" hlc/report
for id in "${ids[@]}"; do
  make_vehicle "vehicle_raspberry_$id" "$id"
  make_middleware "middleware_$id" "$id"
  make_identity "high_level_controller_$id" hlc/traffic hlc/prediction hlc/outcome hlc/report hlc/automaton_answer \
    "vehicleCommand*" readyStatus visualization stopRequest parameterRequest log -- \
    hlc/traffic hlc/prediction hlc/outcome hlc/automaton_request hlc/run_state vehicleStateList systemTrigger \
    parameter commonroad_dds_goal_states logLevel
done
# One process for several vehicles.
if ((${#ids[@]} > 1)); then
  make_vehicle vehicle_raspberry "${ids[@]}"
  make_middleware middleware "${ids[@]}"
fi
# What an operator starts beside the run.
make_identity view -- "vehicle/*/vehicleState" hlc/report
make_identity lab_doctor parameterRequest -- parameter "vehicle/*/vehicleState" vehicleStateList
make_identity automaton_request hlc/automaton_request -- hlc/automaton_answer
rm -f authority.srl
echo "$out: identities of $(find . -name certificate.pem | wc -l) processes, valid for $days days"
