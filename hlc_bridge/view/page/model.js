// The run as the page knows it, and questions about it at any time. Data arrives through
// Run.take(), as messages that hlc_bridge/view/page_messages.hpp specifies.

const kFormat = 1;
const kNumColours = 8; // of the style sheet, for cars
const kNamedColours = { red: 0, blue: 1, green: 2 };

export function clamp(value, least, most) {
  return Math.max(least, Math.min(most, value));
}

/// The values of a column, which holds the first one and then the differences.
function sums(deltas, unit) {
  let sum = 0;
  return deltas.map((delta) => (sum += delta) * unit);
}

/// Points [[x, y], ...] of a line: x and y in turn, each as the difference to the point before.
function line_of(deltas, unit) {
  const [x, y] = [0, 1].map((odd) => sums(deltas.filter((_, i) => i % 2 === odd), unit));
  return x.map((value, i) => [value, y[i]]);
}

/// The pose b, given in the frame a, in a's own frame of reference.
function compose(a, b) {
  const c = Math.cos(a.yaw);
  const s = Math.sin(a.yaw);
  return { x: a.x + c * b.x - s * b.y, y: a.y + s * b.x + c * b.y, yaw: a.yaw + b.yaw };
}

/// The same for a point [x, y].
export function point_in(a, [x, y]) {
  const point = compose(a, { x, y, yaw: 0 });
  return [point.x, point.y];
}

function inverse(a) {
  const c = Math.cos(a.yaw);
  const s = Math.sin(a.yaw);
  return { x: -c * a.x - s * a.y, y: s * a.x - c * a.y, yaw: -a.yaw };
}

/// Between two poses, the heading along the shorter arc.
function between(a, b, part) {
  const turn = Math.atan2(Math.sin(b.yaw - a.yaw), Math.cos(b.yaw - a.yaw));
  return { x: a.x + part * (b.x - a.x), y: a.y + part * (b.y - a.y), yaw: a.yaw + part * turn };
}

export class Run {
  constructor() {
    this.about = null; // of the message "run"
    this.lanes = []; // [left, right], points
    this.vehicles = []; // in the order of the run
    this.maneuvers = []; // {label, path: poses, area: points}
    this.log = [];
    this.num_steps = 0; // steps reported so far
  }

  /// @throws Error for a message of another format
  take(message) {
    const take = `take_${message.kind}`;
    if (!this[take]) throw new Error(`unknown kind of message ${message.kind}`);
    this[take](message);
  }

  take_log({ lines }) {
    this.log.push(...lines);
  }

  take_run(message) {
    if (message.format !== kFormat) {
      throw new Error(`data of format ${message.format}, must be ${kFormat}, that of this page`);
    }
    this.about = message;
    this.unit = message.unit_m;
    this.step_s = message.step_s;
    this.lanes = message.lanes.map((bounds) => bounds.map((bound) => line_of(bound, this.unit)));
    this.vehicles = message.vehicles.map((vehicle, i) => ({
      ...vehicle,
      colour: kNamedColours[vehicle.name] ?? i % kNumColours,
      route: line_of(vehicle.route, this.unit),
      steps: [], // report of step k at [k], if any; without a label: no plan
      drives: [], // stretches without a gap
      whys: {}, // explanation of step k at [k], text
    }));
  }

  take_maneuvers(message) {
    for (const { label, path, area } of message.maneuvers) {
      const poses = [];
      for (let i = 0; i + 2 < path.length; i += 3) {
        const [x, y, yaw] = path.slice(i, i + 3);
        poses.push({ x: x * this.unit, y: y * this.unit, yaw: yaw * this.about.unit_rad });
      }
      this.maneuvers.push({ label, path: poses, area: line_of(area, this.unit) });
    }
  }

  take_steps(message) {
    const { about, unit } = this;
    const { names, sets, units, columns } = message;
    const tables = {
      status: about.statuses,
      reason: about.reasons,
      quality: about.qualities,
      label: names,
      subgraph: names,
      coupled: sets,
      missing: sets,
      waits_for: sets,
      blocked_by: sets,
    };
    const [x, y] = [sums(message.x, unit), sums(message.y, unit)];
    const yaw = sums(message.heading, about.unit_rad);
    const vehicle = this.vehicle(message.vehicle);
    sums(message.k, 1).forEach((k, i) => {
      const report = { k, pose: { x: x[i], y: y[i], yaw: yaw[i] } };
      for (const [name, column] of Object.entries(columns)) {
        report[name] = tables[name] ? tables[name][column[i]] : column[i] * (units[name] || 1);
      }
      vehicle.steps[k] = report;
      this.num_steps = Math.max(this.num_steps, k + 1);
    });
  }

  take_why({ vehicle, steps }) {
    for (const [k, text] of steps) this.vehicle(vehicle).whys[k] = text;
  }

