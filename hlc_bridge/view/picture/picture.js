// Pictures of a run for a talk: the map of the run's page, and beside it the time, the cars with
// their states and a legend. No part of run.html: the program draw_run calls window.picture.

import { Run, clamp } from "./model.js";
import { MapView, colour, font_of, kBar_px } from "./draw.js";
import { state_of } from "./words.js";
import { SvgContext, SvgPath } from "./svg.js";

const kLeast = [1024, 640]; // px of the drawing; a larger picture has larger letters, too
const kPanel_px = 300;
const kMargin_px = 14;
const kInner_px = kPanel_px - 2 * kMargin_px;
const kLine_px = 17;
const kBadge_px = 28;
const kCars_px = 78; // where the list of cars begins
const kAlarms = ["fallback", "stop", "stuck", "silent"];
const kLayers = { reference: true, planned: true, driven: true, areas: true, labels: true, zones: true };
const kLegend = [
  ["reference path", (panel, y) => panel.sample(y, "muted", 1, [2, 4])],
  ["planned", (panel, y) => panel.sample(y, "muted", 3, [7, 4])],
  ["driven", (panel, y) => panel.sample(y, "muted", 3)],
  ["areas of the plan", (panel, y) => panel.box(y, "line", "muted")],
  ["waits for", (panel, y) => panel.sample(y, "alarm", 2)],
  ["keeps its plan, stops or is stuck", (panel, y) => panel.box(y, "ground", "alarm")],
];

const kZones = [
  ["conflict zone, where routes meet", (panel, y) => panel.sample(y, "line", 8)],
  ["road that a car holds", (panel, y) => panel.sample(y, "car-1", 6)],
];

