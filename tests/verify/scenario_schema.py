"""Checks the shipped scenarios against launch_scripts/scenarios/schema.json, and that the schema rejects faulty ones.

The schema is for editors. That it has the keys of the program's own reader is checked by
tests/planner/scenario/schema_test.cpp.
"""

import copy
import json
import pathlib
import sys

import jsonschema
import yaml

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "launch_scripts" / "scenarios"


def accepted_by(schema):
    validator = jsonschema.Draft7Validator(schema)
    return lambda scenario: next(iter(validator.iter_errors(scenario)), None)


def containers(value):
    """All maps and lists within a value, itself included."""
    yield value
    for one in value.values() if isinstance(value, dict) else value:
        if isinstance(one, (dict, list)):
            yield from containers(one)


def faulty(scenario):
    """Copies of the scenario with one fault each: a map with an unknown key, or a value of another type."""
    for place, _ in enumerate(containers(scenario)):
        changed = copy.deepcopy(scenario)
        container = list(containers(changed))[place]
        if isinstance(container, dict):
            container["unknown key"] = True
        else:
            container.append({"unknown key": {}})
        yield changed


def main():
    schema = json.loads((SCENARIOS / "schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    error_of = accepted_by(schema)
    files = sorted(SCENARIOS.glob("*.yaml"))
    faults = 0
    for file in files:
        scenario = yaml.safe_load(file.read_text())
        if error := error_of(scenario):
            sys.exit(f"{file}: {error.json_path}: {error.message}")
        for changed in faulty(scenario):
            faults += 1
            if not error_of(changed):
                sys.exit(f"{file}: accepted with fault {faults}: {changed}")
    print(f"schema: {len(files)} scenarios accepted, {faults} faulty ones rejected")


if __name__ == "__main__":
    main()
