// The run as the page knows it, and questions about it at any time. Data arrives through
// Run.take(), as messages that hlc_bridge/view/page_messages.hpp specifies.

const kFormat = 2;

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
    this.roads = []; // {places: points, zones}, of cells
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
    this.roads = (message.roads || []).map(({ places, zones }) => (
      { places: line_of(places, this.unit), zones: sums(zones, 1) }));
    this.vehicles = message.vehicles.map((vehicle) => ({
      ...vehicle,
      route: line_of(vehicle.route, this.unit),
      steps: [], // report of step k at [k], if any; without a label: no plan
      whys: {}, // explanation of step k at [k]
      searches: {}, // page of what was searched in it
      drives: [], // stretches without a gap
    }));
  }

  poses_of({ x: dx, y: dy, yaw: turns }) {
    const [x, y] = [sums(dx, this.unit), sums(dy, this.unit)];
    return sums(turns, this.about.unit_rad).map((yaw, i) => ({ x: x[i], y: y[i], yaw }));
  }

  take_maneuvers({ maneuvers }) {
    const decode = (one) => (
      { ...one, path: this.poses_of(one), area: line_of(one.area, this.unit) });
    this.maneuvers.push(...maneuvers.map(decode));
  }

  take_steps(message) {
    const { about } = this;
    const poses = this.poses_of(message);
    const vehicle = this.vehicle(message.vehicle);
    sums(message.k, 1).forEach((k, i) => {
      const report = { k, pose: poses[i] };
      for (const [name, column] of Object.entries(message.columns)) {
        const named = about.tables[name];
        const table = about[named] || message[named];
        report[name] = table ? table[column[i]] : column[i] * (about.units[name] || 1);
      }
      vehicle.steps[k] = report;
      this.num_steps = Math.max(this.num_steps, k + 1);
    });
  }

  take_why({ vehicle, steps }) {
    const { whys } = this.vehicle(vehicle);
    for (const [first, last, text] of steps) {
      for (let k = first; k <= last; ++k) whys[k] = text;
    }
  }

  take_search({ vehicle, step, page }) {
    this.vehicle(vehicle).searches[step] = page;
  }

  take_drive(message) {
    const speed = sums(message.speed, 1e-3);
    this.vehicle(message.vehicle).drives.push({
      begin_s: message.begin_ms * 1e-3,
      tick_s: message.tick_ms * 1e-3,
      states: this.poses_of(message).map((pose, i) => ({ ...pose, speed: speed[i] })),
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

  /// Maneuvers of the plan in force, from step k on, as far as they are known: each with its frame.
  plan_in(vehicle, k) {
    const { plan = [], pose } = vehicle.steps[k] || {};
    let frame = pose;
    return plan.map((number) => {
      const motion = { ...this.maneuvers[number], frame };
      frame = compose(frame, motion.path.at(-1));
      return motion;
    });
  }

  /// Where the plan in force is at t; null: there is none.
  planned_at(vehicle, t) {
    const k = this.step_at(t);
    const report = vehicle.steps[k];
    if (!report?.label) return null;
    const part = clamp(t / this.step_s - k, 0, 1);
    const [motion] = this.plan_in(vehicle, k);
    if (part < 1e-6) return report.pose;
    if (!motion) return between(report.pose, (vehicle.steps[k + 1] || report).pose, part);
    const { path, frame } = motion;
    const at = part * (path.length - 1);
    const i = Math.min(path.length - 2, Math.floor(at));
    return compose(frame, between(path[i], path[i + 1], at - i));
  }

  /// The same in the map, as points: its path and the areas that the car may occupy.
  plan_points(vehicle, k) {
    const plan = this.plan_in(vehicle, k);
    const path = plan.flatMap(({ frame, path }) => path.map(({ x, y }) => point_in(frame, [x, y])));
    const areas = plan.map(({ frame, area }) => area.map((corner) => point_in(frame, corner)));
    return { path, areas };
  }

  /// Road that the car holds in step k: its cells' places, conflict zones in it, zone behind its end.
  held_in(vehicle, k) {
    const [road, first, count = 0] = vehicle.steps[k]?.held || [];
    const { places, zones } = this.roads[road] || { places: [], zones: [] };
    const of = (values, i) => values[(first + i) % values.length];
    const cells = (values) => Array.from({ length: count }, (_, i) => of(values, i));
    const held = new Set(cells(zones).filter(Boolean));
    return { places: cells(places), zones: [...held], next: of(zones, count) };
  }

  /// Box of all.
  box() {
    let points = this.lanes.flat(2).concat(this.about.obstacles.flatMap((one) => one.points));
    for (const vehicle of this.vehicles) {
      const planned = vehicle.steps.filter(({ label }) => label).map(({ pose }) => [pose.x, pose.y]);
      points = points.concat(vehicle.route, this.driven_path(vehicle, 0, Infinity), planned);
    }
    const most = (pick) =>
      [0, 1].map((i) => points.reduce((least, p) => pick(least, p[i]), pick()));
    const [min, max] = [most(Math.min), most(Math.max)];
    return points.length ? { min, max } : { min: [0, 0], max: [4.5, 4] };
  }
}
