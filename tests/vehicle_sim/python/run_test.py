"""Runs: the programs' hash, threads, forks, tables."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import hlc

BUILD = Path(os.environ["HLC_BUILD"])
MOST_RUNS = 300


def program(name, *arguments):
    return subprocess.run([BUILD / "bin" / name, *map(str, arguments)], capture_output=True, text=True, check=False)


class RunTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.three = hlc.load_scenario("paper_three_cars", steps=30)
        cls.driven = hlc.drive(cls.three)

    def test_a_run_has_the_hash_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            sweep = Path(folder) / "sweep.yaml"
            scenario = hlc.data_folder().resolve() / "scenarios" / "paper_three_cars.yaml"
            sweep.write_text(f"scenarios: [{scenario}]\nsubgraphs: [B]\nstarts: 1\nsteps: 30\n"
                             "settings:\n  coordination: [cooperative]\n")
            done = program("evaluate", "--sweep", sweep, "--out", Path(folder) / "out")
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = (Path(folder) / "out" / "runs.jsonl").read_text().splitlines()
            hashes = [row["trace_sha256"] for row in map(json.loads, rows) if "trace_sha256" in row]
        self.assertEqual(hashes, [self.driven.trace_sha256])

    def test_runs_in_two_threads_are_the_same_as_one_after_the_other(self):
        found = {}
        threads = [threading.Thread(target=lambda i=i: found.update({i: hlc.drive(self.three).trace_sha256}))
                   for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, {0: self.driven.trace_sha256, 1: self.driven.trace_sha256})

    def test_the_lock_is_released_while_driving(self):
        # With so long an interval a thread gets on only where the other one releases the lock itself.
        interval = sys.getswitchinterval()
        self.addCleanup(sys.setswitchinterval, interval)
        for run in (hlc.drive, hlc.rollout):
            turns = [0]
            during = []

            def drive(run=run, turns=turns, during=during):
                before = turns[0]
                for _ in range(MOST_RUNS):  # a busy machine may let none of the first ones be interrupted
                    run(self.three)
                    if turns[0] > before:
                        break
                during.append(turns[0] - before)

            sys.setswitchinterval(60.0)
            thread = threading.Thread(target=drive)
            thread.start()
            while thread.is_alive():
                turns[0] += 1
                time.sleep(0)  # no wait: it hands the lock over, once
            thread.join()
            sys.setswitchinterval(interval)
            self.assertGreater(during[0], 0)

    def test_signals_are_handled_once_per_step(self):
        # The timer is shorter than a step, so that each check finds a signal: one check in 16 steps would handle 4.
        handled = []
        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, lambda *_: handled.append(1)))
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0.0)
        crowd = hlc.load_scenario("circle", cars=8, steps=60)
        for run in (hlc.drive, hlc.rollout):
            signal.setitimer(signal.ITIMER_REAL, 1e-4, 1e-4)
            before = len(handled)
            run(crowd)
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            self.assertGreater(len(handled) - before, 30)

    def test_an_interrupt_ends_a_run(self):
        def interrupt(*_):
            raise KeyboardInterrupt

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, interrupt))
        for run in (hlc.drive, hlc.rollout):
            signal.setitimer(signal.ITIMER_REAL, 0.01)
            with self.assertRaises(KeyboardInterrupt):
                for _ in range(MOST_RUNS):
                    run(self.three)

    def test_arrays_have_a_row_per_step_and_a_column_per_vehicle(self):
        self.assertEqual(self.driven.planned.shape, (30, 3, 3))
        self.assertEqual(self.driven.vehicles, (1, 2, 3))
        self.assertTrue(np.isfinite(self.driven.driven).all())
        self.assertLess(np.linalg.norm(self.driven.planned[..., :2] - self.driven.driven[..., :2], axis=2).max(), 0.05)
        for i, vehicle in enumerate(self.three.vehicles):
            np.testing.assert_allclose(self.driven.planned[0, i], vehicle.start, atol=1e-9)

    def test_tables_hold_what_the_arrays_hold(self):
        steps = self.driven.steps
        self.assertEqual(len(steps), 90)
        blue = steps[steps.vehicle == 2]
        np.testing.assert_array_equal(blue.planned_x_m, self.driven.planned[:, 1, 0])
        self.assertIn("planned", set(steps.status))
        trajectories = self.driven.trajectories
        at_start = trajectories[(trajectories.vehicle == 2) & (trajectories.t_s == 0.0)]
        np.testing.assert_array_equal(at_start[["x_m", "y_m"]].to_numpy()[0], self.driven.driven[0, 1, :2])

    def test_a_rollout_is_repeated_and_has_no_driven_poses(self):
        first = hlc.rollout(self.three)
        self.assertEqual(first.trace_sha256, hlc.rollout(self.three).trace_sha256)
        self.assertTrue(np.isnan(first.driven).all())
        np.testing.assert_allclose(first.planned[:, :, :2], self.driven.planned[:, :, :2], atol=0.2)
        self.assertTrue(first.trajectories.empty)

    def test_noise_changes_the_run_and_its_seed_repeats_it(self):
        noisy = hlc.drive(self.three, noise_seed=7)
        self.assertNotEqual(noisy.trace_sha256, self.driven.trace_sha256)
        self.assertEqual(noisy.trace_sha256, hlc.drive(self.three, noise_seed=7).trace_sha256)

    def test_a_replay_is_the_same_and_a_fork_differs_from_its_step_on(self):
        self.assertEqual(hlc.replay(self.driven).trace_sha256, self.driven.trace_sha256)
        fork = hlc.replay(self.driven, forks=[hlc.Fork(10, ["speed=1:0.4"])])
        np.testing.assert_array_equal(fork.planned[:11], self.driven.planned[:11])
        self.assertFalse(np.array_equal(fork.planned, self.driven.planned))

    def test_the_folder_of_a_run_is_driven_again_by_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            own = folder / "own"
            own.mkdir()
            automaton = own / "own_automaton.yaml"
            automaton.write_text((hlc.data_folder() / "automata" / "paper.yaml").read_text())
            three = hlc.load_scenario("paper_three_cars", steps=30,
                                      values={"reference_speed_mps": 0.6, "automaton": str(automaton)})
            run = hlc.drive(three, noise_seed=3, out=folder / "run")
            fork = hlc.replay(run, forks=[hlc.Fork(10, ["speed=1:0.4"])], out=folder / "fork")
            automaton.unlink()  # the copy counts
            self.assertEqual(run.summary["trace_sha256"], run.trace_sha256)
            self.assertEqual(run.summary["vehicles"][1]["driven_speed_mps"]["max"],
                             max(run.steps[run.steps.vehicle == 2].driven_speed_mps))
            self.assertTrue((folder / "run" / "run.html").read_text().startswith("<!doctype html>"))
            again = program("replay", folder / "run")
            self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
            self.assertIn(run.trace_sha256, again.stdout)
            again = program("replay", folder / "fork")
            self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
            self.assertIn(fork.trace_sha256, again.stdout)
            self.assertNotEqual(fork.trace_sha256, run.trace_sha256)

    def test_a_folder_with_a_rule_in_python_is_read_by_no_program(self):
        with tempfile.TemporaryDirectory() as folder:
            run = hlc.drive(self.three, priorities=lambda situation: reversed(situation.vehicles), out=folder)
            self.assertEqual(run.summary["priorities"], "python")
            self.assertTrue((Path(folder) / "run.html").is_file())
            for arguments in (("replay", folder), ("compare", folder, folder), ("summarize", folder)):
                again = program(*arguments)
                self.assertEqual(again.returncode, 2, again.stdout)
                self.assertIn("priorities are a rule in Python, which only Python can drive", again.stderr)

    def test_the_folder_of_a_run_that_fails_is_empty(self):
        def fails(_):
            raise KeyError("mine")

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(KeyError):
                hlc.drive(self.three, priorities=fails, out=folder)
            self.assertEqual(os.listdir(folder), [])

    def test_a_track_that_was_changed_is_that_of_the_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            track = Path(folder) / "own_track.csv"
            track.write_text("t_s,x_m,y_m\n0,1.3,2.9\n100,1.3,2.9\n")
            guest = {"id": 30, "start": {"x_m": 1.3, "y_m": 2.9, "heading_rad": 0.0}, "drive": "track",
                     "track": str(track), "limits": {"speed_mps": 1.0, "acceleration_mps2": 1.5,
                                                     "deceleration_mps2": 3.0, "curvature_per_m": 4.0}}
            run = hlc.drive(hlc.load_scenario("lab_guest", cars=3, steps=10, values={"guests": [guest]}),
                            out=Path(folder) / "run")
            track.unlink()
            again = program("replay", Path(folder) / "run")
            self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
            self.assertIn(run.trace_sha256, again.stdout)

    def test_arguments_of_a_wrong_type_are_named(self):
        cases = [("scenario = 'circle', must be one of load_scenario", lambda: hlc.drive("circle")),
                 ("scenario = None, must be", lambda: hlc.rollout(None)),
                 ("scenario = 'circle', must be", lambda: hlc.Environments("circle", 2)),
                 ("run = 'my_run', must be one of drive", lambda: hlc.replay("my_run")),
                 ("forks = 'priorities=3', must be a list", lambda: hlc.drive(self.three, forks="priorities=3")),
                 ("forks: entry = 3, must be", lambda: hlc.drive(self.three, forks=[3])),
                 ("Fork.changes = 'speed=1:0.4', must be a list",
                  lambda: hlc.drive(self.three, forks=[hlc.Fork(5, "speed=1:0.4")])),
                 ("priorities = 'random', must be a function", lambda: hlc.drive(self.three, priorities="random")),
                 ("priorities = .*, must be the name of one of our strategies",
                  lambda: hlc.load_scenario("circle", priorities=lambda situation: situation.vehicles)),
                 ("subgraph = 3, must be a name", lambda: hlc.load_scenario("circle", subgraph=3)),
                 ("values = .1., must be a dict", lambda: hlc.load_scenario("circle", values=[1])),
                 ("scenarios = None, must be a path", lambda: hlc.load_scenario(None)),
                 ("out = 5, must be a path", lambda: hlc.drive(self.three, out=5))]
        for message, call in cases:
            with self.subTest(message=message), self.assertRaisesRegex(hlc.Error, message):
                call()

    def test_a_folder_with_files_is_refused_and_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            note = Path(folder) / "note.txt"
            note.write_text("mine")
            for out in (folder, note, note / "below"):
                refused = self.assertRaisesRegex(hlc.Error, f"out = {out}, must be a (new|folder that can)")
                with self.subTest(out=out), refused:
                    hlc.drive(self.three, out=out)
            self.assertEqual(note.read_text(), "mine")
        with self.assertRaisesRegex(hlc.Error, "must be one of drive"):
            _ = self.driven.summary

    def test_a_vehicle_that_is_gone_has_no_poses(self):
        fork = hlc.replay(self.driven, forks=[hlc.Fork(10, ["without=3"])])
        self.assertTrue(np.isnan(fork.planned[12:, 2]).all())
        self.assertTrue(np.isfinite(fork.planned[:10]).all())

    def test_a_named_strategy_is_that_of_the_scenario(self):
        other = hlc.load_scenario("paper_three_cars", steps=5, priorities="colouring")
        self.assertEqual(other.priorities, "colouring")
        self.assertEqual(hlc.drive(other).planned.shape, (5, 3, 3))
