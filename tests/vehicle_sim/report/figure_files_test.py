"""All figures of a campaign: files, links, words."""

import json
import re
import tempfile
import unittest
from pathlib import Path

import pandas as pd
from made_up_series import MadeUp, comments_of, faults_of

from report import figures, series, style
from report.errors import InputError


class FigureFiles(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_every_figure_has_its_files_and_the_page_links_them(self) -> None:
        made_up = MadeUp(planned_on=(("A", "none"), ("B", "zone")))
        made_up.subgraph_at = lambda run, _, step: "B slow" if run["policy"] == "zone" and step > 9 else run["subgraph"]
        lines = figures.draw_all(made_up.write(self.folder))
        names = {file.stem for file in (self.folder / "report").glob("*.svg")}
        self.assertEqual(names, {"scenario_two_rings", *(f"{kind}_two_rings_the_2022" for kind in (
            "paths", "error", "vertices", "planning_time", "distances", "subgraphs"))})
        linked = re.findall(r"\]\((report/[^)]+)\)", "\n".join(lines))
        self.assertEqual(len(linked), len(set(linked)))
        self.assertEqual({Path(link).name for link in linked},
                         {file.name for file in (self.folder / "report").iterdir()})
        for name in names:
            self.assertGreater((self.folder / "report" / f"{name}.pdf").stat().st_size, 1000)
            self.assertGreater(len(pd.read_csv(self.folder / "report" / f"{name}.csv")), 0)
            comments = comments_of(self.folder / "report" / f"{name}.svg")
            self.assertTrue(any("[" in text and "]" in text for text in comments), f"{name}: no unit")
            self.assertFalse([text for text in comments if "two_rings" in text or "the_2022" in text])
        self.assertIn("## two rings, profile the 2022", lines)

    def test_the_same_series_give_the_same_bytes(self) -> None:
        folders = [MadeUp().write(self.folder / name) for name in ("one", "two")]
        for folder in folders:
            figures.draw_all(folder)
        for file in (folders[0] / "report").iterdir():
            self.assertEqual(file.read_bytes(), (folders[1] / "report" / file.name).read_bytes(), file.name)

    def test_what_is_not_shown_is_named(self) -> None:
        made_up = MadeUp()
        made_up.distance_at = lambda run, time_s: 0.7
        made_up.runs[0]["fault"] = "vehicles 1 and 2 touched"
        lines = figures.draw_all(made_up.write(self.folder))
        self.assertIn("* subgraph A does not count: vehicles 1 and 2 touched", lines)
        self.assertIn("* No car changed its subgraph: there is no figure of subgraphs.", lines)
        self.assertIn("* No two cars came closer than 0.6 m: there is no figure of distances.", lines)

    def test_nothing_is_hidden_or_cut_off_whatever_is_drawn(self) -> None:
        for cars, planned_on in ((1, (("A", "none"),)), (3, tuple((name, "none") for name in "ABCDEFGHI")),
                                 (20, (("J2", "none"), ("J2", "zone_look_ahead")))):
            made_up = MadeUp(cars=cars, planned_on=planned_on, steps=20)
            made_up.subgraph_at = lambda run, vehicle, step: f"label {step // 5}, at most 0.{vehicle % 4 + 1} m/s"
            groups = series.read_series(made_up.write(self.folder / str(cars)) / "series")
            with style.journal():
                for _, drawing in figures.drawings_of(groups):
                    with self.subTest(cars=cars, name=drawing.name):
                        self.assertEqual(faults_of(drawing), [])

    def test_a_damaged_series_is_refused_in_one_line(self) -> None:
        MadeUp().write(self.folder)
        good = {file: file.read_text() for file in (self.folder / "series").iterdir()}
        for name, was, now, message in (
                ("steps.csv", "error_mm", "error", "column error_mm is missing"),
                ("steps.csv", ",101,", ",many,", "generated = many, must be a number"),
                ("steps.csv", "true", "yes", "searched = yes, must be true or false"),
                ("drives.csv", "x_m", "x", "column x_m is missing"),
                ("places.json", '"fault"', '"reason"', "fault is missing"),
                ("places.json", "{", "", "must be an object")):
            file = self.folder / "series" / name
            file.write_text(good[file].replace(was, now, 1))
            with self.subTest(message=message), self.assertRaises(InputError) as refused:
                figures.draw_all(self.folder)
            text = str(refused.exception)
            self.assertIn(message, text)
            self.assertIn(name, text)
            self.assertNotIn("\n", text)
            file.write_text(good[file])
        (self.folder / "series" / "drives.csv").unlink()
        with self.assertRaisesRegex(InputError, "drives.csv: No such file"):
            figures.draw_all(self.folder)

    def test_numbers_of_a_damaged_row_are_named_with_their_line(self) -> None:
        MadeUp().write(self.folder)
        file = self.folder / "series" / "steps.csv"
        lines = file.read_text().splitlines()
        lines[4] = lines[4].replace(",true,", ",maybe,")
        file.write_text("\n".join(lines) + "\n")
        with self.assertRaisesRegex(InputError, r"steps.csv:5: searched = maybe"):
            series.read_series(self.folder / "series")

    def test_places_keep_the_order_of_the_campaign(self) -> None:
        made_up = MadeUp(planned_on=(("D", "none"), ("A", "none")), starts=1)
        self.assertEqual([run.label for run in made_up.group(self.folder).runs], ["subgraph D", "subgraph A"])
        self.assertEqual(len(json.loads((self.folder / "series" / "places.json").read_text())["runs"]), 2)


if __name__ == "__main__":
    unittest.main()
