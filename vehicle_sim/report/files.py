"""Files that a reader sees whole: the old one or the new one."""

import os
from collections.abc import Callable
from pathlib import Path

from report.errors import InputError

MOST_BYTES = 2 << 30  # as of a run's record


def check_regular(file: Path, allowed: str) -> None:
    """A pipe or device would wait, or never end. @raises InputError"""
    if not file.exists():
        raise InputError(f"{file}: no such file, must be {allowed}")
    if not file.is_file() or file.stat().st_size > MOST_BYTES:
        raise InputError(f"{file}: cannot be read, must be {allowed}, a regular file of at most {MOST_BYTES} bytes")


def read_text(file: Path, allowed: str) -> str:
    """The whole file, with the line ends that it has. @raises InputError"""
    check_regular(file, allowed)
    try:
        return file.read_bytes().decode("utf-8")
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}, must be {allowed}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: byte {error.start} is no UTF-8, must be {allowed}") from None


def replace(file: Path, write: Callable[[Path], object]) -> None:
    """Calls write(partial) for a file beside this one, then renames it.

    Raises OSError of `file`.
    """
    partial = file.with_name(f".{file.stem}.{os.getpid()}{file.suffix}")
    try:
        write(partial)
        partial.replace(file)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(file)) from error
    finally:
        partial.unlink(missing_ok=True)
