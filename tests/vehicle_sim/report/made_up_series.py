"""Small made-up series of runs on a ring of 1 m radius, and what tests ask of every figure."""

import csv
import json
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.text import Text

from report import series, style

STEP_S = 0.2
TICK_S = 0.02
SPEED_MPS = 0.8
NAMES = ("red", "blue", "green")


def ring(radius_m: float, count: int = 90) -> list[list[float]]:
    """Corners of a circle around (0, 0)."""
    turns = [2.0 * math.pi * i / count for i in range(count)]
    return [[radius_m * math.cos(turn), radius_m * math.sin(turn)] for turn in turns]


def ring_place(cars: int, zones: dict | None = None) -> dict:
    """A ring of two lanelets; car i starts i / cars of the way around."""
    half = ring(1.15, 90), ring(0.85, 90)
    lanelets = [{"id": number + 1, "left_m": half[1][45 * number:45 * number + 46] + [half[1][0]] * (number == 1),
                 "right_m": half[0][45 * number:45 * number + 46] + [half[0][0]] * (number == 1)}
                for number in (0, 1)]
    vehicles = []
    for index in range(cars):
        turn = 2.0 * math.pi * index / cars
        name = NAMES[index] if index < len(NAMES) else f"car {index + 1}"
        vehicles.append({
            "id": index + 1, "name": name, "start_s_m": turn,
            "start": {"x_m": math.cos(turn), "y_m": math.sin(turn), "yaw_rad": turn + 0.5 * math.pi},
            "path": {"is_closed": True, "length_m": 2.0 * math.pi, "points_m": ring(1.0)}})
    return {"scenario": "two_rings", "step_s": STEP_S, "has_map": True, "lanelets": lanelets,
            "footprint": {"length_m": 0.22, "width_m": 0.11}, "vehicles": vehicles, "zones": zones or {}}


def road_place(length_m: float = 200.0, cars: int = 20, is_upright: bool = False) -> dict:
    """A straight road of two lanes, all cars on it one behind the other."""
    def at(x: float, y: float) -> list[float]:
        return [-y, x] if is_upright else [x, y]

    lanelets = [{"id": 10 * lane + piece, "left_m": [at(20.0 * piece, 0.3 * lane), at(20.0 * piece + 20.0, 0.3 * lane)],
                 "right_m": [at(20.0 * piece, 0.3 * lane - 0.3), at(20.0 * piece + 20.0, 0.3 * lane - 0.3)]}
                for lane in (0, 1) for piece in range(int(length_m / 20.0))]
    vehicles = []
    for index in range(cars):
        x, y = at(2.0 + 9.0 * index, -0.15)
        vehicles.append({"id": index + 1, "name": f"car {index + 1}", "start_s_m": 2.0 + 9.0 * index,
                         "start": {"x_m": x, "y_m": y, "yaw_rad": 0.5 * math.pi if is_upright else 0.0},
                         "path": {"is_closed": False, "length_m": length_m,
                                  "points_m": [at(0.0, -0.15), at(length_m, -0.15)]}})
    return {"scenario": "long_road", "step_s": STEP_S, "has_map": True, "lanelets": lanelets,
            "footprint": {"length_m": 0.22, "width_m": 0.11}, "vehicles": vehicles, "zones": {}}


