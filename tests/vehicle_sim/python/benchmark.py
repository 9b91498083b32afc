"""Prints the figures of vehicle_sim/python/README.md, as ratios where two things are compared.

usage: PYTHONPATH=build/release/python python3 tests/vehicle_sim/python/benchmark.py build/release [SECONDS]
SECONDS: for which 1000 environments are stepped; default 60
"""

import os
import re
import statistics
import subprocess
import sys
import time

import numpy as np

import hlc

REPEATS = 40


def duration_s(call):
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


def resident_mb():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def compare(one, other):
    """Ratio of the medians, measured in turn."""
    pairs = [(one(), other()) for _ in range(REPEATS)]
    return statistics.median(a for a, b in pairs) / statistics.median(b for a, b in pairs)


def step_rate(environments, seconds):
    """Car-steps per second with random actions."""
    shape = (environments.num_environments, environments.num_cars)
    actions = np.random.default_rng(1).integers(environments.num_actions, size=(100, *shape))
    environments.reset(1)
    steps = 0
    begin = time.perf_counter()
    while time.perf_counter() - begin < seconds:
        environments.step(actions[steps % 100])
        steps += 1
    return steps * shape[0] * shape[1] / (time.perf_counter() - begin)


def main():
    build = sys.argv[1]
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 60.0
    three = hlc.load_scenario("paper_three_cars")

    def program_s():
        done = subprocess.run([f"{build}/bin/rollout", "--scenario", "paper_three_cars"], capture_output=True, text=True,
                              check=True)
        return 1e-3 * float(re.search(r"steps in ([0-9.]+) ms", done.stdout)[1])

    def ours_s():
        return duration_s(lambda: hlc.rollout(three))

    def own_rule_s():
        return duration_s(lambda: hlc.rollout(three, priorities=lambda situation: situation.vehicles))

    print(f"hlc.rollout / steps of the program rollout: {compare(ours_s, program_s):.3f}")
    print(f"own rule / ours: {compare(own_rule_s, ours_s):.3f}")
    print(f"64 environments of three cars: {step_rate(hlc.Environments(three, 64), 5.0):.0f} car-steps/s")
    many = hlc.Environments(three, 1000)
    step_rate(many, 5.0)
    before = resident_mb()
    rate = step_rate(many, seconds)
    print(f"1000 environments for {seconds:.0f} s: {rate:.0f} car-steps/s, {resident_mb() - before:+.1f} MB")


if __name__ == "__main__":
    main()
