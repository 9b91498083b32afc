"""Automata, single problems, Pareto fronts: the values of the programs."""

import csv
import json
import os
import subprocess
import tempfile
import traceback
import unittest
from pathlib import Path

import numpy as np

import hlc

BUILD = Path(os.environ["HLC_BUILD"])
FROM, TO = (0.0, 0.0), (0.7, 0.0)


def effort(**others):
    """J2 in Python."""
    return hlc.Cost(**{"value": lambda x, u: float(u @ u), "gradient": lambda x, u: (np.zeros(5), 2.0 * u), **others})


class AutomatonTest(unittest.TestCase):
    def test_a_built_automaton_is_the_same_when_read(self):
        built = hlc.load_automaton("paper", subgraph="B")
        self.assertEqual(built.trims.shape, (12, 2))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "b.yaml"
            built.save(file)
            read = hlc.load_automaton(file)
        self.assertEqual(len(read.maneuvers), len(built.maneuvers))
        for one, other in zip(read.maneuvers, built.maneuvers):
            np.testing.assert_array_equal(one.states, other.states)
            self.assertEqual(one.criteria, other.criteria)

    def test_maneuvers_join_their_trims(self):
        automaton = hlc.load_automaton("paper", subgraph="B")
        for one in automaton.maneuvers:
            np.testing.assert_allclose(one.states[0], [0, 0, 0, *automaton.trims[one.from_trim]], atol=1e-9)
            np.testing.assert_allclose(one.states[-1, 3:], automaton.trims[one.to_trim], atol=1e-6)
            self.assertEqual(len(one.states), len(one.inputs) + 1)

    def test_an_unknown_subgraph_is_named(self):
        with self.assertRaisesRegex(hlc.Error, "paper.yaml: subgraph = Z, must be one of A, B, C, D"):
            hlc.load_automaton("paper", subgraph="Z")


class ProblemTest(unittest.TestCase):
    def test_plan_cost_and_counts_are_those_of_the_program(self):
        for file in sorted((hlc.data_folder() / "problems").glob("*.json")):
            done = subprocess.run([BUILD / "bin" / "plan_problem", file, "--json"], capture_output=True, text=True,
                                  check=False)
            expected = json.loads(done.stdout)
            if "vehicles" in expected:
                with self.assertRaisesRegex(hlc.Error, "must be of one vehicle .plan_joint_problem"):
                    hlc.plan_problem(file)
                continue
            with self.subTest(file=file.name):
                plan = hlc.plan_problem(file)
                self.assertEqual(plan.status, expected["status"])
                self.assertEqual(plan.cost_m2, expected["cost"])
                self.assertEqual((plan.trims + 1).tolist(), expected["trims"])
                self.assertEqual(plan.poses.tolist(), expected["poses"])
                self.assertEqual((plan.generated, plan.expanded), (expected["generated"], expected["expanded"]))

    def test_joint_plans_costs_and_counts_are_those_of_the_program(self):
        file = hlc.data_folder() / "problems" / "two_at_a_crossing.json"
        done = subprocess.run([BUILD / "bin" / "plan_problem", file, "--json"], capture_output=True, text=True,
                              check=False)
        expected = json.loads(done.stdout)
        found = hlc.plan_joint_problem("two_at_a_crossing")
        self.assertEqual([found.status, found.cost_m2, found.lower_bound_m2, found.alone_m2, found.constant_order_m2,
                          found.best_order_m2, found.nodes, found.expanded],
                         [expected[key] for key in ("status", "cost", "lower_bound", "alone", "constant_order",
                                                    "best_order", "nodes", "expanded")])
        self.assertEqual([(one.cost_m2, (one.trims + 1).tolist(), one.poses.tolist()) for one in found.plans],
                         [(one["cost"], one["trims"], one["poses"]) for one in expected["vehicles"]])
        self.assertLess(found.cost_m2, found.best_order_m2)

    def test_bad_choices_of_a_joint_problem_are_named(self):
        with self.assertRaisesRegex(hlc.Error, "parked_car.json: of one vehicle, must be a joint problem"):
            hlc.plan_joint_problem("parked_car")
        with self.assertRaisesRegex(hlc.Error, "crossing.json: cost_to_go = 2022, must be reachable or straight_line"):
            hlc.plan_joint_problem("two_at_a_crossing", engine="best_first", cost_to_go="2022")
        with self.assertRaisesRegex(hlc.Error, "max_expansions = 0, must be a whole number in 1"):
            hlc.plan_joint_problem("two_at_a_crossing", max_expansions=0)

    def test_another_engine_finds_the_same_cost(self):
        ours = hlc.plan_problem("parked_car")
        plain = hlc.plan_problem("parked_car", engine="best_first")
        self.assertAlmostEqual(ours.cost_m2, plain.cost_m2, delta=1e-9)
        self.assertNotEqual(ours.expanded, plain.expanded)

    def test_bad_choices_are_named(self):
        with self.assertRaisesRegex(hlc.Error, "parked_car.json: engine = fast, must be"):
            hlc.plan_problem("parked_car", engine="fast")
        with self.assertRaisesRegex(hlc.Error, "max_expansions = 0, must be"):
            hlc.plan_problem("parked_car", max_expansions=0)


