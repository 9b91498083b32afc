// Puts the page together. The run is in the element "data": a JSON array of messages.

import { Run } from "./model.js";
import { MapView } from "./draw.js";
import { TimeLine } from "./timeline.js";
import { CarList, Log, Report } from "./panel.js";
import { Player, listen_to_keys, listen_to_pointers, listen_to_scrubbing } from "./controls.js";

export const by_id = (id) => document.getElementById(id);
const root = document.documentElement;
const kDark = matchMedia("(prefers-color-scheme: dark)");

class Page {
  constructor(run) {
    this.run = run;
    by_id("zones").parentElement.hidden = run.roads.length === 0;
    this.selected = null;
    this.map = new MapView(by_id("map"));
    this.time_line = new TimeLine(by_id("time_line"));
    this.player = new Player(run, () => this.show());
    const select = (id) => this.select(id);
    this.list = new CarList(by_id("cars"), run, select);
    this.report = new Report(by_id("report_title"), by_id("report"), run, select);
    this.log = new Log(by_id("log"), run, (t) => this.player.seek(t));
    this.refresh();
    this.listen();
    this.read_address();
  }

  /// After new messages of the run.
  refresh() {
    by_id("scrub").max = this.run.end_s;
    this.map.set_run(this.run);
    this.time_line.set_run(this.run);
    this.draw_static();
  }

  get follow() {
    return by_id("follow").checked;
  }

  /// {t, selected: id or null, follow, layers: {reference, planned, driven, areas, labels, zones}}
  get shown() {
    const boxes = [...document.querySelectorAll("#layers input")];
    const layers = Object.fromEntries(boxes.map(({ id, checked }) => [id, checked]));
    return { t: this.player.t, selected: this.selected, follow: this.follow, layers };
  }

  /// No car, if there is none with this id.
  select(id) {
    this.selected = this.run.vehicle(id) ? id : null;
    this.draw_static();
  }

  /// Draws once per frame, however many changes there were.
  show() {
    if (this.is_due) return;
    this.is_due = true;
    requestAnimationFrame(() => {
      this.is_due = false;
      this.draw();
    });
  }

  draw() {
    const { run, player, shown } = this;
    this.map.draw(shown);
    this.list.show(shown);
    this.report.show(shown);
    this.log.show(shown);
    by_id("cursor").style.left = `${this.time_line.x_of(shown.t) - 1}px`;
    by_id("step").textContent = `step ${run.step_at(shown.t)} (0 to ${run.num_steps - 1})`;
    if (document.activeElement !== by_id("time")) by_id("time").value = shown.t.toFixed(2);
    by_id("scrub").value = shown.t;
    by_id("play").ariaPressed = player.direction === 1;
    by_id("back").ariaPressed = player.direction === -1;
    this.keep_address();
  }

  /// The address follows the moment shown, not in every frame: browsers limit how often.
  keep_address() {
    this.address_due ??= setTimeout(() => {
      this.address_due = null;
      const { t, selected, follow } = this.shown;
      const car = selected === null ? "" : `&car=${selected}${follow ? "&follow=1" : ""}`;
      history.replaceState(null, "", `#t=${t.toFixed(2)}${car}`);
    }, 500);
  }

  /// With what does not depend on the time.
  draw_static() {
    const { time_line, shown, selected } = this;
    time_line.draw(shown);
    time_line.draw_planning(by_id("planning"), shown);
    time_line.fill_legend(by_id("legend"));
    const of = selected === null ? "the slowest car" : `car ${selected}`;
    by_id("planning_title").textContent =
      `planning time of ${of} in every step, logarithmic; dashed: the step of ${this.run.step_s} s`;
    this.show();
  }

  listen() {
    listen_to_pointers(by_id("map"), this.map, {
      on_click: (x, y) => this.select(this.map.car_at(x, y, this.player.t)?.id),
      on_move: () => this.show(),
    });
    listen_to_scrubbing(by_id("times"), ({ type, target, offsetX, offsetY }) => {
      const is_row = type === "pointerdown" && target.id === "time_line";
      const vehicle = is_row && this.time_line.vehicle_at(offsetY);
      if (vehicle) this.select(vehicle.id);
      this.player.seek(this.time_line.time_at(offsetX));
    });
    this.listen_to_inputs();
    new ResizeObserver(() => {
      this.draw_static();
      this.draw(); // at once: the next frame would be late, and this one distorted
    }).observe(by_id("map"));
    kDark.addEventListener("change", () => this.set_theme(kDark.matches));
    window.addEventListener("hashchange", () => this.read_address());
  }

