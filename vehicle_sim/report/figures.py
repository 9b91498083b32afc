"""All figures of a campaign, from OUT/series into OUT/report; files and links of any figures."""

from collections.abc import Iterable, Iterator
from pathlib import Path

from . import (
    figure_distances, figure_error, figure_paths, figure_planning_time, figure_scenario, figure_subgraphs,
    figure_vertices, style,
)
from .errors import InputError
from .series import Group, read_series


def drawings_of(groups: list[Group]) -> Iterator[tuple[Group, style.Drawing]]:
    """Each figure that has something to show, by scenario and profile."""
    scenarios: set[str] = set()
    for group in groups:
        if group.scenario not in scenarios:
            scenarios.add(group.scenario)
            yield group, figure_scenario.draw_group(group)
        for draw in (figure_paths.draw, figure_error.draw, figure_vertices.draw, figure_planning_time.draw,
                     figure_distances.draw):
            drawing = draw(group)
            if drawing is not None:
                yield group, drawing
        for drawing in figure_subgraphs.draw(group):
            yield group, drawing


def _drawn(groups: list[Group], series: Path) -> Iterator[tuple[Group, style.Drawing]]:
    """The same; values that no run has fail in one line."""
    try:
        yield from drawings_of(groups)
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"{series}: {type(error).__name__} {error}, must be as evaluate --series wrote it") from error


def heading_of(group: Group) -> str:
    """Scenario and profile in words."""
    return f"{style.words(group.scenario)}, profile {style.words(group.profile)}"


def notes_of(group: Group) -> list[str]:
    """What the figures of a group do not show."""
    notes = [f"* {run.label} does not count: {run.fault}" for run in group.runs if run.fault]
    if not figure_subgraphs.rows_of(group)[0]:
        notes.append("* No car changed its subgraph: there is no figure of subgraphs.")
    if len(group.cars) > 1 and figure_distances.draw(group) is None:
        notes.append(f"* No two cars came closer than {figure_distances.SHOWN_M} m: there is no figure of distances.")
    return notes


def draw_all(folder: Path) -> list[str]:
    """Draws all figures of the folder of a campaign. Returns the page's lines, links relative to that folder.

    Raises InputError in one line if a file of the series is not one, OSError if a file cannot be written.
    """
    folder = Path(folder)
    groups = read_series(folder / "series")
    target = folder / "report"
    target.mkdir(exist_ok=True)
    lines: list[str] = []
    last: Group | None = None
    with style.journal():
        for group, drawing in _drawn(groups, folder / "series"):
            if group is not last:
                lines += [f"## {heading_of(group)}", ""]
                lines += [*notes_of(group), ""] if notes_of(group) else []
                last = group
            lines += _saved(drawing, target)
    return lines


def save_all(drawings: Iterable[style.Drawing], target: Path) -> list[str]:
    """Draws and saves figures. Returns the page's lines, links relative to the folder that `target` lies in."""
    with style.journal():
        return [line for drawing in drawings for line in _saved(drawing, target)]


def _saved(drawing: style.Drawing, target: Path) -> list[str]:
    files = style.save(drawing, target)
    links = ", ".join(f"[{file.suffix[1:].upper()}](report/{file.name})" for file in files[1:])
    return [f"![{drawing.caption}](report/{files[0].name})", "", f"{drawing.caption} {links}", ""]
