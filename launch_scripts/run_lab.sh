#!/usr/bin/env bash
# Drives a scenario: one simulated car, middleware and high-level controller per vehicle and one lab control,
# each its own process, or one process with all cars and one middleware, over DDS. Prints the result table.
set -uo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
root=$(dirname "$here")
runs=$root/runs programs=""
if [[ -x $here/lab_control ]]; then # installed beside the programs
  runs=$PWD/runs programs=$here
fi

usage() {
  cat <<'TEXT'
usage: run_lab.sh [flags]      (every flag also as --name=value)
Installs what is missing, builds, drives three cars for 30 s, prints the result table. Where it is installed beside the
programs it builds nothing, and runs/ is in the working directory.
  --scenario FILE         scenario file (YAML), or the name of one of launch_scripts/scenarios
                          (default paper_three_cars; also paper_red_alone, circle, lab_cars)
  --commonroad FILE       drives the planning problems of this CommonRoad file (2020a, 2018b) instead, with the vehicle of
                          --scenario (default then: passenger_cars_in_town); refuses what cannot be honoured
  --from_standstill BOOL  with --commonroad; true: cars that move in their initial states begin standing there;
                          false (default): these are refused
  --profile NAME          default: every plan optimal, safe under loss of messages between controllers
                          2022: the rules that produced the paper's numbers
  --engine NAME           search engine: branch_and_bound (default profile) or best_first (profile 2022); the same called
                          through OMPL's planner interface: ompl_branch_and_bound, ompl_best_first
  --subgraph NAME         of the automaton, instead of the scenario's
  --priorities NAME       who plans first: constant, random, fca, colouring, waiting_time, explorative, optimal or
                          best_order (rollout --help explains them), instead of the scenario's
  --policy NAME           by which the cars change the subgraph themselves, or none, instead of the scenario's
  --map FILE              CommonRoad XML instead of the scenario's map
  --cars N                number of cars (scenarios circle and lab_cars)
  --seed N                of the draw of cars (scenario lab_cars) and of random routes, instead of the scenario's
  --routes random         every car takes random turns forever, instead of the scenario's routes
  --steps N               control steps of 0.2 s, instead of the scenario's
  --simulated_time BOOL   true: logical time, as fast as possible (default); false: real time
  --noise_seed N          measurement noise of the simulated cars from this seed (default: none)
  --gains_scale X         gains of the simulated cars' followers (default 1)
  --stamps NAME           of the simulated cars: exact, or lab: 20 ms early and with the lab's tracking errors (default:
                          as the scenario's lab)
  --on_death WHAT         stop (default): when a process dies, the others make a minimal-risk stop and the run ends;
                          continue (real time): the run continues, and a killed controller may be restarted
                          (launch_scripts/vehicle.sh --vehicle_ids N --only hlc --out DIR)
  --share NAME            none: a middleware and a simulator process per vehicle; machine: one of each for all (default:
                          none up to 4 cars; a drive is the same with both)
  --transport NAME        loopback (default) or lab
  --dds_domain N          lab domain; the vehicles take the next ones (--share machine: one), the controllers N + 50
                          (default: a free block)
  --security DIR          DDS security with the identities of make_security.sh (default: HLC_SECURITY, or none)
  --dump_problems DIR     write each planning problem to a JSON file in this new or empty folder, for plan_problem; in
                          real time this may delay steps
  --page BOOL             true (default): the run folder gets run.html, the whole run to be watched in a browser
  --log_level NAME        least severe messages in the logs: trace, debug, info, warning, error, critical or off
                          (default: the environment variable HLC_LOG_LEVEL, or info)
  --messages BOOL         true (default): the run folder gets run.mcap, every message between the processes, for Foxglove,
                          Lichtblick and the libraries of MCAP
  --view                  prints the address of a page on this machine that shows the run while it drives, best in real
                          time; the run is the same with it
  --out DIR               run folder (default: a new one in runs/)
  --preset NAME           build preset (default release)
  --startup_timeout_s N   startup timeout (default 20)
  --no_build              use the existing programs
  --bin DIR               use the programs in DIR, build nothing
Examples:
  run_lab.sh --scenario lab_cars --cars 10
  run_lab.sh --view --simulated_time=false --out runs/my_run
  run_lab.sh --commonroad problem.xml --from_standstill true
Exit codes: 0 success, 1 setup or build failed, or a record or --dump_problems is incomplete, 2 invalid input, 3 startup timeout,
            4 a process died during the run, 5 a vehicle left its plan or touched another one,
            6 all steps driven, but a vehicle was stuck at the end: it had waited for others for 20 s, 130 interrupted
TEXT
}

