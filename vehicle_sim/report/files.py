"""Files that a reader sees whole: the old one or the new one."""

import os
from collections.abc import Callable
from pathlib import Path


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
