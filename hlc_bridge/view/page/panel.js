// The text beside the map: cars, report, log. Text of the run is never markup: tags show as they are.

import { clamp } from "./model.js";
import { milliseconds, report_rows, seconds, state_of } from "./words.js";

export function element(tag, text = "", attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

/// Changes the page only where it differs: it is called in every frame.
function set_text(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

function badge({ id, colour }) {
  const style = `background: var(--car-${colour}); color: var(--ink-${colour})`;
  return element("span", id, { class: "badge", style });
}

/// @param select  called with the id of a clicked car
export class CarList {
  constructor(body, run, select) {
    this.run = run;
    this.list = body.closest("div");
    this.rows = run.vehicles.map((vehicle) => {
      const row = element("tr", "", { tabindex: "0", id: `car_${vehicle.id}` });
      const cells = ["", vehicle.name, "", ""].map((text) => element("td", text));
      cells[0].append(badge(vehicle));
      row.append(...cells);
      row.addEventListener("click", () => select(vehicle.id));
      row.addEventListener("keydown", ({ key }) => key === "Enter" && select(vehicle.id));
      body.append(row);
      return { vehicle, row, state: cells[2], planning: cells[3] };
    });
  }

  show({ t, selected }) {
    const chosen = this.rows.find(({ vehicle }) => vehicle.id === selected);
    if (chosen && chosen !== this.chosen) this.scroll_to(chosen.row);
    this.chosen = chosen;
    for (const { vehicle, row, state, planning } of this.rows) {
      const { kind, words } = state_of(this.run, vehicle, t);
      const report = this.run.report_at(vehicle, t);
      set_text(state, words);
      set_text(planning, report ? milliseconds(report.planning_s) : "");
      if (row.dataset.kind !== kind) row.dataset.kind = kind;
      row.classList.toggle("late", Boolean(report?.is_late));
      row.classList.toggle("selected", vehicle.id === selected);
    }
  }

  /// Scrolls the list alone: on a small screen the map must stay where it is.
  scroll_to({ offsetTop, offsetHeight }) {
    const { list } = this;
    const least = offsetTop + offsetHeight - list.clientHeight;
    list.scrollTop = clamp(list.scrollTop, least, offsetTop);
  }
}

export class Report {
  constructor(title, list, run, select) {
    Object.assign(this, { title, list, run, select, shown: "" });
  }

  show({ t, selected }) {
    const vehicle = this.run.vehicle(selected);
    const rows = vehicle ? report_rows(this.run, vehicle, t) : [];
    const title = vehicle && `Car ${vehicle.id} (${vehicle.name}) in step ${this.run.step_at(t)}`;
    set_text(this.title, title || "Click on a car to see its report.");
    const now = JSON.stringify([selected, rows]);
    if (now === this.shown) return;
    this.shown = now;
    this.list.replaceChildren();
    for (const [name, content] of rows) {
      const parts = content.map?.((id) => this.car_button(id)) ||
        [content.k === undefined ? content : this.search_button(vehicle, content.k)];
      const value = element("dd", "", { "data-row": name });
      value.append(...(parts.length ? parts : ["none"]));
      const title = this.run.about.words.terms[name];
      this.list.append(element("dt", name, title && { title }), value);
    }
  }

  car_button(id) {
    const vehicle = this.run.vehicle(id);
    if (!vehicle) return element("span", `car ${id} `);
    const button = element("button", "", { class: "car" });
    button.append(badge(vehicle), ` car ${id}`);
    button.addEventListener("click", () => this.select(id));
    return button;
  }

  /// Shows a page of its own over this one, without scripts.
  search_button({ id, searches }, k) {
    const button = element("button", "show the search tree");
    button.addEventListener("click", () => {
      const [dialog, close] = [element("dialog"), element("button", `close: car ${id}, step ${k}`)];
      close.addEventListener("click", () => dialog.close());
      dialog.addEventListener("close", () => dialog.remove());
      dialog.addEventListener("keydown", (event) => event.stopPropagation()); // Escape closes it
      dialog.append(close, element("iframe", "", { srcdoc: searches[k], sandbox: "" }));
      document.body.append(dialog);
      dialog.showModal();
    });
    return button;
  }
}

/// What the processes logged. Lines with a time of the run lead there.
export class Log {
  constructor(list, run, seek) {
    Object.assign(this, { list, run, seek, lines: [] });
  }

  add({ process, stamp, level, text, run_s }) {
    const row = element("li", "", { class: level });
    const time = run_s === null ? stamp.slice(11) : seconds(run_s);
    row.append(element("time", time), element("b", process), element("span", text));
    if (!["", "info"].includes(level)) row.append(element("em", level));
    if (run_s !== null) row.addEventListener("click", () => this.seek(run_s));
    this.list.append(row);
    this.lines.push({ row, run_s });
  }

  /// Marks the lines logged up to t, where that is known.
  show({ t }) {
    let last = null;
    this.run.log.slice(this.lines.length).forEach((line) => this.add(line));
    for (const { row, run_s } of this.lines) {
      if (run_s === null) continue;
      row.classList.toggle("later", run_s > t);
      if (run_s <= t) last = row;
    }
    if (last === this.last) return;
    this.last = last;
    if (last) this.list.scrollTop = last.offsetTop - this.list.clientHeight / 2;
  }
}
