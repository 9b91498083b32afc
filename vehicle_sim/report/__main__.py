"""python -m report OUT: writes OUT/report.md and OUT/report/."""

import argparse
import os
import sys
from pathlib import Path

from report.errors import InputError
from report.results import read_folder
from report.tables import Page, page_of

BAD_INPUT, NOT_WRITABLE = 2, 3


class _Parser(argparse.ArgumentParser):
    """Errors are one line."""

    def error(self, message: str) -> None:
        self.exit(BAD_INPUT, f"report: {message}, see --help\n")


def _parse() -> argparse.Namespace:
    parser = _Parser(
        prog="report", allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Tables, statistics and figures of a folder that evaluate wrote: OUT/report.md is the page, "
                    "OUT/report/ has\nthe data of every table and the figures (if evaluate wrote OUT/series).",
        epilog="Exit codes: 0 done, 2 invalid input, 3 not writable.")
    parser.add_argument("folder", metavar="OUT", type=Path, help="with campaign.json, runs.csv and, of a campaign, "
                                                                 "cars.csv")
    return parser.parse_args()


def write(page: Page, figures: list[str], folder: Path) -> None:
    """The data first, then the page, which a reader sees whole. @raises OSError"""
    (folder / "report").mkdir(exist_ok=True)
    links = [f"[{name}.csv](report/{name}.csv)" for name in page.data]
    for name, data in page.data.items():
        text = data.to_csv(index=False, float_format="%.12g", lineterminator="\n")
        replace(folder / "report" / f"{name}.csv", text)
    drawn = "# Figures\n\n" + "\n".join(figures) + "\n\n" if figures else ""
    replace(folder / "report.md", f"{page.text}{drawn}Data of the tables: {', '.join(links)}\n\n{page.origin}")


def replace(file: Path, text: str) -> None:
    """Writes beside the file and renames: the old text or the whole new one. @raises OSError of the file"""
    partial = file.with_name(f".{file.name}.{os.getpid()}")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(file)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(file)) from error
    finally:
        partial.unlink(missing_ok=True)


def main() -> int:
    """@return the exit code"""
    folder = _parse().folder
    try:
        page = page_of(read_folder(folder))
        write(page, [], folder)  # a figure that fails must not take the tables with it
        if (folder / "series").is_dir():
            from report import figures  # needs matplotlib, which tables do not

            write(page, figures.draw_all(folder), folder)
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return BAD_INPUT
    except OSError as error:
        print(f"report: {error.filename}: {error.strerror}, must be writable", file=sys.stderr)
        return NOT_WRITABLE
    return 0


if __name__ == "__main__":
    sys.exit(main())
