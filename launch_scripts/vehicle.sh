#!/usr/bin/env bash
# One vehicle: its simulated car, its middleware and its high-level controller, as one machine of the lab
# runs them; or several vehicles, which share the first two. Ends when all processes have ended. --only
# restarts one of them during a run.
set -uo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
root=$(dirname "$here")
runs=$root/runs programs=$root/build/release/bin
if [[ -x $here/vehicle_sim ]]; then # installed beside the programs
  runs=$PWD/runs programs=$here
fi

usage() {
  cat <<'TEXT'
usage: vehicle.sh --vehicle_ids N --scenario FILE [flags]      (every flag also as --name=value)
Starts the processes of one vehicle or several, as on one machine of the lab, or restarts one of them during a run.
  --vehicle_ids N,N,...   vehicle, 1 ... 30; several, such as 1,2,3: one process with all simulated cars, one
                          middleware, and a controller each
  --scenario FILE         scenario file, or the name of one in launch_scripts/scenarios
  --profile NAME          default or 2022 (default: default)
  --engine NAME           branch_and_bound, best_first, ompl_branch_and_bound or ompl_best_first (default: the
                          scenario's, else the profile's)
  --subgraph NAME         instead of the scenario's
  --priorities NAME       who plans first: constant, random, fca, colouring, waiting_time, explorative, optimal or
                          best_order (rollout --help explains them), instead of the scenario's
  --policy NAME           by which the car changes the subgraph itself, or none, instead of the scenario's
  --map FILE              CommonRoad XML instead of the scenario's map
  --cars N                number of cars (scenarios on a circle, or that draw their cars)
  --seed N                of drawn cars and of random routes, instead of the scenario's
  --routes random         random turns forever, instead of the scenario's routes
  --simulated_time BOOL   true: logical time (default), false: real time
  --transport NAME        loopback (default) or lab
  --dds_domain N          lab domain (default 1). Several vehicles share it; with the transport loopback it must
                          not be one that a run of run_lab.sh or a test uses at the moment
  --middleware_domain N   local domain of this vehicle (default: lab domain + vehicle, the first of several)
  --controller_domain N   domain of the controllers (default: lab domain + 50)
  --discovery_mode MODE   simple (default: multicast) or client, with the address of the lab domain's discovery server:
                          --discovery_server_id ID, --discovery_server_ip ADDRESS, --discovery_server_port PORT
  --controller_peers A,B  addresses of the other machines, asked on the controllers' domain besides multicast
  --security DIR          DDS security with the identities of make_security.sh (default: HLC_SECURITY, or none)
  --dump_problems DIR     folder for the controller's planning problems, see plan_problem (default: not written)
  --pose X,Y,YAW          initial pose of the simulated car, of each of several (default: the scenario's start)
  --noise_seed N          measurement noise from this seed, one for each of several (default: none)
  --gains_scale X         gains of the simulated car's follower (default 1; 0: it does not move)
  --stamps NAME           of the simulated car: exact, or lab: 20 ms early and with the lab's tracking errors (default: as
                          the scenario's lab)
  --log_level NAME        least severe messages in the logs: trace, debug, info, warning, error, critical or off
                          (default: the environment variable HLC_LOG_LEVEL, or info)
  --messages BOOL         true: every message of these processes is recorded in --out (default: false)
  --on_death WHAT         stop (default): a process that is killed fails the run; continue: it may be restarted
  --only NAME             restart one process: hlc, middleware or vehicle. Omitted flags are those with
                          which the vehicle of the run in --out was started, except --bin; a car keeps its last pose.
                          What several vehicles share is restarted with all of them as --vehicle_ids
  --out DIR               folder for logs and the vehicle's record (default: runs/vehicle_N)
  --bin DIR               folder of the programs (default: build/release/bin, or where this script is installed)
  --startup_timeout_s N   startup timeout (default 30)
Examples:
  vehicle.sh --vehicle_ids 1 --scenario paper_red_alone --dds_domain 40 --out runs/by_hand
  vehicle.sh --vehicle_ids 2 --only hlc --out runs/my_run
Exit codes: 0 success, 2 invalid input, otherwise the first failing one of the processes
TEXT
}

fail() { echo "vehicle.sh: $1" >&2; exit 2; }
# shellcheck source=SCRIPTDIR/domain_locks.sh
source "$here/domain_locks.sh"

vehicle_ids="" scenario="" profile=default engine="" priorities="" dump_problems="" subgraph="" policy="" map="" cars="" seed="" routes=""
simulated_time=true transport=loopback dds_domain=1 middleware_domain="" controller_domain="" pose=""
# shellcheck disable=SC2034 # read by name
discovery_mode="" discovery_server_id="" discovery_server_ip="" discovery_server_port="" controller_peers=""
security=${HLC_SECURITY-} noise_seed="" gains_scale="" stamps="" log_level=${HLC_LOG_LEVEL:-info} messages=false on_death=stop out="" bin=$programs startup_timeout_s=30 only="" shared_by=""
kept_flags=(vehicle_ids scenario profile engine priorities dump_problems subgraph policy map cars seed routes simulated_time transport
  discovery_mode discovery_server_id discovery_server_ip discovery_server_port controller_peers dds_domain middleware_domain
  controller_domain security pose noise_seed gains_scale stamps log_level messages on_death startup_timeout_s shared_by)
# Whose programs run is never read from a run folder: --bin is not kept.
take_flags() {
  local name value
  renamed() { echo "vehicle.sh: --$name is now --$1" >&2; name=$1; }
  while (($#)); do
    case "$1" in
      -h | --help) usage; exit 0 ;;
      --version) exec "$here/version.sh" vehicle.sh ;;
      --*=*) name=${1%%=*} value=${1#*=} ;;
      --*) name=$1 value=${2-} ;;
      *) fail "unexpected argument $1 (see --help)" ;;
    esac
    name=${name#--}
    case "$name" in # up to the last release
      id) renamed vehicle_ids ;;
      dump-problems) renamed dump_problems ;;
    esac
    [[ $name =~ ^(out|only|bin)$ || ($name != *" "* && " ${kept_flags[*]} " == *" $name "*) ]] || fail "unknown flag --$name (see --help)"
    if [[ $1 != *=* ]]; then
      (($# >= 2)) || fail "--$name needs a value"
      shift
    fi
    shift
    [[ $name != dump_problems || -n $value ]] || fail "--dump_problems = , must be a folder"
    printf -v "$name" '%s' "$value"
  done
}
take_flags "$@"
name_of() { # ids: 3, or 1-20 for several
  if [[ $1 == *,* ]]; then echo "${1%%,*}-${1##*,}"; else echo "$1"; fi
}
flags_file=$out/logs/vehicle_$(name_of "$vehicle_ids").flags
if [[ -n $only && -n $out && -e $flags_file ]]; then
  [[ -O $out && -O $flags_file && -f $flags_file ]] || fail "--out = $out: of another user, must be a run of this one"
  mapfile -d '' -t former <"$flags_file"
  given_bin=$bin
  take_flags "${former[@]}"
  bin=$given_bin
  take_flags "$@"
fi
# Files and folders of any name: none begins with a dash.
for name in out dump_problems map security bin; do [[ -z ${!name} || ${!name} == /* ]] || printf -v "$name" '%s' "$PWD/${!name}"; done
case "$only" in
  "" | hlc | middleware | vehicle) ;;
  *) fail "--only = $only, must be one of hlc, middleware, vehicle" ;;
esac
[[ $messages == true || $messages == false ]] || fail "--messages = $messages, must be one of true, false"
[[ $on_death == stop || $on_death == continue ]] || fail "--on_death = $on_death, must be one of stop, continue"
[[ $vehicle_ids =~ ^[0-9]{1,2}(,[0-9]{1,2})*$ ]] || fail "--vehicle_ids = $vehicle_ids, must be in 1 ... 30"
ids=()
for one in ${vehicle_ids//,/ }; do
  one=$((10#$one))
  ((one >= 1 && one <= 30)) || fail "--vehicle_ids = $vehicle_ids, must be in 1 ... 30"
  [[ " ${ids[*]} " != *" $one "* ]] || fail "--vehicle_ids = $vehicle_ids, must be different numbers"
  ids+=("$one")
done
vehicle_ids=$(IFS=,; echo "${ids[*]}")
[[ $only == "" || $only == hlc || -z $shared_by || $shared_by == "$vehicle_ids" ]] ||
  fail "--only = $only: vehicle $vehicle_ids shares it, must be with --vehicle_ids $shared_by"
[[ $only != hlc || ${#ids[@]} == 1 ]] || fail "--only = hlc: --vehicle_ids = $vehicle_ids, must be one vehicle"
whole_number() { [[ -z $2 || $2 =~ ^[0-9]{1,9}$ ]] || fail "--$1 = $2, must be a whole number"; }
for name in cars seed dds_domain middleware_domain controller_domain startup_timeout_s; do
  whole_number "$name" "${!name}"
done
startup_timeout_s=$((10#$startup_timeout_s)) # 010 is ten
for one in ${noise_seed//,/ }; do whole_number noise_seed "$one"; done
[[ -z $gains_scale || $gains_scale =~ ^[0-9]+(\.[0-9]+)?$ ]] || fail "--gains_scale = $gains_scale, must be a number >= 0"
[[ -z $stamps || $stamps == exact || $stamps == lab ]] || fail "--stamps = $stamps, must be one of exact, lab"
[[ -z $gains_scale || $stamps != lab ]] || fail "--stamps = lab with --gains_scale, must be exact: the lab's follower has no gains"
[[ -z $gains_scale ]] || stamps=exact
[[ $log_level =~ ^(trace|debug|info|warning|error|critical|off)$ ]] ||
  fail "--log_level = $log_level, must be one of trace, debug, info, warning, error, critical, off"
[[ -n $scenario ]] || fail "--scenario is missing"
is_file() { [[ -e $1 && ! -d $1 ]]; }
shipped=$here/scenarios/${scenario%.yaml}.yaml
if ! is_file "$scenario" && is_file "$shipped"; then scenario=$shipped; fi # a folder hides none of ours
[[ ! -d $scenario ]] || fail "--scenario = $scenario is a folder, must be a scenario file"
[[ -e $scenario ]] || fail "--scenario: no file $shipped"
[[ $scenario == /* ]] || scenario=$PWD/$scenario
[[ -n $middleware_domain ]] || middleware_domain=$((dds_domain + ids[0]))
[[ -n $out ]] || out=$runs/vehicle_$(name_of "$vehicle_ids")
if [[ -z $only && -e $out/run.json ]] && ! grep -q "did not end the run" "$out/run.json"; then
  fail "--out = $out: a finished run, must be a new folder; --only requires a running one"
fi

# run_lab.sh reserves its domains and sets a variable. A manual start shares a domain with other vehicles of the user.
share_domain() { # flag, domain
  { lock_domain "$2" --shared && ! domain_has "$2" others; } || fail "$1 = $2: a run on this machine uses it"
}
if [[ $transport == loopback && -z ${HLC_DOMAINS_ARE_RESERVED-} && -z $only ]]; then
  share_domain --dds_domain "$((10#$dds_domain))"
  share_domain --middleware_domain "$((10#$middleware_domain))"
fi
if [[ -n $dump_problems ]]; then # other vehicles of the run may write there, too
  { mkdir -p -- "$dump_problems" && probe=$(mktemp -- "$dump_problems/XXXXXX") && rm -- "$probe"; } 2>/dev/null ||
    fail "--dump_problems = $dump_problems: not writable, must be a folder that can be created and written to"
fi
mkdir -p "$out/logs" 2>/dev/null || fail "--out = $out: not writable"
[[ -x $bin/vehicle_sim ]] || fail "--bin = $bin: no programs there, build first"

choices=(--scenario "$scenario" --profile "$profile")
[[ -z $engine ]] || choices+=(--engine "$engine")
[[ -z $subgraph ]] || choices+=(--subgraph "$subgraph")
[[ -z $priorities ]] || choices+=(--priorities "$priorities")
[[ -z $policy ]] || choices+=(--policy "$policy")
[[ -z $map ]] || choices+=(--map "$map")
[[ -z $cars ]] || choices+=(--cars "$cars")
[[ -z $seed ]] || choices+=(--seed "$seed")
[[ -z $routes ]] || choices+=(--routes "$routes")
appends=() # a restarted car keeps its last pose, and its record continues
if [[ $only == vehicle && -s $out/vehicle_${ids[0]}.csv ]]; then
  appends=(--append_record)
fi
if [[ $only == vehicle && -s $out/vehicle_${ids[0]}.csv && " $*" != *" --pose"* ]]; then
  last=$(for one in "${ids[@]}"; do
    grep -E '^[0-9]+(,[^,]+){7}$' "$out/vehicle_$one.csv" | tail -n 1 | cut -d, -f2-4
  done)
  ((${#ids[@]} != $(wc -l <<<"$last"))) || pose=$(paste -sd, <<<"${last:-$pose}")
fi
if [[ (-z $pose || -z $stamps) && $only != hlc && $only != middleware ]]; then
  starts=$("$bin/show_scenario" "${choices[@]}" --print_starts) || exit 2
  [[ -n $stamps ]] || stamps=$(awk 'NR == 1 {print $3}' <<<"$starts")
fi
if [[ -z $pose && $only != hlc && $only != middleware ]]; then
  for one in "${ids[@]}"; do
    start=$(awk -v id="$one" '$1 == id {print $2}' <<<"$starts")
    [[ -n $start ]] || fail "--vehicle_ids = $one, must be one of $(awk '{printf "%s%s", s, $1; s = ", "}' <<<"$starts"), or any with --pose"
    pose+=${pose:+,}$start
  done
fi

common=(--simulated_time="$simulated_time" --dds_domain="$dds_domain" --transport="$transport"
  --startup_timeout_s="$startup_timeout_s" --log_level="$log_level")
! $messages || common+=(--messages_folder="$out/messages")
for name in discovery_mode discovery_server_id discovery_server_ip discovery_server_port security; do
  [[ -z ${!name} ]] || common+=("--$name=${!name}")
done
vehicle=(--vehicle_ids="$vehicle_ids" --pose="$pose" --scenario="$scenario" --record="$out/vehicle_{id}.csv" "${appends[@]}")
[[ -z $noise_seed ]] || vehicle+=(--noise_seed="$noise_seed")
[[ -z $gains_scale ]] || vehicle+=(--gains_scale="$gains_scale")
[[ -z $stamps ]] || vehicle+=(--stamps="$stamps")
controller=("${choices[@]}")
[[ -z $controller_domain ]] || controller+=(--controller_domain="$controller_domain")
[[ -z $controller_peers ]] || controller+=(--controller_peers="$controller_peers")
[[ -z $dump_problems ]] || controller+=(--dump_problems="$dump_problems")

# With two controllers a car would follow both alternately.
if [[ -n $only ]]; then
  process=${only/#hlc/high_level_controller}_$(name_of "$vehicle_ids")
  pid=$(awk -v name="$process" '$2 == name {pid = $1} END {print pid}' "$out/logs/vehicle_${ids[0]}.pids" 2>/dev/null)
  program=$(basename "$(readlink "/proc/${pid:-none}/exe" 2>/dev/null)" " (deleted)") # rebuilt meanwhile
  [[ ! $program =~ ^(vehicle_sim|middleware|high_level_controller)$ ]] ||
    fail "--only = $only: $process still running; stop it first: kill -9 $pid"
fi

scenario=$(realpath "$scenario") bin=$(realpath "$bin")
[[ -z $map ]] || map=$(realpath "$map")
keep_flags() { # ids
  local vehicle_ids=$1 name
  for name in "${kept_flags[@]}"; do
    [[ -z ${!name} ]] || printf '%s\0' "--$name=${!name}"
  done >"$out/logs/vehicle_$(name_of "$vehicle_ids").flags"
}
if [[ -z $only ]]; then
  ((${#ids[@]} == 1)) || shared_by=$vehicle_ids
  for one in $vehicle_ids "${ids[@]}"; do keep_flags "$one"; done
fi

declare -A names=() # of running processes, by pid
is_ending=false
# shellcheck disable=SC2317 # called by the trap
end_all() {
  trap : INT TERM HUP # not '', which children would inherit
  is_ending=true
  ((${#names[@]} > 0)) || return
  kill -TERM "${!names[@]}" 2>/dev/null
  local deadline=$((SECONDS + 4))
  while kill -0 "${!names[@]}" 2>/dev/null && ((SECONDS < deadline)); do sleep 0.05; done
  # Processes that hang or are stopped, and the controllers of a common parent.
  local pid left=()
  for pid in "${!names[@]}"; do
    read -r -a children 2>/dev/null <"/proc/$pid/task/$pid/children" && left+=("${children[@]}")
  done
  kill -KILL "${!names[@]}" "${left[@]}" 2>/dev/null
}
trap end_all INT TERM HUP EXIT

start() { # name for --only, name, program and flags
  local name=$2
  [[ -z $only || $only == "$1" ]] || return 0
  shift 2
  # Gets SIGTERM when this script ends, even by SIGKILL.
  [[ -n $only ]] || : >"$out/logs/$name.log"
  setpriv --pdeathsig TERM -- "$@" >>"$out/logs/$name.log" 2>&1 </dev/null &
  names[$!]=$name
}
all=$(name_of "$vehicle_ids")
start vehicle "vehicle_$all" "$bin/vehicle_sim" "${common[@]}" "${vehicle[@]}"
start middleware "middleware_$all" "$bin/middleware" "${common[@]}" --vehicle_ids="$vehicle_ids" \
  --middleware_domain="$middleware_domain"
# One program reads the scenario for all controllers, each of which is a process of its own. Those that may
# be restarted start alone.
controllers=("$vehicle_ids")
[[ $on_death == stop ]] || controllers=("${ids[@]}")
for one in "${controllers[@]}"; do
  start hlc "high_level_controller_$(name_of "$one")" "$bin/high_level_controller" "${common[@]}" --vehicle_ids="$one" \
    --middleware_domain="$middleware_domain" "${controller[@]}"
done
for one in "${ids[@]}"; do
  [[ -n $only ]] || : >"$out/logs/vehicle_$one.pids"
  for pid in "${!names[@]}"; do
    [[ ! ${names[$pid]} =~ _($all|$one)$ ]] || echo "$pid ${names[$pid]}"
  done >>"$out/logs/vehicle_$one.pids"
done
! $is_ending || end_all # signal during the start

first=0
while true; do
  for pid in "${!names[@]}"; do
    kill -0 "$pid" 2>/dev/null && continue
    wait "$pid"
    code=$?
    if ((code > 128)) && [[ $on_death == continue ]]; then
      which=${names[$pid]%_*} of=$vehicle_ids
      [[ $which != high_level_controller ]] || of=${names[$pid]##*_}
      echo "${names[$pid]} was killed; restart: $0 --vehicle_ids $of --only ${which/high_level_controller/hlc} --out ${out@Q} --bin ${bin@Q}" >&2
    elif ((code != 0)); then
      echo "${names[$pid]} ended with exit code $code: $(tail -n 1 "$out/logs/${names[$pid]}.log")" >&2
      ((first != 0)) || first=$code
      # For run_lab.sh, which cannot see the order among processes of several vehicles.
      echo "$code ${names[$pid]}" >>"$out/logs/failures"
    fi
    unset "names[$pid]"
    ((code != 2)) || end_all # rejected its input: the others would wait for it
  done
  ((${#names[@]} > 0)) || break
  # Only sleeps until a process ends: it does not report a process killed while another command ran.
  wait -n "${!names[@]}" 2>/dev/null
done
exit "$first"
