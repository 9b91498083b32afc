"""One drawing of a program of the planner: `python -m report.draw KIND DATA OUT` (draw.sh)."""

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path

from . import figure_automaton, figure_pareto, figure_problem, figure_scenario, style
from .errors import InputError
from .files import replace

KINDS: dict[str, Callable[[dict], style.Drawing]] = {
    "automaton": figure_automaton.draw, "pareto": figure_pareto.draw, "problem": figure_problem.draw,
    "scenario": figure_scenario.draw, "sheet": lambda data: figure_scenario.draw(data, with_poses=True),
}
FORMATS = (".svg", ".pdf", ".png")


def draw(kind: str, data: Path, out: Path) -> None:
    """Draws beside `out` and renames: a reader sees the old drawing or the whole new one.

    Raises InputError in one line, OSError.
    """
    try:
        content = json.loads(data.read_text(encoding="utf-8"))
        with style.journal():
            drawing = KINDS[kind](content)
            suffix = out.suffix if out.suffix in FORMATS else ".svg"
            when = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(suffix, {})
            replace(out, lambda file: drawing.figure.savefig(file, format=suffix[1:], metadata=when, dpi=200))
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"{data}: {type(error).__name__} {error}, must be the data of a drawing {kind}") from error


def main(arguments: list[str]) -> int:
    """0; 2 after one line: bad input, or not writable."""
    parser = argparse.ArgumentParser(prog="draw.sh", description="Draws what a program of the planner wrote.")
    parser.add_argument("kind", choices=sorted(KINDS))
    parser.add_argument("data", type=Path, help="JSON")
    parser.add_argument("out", type=Path, help="SVG, PDF or PNG by its extension, otherwise SVG")
    choices = parser.parse_args(arguments)
    try:
        draw(choices.kind, choices.data, choices.out)
    except InputError as error:
        print(f"draw.sh: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"draw.sh: {choices.out}: {error.strerror}, must be writable", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
