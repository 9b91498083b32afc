// The state of a car in words.

function ids_text(ids) {
  return ids.length === 1 ? `car ${ids[0]}` : `cars ${ids.join(", ")}`;
}

export function seconds(value, digits = 1) {
  return `${value.toFixed(digits)} s`;
}

/// Why the car kept its plan, after "keeps its plan: ".
function reason_words(run, { reason, blocked_by }) {
  const [by_cars, alone] = run.about.words.reasons[reason];
  return blocked_by.length ? by_cars.replace("CARS", ids_text(blocked_by)) : alone;
}

/// {kind, words, short}: kind is one of page_words.cpp, short a label for the map, empty: none.
export function state_of(run, vehicle, t) {
  const state = (kind, words, short = "") => ({ kind, words, short });
  const { unknown } = run.about.words.kinds;
  const report = run.report_at(vehicle, t);
  if (vehicle.guest) return state("drives", "guest");
  if (!report) return state("silent", "no report in this step", "no report");
  const driven = run.driven_at(vehicle, t);
  const stands = driven && Math.abs(driven.speed) < 0.025; // m/s
  if (report.status === "minimal_risk_stop") {
    const motion = stands ? "stands" : "drives its plan to the end";
    return state("stop", `minimal-risk stop: ${driven ? motion : unknown}`, "stop");
  }
  const since_s = report.waits_since * run.step_s;
  const wait = wait_words(report, since_s, t);
  if (report.status === "fallback") {
    const words = `keeps its plan: ${reason_words(run, report)}${wait ? `; ${wait}` : ""}`;
    return state("fallback", words, `kept plan: ${report.reason.replace("_", " ")}`);
  }
  if (wait) {
    const short = `waits for ${report.waits_for.join(", ")}`;
    const is_stuck = t - since_s >= run.about.stuck_after_s;
    if (is_stuck) return state("stuck", `stuck: ${wait}`, `stuck, ${short}`);
    return state("waits", wait, short);
  }
  if (report.status === "standby") {
    const where = report.reason === "off_route" ? ", off every route" : "";
    return state("standby", `stands by for the start${where}`);
  }
  if (!driven) return state("unknown", unknown, "not recorded");
  if (stands) return state("stands", report.arrived ? "at its goal" : "stands");
  return state("drives", `drives, ${Math.abs(driven.speed).toFixed(2)} m/s`);
}

function wait_words({ waits_for }, since_s, t) {
  if (waits_for.length === 0) return "";
  const for_s = Math.max(0, t - since_s);
  return `waits for ${ids_text(waits_for)} since ${seconds(since_s)} (for ${seconds(for_s)})`;
}

export function milliseconds(value_s) {
  return `${(value_s * 1e3).toFixed(2)} ms`;
}

function planning_words(run, report) {
  const late = report.is_late ? `, answer late by ${milliseconds(report.late_s)}` : "";
  const share = (100 * report.planning_s) / run.step_s;
  const percent = share.toFixed(share < 1 ? 2 : 0);
  return `${milliseconds(report.planning_s)}, ${percent} % of the step${late}`;
}

function millimetres(value_m) {
  return `${(1e3 * value_m).toFixed(1)} mm`;
}

function pose_words(pose) {
  const degrees = Math.round((pose.yaw * 180) / Math.PI);
  const turn = degrees - 360 * Math.ceil((degrees - 180) / 360);
  return `x ${pose.x.toFixed(3)} m, y ${pose.y.toFixed(3)} m, ${turn} deg`;
}

function zone_rows(run, vehicle, k) {
  if (run.roads.length === 0) return [];
  const { zones, next } = run.held_in(vehicle, k);
  const holds = (one) => one !== vehicle && run.held_in(one, k).zones.includes(next);
  return [
    ["zones held", zones.map((zone) => `zone ${zone}`).join(", ") || "none"],
    ...(next ? [[`parts of zone ${next}, next, held by`, run.vehicles.filter(holds).map(({ id }) => id)]] : []),
  ];
}

/// Rows of the report of a car at t: [name, text] or [name, ids of other cars].
export function report_rows(run, vehicle, t) {
  const report = run.report_at(vehicle, t);
  const driven = run.driven_at(vehicle, t);
  const planned = run.planned_at(vehicle, t);
  const rows = [["state", state_of(run, vehicle, t).words]];
  if (driven) rows.push(["driven", pose_words(driven)]);
  if (planned) rows.push(["planned", pose_words(planned)]);
  if (driven && planned) {
    const apart_m = Math.hypot(driven.x - planned.x, driven.y - planned.y);
    rows.push(["difference", millimetres(apart_m)]);
  }
  if (!report) return rows;
  const { k, status, reason, quality, gap_m2, level } = report;
  const why = vehicle.whys[k] || run.about.why.replace("VEHICLE", vehicle.id).replace("STEP", k);
  const gap = gap_m2 > 0 ? `, at most ${gap_m2.toFixed(4)} m2 above the optimum` : "";
  return [
    ...rows,
    ["status", reason === "none" ? status : `${status}: ${reason}`],
    ["waits for", report.waits_for],
    ["coupled with", report.coupled],
    ["missing", report.missing],
    ["maneuver", report.label || "no plan yet"],
    ...(why ? [["why", why]] : []),
    ...(vehicle.searches[k] ? [["searched", { k }]] : []),
    ["plan", report.plan_labels],
    ...zone_rows(run, vehicle, k),
    ["subgraph", report.subgraph],
    ["plan found", run.about.words.qualities[quality] + gap],
    ["cost", quality === "none" ? "none" : `${report.cost_m2.toFixed(4)} m2`],
    ...(report.together ? [["plans together", report.together]] : []),
    ["planning time", planning_words(run, report)],
    ["vertices", `${report.generated} generated, ${report.expanded} expanded`],
    ["level", String(level)],
    ["deviation", `${millimetres(report.deviation_m)} outside the planned footprint`],
  ];
}