fail() { echo "run_lab.sh: $1" >&2; exit 2; }
# shellcheck source=SCRIPTDIR/domain_locks.sh
source "$here/domain_locks.sh"

scenario="" commonroad="" from_standstill="" profile=default engine="" priorities="" dump_problems="" subgraph="" policy="" map="" cars="" seed=""
routes="" steps=""
simulated_time=true noise_seed="" gains_scale="" stamps="" on_death=stop transport=loopback dds_domain="" out="" preset=release
bin="" build=true share="" page=true messages=true view=false security=${HLC_SECURITY-}
startup_timeout_s=20 log_level=${HLC_LOG_LEVEL:-info}
while (($#)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --version) exec "$here/version.sh" run_lab.sh ;;
    --no_build) build=false; shift; continue ;;
    --view) view=true; shift; continue ;;
    --*=*) name=${1%%=*} value=${1#*=} ;;
    --*) name=$1 value=${2-} ;;
    *) fail "unexpected argument $1 (see --help)" ;;
  esac
  [[ $name != --dump-problems ]] || { # up to the last release
    echo "run_lab.sh: --dump-problems is now --dump_problems" >&2
    name=--dump_problems
  }
  case "${name#--}" in
    scenario | commonroad | from_standstill | profile | engine | priorities | dump_problems | subgraph | policy | map | cars | seed | routes | steps | \
      simulated_time | noise_seed | gains_scale | stamps | on_death | transport | dds_domain | out | preset | bin | \
      share | page | messages | security | startup_timeout_s | log_level) ;;
    *) fail "unknown flag $name (see --help)" ;;
  esac
  if [[ $1 != *=* ]]; then
    (($# >= 2)) || fail "$name needs a value"
    shift
  fi
  shift
  if [[ -z $value ]]; then
    case "$name" in
      --out | --dump_problems) fail "$name = , must be a new or an empty folder" ;;
      --scenario) fail "$name = , must be a scenario file or the name of one" ;;
      --security) ;; # without, whatever HLC_SECURITY is
      *) fail "$name = , must not be empty" ;;
    esac
  fi
  printf -v "${name#--}" '%s' "$value"
done
[[ $simulated_time == true || $simulated_time == false ]] ||
  fail "--simulated_time = $simulated_time, must be one of true, false"
[[ $page == true || $page == false ]] || fail "--page = $page, must be one of true, false"
[[ $messages == true || $messages == false ]] || fail "--messages = $messages, must be one of true, false"
[[ $on_death == stop || ($on_death == continue && $simulated_time == false) ]] ||
  fail "--on_death = $on_death, must be stop, or in real time continue"
[[ $transport == loopback || $transport == lab ]] || fail "--transport = $transport, must be one of loopback, lab"
[[ -z $share || $share == none || $share == machine ]] || fail "--share = $share, must be one of none, machine"
[[ $share != machine || $transport == loopback || $simulated_time == false ]] ||
  fail "--share = machine with --transport = lab in logical time, must be none"
