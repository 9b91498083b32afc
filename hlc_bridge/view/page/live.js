// A run under way: shows the newest moment until the user goes to another one.

import { Run } from "./model.js";
import { element } from "./panel.js";
import { listen_to_keys } from "./controls.js";
import { by_id, refuse_run, report, show_run } from "./main.js";

const kPause_ms = 200; // between two drawings of the time line; to approach the newest moment

const run = new Run();
const button = element("button", "live", { id: "live", title: "to the newest moment (L)" });
let page = null;
let is_following = true;
let has_news = false;
let shown_s = 0;
let last_ms = 0;
let refreshed_ms = 0;

const follow = () => (is_following = true);

function take(message) {
  if (message.kind === "end") {
    events.close();
    report(message.reason);
    is_following = false;
  } else if (message.kind === "run" && page) {
    location.reload(); // another run
  } else {
    run.take(message);
    if (message.kind === "drive") join(run.vehicle(message.vehicle).drives);
  }
}

/// A stretch begins with the last state of the one before: equal ticks make one of the two.
function join(drives) {
  const [before, last] = drives.slice(-2);
  if (!last || before.tick_s !== last.tick_s) return;
  const end_s = before.begin_s + before.tick_s * (before.states.length - 1);
  if (Math.abs(end_s - last.begin_s) > 1e-6) return;
  before.states.push(...last.states.slice(1));
  drives.pop();
}

function advance(now_ms) {
  requestAnimationFrame(advance);
  const part = Math.min(1, (now_ms - last_ms) / kPause_ms);
  last_ms = now_ms;
  if (has_news && now_ms - refreshed_ms >= kPause_ms) {
    has_news = false;
    refreshed_ms = now_ms;
    page.refresh();
  }
  const { player } = page;
  if (player.t !== shown_s) is_following = false; // the user has moved it
  button.ariaPressed = is_following;
  // The last step of which all is known ends where the newest one begins.
  const newest_s = Math.max(0, run.end_s - run.step_s);
  if (is_following) player.seek(player.t + part * (newest_s - player.t));
  shown_s = player.t;
}

const events = new EventSource("events");
events.onmessage = ({ data }) => {
  try {
    JSON.parse(data).forEach(take);
  } catch (error) {
    events.close();
    refuse_run(error);
  }
  has_news = true;
  if (page) return;
  page = show_run(run);
  by_id("player").append(button);
  button.addEventListener("click", follow);
  listen_to_keys({ l: follow });
  requestAnimationFrame(advance);
};
events.onopen = () => report("");
events.onerror = () => report("The connection is broken; this page connects again by itself.");
