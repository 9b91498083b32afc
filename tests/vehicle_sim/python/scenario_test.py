"""Scenarios, their changed values, and what is refused."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import hlc


class ScenarioTest(unittest.TestCase):
    def test_every_shipped_scenario_has_a_name(self):
        self.assertIn("paper_three_cars", hlc.scenario_names())
        self.assertGreater(len(hlc.scenario_names()), 10)

    def test_a_changed_value_is_that_of_the_file_with_it(self):
        file = hlc.data_folder() / "scenarios" / "paper_three_cars.yaml"
        changed = hlc.load_scenario(file, values={"reference_speed_mps": 0.6, "steps": 10})
        with tempfile.TemporaryDirectory() as folder:
            text = file.read_text().replace("reference_speed_mps: 0.8", "reference_speed_mps: 0.6")
            text = text.replace("steps: 150", "steps: 10").replace("../", f"{file.resolve().parent.parent}/")
            edited = Path(folder) / "edited.yaml"
            edited.write_text(text)
            expected = hlc.load_scenario(edited)
        self.assertEqual(hlc.rollout(changed).trace_sha256, hlc.rollout(expected).trace_sha256)

    def test_a_dict_changes_single_keys_and_none_removes_one(self):
        few = hlc.load_scenario("lab_circle", values={"circle": {"cars": 2}})
        self.assertEqual(len(few.vehicles), 2)
        default = hlc.load_scenario("paper_three_cars", values={"reference_speed_mps": None})
        self.assertEqual(default.reference_speed_mps, 0.8)

    def test_an_invalid_value_is_named_with_file_line_key_and_rule(self):
        cases = [
            ({"horizon_steps": 99}, r"paper_three_cars.yaml:8: horizon_steps = 99, must be .*64"),
            ({"horizon_steps": "many"}, r"paper_three_cars.yaml:8: horizon_steps = many, must be"),
            ({"colour": "red"}, r"paper_three_cars.yaml:\d+: .*colour"),
            ({"vehicles": []}, r"paper_three_cars.yaml:\d+: vehicles .*at least one"),
            ({"steps": object()}, r"values: steps = .*, must be str, bool, int, float, list or dict"),
            ({"reference_speed_mps": float("nan")}, r"reference_speed_mps = nan, must be"),
        ]
        for values, message in cases:
            with self.subTest(values=values), self.assertRaisesRegex(hlc.Error, message) as caught:
                hlc.load_scenario("paper_three_cars", values=values)
            self.assertNotIn("\n", str(caught.exception))
            self.assertIsInstance(caught.exception, ValueError)

    def test_an_unknown_scenario_is_refused_with_those_that_there_are(self):
        with self.assertRaisesRegex(hlc.Error, "no_such, must be a file, or one of .*paper_three_cars"):
            hlc.load_scenario("no_such")
        with self.assertRaisesRegex(hlc.Error, "no_such.yaml"):
            hlc.load_scenario("no_such.yaml")

    def test_arguments_have_bounds(self):
        for arguments in ({"steps": 0}, {"steps": 1.5}, {"steps": True}, {"seed": -1}, {"cars": 256}):
            with self.subTest(**arguments), self.assertRaisesRegex(hlc.Error, "must be a whole number in"):
                hlc.load_scenario("lab_cars", **arguments)

    def test_guests_are_refused_where_nobody_drives_them(self):
        with self.assertRaisesRegex(hlc.Error, "guests"):
            hlc.rollout(hlc.load_scenario("lab_guest"))
        with self.assertRaisesRegex(hlc.Error, "guests"):
            hlc.Environments(hlc.load_scenario("lab_guest"), 1)

    def test_what_a_scenario_is(self):
        scenario = hlc.load_scenario("paper_three_cars")
        self.assertEqual([one.name for one in scenario.vehicles], ["red", "blue", "green"])
        self.assertEqual(scenario.trims.shape, (12, 2))
        self.assertEqual(scenario.step_s, 0.2)
        np.testing.assert_allclose(scenario.vehicle_size_m, (0.22, 0.107))
        self.assertIn("paper_three_cars", repr(scenario))
