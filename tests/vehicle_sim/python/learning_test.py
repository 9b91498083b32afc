"""Environments for learners."""

import unittest

import numpy as np

import hlc


def pursuit(trims, observation, permitted):
    """The permitted trim that drives on and whose steering leads nearest to the route 0.4 m ahead."""
    ahead = observation[4:6]
    steering = np.arctan(0.15 * 2.0 * ahead[1] / (ahead @ ahead))
    return int(np.argmin(np.abs(trims[:, 1] - steering) + 9.0 * ~permitted + 0.2 * (trims[:, 0] == 0.0)))


class LearningTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.three = hlc.load_scenario("paper_three_cars")

    def drive(self, environments, steps, seed=5, choose=None):
        """Random permitted actions."""
        random = np.random.default_rng(seed)
        result = environments.reset(seed)
        results = [result]
        for _ in range(steps):
            weights = random.random(result.permitted.shape) * result.permitted
            result = environments.step(weights.argmax(axis=-1))
            results.append(result)
        return results

    def test_shapes_are_as_documented(self):
        environments = hlc.Environments(self.three, 4)
        result = environments.reset(1)
        self.assertEqual(result.observations.shape, (4, 3, 20))
        self.assertEqual(result.permitted.shape, (4, 3, 12))
        self.assertEqual(result.rewards.shape, (4, 3))
        self.assertEqual(result.terminated.dtype, np.bool_)
        self.assertEqual(environments.poses.shape, (4, 3, 3))

    def test_the_same_seed_repeats_everything_and_environments_differ(self):
        first = self.drive(hlc.Environments(self.three, 3), 40)
        again = self.drive(hlc.Environments(self.three, 3), 40)
        for one, other in zip(first, again):
            for a, b in zip(one, other):
                np.testing.assert_array_equal(a, b)
        self.assertFalse(np.array_equal(first[0].observations[0], first[0].observations[1]))

    def test_an_environment_of_many_is_that_environment_alone(self):
        many, alone = hlc.Environments(self.three, 5), hlc.Environments(self.three, 1)
        actions = np.random.default_rng(3).integers(12, size=(30, 5, 3))
        many.reset(10)
        alone.reset(12)
        for one in actions:
            np.testing.assert_array_equal(many.step(one).observations[2], alone.step(one[2:3]).observations[0])

    def test_who_stands_is_never_terminated_and_pays_for_the_way_left(self):
        environments = hlc.Environments(self.three, 2, episode_steps=10)
        before = environments.reset(1)
        standing = np.full((2, 3), int(np.argmin(self.three.trims[:, 0])))
        result = environments.step(standing)
        self.assertFalse(result.terminated.any())
        np.testing.assert_array_equal(result.observations, before.observations)
        np.testing.assert_allclose(result.rewards, -(0.16**2), rtol=0.05)

    def test_an_episode_is_truncated_after_its_steps_and_begins_again(self):
        environments = hlc.Environments(self.three, 1, episode_steps=3)
        begin = environments.reset(1).observations
        standing = np.full((1, 3), int(np.argmin(self.three.trims[:, 0])))
        truncated = [environments.step(standing) for _ in range(3)]
        self.assertEqual([bool(one.truncated[0]) for one in truncated], [False, False, True])
        self.assertFalse(np.array_equal(truncated[-1].observations, begin))

    def test_the_final_observations_are_those_before_the_next_episode(self):
        circle = hlc.load_scenario("circle", cars=2)
        long, short = (hlc.Environments(circle, 2, random_starts=False, episode_steps=steps) for steps in (9, 3))
        begin = short.reset(1)
        long.reset(1)
        np.testing.assert_array_equal(begin.final_observations, begin.observations)
        result = begin
        for step in range(3):
            actions = np.array([[pursuit(circle.trims, *car) for car in zip(*cars)]
                                for cars in zip(result.observations, result.permitted)])
            result, goes_on = short.step(actions), long.step(actions)
            self.assertFalse(goes_on.terminated.any())
            np.testing.assert_array_equal(result.final_observations, goes_on.observations)
            self.assertEqual(np.array_equal(result.observations, result.final_observations), step < 2)

    def test_who_drives_straight_on_leaves_its_lanes(self):
        environments = hlc.Environments(self.three, 8)
        environments.reset(1)
        trims = self.three.trims
        fast = int(np.argmax(np.where(trims[:, 1] == 0.0, trims[:, 0], -1.0)))
        rewards = [environments.step(np.full((8, 3), fast)) for _ in range(40)]
        ends = [one.rewards[one.terminated] for one in rewards if one.terminated.any()]
        self.assertGreater(len(ends), 0)
        self.assertTrue((np.concatenate(ends) <= -1.0).all())

    def test_cars_that_meet_are_both_terminated(self):
        circle = hlc.load_scenario("circle", cars=2)
        environments = hlc.Environments(circle, 1, random_starts=False, episode_steps=1000)
        result = environments.reset(1)
        for _ in range(300):
            following = pursuit(circle.trims, result.observations[0, 1], result.permitted[0, 1])
            standing = int(np.argmin(circle.trims[:, 0]))
            result = environments.step(np.array([[standing, following]]))
            if result.terminated.any():
                break
        self.assertEqual(result.terminated.tolist(), [[True, True]])

    def test_many_cars_find_room(self):
        environments = hlc.Environments(hlc.load_scenario("lab_cars", cars=20), 2)
        result = environments.reset(1)
        self.assertEqual(result.observations.shape, (2, 20, 105))
        self.assertFalse(result.terminated.any())

    def test_what_a_permitted_action_leads_to_is_that_trim(self):
        environments = hlc.Environments(self.three, 16, episode_steps=1000)
        result = environments.reset(1)
        random = np.random.default_rng(1)
        checked = 0
        for _ in range(50):
            weights = random.random(result.permitted.shape) * result.permitted
            actions = weights.argmax(axis=-1)
            result = environments.step(actions)
            goes_on = ~result.terminated.any(axis=1)
            trims = self.three.trims[actions[goes_on]]
            np.testing.assert_allclose(result.observations[goes_on][..., :2], trims, atol=1e-6)
            checked += int(goes_on.sum())
        self.assertGreater(checked, 100)

    def test_bad_arguments_are_named(self):
        environments = hlc.Environments(self.three, 2)
        environments.reset(1)
        for actions, message in ((np.zeros((3, 2), int), r"shape \(2, 3\)"), (np.full((2, 3), 12), "12, must be 0 ... 11"),
                                 (np.full((2, 3), -1), "-1, must be")):
            with self.assertRaisesRegex(hlc.Error, message):
                environments.step(actions)
        with self.assertRaisesRegex(hlc.Error, "num_environments = 0"):
            hlc.Environments(self.three, 0)

    def test_a_step_before_the_first_reset_is_refused(self):
        with self.assertRaisesRegex(hlc.Error, "reset"):
            hlc.Environments(self.three, 1).step(np.zeros((1, 3), int))


