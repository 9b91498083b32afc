"""launch_scripts/PROGRAMS.md is what its script writes."""
import unittest

import programs_page


class ProgramsPage(unittest.TestCase):
    def test_is_up_to_date(self):
        self.assertTrue(programs_page.PAGE.read_text(encoding="utf-8") == programs_page.page(),
                        "out of date: launch_scripts/programs_page.py writes it")


if __name__ == "__main__":
    unittest.main()
