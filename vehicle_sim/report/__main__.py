"""python -m report OUT: writes OUT/report.md and OUT/report/."""

import argparse
import sys
from pathlib import Path

from report.errors import InputError
from report.files import replace
from report.flags import BAD_INPUT, INTERRUPTED, Parser
from report.priorities import Priorities
from report.results import read_folder
from report.tables import Page, page_of

NO_SERIES = "None: there are no series, which `evaluate --series` writes for a campaign."
NOT_DRAWN = "Not drawn: the report ended before."


def _parse() -> argparse.Namespace:
    parser = Parser(
        prog="report",
        description="Tables, statistics and figures of a folder that evaluate or compare_priorities wrote: "
                    "OUT/report.md is\nthe page, OUT/report/ has the data of every table and the figures (of evaluate "
                    "only if it wrote OUT/series).",
        epilog="Exit codes: 0 done, 2 invalid input or not writable.")
    parser.add_argument("folder", metavar="OUT", type=Path, help="with campaign.json, runs.csv and what belongs to "
                                                                 "them")
    return parser.parse_args()


def write(page: Page, figures: list[str], folder: Path) -> None:
    """The data first, then the page, which a reader sees whole. @raises OSError"""
    (folder / "report").mkdir(exist_ok=True)
    links = [f"[{name}.csv](report/{name}.csv)" for name in page.data]
    for name, data in page.data.items():
        replace(folder / "report" / f"{name}.csv",
                lambda file, data=data: data.to_csv(file, index=False, float_format="%.12g", lineterminator="\n"))
    drawn = "# Figures\n\n" + "\n".join(figures) + "\n\n" if figures else ""
    text = f"{page.text}{drawn}Data of the tables: {', '.join(links)}\n\n{page.origin}"
    replace(folder / "report.md", lambda file: file.write_text(text, encoding="utf-8"))


def main() -> int:
    """@return the exit code"""
    folder = _parse().folder
    try:
        results = read_folder(folder)
        page = page_of(results)
        if isinstance(results, Priorities):
            from report import figure_priorities, figures

            write(page, [NOT_DRAWN], folder)
            drawings = figure_priorities.drawings_of(results, page.data["priorities"])
            write(page, figures.save_all(drawings, folder / "report"), folder)
        elif not (folder / "series").exists():
            write(page, [NO_SERIES], folder)
        else:
            write(page, [NOT_DRAWN], folder)  # a figure that fails must not take the tables with it
            from report import figures  # needs matplotlib, which tables do not

            write(page, figures.draw_all(folder), folder)
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return BAD_INPUT
    except OSError as error:
        print(f"report: {error.filename}: {error.strerror}, must be writable", file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        print("report: interrupted, the same command goes on", file=sys.stderr)
        return INTERRUPTED
    print(folder / "report.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