  take_drive(message) {
    const [x, y] = [sums(message.x, this.unit), sums(message.y, this.unit)];
    const yaw = sums(message.yaw, this.about.unit_rad);
    const speed = sums(message.speed, 1e-3);
    this.vehicle(message.vehicle).drives.push({
      begin_s: message.begin_ms * 1e-3,
      tick_s: message.tick_ms * 1e-3,
      states: x.map((_, i) => ({ x: x[i], y: y[i], yaw: yaw[i], speed: speed[i] })),
    });
  }

  vehicle(id) {
    return this.vehicles.find((vehicle) => vehicle.id === id);
  }

  get end_s() {
    return this.num_steps * this.step_s;
  }

  step_at(t) {
    return clamp(Math.floor(t / this.step_s + 1e-6), 0, this.num_steps - 1);
  }

  report_at(vehicle, t) {
    return vehicle.steps[this.step_at(t)];
  }

  /// Where the car was, with its speed; null: not recorded. A record holds for a tick.
  driven_at(vehicle, t) {
    for (const { begin_s, tick_s, states } of vehicle.drives) {
      const at = (t - begin_s) / tick_s;
      const last = states.length - 1;
      if (at < -1e-6 || at > last + 1 + 1e-6) continue;
      const i = clamp(Math.floor(at), 0, last);
      const part = clamp(at - i, 0, 1);
      const [a, b] = [states[i], states[Math.min(last, i + 1)]];
      return { ...between(a, b, part), speed: a.speed + part * (b.speed - a.speed) };
    }
    return null;
  }

  driven_path(vehicle, from_s, to_s) {
    return vehicle.drives.flatMap(({ begin_s, tick_s, states }) => {
      const first = Math.max(0, Math.ceil((from_s - begin_s) / tick_s));
      const end = Math.max(0, Math.floor((to_s - begin_s) / tick_s) + 1);
      return states.slice(first, end).map(({ x, y }) => [x, y]);
    });
  }

  /// Frame of the maneuver under way in step k: it ends where the plan is at the next step. null
  /// without a plan or a known maneuver, or if the plan continues elsewhere, after a deviation.
  frame_of_maneuver(vehicle, k) {
    const report = vehicle.steps[k];
    const next = vehicle.steps[k + 1];
    const maneuver = this.maneuvers[report?.maneuver];
    if (!maneuver || !next) return null;
    const frame = compose(next.pose, inverse(maneuver.path.at(-1)));
    const apart_m = Math.hypot(frame.x - report.pose.x, frame.y - report.pose.y);
    return apart_m < 0.05 ? { maneuver, frame } : null;
  }

  /// Where the plan in force is at t; null: none, or not known, as within the last step.
  planned_at(vehicle, t) {
    const k = this.step_at(t);
    const report = vehicle.steps[k];
    if (!report?.label) return null;
    const part = clamp(t / this.step_s - k, 0, 1);
    const motion = this.frame_of_maneuver(vehicle, k);
    if (part < 1e-6) return report.pose;
    if (motion) {
      const { path } = motion.maneuver;
      const at = part * (path.length - 1);
      const i = Math.min(path.length - 2, Math.floor(at));
      return compose(motion.frame, between(path[i], path[i + 1], at - i));
    }
    const next = !this.maneuvers[report.maneuver] && vehicle.steps[k + 1];
    return next ? between(report.pose, next.pose, part) : null;
  }

  /// Points of the plan during the steps from ... to - 1, as far as it is known.
  planned_path(vehicle, from, to) {
    const points = [];
    for (let k = from; k < to; ++k) {
      if (!vehicle.steps[k]?.label) continue;
      const motion = this.frame_of_maneuver(vehicle, k);
      const poses = motion
        ? motion.maneuver.path.map((pose) => compose(motion.frame, pose))
        : [vehicle.steps[k].pose];
      points.push(...poses.map(({ x, y }) => [x, y]));
      if (!motion) break;
    }
    return points;
  }

  /// Area that the car may occupy in step k according to its plan; null: not known.
  area_in(vehicle, k) {
    const motion = this.frame_of_maneuver(vehicle, k);
    return motion && motion.maneuver.area.map((corner) => point_in(motion.frame, corner));
  }

  /// Box of all there is to see.
  box() {
    const min = [Infinity, Infinity];
    const max = [-Infinity, -Infinity];
    const add = (point) => {
      for (const i of [0, 1]) {
        min[i] = Math.min(min[i], point[i]);
        max[i] = Math.max(max[i], point[i]);
      }
    };
    for (const bound of this.lanes.flat()) bound.forEach(add);
    for (const vehicle of this.vehicles) {
      vehicle.route.forEach(add);
      this.driven_path(vehicle, 0, Infinity).forEach(add);
      vehicle.steps.forEach(({ label, pose }) => label && add([pose.x, pose.y]));
    }
    return min[0] <= max[0] ? { min, max } : { min: [0, 0], max: [4.5, 4] };
  }
}