/// The words in at most so many lines of the context's font; what does not fit is left out.
function lines_of(context, words, width_px, most) {
  const fits = (line) => context.measureText(line).width <= width_px;
  const lines = [];
  for (const word of words.split(" ")) {
    const longer = `${lines.at(-1)} ${word}`;
    if (lines.length && fits(longer)) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  const shown = lines.slice(0, most);
  let last = shown.pop();
  const end = lines.length > most ? "\u2026" : "";
  while (last && !fits(last + end)) last = last.slice(0, -1);
  return [...shown, last + end];
}

/// What stands beside the map.
class Panel {
  constructor(context, left, height) {
    Object.assign(this, { context, left: left + kMargin_px, height });
  }

  ground() {
    this.fill_box("page", this.left - kMargin_px, 0, kPanel_px, this.height);
  }

  fill_box(name, ...box) {
    Object.assign(this.context, { globalAlpha: 1, fillStyle: colour(name) });
    this.context.fillRect(...box);
  }

  use_font(size_px) {
    Object.assign(this.context, { font: font_of(size_px), textBaseline: "middle" });
  }

  /// In the middle of a line from the panel's margin on, with y at the line's middle.
  text(words, x, y, { size_px = 13, name = "text", align = "left" } = {}) {
    this.use_font(size_px);
    const { context } = this;
    Object.assign(context, { globalAlpha: 1, fillStyle: colour(name), textAlign: align });
    context.fillText(words, this.left + x, y);
  }

  sample(y, name, lineWidth, dashes = []) {
    const { context, left } = this;
    const path = new Path2D();
    path.moveTo(left, y);
    path.lineTo(left + kBadge_px, y);
    Object.assign(context, { globalAlpha: 1, strokeStyle: colour(name), lineWidth });
    context.setLineDash(dashes);
    context.stroke(path);
  }

  box(y, inside, outline) {
    this.fill_box(outline, this.left, y - 6, kBadge_px, 12);
    this.fill_box(inside, this.left + 2, y - 4, kBadge_px - 4, 8);
  }

  title({ scenario }, t, more) {
    this.use_font(15);
    const [title] = lines_of(this.context, scenario, kInner_px, 1);
    this.text(title, 0, 20, { size_px: 15 });
    this.text(`${t.toFixed(2)} s`, 0, 50, { size_px: 26 });
    this.text(more, kInner_px, 53, { name: "muted", align: "right" });
  }

  /// @return where it begins
  legend({ roads }) {
    const entries = [...kLegend, ...(roads.length ? kZones : [])];
    const begin = this.height - kMargin_px - entries.length * kLine_px;
    entries.forEach(([words, draw], i) => {
      const y = begin + (i + 0.5) * kLine_px;
      draw(this, y);
      this.text(words, kBadge_px + 8, y, { size_px: 12, name: "muted" });
    });
    return begin;
  }

  /// Every car has as many lines at all times, so that it stands still in a video.
  cars(run, t, end) {
    const fit = Math.floor((end - kCars_px) / kLine_px) - 1;
    const { vehicles } = run;
    const shown = vehicles.slice(0, vehicles.length > fit ? fit - 1 : fit);
    const most = clamp(Math.floor(fit / shown.length), 1, 3);
    shown.forEach((vehicle, i) => {
      const { kind, words } = state_of(run, vehicle, t);
      const name = kAlarms.includes(kind) ? "alarm" : "text";
      const text = most > 1 ? `${vehicle.name}: ${words}` : words;
      this.car(vehicle, text, kCars_px + i * most * kLine_px, most, name);
    });
    const num_left_out = vehicles.length - shown.length;
    if (num_left_out === 0) return;
    this.text(`and ${num_left_out} more cars`, 0, kCars_px + (shown.length + 0.5) * kLine_px);
  }

  car({ id, colour: number }, words, top, most, name) {
    const [x, y] = [kBadge_px + 8, top + kLine_px / 2];
    this.fill_box(`car-${number}`, this.left, top + 1, kBadge_px, kLine_px - 2);
    this.text(id, kBadge_px / 2, y, { size_px: 12, name: `ink-${number}`, align: "center" });
    this.use_font(13);
    lines_of(this.context, words, kInner_px - x, most).forEach((line, i) => {
      this.text(line, x, y + i * kLine_px, { name });
    });
  }
}

class Picture {
  constructor(run) {
    this.run = run;
  }

  /// @param width, height  px
  /// @param theme  light or dark
  /// @param follow  id of the car in the middle; null: the whole map
  /// @param speed  of a video
  choose({ width, height, theme, follow, speed }) {
    document.documentElement.dataset.theme = theme;
    Object.assign(this, { width, height, follow, speed });
    this.canvas = Object.assign(document.createElement("canvas"), { width, height });
    this.begin(this.canvas.getContext("2d"));
  }

  begin(context) {
    const unit = Math.min(this.width / kLeast[0], this.height / kLeast[1]);
    const [left, height] = [this.width / unit - kPanel_px, this.height / unit];
    Object.assign(this, { context, left, drawn_height: height });
    context.scale(unit, unit);
    // The map leaves room for the page's bars above and below it, which a picture does not have.
    const [clientWidth, clientHeight] = [left, height + 2 * kBar_px];
    this.map = new MapView({ clientWidth, clientHeight, getContext: () => context });
    this.map.set_run(this.run);
    if (this.follow !== null) this.map.zoom(2.5);
    this.panel = new Panel(context, left, height);
  }

  draw(t) {
    const { context, follow, panel, run } = this;
    panel.fill_box("ground", 0, 0, this.left, this.drawn_height);
    context.save();
    context.transform(1, 0, 0, 1, 0, -kBar_px);
    this.map.draw({ t, selected: follow, follow: follow !== null, layers: kLayers });
    context.restore();
    context.save();
    panel.ground();
    panel.title(run.about, t, this.speed === 1 ? "" : `speed ${this.speed}`);
    panel.cars(run, t, panel.legend(run));
    context.restore();
  }

  /// @return the file in base64
  png(t) {
    this.draw(t);
    return this.canvas.toDataURL("image/png").split(",")[1];
  }

  /// Afterwards there are no other pictures.
  svg(t) {
    window.Path2D = SvgPath;
    this.begin(new SvgContext(this.width, this.height));
    this.draw(t);
    return new XMLSerializer().serializeToString(this.context.image);
  }

  /// The same as all there is on the page, to be printed.
  show(t) {
    this.svg(t);
    const { image } = this.context;
    for (const { style } of [image, document.body]) style.display = "block";
    document.body.replaceChildren(image);
  }
}

const drawn_run = new Run();
for (const message of JSON.parse(document.getElementById("data").textContent)) {
  drawn_run.take(message);
}
window.picture = new Picture(drawn_run);
