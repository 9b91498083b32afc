"""Flags of the package's programs."""

import argparse

BAD_INPUT, INTERRUPTED = 2, 130  # an output that cannot be written is bad input, too


class Parser(argparse.ArgumentParser):
    """Takes whole names only; an error is one line."""

    def __init__(self, prog: str, description: str, epilog: str) -> None:
        super().__init__(prog=prog, description=description, epilog=epilog, allow_abbrev=False,
                         formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message: str) -> None:
        self.exit(BAD_INPUT, f"{self.prog}: {message}, see --help\n")
