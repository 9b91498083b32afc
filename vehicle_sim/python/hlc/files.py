"""Where the shipped scenarios, automata and problems are."""

from __future__ import annotations

import importlib
import os
from pathlib import Path
from typing import Any, SupportsIndex, Union

from hlc._core import Error

PathLike = Union[str, "os.PathLike[str]"]


def data_folder() -> Path:
    """Folder of the shipped files: scenarios, automata, labs, maps, problems."""
    return Path(__file__).parent / "data"


def scenario_names() -> list[str]:
    """Names that `load_scenario` takes."""
    return sorted(file.stem for file in (data_folder() / "scenarios").glob("*.yaml"))


def find(path_or_name: PathLike, kind: str, extension: str) -> Path:
    """The file itself, or for a bare name the shipped one.

    kind: folder of data_folder(), for example "scenarios".
    """
    given = as_path(kind, path_or_name)
    if given.is_file() or given.suffix or len(given.parts) != 1:
        return given
    folder = data_folder() / kind
    file = folder / (given.name + extension)
    if file.is_file():
        return file
    names = ", ".join(sorted(one.stem for one in folder.glob("*" + extension)))
    raise Error(f"{kind}: {given}, must be a file, or one of {names}")


def optional_module(name: str) -> Any:
    """The module; raises Error where the package was installed without its extra "all"."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise Error(f'{name}: is not installed, must be for tables and figures: pip install ".[all]"') from error


def check_whole(name: str, value: object, least: int, most: int) -> None:
    """Raises Error unless the value is None or a whole number in least ... most."""
    if value is None:
        return
    if isinstance(value, bool) or not isinstance(value, SupportsIndex) or not least <= int(value) <= most:
        raise Error(f"{name} = {value!r}, must be a whole number in {least} ... {most}")


def check_is(name: str, value: object, allowed: Union[type, tuple[type, ...]], what: str) -> None:
    """Raises Error unless the value is of an allowed type."""
    if not isinstance(value, allowed):
        raise Error(f"{name} = {value!r}, must be {what}")


def as_path(name: str, value: object) -> Path:
    """Raises Error unless the value is a path."""
    try:
        return Path(value)  # type: ignore[arg-type]
    except TypeError as error:
        raise Error(f"{name} = {value!r}, must be a path") from error
