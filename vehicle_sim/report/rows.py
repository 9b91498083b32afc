"""Rows of a comma-separated file (RFC 4180), with every error at its line."""

import csv
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd

from report.errors import InputError
from report.files import check_regular


class Rows:
    """The texts of a file; columns are checked when they are read."""

    def __init__(self, path: Path) -> None:
        self._path = path
        check_regular(path, "written by evaluate or compare_priorities")
        try:
            with path.open(newline="", encoding="utf-8") as file:
                reader = csv.reader(file, strict=True)
                self._header = next(reader, [])
                self._lines, rows = [], []
                for row in reader:
                    if len(row) != len(self._header):
                        raise self._error(reader.line_num, f"{len(row)} values", f"{len(self._header)} as in line 1")
                    self._lines.append(reader.line_num)
                    rows.append(row)
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            raise InputError(f"{path}: {error}, must be comma-separated UTF-8 text (RFC 4180)") from None
        if len(set(self._header)) != len(self._header):
            raise self._error(1, "a name twice", "different names")
        self._texts = dict(zip(self._header, zip(*rows))) if rows else {name: () for name in self._header}

    def __len__(self) -> int:
        return len(self._lines)

    def names(self, prefix: str) -> list[str]:
        """The columns whose names begin so."""
        return [name for name in self._header if name.startswith(prefix)]

    def texts(self, name: str, allowed: Iterable[str] | None = None) -> pd.Series:
        """@param allowed: values; absent: any text."""
        if name not in self._texts:
            raise self._error(1, f"no column {name}", "with it; is the file of another format?")
        texts = pd.Series(self._texts[name], dtype=object)
        if allowed is not None:
            self._check(name, texts, ~texts.isin(list(allowed)), "one of " + ", ".join(allowed))
        return texts

    def numbers(self, name: str, needed: pd.Series | None = None) -> pd.Series:
        """Numbers, NaN for an empty text. @param needed: rows in which it must not be empty."""
        texts = self.texts(name)
        numbers = pd.to_numeric(texts.where(texts != "", np.nan), errors="coerce").astype(float)
        self._check(name, texts, (texts != "") & ~np.isfinite(numbers), "a number, or empty")
        if needed is not None:
            self._check(name, texts, (texts == "") & needed, "a number")
        return numbers

    def integers(self, name: str) -> pd.Series:
        """Integers >= 0."""
        numbers = self.numbers(name, needed=pd.Series(True, index=range(len(self))))
        self._check(name, self.texts(name), (numbers < 0) | (numbers % 1 != 0), "an integer >= 0")
        return numbers.astype(int)

    def fail(self, value: str, allowed: str) -> None:
        """@raises InputError for the file as a whole."""
        raise InputError(f"{self._path}: {value}, must be {allowed}")

    def _check(self, name: str, texts: pd.Series, is_wrong: pd.Series, allowed: str) -> None:
        if is_wrong.any():
            row = int(np.flatnonzero(is_wrong)[0])
            raise self._error(self._lines[row], f'{name} = "{texts.iloc[row]}"', allowed)

    def _error(self, line: int, value: str, allowed: str) -> InputError:
        return InputError(f"{self._path}:{line}: {value}, must be {allowed}")
