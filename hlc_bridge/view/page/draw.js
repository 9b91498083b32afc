// The map: lanes, paths, areas and cars at one time, on a canvas. World coordinates in m, y up.

import { compose, point_in } from "./model.js";
import { state_of } from "./words.js";

const kTrail_s = 4; // of the driven path
const kNumColours = 8;
const kBar_px = 36; // of the buttons above and below
const kNamed = { red: 0, blue: 1, green: 2 };

/// Colour of a car: that of its name, otherwise by its place in the run.
export function colour_index(run, vehicle) {
  const named = kNamed[vehicle.name];
  return named !== undefined ? named : run.vehicles.indexOf(vehicle) % kNumColours;
}

/// As the style sheet gives them, light or dark.
export function read_colours() {
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue(`--${name}`).trim();
  const colours = { cars: [] };
  for (let i = 0; i < kNumColours; ++i) {
    colours.cars.push({ fill: value(`car-${i}`), ink: value(`ink-${i}`) });
  }
  for (const name of ["ground", "lane", "bound", "text", "muted", "alarm"]) {
    colours[name] = value(name);
  }
  return colours;
}

const font_of = (size_px) => `600 ${size_px}px system-ui, sans-serif`;

function path_through(points, closed) {
  const path = new Path2D();
  points.forEach(([x, y], i) => (i === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  if (closed) path.closePath();
  return path;
}

function path_at(pose, points, closed = true) {
  return path_through(points.map((point) => point_in(pose, point)), closed);
}

/// Adapts the canvas to page and screen. @return its pixels per px of the page
export function adapt(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  return ratio;
}

export class MapView {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.centre = [0, 0];
    this.scale = 100; // px per m
    this.is_fitted = true; // until the user zooms or moves
    this.colours = read_colours();
  }

  /// After a change of the run's map or routes.
  set_run(run) {
    this.run = run;
    this.lanes = run.lanes.map(([left, right]) => ({
      area: path_through([...left, ...[...right].reverse()], true),
      bounds: [path_through(left), path_through(right)],
    }));
    this.routes = new Map(run.vehicles.map((v) => [v.id, path_through(v.route, v.closed)]));
    this.fit();
  }

  fit() {
    const { min, max } = this.run.box();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const margin_m = 0.2;
    const across = max[0] - min[0] + 2 * margin_m;
    const up = max[1] - min[1] + 2 * margin_m;
    this.centre = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2];
    this.scale = Math.max(1, Math.min(width / across, (height - 2 * kBar_px) / up));
    this.is_fitted = true;
  }

  get middle() {
    return [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
  }

  /// What is at (x, y) on the canvas stays there.
  zoom(factor, x = this.middle[0], y = this.middle[1]) {
    const before = this.scale;
    this.scale = Math.max(5, Math.min(5000, before * factor));
    const growth = this.scale / before - 1;
    this.move((this.middle[0] - x) * growth, (this.middle[1] - y) * growth);
  }

  move(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
    this.is_fitted = false;
  }

  to_canvas([x, y]) {
    const [middle_x, middle_y] = this.middle;
    return [
      (x - this.centre[0]) * this.scale + middle_x,
      (this.centre[1] - y) * this.scale + middle_y,
    ];
  }

  /// Where a car is drawn at t: as driven, else as planned, then or when the step began.
  place(vehicle, t) {
    const { run } = this;
    const planned = (at) => run.planned_at(vehicle, at);
    return run.driven_at(vehicle, t) || planned(t) || planned(run.step_at(t) * run.step_s);
  }

  /// The car at (x, y) on the canvas, or the nearest within a finger's width.
  car_at(x, y, t) {
    let [nearest, least_px] = [null, 24];
    for (const vehicle of this.run.vehicles) {
      const pose = this.place(vehicle, t);
      if (!pose) continue;
      const at = this.to_canvas([pose.x, pose.y]);
      const inside_px = (0.4 * vehicle.length_m * this.scale) | 0;
      const apart_px = Math.max(0, Math.hypot(at[0] - x, at[1] - y) - inside_px);
      if (apart_px < least_px) [nearest, least_px] = [vehicle, apart_px];
    }
    return nearest;
  }

  /// From here on drawing is in world coordinates.
  use_world() {
    const s = this.scale * this.ratio;
    const [x, y] = this.to_canvas([0, 0]);
    this.context.setTransform(s, 0, 0, -s, x * this.ratio, y * this.ratio);
  }

  use_canvas() {
    this.context.globalAlpha = 1;
    this.context.setLineDash([]);
    this.context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
  }

  /// @param dashes  in px
  stroke(path, colour, width_px, dashes = [], opacity = 1) {
    const { context, scale } = this;
    const lineWidth = width_px / scale;
    Object.assign(context, { globalAlpha: opacity, strokeStyle: colour, lineWidth });
    context.setLineDash(dashes.map((px) => px / scale));
    context.stroke(path);
  }

  fill(path, colour, opacity = 1) {
    Object.assign(this.context, { globalAlpha: opacity, fillStyle: colour });
    this.context.fill(path);
  }

  colour_of(vehicle) {
    return this.colours.cars[colour_index(this.run, vehicle)];
  }

  /// @param shown  {t, selected: id or null, follow, layers: {reference, driven, planned, areas}}
  draw(shown) {
    this.ratio = adapt(this.canvas);
    if (this.is_fitted) this.fit();
    const followed = shown.follow && this.run.vehicle(shown.selected);
    const pose = followed && this.place(followed, shown.t);
    if (pose) this.centre = [pose.x, pose.y];
    this.use_canvas();
    this.context.lineJoin = "round";
    this.context.fillStyle = this.colours.ground;
    this.context.fillRect(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    this.use_world();
    for (const { area } of this.lanes) this.fill(area, this.colours.lane);
    for (const bound of this.lanes.flatMap(({ bounds }) => bounds)) {
      this.stroke(bound, this.colours.bound, 1);
    }
    for (const vehicle of this.run.vehicles) this.draw_paths(vehicle, shown);
    for (const vehicle of this.run.vehicles) this.draw_car(vehicle, shown);
    for (const vehicle of this.run.vehicles) this.draw_waiting(vehicle, shown.t);
    this.use_canvas();
    this.draw_labels(shown);
  }

  draw_paths(vehicle, { t, selected, layers }) {
    const run = this.run;
    const colour = this.colour_of(vehicle).fill;
    const is_selected = vehicle.id === selected;
    const fade = selected === null || is_selected ? 1 : 0.35;
    const k = run.step_at(t);
    if (layers.reference) {
      this.stroke(this.routes.get(vehicle.id), colour, is_selected ? 2 : 1, [2, 4], 0.8 * fade);
    }
    const area = layers.areas && run.area_in(vehicle, k);
    if (area) {
      this.fill(path_through(area, true), colour, 0.22);
      this.stroke(path_through(area, true), colour, 1, [], 0.7);
    }
    if (layers.driven) {
      const from_s = is_selected ? 0 : t - kTrail_s;
      const width_px = is_selected ? 2 : 3;
      this.stroke(path_through(run.driven_path(vehicle, from_s, t)), colour, width_px, [], fade);
    }
    if (layers.planned) {
      const to = k + 1 + run.about.horizon_steps;
      const path = path_through(run.planned_path(vehicle, k, to));
      this.stroke(path, this.colours.ground, 5, [], 0.7 * fade);
      this.stroke(path, colour, 3, [7, 4], fade);
    }
  }

  draw_car(vehicle, { t, selected, layers }) {
    const pose = this.place(vehicle, t);
    if (!pose) return;
    const planned = layers.planned && this.run.planned_at(vehicle, t);
    const { fill } = this.colour_of(vehicle);
    if (planned) this.stroke(this.rectangle(vehicle, planned), fill, 1.5, [3, 2]);
    const body = this.rectangle(vehicle, pose);
    const { kind } = state_of(this.run, vehicle, t);
    const alarms = ["fallback", "stop", "stuck", "silent"].includes(kind);
    this.fill(body, fill, this.run.driven_at(vehicle, t) ? 1 : 0.4);
    const { length_m, width_m } = vehicle;
    const bonnet = { length_m: 0.14 * length_m, width_m: 0.8 * width_m };
    const [x, y] = point_in(pose, [0.38 * length_m, 0]);
    this.fill(this.rectangle(bonnet, { ...pose, x, y }), this.colours.ground);
    this.stroke(body, alarms ? this.colours.alarm : this.colours.text, alarms ? 3 : 1.2);
    if (vehicle.id !== selected) return;
    const ring = new Path2D();
    ring.arc(pose.x, pose.y, Math.max(vehicle.length_m * 0.75, 18 / this.scale), 0, 2 * Math.PI);
    this.stroke(ring, this.colours.text, 2);
  }

  rectangle({ length_m, width_m }, pose) {
    const [x, y] = [length_m / 2, width_m / 2];
    return path_at(pose, [[x, y], [-x, y], [-x, -y], [x, -y]]);
  }

  /// Arrows from a car that waits to those for which it does.
  draw_waiting(vehicle, t) {
    const report = this.run.report_at(vehicle, t);
    const from = report && this.place(vehicle, t);
    if (!from) return;
    for (const id of report.waits_for) {
      const other = this.run.vehicle(id);
      const to = other && this.place(other, t);
      if (!to) continue;
      const [dx, dy] = [to.x - from.x, to.y - from.y];
      const apart_m = Math.hypot(dx, dy);
      const tip = -Math.min(0.5 * vehicle.length_m, apart_m / 3);
      const [back, side] = [tip - 10 / this.scale, 4 / this.scale];
      const points = [[-apart_m, 0], [tip, 0], [back, side], [tip, 0], [back, -side]];
      const arrow = path_at({ ...to, yaw: Math.atan2(dy, dx) }, points, false);
      this.stroke(arrow, this.colours.ground, 5);
      this.stroke(arrow, this.colours.alarm, 2);
    }
  }

  /// The cars' numbers on them, and the states of those that do not just drive.
  draw_labels({ t, selected, layers }) {
    this.context.textAlign = "center";
    this.context.textBaseline = "middle";
    const [labels, taken] = [[], []]; // taken: places of numbers and labels
    for (const vehicle of this.run.vehicles) {
      const pose = this.place(vehicle, t);
      if (!pose) continue;
      const { fill, ink } = this.colour_of(vehicle);
      const [x, y] = this.to_canvas(point_in(pose, [-0.12 * vehicle.length_m, 0]));
      const size_px = Math.max(11, Math.min(22, 0.8 * vehicle.width_m * this.scale));
      this.text(String(vehicle.id), x, y, ink, size_px, fill);
      taken.push({ x, y, half: 8 });
      const { short } = state_of(this.run, vehicle, t);
      if (short && (layers.labels || vehicle.id === selected)) {
        labels.push([short, x, y + Math.max(vehicle.length_m * this.scale, 20) / 2 + 10]);
      }
    }
    for (const label of labels) this.draw_label(...label, taken);
  }

  /// Below its car, farther down where others are, then with a line to the car.
  draw_label(words, x, y, taken) {
    const { context, colours } = this;
    context.font = font_of(12);
    const half = context.measureText(words).width / 2 + 3;
    const meets = (one) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y - at) < 13;
    let at = y;
    while (taken.some(meets)) at += 7;
    taken.push({ x, y: at, half });
    context.fillStyle = colours.text;
    if (at > y) context.fillRect(x, y - 10, 1, at - y);
    this.text(words, x, at, colours.text, 12);
  }

  text(words, x, y, colour, size_px, halo = this.colours.ground) {
    const { context } = this;
    Object.assign(context, { lineWidth: 4, strokeStyle: halo, fillStyle: colour });
    context.font = font_of(size_px);
    context.strokeText(words, x, y);
    context.fillText(words, x, y);
  }
}
