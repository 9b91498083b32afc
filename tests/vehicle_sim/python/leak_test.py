"""What is driven again and again takes no more memory."""

import gc
import os
import sys
import unittest

import numpy as np

import hlc

PAGE = os.sysconf("SC_PAGE_SIZE")


def resident_mb():
    gc.collect()
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * PAGE / 1e6


class LeakTest(unittest.TestCase):
    def test_a_thousand_environments_keep_their_memory(self):
        environments = hlc.Environments(hlc.load_scenario("paper_three_cars"), 1000)
        actions = np.random.default_rng(1).integers(12, size=(10, 1000, 3))
        environments.reset(1)

        def step(times):
            for i in range(times):
                result = environments.step(actions[i % 10])
            return result.observations.nbytes

        size = step(20)
        before = resident_mb()
        step(200)
        # One array of each step would be 48 MB.
        self.assertLess(resident_mb() - before, 0.25 * 200 * size / 1e6)

    def test_runs_keep_neither_memory_nor_references(self):
        scenario = hlc.load_scenario("paper_three_cars", steps=10)

        def rule(situation):
            return situation.vehicles

        def broken(situation):
            raise KeyError(situation.vehicles)

        def drive(times):
            for _ in range(times):
                hlc.drive(scenario, priorities=rule)
                try:
                    hlc.rollout(scenario, priorities=broken)
                except KeyError:
                    pass

        drive(10)
        counts = sys.getrefcount(rule), sys.getrefcount(broken)
        before = resident_mb()
        drive(60)
        self.assertEqual((sys.getrefcount(rule), sys.getrefcount(broken)), counts)
        # A run's arrays are 0.2 MB.
        self.assertLess(resident_mb() - before, 4.0)
