"""The README's code and the notebooks run as they stand."""

import contextlib
import io
import json
import os
import re
import tempfile
import unittest
from pathlib import Path

import matplotlib.pyplot as plt

PACKAGE = Path(__file__).resolve().parents[3] / "vehicle_sim" / "python"


@contextlib.contextmanager
def in_new_folder():
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(before)


def execute(cells, name):
    """One after the other with common variables. Returns what they printed."""
    variables = {"__name__": "__main__"}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        for number, cell in enumerate(cells, 1):
            exec(compile(cell, f"{name}, block {number}", "exec"), variables)  # pylint: disable=exec-used
    plt.close("all")
    return printed.getvalue()


class DocumentTest(unittest.TestCase):
    def test_every_block_of_the_readme_runs(self):
        blocks = re.findall(r"```python\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)
        self.assertGreater(len(blocks), 5)
        with in_new_folder() as folder:
            printed = execute(blocks, "README.md")
            self.assertEqual({file.name for file in folder.glob("*.svg")}, {"first_run.svg", "own_rule.svg", "front.svg"})
        self.assertIn("(60, 3, 3)", printed)
        shown = re.findall(r"```text\n(.*?)```", (PACKAGE / "README.md").read_text(), re.DOTALL)
        self.assertGreater(len(shown), 1)
        for text in shown:
            self.assertIn(text, printed)
        self.assertIn("horizon_steps = 99, must be", printed)

    def test_every_notebook_runs(self):
        files = sorted((PACKAGE / "notebooks").glob("*.ipynb"))
        self.assertEqual(len(files), 4)
        for file in files:
            with self.subTest(file=file.name), in_new_folder():
                cells = json.loads(file.read_text())["cells"]
                printed = execute(["".join(one["source"]) for one in cells if one["cell_type"] == "code"], file.name)
                if file.stem == "what_if":  # every fork is another run
                    self.assertEqual(printed.count("after: 0.000 m"), 1, printed)
