"""Own priority rules, and what becomes of their errors."""

import traceback
import unittest

import numpy as np

import hlc


class RuleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.three = hlc.load_scenario("paper_three_cars", steps=25)

    def test_the_constant_rule_in_python_gives_the_same_run(self):
        own = hlc.drive(self.three, priorities=lambda situation: sorted(situation.vehicles))
        self.assertEqual(own.trace_sha256, hlc.drive(self.three).trace_sha256)

    def test_another_order_gives_other_levels(self):
        own = hlc.drive(self.three, priorities=lambda situation: sorted(situation.vehicles, reverse=True))
        ours = hlc.drive(self.three)
        self.assertNotEqual(own.trace_sha256, ours.trace_sha256)
        coupled = ours.level.max(axis=1) > 0
        self.assertTrue(coupled.any())
        self.assertFalse(np.array_equal(own.level, ours.level))

    def test_the_situation_is_that_of_the_run(self):
        seen = []

        def rule(situation):
            seen.append(situation)
            return situation.vehicles

        run = hlc.rollout(self.three, priorities=rule)
        first = seen[0]
        self.assertEqual(len(first.poses), len(first.vehicles))
        self.assertEqual(set(first.coupled), set(first.vehicles))
        for vehicle, others in first.coupled.items():
            for other in others:
                self.assertIn(vehicle, first.coupled[other])
        start = [one.start for one in self.three.vehicles if one.id == first.vehicles[0]][0]
        np.testing.assert_allclose(first.poses[0], start, atol=1e-9)
        last = seen[-1]
        index = run.vehicles.index(last.vehicles[0])
        self.assertLess(np.linalg.norm(last.poses[0, :2] - run.planned[-1, index, :2]), 0.3)
        self.assertTrue((last.speeds_mps >= 0.0).all())

    def test_a_rule_that_raises_ends_its_run_alone_with_its_traceback(self):
        def broken(situation):
            return [situation.no_such_name]

        try:
            hlc.drive(self.three, priorities=broken)
        except AttributeError as error:  # assertRaises drops the traceback
            names = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertIn("broken", names)
        self.assertEqual(hlc.drive(self.three).planned.shape, (25, 3, 3))

    def test_a_nonsense_order_is_refused_with_the_vehicles(self):
        for order in ([1, 1], [99], ["1"], 3, "12", None, [1.0], [-1], [257], [2**70], [-(2**70)], {1: 2, 9: 1}):
            with self.subTest(order=order), self.assertRaisesRegex(
                    hlc.Error, "priorities: the function returned .*, must be a sequence of some of the vehicles .*"):
                hlc.rollout(self.three, priorities=lambda situation, order=order: order)

    def test_a_run_in_a_rule_has_its_own_rule(self):
        inner = hlc.rollout(self.three, steps=3)
        found = []

        def rule(situation):
            if not found:
                found.append(hlc.rollout(self.three, steps=3, priorities=lambda s: s.vehicles).trace_sha256)
            return situation.vehicles

        hlc.rollout(self.three, steps=3, priorities=rule)
        self.assertEqual(found, [inner.trace_sha256])
