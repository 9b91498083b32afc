// Time and input: the clock that plays the run, keys, mouse and touch.

import { clamp } from "./model.js";

export class Player {
  constructor(run, on_change) {
    Object.assign(this, { run, on_change, t: 0, speed: 1, direction: 0, last_ms: null });
  }

  seek(t) {
    this.t = clamp(t || 0, 0, this.run.end_s);
    this.on_change();
  }

  /// To the begin of a step, relative to the one shown; stops.
  step(count) {
    this.play(0);
    const at = this.t / this.run.step_s;
    const from = count < 0 ? Math.ceil(at - 1e-6) : Math.floor(at + 1e-6);
    this.seek((from + count) * this.run.step_s);
  }

  /// @param direction  1: forwards, -1: backwards, 0: stop
  play(direction) {
    if (direction === 1 && this.t >= this.run.end_s) this.t = 0;
    if (direction === -1 && this.t <= 0) this.t = this.run.end_s;
    this.direction = direction;
    this.last_ms = null;
    this.on_change();
    if (direction !== 0) requestAnimationFrame(this.advance);
  }

  toggle(direction) {
    this.play(this.direction === direction ? 0 : direction);
  }

  advance = (now_ms) => {
    if (this.direction === 0) return;
    const since_s = this.last_ms === null ? 0 : (now_ms - this.last_ms) * 1e-3;
    this.last_ms = now_ms;
    this.seek(this.t + this.direction * this.speed * since_s);
    const is_over = this.direction > 0 ? this.t >= this.run.end_s : this.t <= 0;
    if (is_over) this.play(0);
    else requestAnimationFrame(this.advance);
  };
}

/// Moving and zooming by mouse, wheel and fingers. @param on_click  called with the place of a click
export function listen_to_pointers(canvas, view, { on_click, on_move }) {
  const fingers = new Map(); // pointer id: [x, y]
  let has_moved = false;
  const place = (event) => [event.offsetX, event.offsetY];
  const grip = () => {
    const [a, b = a] = [...fingers.values()];
    const px = Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1]));
    return { px, x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2 };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
    if (fingers.size === 0) has_moved = false;
    fingers.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = place(event);
    if (!has_moved && Math.hypot(now[0] - before[0], now[1] - before[1]) < 4) return;
    has_moved = true;
    const was = grip();
    fingers.set(event.pointerId, now);
    const is = grip();
    view.zoom(is.px / was.px, is.x, is.y);
    view.move(is.x - was.x, is.y - was.y);
    on_move();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => {
      if (!fingers.delete(event.pointerId) || fingers.size > 0) return;
      if (!has_moved && end === "pointerup") on_click(...place(event));
    });
  }
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
    on_move();
  }, { passive: false });
}

/// Dragging along the time lines. @param seek  called with the events
export function listen_to_scrubbing(lines, seek) {
  lines.addEventListener("pointerdown", (event) => {
    if (event.isTrusted) lines.setPointerCapture(event.pointerId);
    seek(event);
  });
  lines.addEventListener("pointermove", (event) => event.buttons !== 0 && seek(event));
}

/// {key: action}, such as "Shift+ArrowLeft". Keys that the element in focus uses stay with it.
export function listen_to_keys(actions) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName: tag, type } = event.target;
    if (tag === "SELECT" || type === "number") return;
    if ((tag === "BUTTON" || type === "checkbox" || tag === "SUMMARY") && event.key === " ") return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = actions[(event.shiftKey && key.length > 1 ? "Shift+" : "") + key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