whole_number() { [[ -z $2 || $2 =~ ^[0-9]{1,9}$ ]] || fail "--$1 = $2, must be a whole number"; }
for name in cars seed steps noise_seed dds_domain startup_timeout_s; do whole_number "$name" "${!name}"; done
in_range() { # flag, value, from, to
  [[ -z $2 ]] || ((10#$2 >= $3 && 10#$2 <= $4)) || fail "--$1 = $2, must be in $3 ... $4"
}
[[ -z $cars ]] || ((10#$cars >= 1 && 10#$cars <= 30)) ||
  fail "--cars = $cars, must be in 1 ... 30 in the lab; rollout and evaluate take more"
in_range steps "$steps" 1 10000
in_range startup_timeout_s "$startup_timeout_s" 1 3000
in_range noise_seed "$noise_seed" 0 999999000 # every car adds its id
startup_timeout_s=$((10#$startup_timeout_s)) # 010 is ten
[[ -z $noise_seed ]] || noise_seed=$((10#$noise_seed))
[[ -z $seed ]] || seed=$((10#$seed))
[[ -z $gains_scale || $gains_scale =~ ^[0-9]+(\.[0-9]+)?$ ]] || fail "--gains_scale = $gains_scale, must be a number >= 0"
[[ -z $stamps || $stamps == exact || $stamps == lab ]] || fail "--stamps = $stamps, must be one of exact, lab"
[[ -z $gains_scale || $stamps != lab ]] || fail "--stamps = lab with --gains_scale, must be exact: the lab's follower has no gains"
[[ -z $gains_scale ]] || stamps=exact
# Files and folders of any name: none begins with a dash.
for name in out dump_problems map security bin; do [[ -z ${!name} || ${!name} == /* ]] || printf -v "$name" '%s' "$PWD/${!name}"; done
[[ -z $security || -r $security/authority.pem ]] ||
  fail "--security = $security: no authority.pem, must be a folder of make_security.sh"
[[ $log_level =~ ^(trace|debug|info|warning|error|critical|off)$ ]] ||
  fail "--log_level = $log_level, must be one of trace, debug, info, warning, error, critical, off"
case "$preset" in
  release | debug | asan | tsan | fast_dds_3) ;;
  *) fail "--preset = $preset, must be one of release, debug, asan, tsan, fast_dds_3" ;;
esac
[[ -z $from_standstill || ($from_standstill =~ ^(true|false)$ && -n $commonroad) ]] ||
  fail "--from_standstill = $from_standstill, must be one of true, false, with --commonroad"
[[ -z $commonroad || -z $map$routes$cars$seed$policy ]] ||
  fail "--commonroad with --map, --routes, --cars, --seed or --policy, must be without"
[[ -z $commonroad || -f $commonroad ]] || fail "--commonroad = $commonroad is no file, must be a CommonRoad file"
[[ -z $commonroad || $commonroad == /* ]] || commonroad=$PWD/$commonroad
if [[ -z $scenario ]]; then
  scenario=paper_three_cars
  [[ -z $commonroad ]] || scenario=passenger_cars_in_town
fi
is_file() { [[ -e $1 && ! -d $1 ]]; }
shipped=$here/scenarios/${scenario%.yaml}.yaml
if ! is_file "$scenario" && is_file "$shipped"; then scenario=$shipped; fi # a folder hides none of ours
[[ ! -d $scenario ]] || fail "--scenario = $scenario is a folder, must be a scenario file"
[[ -e $scenario ]] || fail "--scenario: no file $shipped; shipped: $(cd "$here/scenarios" && echo *.yaml)"
[[ -r $scenario ]] || fail "--scenario = $scenario: cannot be read, must be a scenario file"
[[ $scenario == /* ]] || scenario=$PWD/$scenario
[[ -n $bin ]] || bin=$programs
[[ -z $bin ]] || build=false

required="must be a new or an empty folder"
check_new_or_empty() { # flag, folder
  [[ ! -e $2 || -d $2 ]] || fail "--$1 = $2 is not a folder, $required"
  [[ -z $(ls -A -- "$2" 2>/dev/null) ]] || fail "--$1 = $2 is not empty, $required"
}
[[ -z $out ]] || check_new_or_empty out "$out"
[[ -z $dump_problems ]] || check_new_or_empty dump_problems "$dump_problems"

# Whoever has to build first waits for minutes, so what can be seen without show_scenario is refused before: only what
# show_scenario would certainly refuse, too. It looks at the rest.
check_before_build() {
  mentions() { grep -qw -e "$1" "$scenario"; }
  [[ $profile == default || $profile == 2022 ]] || fail "--profile = $profile, must be one of default, 2022"
  [[ -z $routes || $routes == random ]] || fail "--routes = $routes, must be random"
  [[ -z $map || (-r $map && ! -d $map) ]] || fail "--map = $map: cannot be read, must be a CommonRoad file"
  [[ -z $cars ]] || mentions circle || mentions draw ||
    fail "--cars: $scenario has named vehicles; must be a scenario with \`circle\` or \`draw\`"
  [[ -z $seed || -n $routes ]] || mentions draw || mentions random ||
    fail "--seed: $scenario has nothing to draw; must be a scenario with \`draw\` or random routes"
  local rules=$root/planner/coordination/priorities # also one that somebody adds
  [[ -z $priorities ]] || grep -rqF -e "\"$priorities\"" "$rules" ||
    fail "--priorities = $priorities, must be one of$(sed -n 's/.*\.name = "\([^"]*\)".*/ \1/p' "$rules"/*.cpp | paste -sd,)"
}
! $build || check_before_build

build_programs() { ! $build || "$here/build.sh" --preset "$preset" "$1" || exit 1; }
if $build; then
  "$here/setup.sh" || exit 1
  build_programs --run_programs
  if $view || [[ -n $commonroad ]]; then build_programs --programs; fi
fi
[[ -n $bin ]] || bin=$root/build/$preset/bin
[[ -x $bin/lab_control ]] || fail "no programs in $bin; leave out --no_build and --bin"

imported=""
# shellcheck disable=SC2317 # called by the traps
remove_imported() { [[ -z $imported ]] || rm -rf -- "$imported"; }
if [[ -n $commonroad ]]; then # with its map beside it, so that the run folder's copies name each other
  imported=$(mktemp -d) || fail "no temporary folder for --commonroad, must be one that can be created"
  trap remove_imported EXIT
  name=$(basename "$commonroad" .xml)
  mkdir "$imported/maps" "$imported/scenarios"
  cp -- "$commonroad" "$imported/maps/$name.xml" ||
    fail "--commonroad = $commonroad: cannot be read, must be a CommonRoad file"
  message=$("$bin/import_commonroad" --commonroad "$imported/maps/$name.xml" --like "$scenario" \
    --from_standstill "${from_standstill:-false}" --out "$imported/scenarios/$name.yaml" 2>&1) ||
    { echo "${message//"$imported/maps/$name.xml"/"$commonroad"}" >&2; exit 2; }
  scenario=$imported/scenarios/$name.yaml
fi

choices=(--scenario "$scenario" --profile "$profile")
[[ -z $engine ]] || choices+=(--engine "$engine")
[[ -z $subgraph ]] || choices+=(--subgraph "$subgraph")
[[ -z $priorities ]] || choices+=(--priorities "$priorities")
[[ -z $policy ]] || choices+=(--policy "$policy")
[[ -z $map ]] || choices+=(--map "$map")
[[ -z $cars ]] || choices+=(--cars "$cars")
[[ -z $seed ]] || choices+=(--seed "$seed")
[[ -z $routes ]] || choices+=(--routes "$routes")
check=("${choices[@]}")
[[ -z $steps ]] || check+=(--steps "$steps")
starts=$("$bin/show_scenario" "${check[@]}" --print_starts --print_steps --print_period --print_guests) || exit 2
read -r guests by_hand < <(tail -n 1 <<<"$starts")
period_ms=$(tail -n 2 <<<"$starts" | head -n 1)
steps=$(tail -n 3 <<<"$starts" | head -n 1)
starts=$(head -n -3 <<<"$starts")
[[ $by_hand == - ]] || build_programs --programs # drive_by_hand
guest_ids=()
[[ $guests == - ]] || mapfile -t guest_ids < <(tr , '\n' <<<"$guests")
for id in "${guest_ids[@]}"; do
  ((id <= 30)) || fail "scenario $scenario: guest $id, must be in 1 ... 30 in the lab; evaluate takes more"
done
[[ $period_ms =~ ^[0-9]+$ && $((period_ms % 50)) == 0 ]] ||
  fail "scenario $scenario: the automaton's step_s is $period_ms ms, must be a multiple of 50 ms in the lab; rollout takes others"
mapfile -t ids < <(awk '{print $1}' <<<"$starts")
((ids[-1] <= 30)) || fail "scenario $scenario: vehicle ${ids[-1]}, must be in 1 ... 30 in the lab; rollout and evaluate take more"
[[ -n $stamps ]] || stamps=$(awk 'NR == 1 {print $3}' <<<"$starts")

# With more than 4 cars the processes of each cost more than they compute.
if [[ -z $share ]]; then
  share=machine
  ((${#ids[@]} > 4)) && [[ $transport == loopback || $simulated_time == false ]] || share=none
fi

# A block of DDS domains not used by any other run on this machine: the lab's and one per middleware, 50 higher
# the controllers'. This shell and its children hold the locks; a manual vehicle.sh shares them.
largest_id=${ids[-1]}
[[ $share == none ]] || largest_id=${ids[0]}
block_is_free() { # first domain, whose participants make it taken: anybody's or others'
  local domain fd fds=()
  for ((domain = $1; domain <= $1 + largest_id; domain++)); do
    if lock_domain "$domain" --exclusive; then
      fds+=("$lock")
      domain_has "$domain" "$2" || domain_has $((domain + 50)) "$2" || continue
    fi
    for fd in "${fds[@]}"; do exec {fd}<&-; done
    return 1
  done
}
if [[ -n $dds_domain ]]; then
  dds_domain=$((10#$dds_domain))
  ((dds_domain + largest_id <= 50)) ||
    fail "--dds_domain = $dds_domain, must be in 0 ... $((50 - largest_id)) (the vehicles take the next ones)"
  block_is_free "$dds_domain" others ||
    fail "--dds_domain = $dds_domain: another run uses one of $dds_domain ... $((dds_domain + largest_id))"
else
  blocks=$((50 - largest_id))
  for ((i = 0; i < blocks; i++)); do
    first=$((1 + (EUID + i) % blocks))
    if block_is_free "$first" anybody; then
      dds_domain=$first
      break
    fi
  done
  [[ -n $dds_domain ]] || fail "no free block of $((largest_id + 1)) DDS domains in 1 ... 50; give --dds_domain"
fi

made=()
make_folder() { # flag, folder
  local probe
  check_new_or_empty "$1" "$2" # since the build another run may have taken it
  [[ -d $2 ]] || made=("$2" "${made[@]}")
  if ! mkdir -p -- "$2" 2>/dev/null; then
    rmdir -- "${made[@]}" 2>/dev/null
    fail "--$1 = $2: the folder cannot be created, $required"
  fi
  if ! probe=$(mktemp -- "$2/XXXXXX" 2>/dev/null) || ! rm -- "$probe" 2>/dev/null; then
    rmdir -- "${made[@]}" 2>/dev/null
    fail "--$1 = $2: not writable, $required that is writable"
  fi
}
[[ -z $out ]] || make_folder out "$out" # first: may contain the problems
if [[ -n $dump_problems ]]; then
  make_folder dump_problems "$dump_problems"
fi
if [[ -z $out ]]; then
  out=$runs/$(date +%Y%m%d_%H%M%S)_$(basename "$scenario" .yaml)
  base=$out
  for ((i = 2; ; i++)); do
    mkdir -p "$runs" && mkdir "$out" 2>/dev/null && break
    out=${base}_$i
    ((i < 1000)) || fail "cannot create a run folder in $runs"
  done
fi
mkdir -p "$out/logs" "$out/configuration" 2>/dev/null || fail "--out = $out: not writable"

# Flags of this run, in addition to the files that summarize writes.
quoted() { # for YAML
  local text=${1//\\/\\\\}
  text=${text//\"/\\\"}
  case "$1" in
    "") echo null ;;
    *[$'\n\t\r']*) text=${text//$'\n'/\\n} text=${text//$'\t'/\\t} text=${text//$'\r'/\\r}; printf '"%s"' "$text" ;;
    *) printf "'%s'" "${1//\'/\'\'}" ;;
  esac
}
cat >"$out/configuration/flags.yaml" <<TEXT
# Flags of run_lab.sh; null: not given. Car N measures with the noise of seed noise_seed + N.
scenario: $(quoted "$(realpath "$scenario")")
commonroad: $(quoted "$commonroad")
profile: $(quoted "$profile")
engine: $(quoted "$engine")
subgraph: $(quoted "$subgraph")
priorities: $(quoted "$priorities")
policy: $(quoted "$policy")
map: $(quoted "${map:+$(realpath "$map")}")
cars: ${cars:-null}
seed: ${seed:-null}
routes: $(quoted "$routes")
steps: $steps
simulated_time: $simulated_time
noise_seed: ${noise_seed:-null}
gains_scale: ${gains_scale:-1}
stamps: $stamps
on_death: $on_death
transport: $transport
share: $share
dds_domain: $dds_domain
startup_timeout_s: $startup_timeout_s
programs: $(quoted "$(realpath "$bin")")
TEXT

# Runs a command that gets SIGTERM when this script ends, even by SIGKILL.
with_me() { exec setpriv --pdeathsig TERM -- "$@"; }

children=() lab_control="" view_process=""
any_runs() {
  local pid
  for pid in "$@"; do kill -0 "$pid" 2>/dev/null && return 0; done
  return 1
}
wait_until() { # $SECONDS, for the children to end
  while any_runs "${children[@]}" && ((SECONDS < $1)); do sleep 0.05; done
}
# shellcheck disable=SC2317 # called by the traps
end_children() {
  trap '' INT TERM HUP
  ((${#children[@]} > 0)) && any_runs "${children[@]}" || return 0
  kill -TERM "${children[@]}" 2>/dev/null
  wait_until $((SECONDS + 8)) # vehicle.sh kills processes that do not terminate
  [[ -z $lab_control ]] || kill -KILL "$lab_control" 2>/dev/null
  local pid
  for pid in "${children[@]}"; do wait "$pid" 2>/dev/null; done
}
# Shows what it has to its browsers, and that the run has ended.
# shellcheck disable=SC2317 # called by the traps
end_view() {
  [[ -n $view_process ]] || return 0
  local deadline=$((SECONDS + 4))
  kill -TERM "$view_process" 2>/dev/null
  while any_runs "$view_process" && ((SECONDS < deadline)); do sleep 0.05; done
  kill -KILL "$view_process" 2>/dev/null
  wait "$view_process" 2>/dev/null
  view_process=""
}
# shellcheck disable=SC2317 # called by the traps
end_all() { end_children; end_view; remove_imported; }
# The table of the steps that were recorded.
summarize() {
  local page_flag=()
  [[ $page == true ]] || page_flag=(--page false)
  "$bin/summarize" --run "$out" "${page_flag[@]}"
}
# shellcheck disable=SC2317 # called by the trap
end_early() {
  end_children
  end_view
  [[ ! -s $out/reports.csv ]] || summarize # before the imported scenario is removed: it keeps a copy
  exit 130
}
trap end_early INT TERM HUP
trap end_all EXIT # also when this script fails

secured=()
[[ -z $security ]] || secured=(--security "$security")
flags=(--dds_domain "$dds_domain" --simulated_time "$simulated_time" --transport "$transport" --out "$out" "${secured[@]}")
export HLC_LOG_LEVEL=$log_level
if $view; then # whatever becomes of it, the run goes on
  view_log=$out/logs/view.txt
  with_me "$bin/view" --dds_domain "$dds_domain" --simulated_time "$simulated_time" --transport "$transport" \
    --logs "$out/logs" "${secured[@]}" "${choices[@]}" </dev/null >"$view_log" 2>&1 &
  view_process=$!
  deadline=$((SECONDS + startup_timeout_s))
  while ! grep -qs '^view: http' "$view_log" && any_runs "$view_process" && ((SECONDS < deadline)); do sleep 0.05; done
  grep -s '^view: http' "$view_log" || echo "run_lab.sh: no view of this run: $(tail -n 1 "$view_log" 2>/dev/null)" >&2
fi
groups=("${ids[@]}")
[[ $share == none ]] || groups=("$(IFS=,; echo "${ids[*]}")")
for group in "${groups[@]}"; do
  pose="" seeds=""
  for id in ${group//,/ }; do
    pose+=${pose:+,}$(awk -v id="$id" '$1 == id {print $2}' <<<"$starts")
    [[ -z $noise_seed ]] || seeds+=${seeds:+,}$((noise_seed + id))
  done
  vehicle=("${flags[@]}" --messages "$messages" --on_death "$on_death" --vehicle_ids "$group" --bin "$bin" "${choices[@]}"
    --startup_timeout_s $((startup_timeout_s + 10)) --pose "$pose" --stamps "$stamps")
  [[ -z $seeds ]] || vehicle+=(--noise_seed "$seeds")
  [[ -z $gains_scale ]] || vehicle+=(--gains_scale "$gains_scale")
  [[ -z $dump_problems ]] || vehicle+=(--dump_problems "$dump_problems")
  HLC_DOMAINS_ARE_RESERVED=1 with_me "$here/vehicle.sh" "${vehicle[@]}" 2>>"$out/logs/vehicles.log" &
  children+=($!)
done
recorded=()
$messages && recorded=(--messages_folder "$out/messages")
guest_flags=()
if ((${#guest_ids[@]} > 0)); then
  guest_flags=(--guest_ids "$guests")
  seeds=""
  [[ -z $noise_seed ]] || for id in "${guest_ids[@]}"; do seeds+=${seeds:+,}$((noise_seed + id)); done
  with_me "$bin/vehicle_sim" --dds_domain "$dds_domain" --simulated_time "$simulated_time" --transport "$transport" "${secured[@]}" \
    "${recorded[@]}" --vehicle_ids "$guests" --scenario "$scenario" --stamps "$stamps" ${seeds:+--noise_seed "$seeds"} \
    --startup_timeout_s $((startup_timeout_s + 10)) --record "$out/vehicle_{id}.csv" </dev/null >"$out/logs/guests.log" 2>&1 &
  children+=($!)
fi
vehicles=("${children[@]}")
with_me "$bin/lab_control" "${flags[@]}" "${recorded[@]}" --vehicle_ids "$(IFS=,; echo "${ids[*]}")" "${guest_flags[@]}" --steps "$steps" \
  --period_ms "$period_ms" --on_death "$on_death" --startup_timeout_s "$startup_timeout_s" </dev/null &
children+=($!)
lab_control=$!

[[ $by_hand == - ]] || echo "Guests that are driven by hand ($by_hand) wait for, each in a terminal of its own:
  $bin/drive_by_hand --scenario ${scenario@Q} --vehicle_id ${by_hand%%,*} --dds_domain $dds_domain --transport $transport"

# Lab control ends last, or nearly so: if it outlives all vehicles by far, it hangs.
while any_runs "$lab_control" && any_runs "${vehicles[@]}"; do
  wait -n "${children[@]}" 2>/dev/null
  # A process that has rejected its input does not appear: do not wait for it.
  ! grep -qs '^2 ' "$out/logs/failures" || { kill -TERM "${children[@]}" 2>/dev/null; break; }
done
any_runs "$lab_control" && wait_until $((SECONDS + startup_timeout_s + 15))
if ! any_runs "${vehicles[@]}" && any_runs "$lab_control"; then
  echo "lab_control not responding" >&2
  kill -KILL "$lab_control"
fi
wait "$lab_control"
code=$?
((code != 6)) || code=0 # all steps driven: summarize reports the stuck vehicles
((code == 0)) || echo "$code lab_control" >>"$out/logs/failures"
((code <= 130)) || echo "lab_control died (signal $((code - 128)))" >&2

# The others end after lab control's stop; the rest is terminated.
((code <= 1 || code == 4 || code > 130)) || kill -TERM "${children[@]}" 2>/dev/null
wait_until $((SECONDS + 12))
kill -TERM "${children[@]}" 2>/dev/null # vehicle.sh kills processes that do not terminate
for pid in "${children[@]}"; do
  wait "$pid"
  child=$?
  ((code != 0 || child == 0)) || code=$child
done
# The first failure is the cause: the others may be its consequence. Any failure has precedence over 1, a good
# run with an incomplete record.
if [[ -s $out/logs/failures ]]; then
  read -r code _ < <(grep -v '^1 ' "$out/logs/failures" || cat "$out/logs/failures")
fi
((code <= 130)) || code=4 # killed or crashed
((code == 0)) || cat "$out/logs/vehicles.log" >&2

if [[ -s $out/reports.csv ]]; then
  summarize
  summarized=$?
  ((code > 1 || summarized == 0)) || code=$summarized
fi
exit "$code"
