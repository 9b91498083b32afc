// Pictures over time: what every car did in every step, and how long planning took.

import { clean_context, colour } from "./draw.js";
import { seconds, state_of } from "./words.js";

const kLeft_px = 30; // for the cars' numbers
const kRight_px = 16;

/// How strongly a step of this kind shows its car's colour, otherwise kFaint.
const kFaint = 0.2;
const kOpacities = { drives: 0.7, fallback: 1, late: 1, standby: 0.05, unknown: 0, silent: 0 };
/// Marks distinguish kinds without colours: [its colour's name, slope of its lines; 0: a full box].
const kMarks = {
  waits: ["text", 1],
  stuck: ["alarm", 1],
  fallback: ["alarm", 0],
  stop: ["alarm", -1],
  late: ["alarm", 0],
};

/// @param box  [left, top, width, height]
/// @param fill  name of a colour
function draw_step(context, kind, box, fill) {
  const [mark, slope] = kMarks[kind] || [];
  context.globalAlpha = kOpacities[kind] ?? kFaint;
  context.fillStyle = colour(slope === 0 ? mark : fill);
  context.fillRect(...box);
  context.globalAlpha = 1;
  if (!slope) return;
  context.save();
  context.beginPath();
  context.rect(...box);
  context.clip();
  Object.assign(context, { strokeStyle: colour(mark), lineWidth: 2 });
  context.beginPath();
  const [left, top, width, height] = box;
  const [from, to] = slope > 0 ? [top + height, top] : [top, top + height];
  for (let x = left - height; x < left + width; x += 5) {
    context.moveTo(x, from);
    context.lineTo(x + height, to);
  }
  context.stroke();
  context.restore();
}

/// Stretches of steps of the same kind: [{kind, from, to}].
function stretches_of(run, vehicle) {
  const stretches = [];
  for (let k = 0; k < run.num_steps; ++k) {
    const { kind } = state_of(run, vehicle, (k + 0.5) * run.step_s);
    const last = stretches.at(-1);
    if (last && last.kind === kind) last.to = k + 1;
    else stretches.push({ kind, from: k, to: k + 1 });
  }
  return stretches;
}

/// Distance of up to `count` marks in the span.
function round_distance(span, count) {
  const power = 10 ** Math.floor(Math.log10(span / count));
  return [1, 2, 5, 10].map((m) => m * power).find((d) => span / d <= count);
}

export class TimeLine {
  constructor(canvas) {
    this.canvas = canvas;
  }

  set_run(run) {
    this.run = run;
    this.stretches = run.vehicles.map((vehicle) => stretches_of(run, vehicle));
    this.row_px = run.vehicles.length > 8 ? 10 : 14;
    this.canvas.style.height = `${run.vehicles.length * this.row_px + 20}px`;
  }

  get width() {
    return Math.max(1, this.canvas.clientWidth - kLeft_px - kRight_px);
  }

  x_of(t) {
    return kLeft_px + (this.width * t) / Math.max(this.run.end_s, 1e-9);
  }

  /// May be outside the run.
  time_at(x) {
    return ((x - kLeft_px) / this.width) * this.run.end_s;
  }

  vehicle_at(y) {
    return this.run.vehicles[Math.floor(y / this.row_px)];
  }

  /// All but the time shown, an element above it that moves in every frame.
  draw({ selected }) {
    const context = clean_context(this.canvas);
    this.run.vehicles.forEach((vehicle, row) => {
      const y = row * this.row_px;
      const is_selected = vehicle.id === selected;
      context.font = `${is_selected ? 700 : 400} ${Math.min(11, this.row_px - 1)}px sans-serif`;
      const fillStyle = colour("text");
      Object.assign(context, { fillStyle, textAlign: "right", textBaseline: "middle" });
      const name = (is_selected ? "> " : "") + vehicle.id;
      context.fillText(name, kLeft_px - 5, y + this.row_px / 2);
      for (const stretch of this.stretches[row]) this.draw_stretch(context, vehicle, stretch, y);
    });
    this.draw_marks(context);
  }

  draw_stretch(context, vehicle, { kind, from, to }, y) {
    const left = this.x_of(from * this.run.step_s);
    const width = Math.max(1, this.x_of(to * this.run.step_s) - left);
    draw_step(context, kind, [left, y + 1, width, this.row_px - 2], `car-${vehicle.colour}`);
  }

  draw_marks(context) {
    const distance_s = round_distance(Math.max(this.run.end_s, 1), 12);
    Object.assign(context, { textAlign: "center", textBaseline: "bottom", font: "10px sans-serif" });
    context.fillStyle = colour("muted");
    const bottom = this.canvas.clientHeight;
    for (let i = 0; i * distance_s <= this.run.end_s + 1e-9; ++i) {
      const x = this.x_of(i * distance_s);
      context.fillRect(x, bottom - 16, 1, 4);
      context.fillText(seconds(i * distance_s, distance_s < 1 ? 1 : 0), x, bottom);
    }
  }

  /// The kinds that occur in the run.
  fill_legend(element) {
    const kinds = new Set(this.stretches.flat().map(({ kind }) => kind));
    const is_late = ({ steps }) => steps.some((report) => report.is_late);
    if (this.run.vehicles.some(is_late)) kinds.add("late");
    element.replaceChildren();
    for (const [kind, words] of Object.entries(this.run.about.words.kinds)) {
      if (!kinds.has(kind)) continue;
      const entry = document.createElement("span");
      const sample = document.createElement("canvas");
      entry.append(sample, words);
      element.append(entry);
      const box = [0, 0, sample.clientWidth, sample.clientHeight];
      draw_step(clean_context(sample), kind, box, "text");
    }
  }

  /// Planning times of one car, or the largest of all: a bar per step, the step's length as a line.
  draw_planning(canvas, { selected }) {
    const { run } = this;
    const [alarm, muted] = [colour("alarm"), colour("muted")];
    const context = clean_context(canvas);
    const chosen = run.vehicles.filter((v) => selected === null || v.id === selected);
    const height = canvas.clientHeight - 2;
    const least_s = run.step_s * 1e-5;
    const y_of = (s) => height - (height - 8) * Math.max(0, Math.log10(s / least_s) / 5.3);
    for (let k = 0; k < run.num_steps; ++k) {
      const reports = chosen.map((v) => v.steps[k]).filter(Boolean);
      const longest_s = Math.max(0, ...reports.map((r) => r.planning_s));
      const x = this.x_of(k * run.step_s);
      const width = Math.max(1, this.x_of((k + 1) * run.step_s) - x - 0.5);
      const is_late = reports.some((r) => r.is_late);
      context.fillStyle = is_late ? alarm : muted;
      const top = is_late ? 0 : y_of(longest_s);
      if (is_late || longest_s > least_s) context.fillRect(x, top, width, height - top);
    }
    context.strokeStyle = alarm;
    context.setLineDash([5, 3]);
    context.beginPath();
    context.moveTo(kLeft_px, y_of(run.step_s));
    context.lineTo(canvas.clientWidth - kRight_px, y_of(run.step_s));
    context.stroke();
  }
}
