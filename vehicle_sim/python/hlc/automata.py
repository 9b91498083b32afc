"""Motion primitive automata: trims and the maneuvers between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from hlc import _core
from hlc.files import PathLike, find


@dataclass(frozen=True)
class Maneuver:
    """A motion of one step, in the frame of its start pose."""

    from_trim: int
    """From 0: an index into Automaton.trims."""
    to_trim: int
    label: str
    """Criterion that it is optimal for; "trim": the trim itself, driven for a step."""
    duration_s: float
    states: NDArray[np.float64]
    """(N + 1, 5): x [m], y [m], heading [rad], speed [m/s], steering [rad] at equal times."""
    inputs: NDArray[np.float64]
    """(N, 2): acceleration [m/s^2] and steering rate [rad/s], constant between these times."""
    swept_area_m: NDArray[np.float64]
    """(n, 2): convex polygon that holds the footprint with its safety margin throughout [m]."""
    criteria: dict[str, float]
    """Values of all criteria (`hlc.criteria`)."""


class Automaton:
    """An automaton, with all its arrays; see `load_automaton`."""

    def __init__(self, core: _core.AutomatonFile) -> None:
        self._core = core
        self.step_s: float = core.step_s
        self.trims: NDArray[np.float64] = core.trims
        """(T, 2): speed [m/s] and steering [rad]."""
        self.subgraphs: dict[str, list[str]] = core.subgraphs
        """Name of each subgraph, and the labels of its maneuvers."""
        self.maneuvers: list[Maneuver] = [Maneuver(**one) for one in core.maneuvers]

    def save(self, path: PathLike) -> None:
        """Writes the automaton file, which every key `automaton` of a scenario takes. Raises Error."""
        self._core.save(path)

    def __repr__(self) -> str:
        return f"<hlc.Automaton: {len(self.trims)} trims, {len(self.maneuvers)} maneuvers of {self.step_s} s>"


def load_automaton(path: PathLike, *, subgraph: Optional[str] = None) -> Automaton:
    """Reads an automaton file, or builds the automaton of a configuration: its maneuvers are optimised (seconds to
    minutes; the interpreter's lock is released).

    path: a file, or the name of a shipped configuration, as "paper"
    subgraph: of a configuration, builds only what this one needs. None: all

    Raises Error.
    """
    return Automaton(_core.load_automaton(find(path, "automata", ".yaml"), subgraph))
