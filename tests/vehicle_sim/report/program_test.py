"""The program: what it writes, and refuses in one line."""

import contextlib
import io
import json
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import pandas as pd
from made_up import ORIGIN, run, write_campaign, write_csv, write_sweep

import report
from report.__main__ import main


class Program(unittest.TestCase):
    """Run in a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def call(self, *arguments: str) -> tuple[int, str, str]:
        """Exit code, stdout, stderr. Without arguments: of the folder."""
        out, error = io.StringIO(), io.StringIO()
        with mock.patch("sys.argv", ["report", *(arguments or [str(self.folder)])]), contextlib.redirect_stdout(out), \
                contextlib.redirect_stderr(error):
            try:
                code = main()
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), error.getvalue()

    def refused(self, *texts: str) -> None:
        code, out, error = self.call()
        self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
        for text in texts:
            self.assertIn(text, error)
        self.assertFalse((self.folder / "report.md").exists())

    def test_writes_the_page_and_its_data_of_a_campaign(self) -> None:
        write_campaign(self.folder, [run(), run(policy='a"b,c')])
        self.assertEqual(self.call(), (0, f"{self.folder / 'report.md'}\n", ""))
        text = (self.folder / "report.md").read_text()
        self.assertTrue(text.startswith("# Evaluation\n"))
        self.assertTrue(text.endswith("Command: `evaluate`\n\nProgram 0, compiled by GCC; none.\n"))
        for name in ("evaluation", "tradeoff", "tradeoff_fronts"):
            self.assertIn(f"[{name}.csv](report/{name}.csv)", text)
            self.assertIn('a"b,c', list(pd.read_csv(self.folder / "report" / f"{name}.csv").policy))

    def test_a_campaign_without_policies_has_no_tradeoff(self) -> None:
        write_campaign(self.folder)
        self.call()
        self.assertNotIn("Fixed subgraphs and policies", (self.folder / "report.md").read_text())
        self.assertFalse((self.folder / "report" / "tradeoff.csv").exists())

    def test_writes_the_page_and_its_data_of_a_sweep(self) -> None:
        write_sweep(self.folder)
        self.assertEqual(self.call(), (0, f"{self.folder / 'report.md'}\n", ""))
        text = (self.folder / "report.md").read_text()
        self.assertIn("# Sweep rules.yaml\n\n4 runs: 2 combinations of settings; scenarios 1, subgraphs 1, starts 2,",
                      text)
        settings = pd.read_csv(self.folder / "report" / "settings.csv", dtype=str, keep_default_na=False)
        self.assertEqual(list(settings["values"].unique()), ["", "2022", "best_first"])
        self.assertEqual(list(settings["settings"].unique()), ["all", "search"])

    def test_the_same_rows_give_the_same_files(self) -> None:
        write_sweep(self.folder)
        contents = []
        for _ in range(2):
            self.call()
            contents.append({path.name: path.read_bytes() for path in self.folder.glob("report/*")})
        self.assertEqual(*contents)

    def test_figures_are_drawn_only_of_series(self) -> None:
        write_campaign(self.folder)
        figures = types.SimpleNamespace(draw_all=lambda folder: [f"![paths](report/paths.svg) of {folder.name}"])
        with mock.patch.object(report, "figures", figures, create=True):
            self.call()
            self.assertNotIn("paths.svg", (self.folder / "report.md").read_text())
            (self.folder / "series").mkdir()
            self.assertEqual(self.call()[0], 0)
        self.assertIn(f"# Figures\n\n![paths](report/paths.svg) of {self.folder.name}\n",
                      (self.folder / "report.md").read_text())

    def test_series_that_cannot_be_drawn_leave_the_tables_and_are_named_on_the_page(self) -> None:
        write_campaign(self.folder)
        (self.folder / "series").mkdir()
        code, out, error = self.call()
        self.assertEqual((code, out, error.count("\n")), (2, "", 1))
        self.assertIn(str(self.folder / "series"), error)
        text = (self.folder / "report.md").read_text()
        self.assertIn("# Evaluation", text)
        self.assertIn("Not drawn", text)
        self.assertEqual([path.name for path in self.folder.glob("**/.*")], [], "nothing half-written")

    def test_without_series_the_page_names_the_flag_that_writes_them(self) -> None:
        write_campaign(self.folder)
        self.call()
        self.assertIn("`evaluate --series`", (self.folder / "report.md").read_text())

    def test_flags(self) -> None:
        code, out, _ = self.call("--help")
        self.assertEqual(code, 0)
        self.assertIn("Exit codes: 0 done, 2 invalid input or not writable", out)
        for arguments in (("--nonsense", "x"), ("x", "y"), ("--hel",)):
            code, out, error = self.call(*arguments)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), arguments)

    def test_refuses_a_folder_that_is_not_of_evaluate(self) -> None:
        self.refused(f"{self.folder / 'campaign.json'}: no such file, must be written by evaluate")
        write_campaign(self.folder)
        rally, no_origin = {"kind": "rally", "origin": ORIGIN}, {"kind": "campaign", "origin": {}}
        for text, reason in (("{", "must be JSON"), ("[]", "kind = null, must be a text"),
                             ('{"kind": "rally"}', "origin = null, must be an object"),
                             (json.dumps(rally), 'kind = "rally", must be campaign, sweep or priorities'),
                             (json.dumps(no_origin), "origin: command = null, must be a text")):
            (self.folder / "campaign.json").write_text(text)
            self.refused("campaign.json: ", reason)

    def test_refuses_rows_of_another_format(self) -> None:
        cases = ({"lap_s": "fast"}, 'runs.csv:2: lap_s = "fast", must be a number, or empty'), \
                ({"lap_s": "inf"}, 'lap_s = "inf", must be a number, or empty'), \
                ({"stuck_vehicles": np.nan}, 'runs.csv:2: stuck_vehicles = "", must be a number'), \
                ({"start": -1}, 'start = "-1", must be an integer >= 0'), \
                ({"start": 0.5}, 'start = "0.5", must be an integer >= 0'), \
                ({"wall_s": ""}, 'wall_s = "", must be a number')
        for change, reason in cases:
            write_campaign(self.folder, [run() | change])
            self.refused(reason)
        write_campaign(self.folder, [run() | {"stuck_vehicles": np.nan, "failure": "not driven"}])
        self.assertEqual(self.call()[0], 0)

    def test_refuses_files_without_columns_values_or_rows(self) -> None:
        write_campaign(self.folder)
        text = (self.folder / "runs.csv").read_text()
        names = len(text.splitlines()[0].split(","))
        for wrong, reason in ((text.replace("failure", "fail"), "runs.csv:1: no column failure"),
                              (text.replace("\n0,", "\n0,0,"), f":2: {names + 1} values, must be {names} as in line 1"),
                              (text.splitlines()[0] + "\n", "runs.csv: no rows"),
                              (text.replace("lap_s", "effort_per_m"), "runs.csv:1: a name twice"),
                              (text + text.splitlines()[1] + "\n", "runs.csv: run 0 twice"),
                              ("", "runs.csv:1: no column run"), (text + '"a', "RFC 4180")):
            (self.folder / "report.md").unlink(missing_ok=True)
            (self.folder / "runs.csv").write_text(wrong)
            self.refused(reason)
        (self.folder / "runs.csv").write_bytes(b"run\n\xff")
        self.refused("must be comma-separated UTF-8 text")
        (self.folder / "runs.csv").unlink()
        self.refused("runs.csv: no such file")
        write_campaign(self.folder)
        write_csv(self.folder / "cars.csv", [{"run": 0}])
        self.refused("cars.csv:1: no column start")

    def test_refuses_a_campaign_whose_rows_are_not_of_its_plan(self) -> None:
        two = [run(), run(1)]
        for changes, reason in (({"runs": 3}, "runs.csv: 2 rows, 2 different ones, must be 3, as campaign.json has it"),
                                ({"starts": 1}, "runs.csv: start 1, must be in 0 ... 0, as campaign.json has it"),
                                ({"subgraphs": ["B"]}, 'runs.csv: subgraph "A", must be one of B, as campaign.json'),
                                ({"profiles": ["2022"]}, 'runs.csv: profile "default", must be one of 2022'),
                                ({"runs": "two"}, 'campaign: runs = "two", must be an integer')):
            write_campaign(self.folder, two, changes)
            self.refused(reason)
        write_campaign(self.folder, [run(), run()])
        self.refused("runs.csv: 2 rows, 1 different ones, must be 2, as campaign.json has it")
        write_campaign(self.folder, two)
        rows = (self.folder / "cars.csv").read_text().splitlines(keepends=True)
        (self.folder / "cars.csv").write_text("".join(rows[:-1]))
        self.refused("cars.csv: no car of run 1, must have a row per run and car")

    def test_refuses_a_sweep_whose_rows_are_not_of_its_plan(self) -> None:
        write_sweep(self.folder, starts=3)
        self.refused("runs.csv: 4 rows, 4 different ones, must be 6: 2 combinations, 1 scenarios, 1 subgraphs, 3 "
                     "starts")
        write_sweep(self.folder, settings=[{"name": "search", "values": ["2022"]}])
        self.refused('runs.csv:4: set.search = "best_first", must be one of 2022')
        write_sweep(self.folder, settings=[{"name": "search", "values": [2022]}])
        self.refused("settings: values: 0 = 2022, must be a text")
        write_sweep(self.folder, settings=[{"name": "lap", "values": ["standing"]}], tables=[])
        self.refused("runs.csv:1: no column set.lap")
        write_sweep(self.folder, tables=[["trims"]])
        self.refused('tables = "trims", must be one of search')
        write_sweep(self.folder, settings=[{"name": "trims", "values": ["1 2", "1 two"]}], tables=[])
        self.refused('settings: trims = "1 two", must be numbers separated by blanks')
        write_sweep(self.folder, starts=True)
        self.refused("sweep: starts = true, must be an integer")
        write_sweep(self.folder, trims={"offered": {"A": ["1"]}, "moving": []})
        self.refused('trims: offered: A: 0 = "1", must be an integer')

    def test_a_page_that_is_not_writable_is_2(self) -> None:
        write_campaign(self.folder)
        (self.folder / "report.md").mkdir()
        code, _, error = self.call()
        self.assertEqual((code, error.count("\n")), (2, 1))
        self.assertIn("report.md", error)


if __name__ == "__main__":
    unittest.main()