  listen_to_inputs() {
    const on = (id, event, action) => by_id(id).addEventListener(event, action);
    const seek = ({ target }) => this.player.seek(Number(target.value));
    on("theme", "click", () => this.set_theme(root.dataset.theme !== "dark"));
    on("follow", "change", () => this.set_follow(this.follow));
    on("speed", "change", ({ target }) => (this.player.speed = Number(target.value)));
    on("scrub", "input", seek);
    on("time", "change", ({ target }) => {
      this.player.seek(Number(target.value));
      target.value = this.player.t.toFixed(2);
    });
    on("time", "keydown", ({ key, target }) => key === "Enter" && target.blur());
    on("layers", "change", () => this.show());
    const keys = {};
    for (const [key, action, button] of this.actions()) {
      keys[key] = action;
      if (button) on(button, "click", action);
    }
    listen_to_keys(keys);
  }

  /// Key, action, button.
  actions() {
    const { player } = this;
    return [
      ["Home", () => player.seek(0), "first"],
      ["j", () => player.toggle(-1), "back"],
      ["ArrowLeft", () => player.step(-1), "step_back"],
      [" ", () => player.toggle(1), "play"],
      ["ArrowRight", () => player.step(1), "step_on"],
      ["End", () => player.seek(this.run.end_s), "last"],
      ["Shift+ArrowRight", () => player.step(10)],
      ["Shift+ArrowLeft", () => player.step(-10)],
      ["n", () => this.select_next(1)],
      ["p", () => this.select_next(-1)],
      ["Escape", () => this.select(null)],
      ["f", () => this.set_follow(!this.follow)],
      ["+", () => this.zoom(1.4), "closer"],
      ["-", () => this.zoom(1 / 1.4), "farther"],
      ["0", () => this.fit(), "fit"],
    ];
  }

  select_next(change) {
    const { vehicles } = this.run;
    const now = vehicles.findIndex(({ id }) => id === this.selected);
    const next = now < 0 && change < 0 ? -1 : now + change;
    this.select(vehicles.at(next % vehicles.length).id);
  }

  zoom(factor) {
    this.map.zoom(factor);
    this.show();
  }

  fit() {
    by_id("follow").checked = false;
    this.map.fit();
    this.show();
  }

  /// Without a selected car the first one is followed.
  set_follow(follow) {
    by_id("follow").checked = follow;
    if (follow && this.selected === null) this.select_next(1);
    if (follow && this.map.is_fitted) this.map.zoom(2.5);
    this.show();
  }

  set_theme(is_dark) {
    root.dataset.theme = is_dark ? "dark" : "light";
    this.draw_static();
  }

  /// A link to a moment: run.html#t=7.4&car=2, also step=37 and theme=dark.
  read_address() {
    const { theme, car, follow, step, t } =
      Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    if (theme) this.set_theme(theme === "dark");
    if (car) this.select(Number(car));
    if (follow) this.set_follow(follow !== "0");
    if (step) this.player.seek(Number(step) * this.run.step_s);
    if (t) this.player.seek(Number(t));
  }
}

export function report(text) {
  by_id("fault").textContent = text;
}

/// @throws error
export function refuse_run(error) {
  report(`This run cannot be shown: ${error.message}`);
  throw error;
}

export function show_run(run) {
  root.dataset.theme = kDark.matches ? "dark" : "light";
  document.title = by_id("title").textContent = `Run of ${run.about.scenario}`;
  by_id("about").textContent = run.about.about;
  by_id("keys").textContent = run.about.words.keys;
  report(run.about.fault);
  return (window.page = new Page(run));
}

function start() {
  try {
    const run = new Run();
    for (const message of JSON.parse(by_id("data").textContent)) run.take(message);
    show_run(run);
    if (run.num_steps === 0) by_id("fault").textContent += " No step was reported.";
  } catch (error) {
    refuse_run(error);
  }
}

if (by_id("data").textContent !== "[]") start(); // else live.js does
