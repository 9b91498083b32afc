"""Reads run.mcap with the package mcap, and holds it against the run's other records."""

import csv
import json
import struct
import sys
from collections import Counter
from pathlib import Path

from mcap.reader import make_reader


def faults_of(run: Path) -> list[str]:
    """One line for each fault; none: the recording is whole."""
    faults: list[str] = []
    reports: Counter[tuple[int, int]] = Counter()
    cars: set[str] = set()
    count = 0
    last = 0
    with open(run / "run.mcap", "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        for schema, channel, message in reader.iter_messages():
            count += 1
            if message.log_time < last:
                faults.append(f"message {count} of {channel.topic} is earlier than the one before")
            last = message.log_time
            if schema.name == "hlc::ReportMessage":
                # After the header of 4 bytes: octet vehicle_id, padding, unsigned long long step.
                vehicle, step = struct.unpack_from("<B7xQ", message.data, 4)
                reports[vehicle, step] += 1
            elif channel.message_encoding == "json":
                content = json.loads(message.data)
                if channel.topic == "scene/cars":
                    cars.update(entity["id"] for entity in content["entities"])
    if summary is None or summary.statistics.message_count != count:
        faults.append(f"the index does not have the {count} messages")
    with open(run / "reports.csv", encoding="utf-8") as file:
        expected = Counter((int(row["id"]), int(row["step"])) for row in csv.DictReader(file))
    if reports != expected:
        faults.append(f"reports: {sum(reports.values())}, must be the {sum(expected.values())} of reports.csv")
    if cars != {f"car {vehicle}" for vehicle, _ in expected}:
        faults.append(f"scene/cars has {sorted(cars)}")
    return faults


def main() -> int:
    """Exit code 0: whole, 1: not."""
    faults = faults_of(Path(sys.argv[1]))
    for line in faults:
        print(f"messages.py: {sys.argv[1]}: {line}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