class ParetoTest(unittest.TestCase):
    def test_the_front_is_that_of_the_program(self):
        front = hlc.pareto_front("paper", FROM, TO, points=4)
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "front.csv"
            subprocess.run([BUILD / "bin" / "pareto_front", hlc.data_folder() / "automata" / "paper.yaml", "--from", "0",
                            "0", "--to", "0.7", "0", "--points", "4", "--out", table], check=True, capture_output=True)
            with table.open() as file:
                rows = list(csv.DictReader(file))
        expected = [[float(row["J1"]), float(row["J2"])] for row in rows]
        np.testing.assert_array_equal(front.objectives, expected)
        self.assertEqual(rows[front.knee]["knee"], "1")

    def test_our_criterion_written_in_python_gives_our_front(self):
        ours = hlc.pareto_front("paper", FROM, TO, points=3)
        own = hlc.pareto_front("paper", FROM, TO, criteria=["J1", effort()], points=3)
        np.testing.assert_allclose(own.objectives, ours.objectives, rtol=1e-6)

    def test_a_cost_that_raises_passes_its_own_exception(self):
        def broken(x, u):
            return 1.0 / 0.0

        for part in ("value", "gradient"):
            with self.subTest(part=part):
                try:
                    hlc.pareto_front("paper", FROM, TO, criteria=["J1", effort(**{part: broken})], points=3)
                except ZeroDivisionError as error:  # assertRaises drops the traceback
                    names = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
                self.assertIn("broken", names)

    def test_nonsense_of_a_cost_is_named(self):
        cases = [({"value": lambda x, u: float("nan")}, "value of a Cost is nan, must be finite"),
                 ({"value": lambda x, u: None}, "value of a Cost is None, must be a number"),
                 ({"value": lambda x, u: "much"}, "value of a Cost is 'much', must be a number"),
                 ({"value": lambda x, u: 10**400}, "value of a Cost is 1000.*, must be a number"),
                 ({"gradient": lambda x, u: (np.zeros(4), u)}, r"gradient of a Cost is \(array.*, must be two arrays"),
                 ({"gradient": lambda x, u: ("steep", u)}, r"gradient of a Cost is \('steep', .*, must be two arrays"),
                 ({"gradient": lambda x, u: ([[1], [2, 3]], u)}, r"gradient of a Cost is \(\[\[1.*, must be two"),
                 ({"gradient": lambda x, u: 3}, "gradient of a Cost is 3, must be two arrays")]
        for parts, message in cases:
            with self.subTest(message=message), self.assertRaisesRegex(hlc.Error, message):
                hlc.pareto_front("paper", FROM, TO, criteria=["J1", effort(**parts)], points=3)

    def test_bad_arguments_are_named(self):
        cases = [({"criteria": ["J1"]}, "criteria"), ({"criteria": ["J1", "J1"]}, "criteria"),
                 ({"criteria": ["J1", "J9"]}, "J9"), ({"points": 1}, "points = 1"), ({"duration_s": 0.0}, "duration_s"),
                 ({"to_trim": (99.0, 0.0)}, "to_trim")]
        for arguments, message in cases:
            with self.subTest(**arguments), self.assertRaisesRegex(hlc.Error, message):
                hlc.pareto_front(**{"configuration": "paper", "from_trim": FROM, "to_trim": TO, **arguments})
