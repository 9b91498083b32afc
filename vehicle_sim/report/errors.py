"""Invalid input, reported in one line."""


class InputError(Exception):
    """Invalid input: file, place, value and what is allowed (exit code 2)."""