class ParallelEnvTest(unittest.TestCase):
    def setUp(self):
        self.env = hlc.ParallelEnv(hlc.load_scenario("paper_three_cars"), episode_steps=20)

    def test_an_episode_in_the_parallel_interface(self):
        observations, infos = self.env.reset(seed=3)
        self.assertEqual(self.env.agents, ["red", "blue", "green"])
        steps = 0
        while self.env.agents:
            actions = {a: self.env.action_space(a).sample(infos[a]["action_mask"]) for a in self.env.agents}
            observations, rewards, terminations, truncations, infos = self.env.step(actions)
            for one in (observations, rewards, terminations, truncations, infos):
                self.assertEqual(set(one), {"red", "blue", "green"})
            for agent, observation in observations.items():
                self.assertTrue(self.env.observation_space(agent).contains(observation))
            steps += 1
        self.assertTrue(any(terminations.values()) or all(truncations.values()))
        self.assertLessEqual(steps, 20)
        with self.assertRaisesRegex(hlc.Error, "must be reset"):
            self.env.step({})

    def test_the_last_observations_of_an_episode_are_those_of_its_end(self):
        scenario = hlc.load_scenario("paper_three_cars")
        env = hlc.ParallelEnv(scenario, episode_steps=1)
        begin, infos = env.reset(seed=3)
        actions = {a: pursuit(scenario.trims, begin[a], infos[a]["action_mask"].astype(bool)) for a in env.agents}
        last, _, _, truncations, _ = env.step(actions)
        self.assertTrue(all(truncations.values()))
        for agent, action in actions.items():
            self.assertGreater(scenario.trims[action, 0], 0.0)
            np.testing.assert_allclose(last[agent][:2], scenario.trims[action], atol=1e-6)

    def test_the_seed_repeats_an_episode(self):
        first = self.env.reset(seed=3)[0]
        other = self.env.reset()[0]
        again = self.env.reset(seed=3)[0]
        np.testing.assert_array_equal(first["red"], again["red"])
        self.assertFalse(np.array_equal(first["red"], other["red"]))

    def test_actions_of_all_agents_are_needed(self):
        self.env.reset(seed=3)
        with self.assertRaisesRegex(hlc.Error, "actions: none of blue, green"):
            self.env.step({"red": 0})

    def test_pettingzoo_accepts_it(self):
        try:
            from pettingzoo.test import parallel_api_test
        except ImportError:
            self.skipTest("PettingZoo is not installed")
        parallel_api_test(self.env, num_cycles=100)
