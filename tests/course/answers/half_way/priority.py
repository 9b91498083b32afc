"""Half way to exercise 2: our rule `constant`."""


def rule(situation):
    return sorted(situation.vehicles)