class MadeUp:
    """Series of a campaign; attributes are changed before `groups` or `write`."""

    def __init__(self, cars: int = 2, planned_on: tuple[tuple[str, str], ...] = (("A", "none"), ("B", "none")),
                 starts: int = 3, steps: int = 40, zones: dict | None = None) -> None:
        """planned_on: subgraph and policy of the runs."""
        self.place = ring_place(cars, zones)
        self.runs = [{"run": number, "scenario": "two_rings", "profile": "the_2022", "subgraph": subgraph,
                      "policy": policy, "start": start, "fault": ""}
                     for number, (subgraph, policy, start) in enumerate(
                         (*one, start) for one in planned_on for start in range(starts))]
        self.steps = steps
        self.stuck: set[tuple[int, int]] = set()  # run and vehicle
        self.off_m = {run["run"]: 0.01 * (run["run"] + 1) for run in self.runs}  # outside the ring
        self.error_at = lambda run, s_m: 1e3 * self.off_m[run["run"]]
        self.subgraph_at = lambda run, vehicle, step: run["subgraph"]
        self.distance_at = lambda run, time_s: 0.05 + 0.1 * abs(time_s - 3.0)
        self.limit_at = lambda run, time_s: ""

    def vehicles_of(self, run: dict) -> list[dict]:
        """Of other starts the first one."""
        return self.place["vehicles"] if run["start"] == 0 else self.place["vehicles"][:1]

    def way(self, run: dict, car: dict, time_s: float) -> float:
        """Arc length driven since the start [m]; a stuck car stands after 2 s."""
        return SPEED_MPS * (min(time_s, 2.0) if (run["run"], car["id"]) in self.stuck else time_s)

    def step_rows(self, run: dict) -> list[list[object]]:
        """Rows of steps.csv."""
        rows = []
        for car in self.vehicles_of(run):
            for step in range(self.steps):
                time_s = STEP_S * step
                s_m = car["start_s_m"] + 0.3 * run["start"] + self.way(run, car, time_s)
                is_stuck = (run["run"], car["id"]) in self.stuck and step == self.steps - 1
                rows.append([run["run"], run["scenario"], run["profile"], run["subgraph"], run["policy"], run["start"],
                             car["id"], car["name"], step, f"{time_s:.3f}", self.subgraph_at(run, car["id"], step),
                             0 if step == 0 else 100 + step, 0 if step == 0 else 10 + step,
                             "false" if step == 0 else "true",
                             "" if step == 0 or run["start"] else f"{0.01 * (step + 1)}",
                             s_m, self.error_at(run, s_m), "true" if is_stuck else "false"])
        return rows

    def drive_rows(self, run: dict) -> list[list[object]]:
        """Rows of drives.csv."""
        rows = []
        radius = 1.0 + self.off_m[run["run"]]
        for car in self.vehicles_of(run):
            for tick in range(round(self.steps * STEP_S / TICK_S) + 1):
                time_s = TICK_S * tick
                turn = car["start_s_m"] + 0.3 * run["start"] + self.way(run, car, time_s)
                speed = 0.0 if (run["run"], car["id"]) in self.stuck and time_s >= 2.0 else SPEED_MPS
                rows.append([run["run"], car["id"], f"{time_s:.3f}", radius * math.cos(turn), radius * math.sin(turn),
                             turn + 0.5 * math.pi, speed, self.limit_at(run, time_s)])
        return rows

    def distance_rows(self, run: dict) -> list[list[object]]:
        """Rows of distances.csv: all pairs of neighbours, each 1 mm farther than the one before."""
        cars = self.place["vehicles"]
        if run["start"]:
            return []
        return [[run["run"], a["id"], b["id"], f"{a['name']} and {b['name']}", f"{TICK_S * tick:.3f}", distance, 0.02]
                for a, b in zip(cars, cars[1:], strict=False)
                for tick in range(round(self.steps * STEP_S / TICK_S) + 1)
                if (distance := self.distance_at(run, TICK_S * tick) + 0.001 * a["id"]) < 1.0]

    def write(self, folder: Path) -> Path:
        """Writes OUT/series. Returns OUT."""
        target = folder / "series"
        target.mkdir(parents=True, exist_ok=True)
        for name, rows_of in (("steps", self.step_rows), ("drives", self.drive_rows),
                              ("distances", self.distance_rows)):
            with (target / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(series.COLUMNS[name])
                for run in self.runs:
                    writer.writerows(rows_of(run))
        (target / "places.json").write_text(json.dumps({"scenarios": [self.place], "runs": self.runs}))
        return folder

    def group(self, folder: Path) -> series.Group:
        """The only group, read back from files."""
        return series.read_series(self.write(folder) / "series")[0]


def texts_of(figure: Figure) -> list[str]:
    """All texts that are seen."""
    return [text.get_text() for text in figure.findobj(Text) if text.get_visible() and text.get_text()]


def legend_texts(figure: Figure) -> list[str]:
    """The texts of the legend below the axes."""
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def faults_of(drawing: style.Drawing) -> list[str]:
    """What cannot be read: a legend over axes, a text beyond the paper, axes that overlap."""
    figure = drawing.figure
    figure.draw_without_rendering()
    faults = []
    panels = [axes for axes in figure.axes if axes.get_visible()]
    for legend in figure.legends:
        faults += [f"legend over axes {axes.get_title(loc='left')}" for axes in panels
                   if legend.get_window_extent().overlaps(axes.get_window_extent())]
    paper = figure.bbox.padded(1.0)
    for legend in figure.legends:
        box = legend.get_window_extent()
        if box.x0 < paper.x0 or box.x1 > paper.x1 or box.y0 < paper.y0 or box.y1 > paper.y1:
            faults.append("legend beyond the paper")
    for text in figure.findobj(Text):
        if text.get_visible() and text.get_text() and not text.get_clip_on():
            box = text.get_window_extent()
            if box.x0 < paper.x0 or box.x1 > paper.x1 or box.y0 < paper.y0 or box.y1 > paper.y1:
                faults.append(f"beyond the paper: {text.get_text()}")
    for i, axes in enumerate(panels):
        faults += [f"axes {i} and {j} overlap" for j in range(i)
                   if axes.get_window_extent().padded(-1.0).overlaps(panels[j].get_window_extent())]
    return faults


def comments_of(svg: Path) -> list[str]:
    """The texts of an SVG file, which must be well-formed: letters are paths, with their text as comment."""
    parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    root = ElementTree.parse(svg, parser).getroot()
    return [node.text.strip() for node in root.iter(ElementTree.Comment)]
