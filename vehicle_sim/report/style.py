"""The common look of all figures: sizes, colours, legends, files."""

import contextlib
import shutil
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pgf import LatexError
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
import pandas as pd

from .files import replace

WIDTH_IN = 7.16  # a page of two columns (IEEE)
MARK = "#444444"  # bounds, marks: no series
ZONE = "#e6e6e6"
LANE = "#f2f2f2"
LANE_BORDER = "#a8a8a8"
OTHERS = "#b8b8b8"  # what is shown, but not distinguished

# Okabe and Ito, Color Universal Design (2008), without the yellow, which is too pale for lines.
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, "#000000")
STROKES = ("solid", (0, (4, 1.5)), (0, (1, 1.2)), (0, (5, 1.2, 1, 1.2)))
COLOUR_OF_NAME = {"red": VERMILION, "blue": BLUE, "green": GREEN, "orange": ORANGE, "purple": PURPLE,
                  "black": "#000000"}


@dataclass(frozen=True)
class Stroke:
    """How a series is drawn. Colour and dashes together are unique for 28 series."""

    colour: str
    dashes: str | tuple[int, tuple[float, ...]] = "solid"

    @property
    def rank(self) -> float:
        """Above lines with fewer gaps, which remain visible below."""
        return 0.01 * STROKES.index(self.dashes)

    def line(self) -> dict[str, object]:
        """The same as arguments of matplotlib."""
        return {"color": self.colour, "linestyle": self.dashes}


@dataclass
class Drawing:
    """A figure with what belongs to it."""

    name: str  # of its files
    figure: Figure
    data: pd.DataFrame  # the numbers that are drawn
    caption: str


@contextlib.contextmanager
def journal() -> Iterator[None]:
    """Within it figures are drawn and saved in the common look."""
    settings = {
        "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans", "font.size": 8.0, "axes.titlesize": 8.0,
        "axes.labelsize": 8.0, "xtick.labelsize": 7.0, "ytick.labelsize": 7.0, "legend.fontsize": 7.0,
        "axes.linewidth": 0.6, "lines.linewidth": 1.1, "axes.grid": True, "grid.color": "#dddddd",
        "grid.linewidth": 0.5, "axes.axisbelow": True, "legend.frameon": False, "legend.handlelength": 2.6,
        "figure.constrained_layout.use": True, "svg.fonttype": "path", "svg.hashsalt": "report", "pdf.fonttype": 42,
        "hatch.linewidth": 0.5,
    }
    with matplotlib.rc_context(settings):
        yield


def new_figure(height_in: float, layout: str = "constrained") -> Figure:
    """An empty figure as wide as a page, without any state of pyplot. layout: "compressed" for maps."""
    figure = Figure(figsize=(WIDTH_IN, height_in), layout=layout)
    FigureCanvasAgg(figure)
    return figure


def stroke(index: int) -> Stroke:
    """The stroke of a series by its number: every second one is dashed, so that two lines on each other both show."""
    colour = index % len(COLOURS)
    return Stroke(COLOURS[colour], STROKES[(colour % 2 + index // len(COLOURS)) % len(STROKES)])


def strokes_of_cars(names: Sequence[str]) -> list[Stroke]:
    """The strokes of cars by their names, all different: a car named "red" is red, the first of that name solid."""
    free = [Stroke(colour, dashes) for dashes in STROKES for colour in COLOURS]
    taken: list[Stroke | None] = []
    for name in names:
        wanted = Stroke(COLOUR_OF_NAME.get(name, ""))
        taken.append(wanted if wanted in free else None)
        if wanted in free:
            free.remove(wanted)
    return [own or (free.pop(0) if free else stroke(number)) for number, own in enumerate(taken)]


def words(name: str) -> str:
    """A name of a scenario or profile as words."""
    return name.replace("_", " ")


def line_entry(label: str, look: Stroke, width: float = 1.4) -> Line2D:
    """A line of a legend."""
    return Line2D([], [], label=label, linewidth=width, color=look.colour, linestyle=look.dashes)


def legend_below(figure: Figure, entries: Sequence[object]) -> None:
    """One legend for all axes, below them: it hides nothing.

    The number of columns follows from the longest text.
    """
    longest = max(len(str(entry.get_label())) for entry in entries)
    fitting = max(1, int(WIDTH_IN * 72.0 / (3.9 * longest + 40.0)))
    columns = min(len(entries), fitting)
    figure.legend(handles=list(entries), loc="outside lower center", ncols=columns, columnspacing=1.4)


def latex_engine() -> str | None:
    """The LaTeX engine that is installed; None: none."""
    for engine in ("lualatex", "xelatex", "pdflatex"):
        if shutil.which(engine):
            return engine
    return None


def save(drawing: Drawing, folder: Path) -> list[Path]:
    """Writes NAME.svg, NAME.pdf, NAME.csv and, where LaTeX is installed, NAME.pgf.

    The same figure gives the same bytes of SVG and PDF.
    """
    files = [folder / f"{drawing.name}.{kind}" for kind in ("svg", "pdf", "csv")]
    replace(files[0], lambda file: drawing.figure.savefig(file, metadata={"Date": None}))
    replace(files[1], lambda file: drawing.figure.savefig(file, metadata={"CreationDate": None}))
    replace(files[2], lambda file: drawing.data.to_csv(file, index=False, float_format="%.7g", lineterminator="\n"))
    if engine := latex_engine():
        files.append(folder / f"{drawing.name}.pgf")
        try:
            with matplotlib.rc_context({"pgf.texsystem": engine}):
                replace(files[-1], lambda file: drawing.figure.savefig(file, backend="pgf"))
        except LatexError as error:  # an engine without the packages that the preamble needs
            print(f"report: {files[-1]}: not written, {engine}: {str(error).splitlines()[0]}", file=sys.stderr)
            files.pop()
    return files
