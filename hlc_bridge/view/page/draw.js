// The map: lanes, paths, areas and cars at one time, on a canvas. World coordinates in m, y up.

import { clamp, point_in } from "./model.js";
import { state_of } from "./words.js";

const kTrail_s = 4; // of the driven path
export const kBar_px = 36; // of the buttons above and below

/// As the style sheet gives it, light or dark. @param name  such as "text", "car-0"
export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
}

export const font_of = (size_px) => `600 ${size_px}px system-ui, sans-serif`;

function path_through(points, closed) {
  const path = new Path2D();
  points.forEach(([x, y], i) => (i === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  if (closed) path.closePath();
  return path;
}

function path_at(pose, points, closed = true) {
  return path_through(points.map((point) => point_in(pose, point)), closed);
}

/// Cleared and adapted to the screen, one unit per px of the page.
export function clean_context(canvas) {
  const ratio = devicePixelRatio;
  canvas.width = Math.round(canvas.clientWidth * ratio); // clears it
  canvas.height = Math.round(canvas.clientHeight * ratio);
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  return context;
}

export class MapView {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.centre = [0, 0];
    this.scale = 100; // px per m
    this.is_fitted = true; // until the user zooms or moves
  }

  set_run(run) {
    this.run = run;
    this.box = run.box();
    const area = ([left, right]) => path_through([...left, ...[...right].reverse()], true);
    this.lanes = run.lanes.map(area);
    this.bounds = run.lanes.flat().map((bound) => path_through(bound));
    this.routes = new Map(run.vehicles.map((v) => [v.id, path_through(v.route, v.closed)]));
    this.zones = new Path2D();
    this.zone_places = {};
    for (const { places, zones } of run.roads) {
      zones.forEach((zone, i) => {
        if (!zone) return;
        (this.zone_places[zone] ??= []).push(places[i]);
        this.zones.moveTo(...places[i]);
        this.zones.lineTo(...places[(i + 1) % places.length]);
      });
    }
    if (this.is_fitted) this.fit();
  }

  fit() {
    const { min, max } = this.box;
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
    this.scale = clamp(before * factor, 5, 5000);
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
      const inside_px = 0.4 * vehicle.length_m * this.scale;
      const apart_px = Math.max(0, Math.hypot(at[0] - x, at[1] - y) - inside_px);
      if (apart_px < least_px) [nearest, least_px] = [vehicle, apart_px];
    }
    return nearest;
  }

  /// @param name  of the colour
  /// @param dashes  in px
  stroke(path, name, width_px, dashes = [], opacity = 1) {
    const { context, scale } = this;
    const lineWidth = width_px / scale;
    Object.assign(context, { globalAlpha: opacity, strokeStyle: colour(name), lineWidth });
    context.setLineDash(dashes.map((px) => px / scale));
    context.stroke(path);
  }

  fill(path, name, opacity = 1) {
    Object.assign(this.context, { globalAlpha: opacity, fillStyle: colour(name) });
    this.context.fill(path);
  }

  draw(shown) {
    const { context, run } = this;
    if (this.is_fitted) this.fit();
    const followed = shown.follow && run.vehicle(shown.selected);
    const pose = followed && this.place(followed, shown.t);
    if (pose) this.centre = [pose.x, pose.y];
    clean_context(this.canvas);
    context.lineJoin = "round";
    context.save();
    context.transform(this.scale, 0, 0, -this.scale, ...this.to_canvas([0, 0])); // in the world
    for (const lane of this.lanes) this.fill(lane, "lane");
    for (const bound of this.bounds) this.stroke(bound, "bound", 1);
    if (shown.layers.zones) this.stroke(this.zones, "muted", 0.1 * this.scale, [], 0.3);
    for (const one of run.about.obstacles) {
      if (shown.t >= one.from_s) this.fill(path_through(one.points, true), "alarm", 0.7);
    }
    for (const vehicle of run.vehicles) this.draw_paths(vehicle, shown);
    for (const vehicle of run.vehicles) this.draw_car(vehicle, shown);
    for (const vehicle of run.vehicles) this.draw_waiting(vehicle, shown.t);
    context.restore();
    this.draw_labels(shown);
  }

  draw_paths(vehicle, { t, selected, layers }) {
    const { run } = this;
    const fill = `car-${vehicle.colour}`;
    const is_selected = vehicle.id === selected;
    const fade = selected === null || is_selected ? 1 : 0.35;
    const k = run.step_at(t);
    if (layers.reference) {
      this.stroke(this.routes.get(vehicle.id), fill, is_selected ? 2 : 1, [2, 4], 0.8 * fade);
    }
    if (layers.zones) {
      const { places } = run.held_in(vehicle, k);
      this.stroke(path_through(places), fill, 0.08 * this.scale, [], 0.5 * fade);
    }
    const { path, areas } = run.plan_points(vehicle, k);
    if (layers.areas) areas.forEach((area, i) => {
      const outline = path_through(area, true);
      if (i === 0) this.fill(outline, fill, 0.22);
      this.stroke(outline, fill, 1, [], i === 0 ? 0.7 : 0.4 * fade);
    });
    if (layers.driven) {
      const from_s = is_selected ? 0 : t - kTrail_s;
      const width_px = is_selected ? 2 : 3;
      this.stroke(path_through(run.driven_path(vehicle, from_s, t)), fill, width_px, [], fade);
    }
    if (layers.planned) {
      const line = path_through(path);
      this.stroke(line, "ground", 5, [], 0.7 * fade);
      this.stroke(line, fill, 3, [7, 4], fade);
    }
  }

  draw_car(vehicle, { t, selected, layers }) {
    const pose = this.place(vehicle, t);
    if (!pose) return;
    const planned = layers.planned && this.run.planned_at(vehicle, t);
    const fill = `car-${vehicle.colour}`;
    if (planned) this.stroke(this.rectangle(vehicle, planned), fill, 1.5, [3, 2]);
    const body = this.rectangle(vehicle, pose);
    const { kind } = state_of(this.run, vehicle, t);
    const alarms = ["fallback", "stop", "stuck", "silent"].includes(kind);
    this.fill(body, fill, this.run.driven_at(vehicle, t) ? 1 : 0.4);
    const { length_m, width_m } = vehicle;
    const bonnet = { length_m: 0.14 * length_m, width_m: 0.8 * width_m };
    const [x, y] = point_in(pose, [0.38 * length_m, 0]);
    this.fill(this.rectangle(bonnet, { ...pose, x, y }), "ground");
    this.stroke(body, alarms ? "alarm" : "text", alarms ? 3 : 1.2);
    if (vehicle.id !== selected) return;
    const ring = new Path2D();
    ring.arc(pose.x, pose.y, Math.max(length_m * 0.75, 18 / this.scale), 0, 2 * Math.PI);
    this.stroke(ring, "text", 2);
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
      this.stroke(arrow, "ground", 5);
      this.stroke(arrow, "alarm", 2);
    }
  }

  /// The cars' numbers on them, and the states of those that do not just drive.
  draw_labels({ t, selected, layers }) {
    Object.assign(this.context, { textAlign: "center", textBaseline: "middle" });
    for (const [zone, places] of Object.entries(layers.zones ? this.zone_places : {})) {
      const [x, y] = [0, 1].map((i) => places.reduce((sum, p) => sum + p[i], 0) / places.length);
      this.text(`zone ${zone}`, ...this.to_canvas([x, y]), 11, "muted");
    }
    const [labels, taken] = [[], []]; // taken: places of numbers and labels
    for (const vehicle of this.run.vehicles) {
      const pose = this.place(vehicle, t);
      if (!pose) continue;
      const [x, y] = this.to_canvas(point_in(pose, [-0.12 * vehicle.length_m, 0]));
      const size_px = clamp(0.8 * vehicle.width_m * this.scale, 11, 22);
      this.text(vehicle.id, x, y, size_px, `ink-${vehicle.colour}`, `car-${vehicle.colour}`);
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
    const { context } = this;
    context.font = font_of(12);
    const half = context.measureText(words).width / 2 + 3;
    const meets = (one) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y - at) < 13;
    let at = y;
    while (taken.some(meets)) at += 7;
    taken.push({ x, y: at, half });
    context.fillStyle = colour("text");
    if (at > y) context.fillRect(x, y - 10, 1, at - y);
    this.text(words, x, at, 12);
  }

  text(words, x, y, size_px, name = "text", halo = "ground") {
    const { context } = this;
    Object.assign(context, { strokeStyle: colour(halo), fillStyle: colour(name), lineWidth: 4 });
    context.font = font_of(size_px);
    context.strokeText(words, x, y);
    context.fillText(words, x, y);
  }
}
