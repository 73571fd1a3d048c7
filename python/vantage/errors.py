# SPDX-License-Identifier: MIT
"""What can go wrong. Every message is one sentence that says what to do.

Wrong types of arguments raise TypeError, Ctrl-C raises KeyboardInterrupt, and what a progress
callback raises ends the call that it was given to.
"""

from __future__ import annotations


class Error(Exception):
    """Root of all exceptions of this package."""


class InvalidInput(Error, ValueError):
    """An argument or option is outside its range, or arrays do not describe a model."""


class FormatError(Error, ValueError):
    """A file is not what its format demands, or of a format that is not read."""


class IoError(Error, OSError):
    """A file cannot be opened or read; `errno` says why where the system told."""

    def __init__(self, number: int, message: str) -> None:
        super().__init__(number, message)
        self.message = message

    def __str__(self) -> str:
        return self.message


class MissingFileError(IoError, FileNotFoundError):
    """There is no file of that name."""


class SolverError(Error, ArithmeticError):
    """A linear system could not be solved by any means."""
