# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the program and of this package."""


class VoussoirError(Exception):
    """A failure with the message of the program."""


class InputError(VoussoirError):
    """Bad input (status 2), or a directory that holds no run."""


class ComputationError(VoussoirError):
    """A failed computation (status 1)."""
