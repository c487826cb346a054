"""Exceptions and warnings, with the words of the command."""

from __future__ import annotations


class FovqaError(Exception):
    """Something went wrong.

    Parameters
    ----------
    complaints
        What is wrong and where, each with how to mend it.
    """

    def __init__(self, complaints: list[tuple[str, str]] | str) -> None:
        if isinstance(complaints, str):
            complaints = [(complaints, "")]
        super().__init__(complaints)
        self.complaints = complaints

    @property
    def message(self) -> str:
        """What is wrong, and where."""
        return "; ".join(message for message, _ in self.complaints)

    @property
    def help(self) -> str:
        """How to mend it; may be empty."""
        return "; ".join(help for _, help in self.complaints if help)

    def __str__(self) -> str:
        lines = []
        for message, help in self.complaints:
            lines.append(message)
            if help:
                lines.append(f"  help: {help}")
        return "\n".join(lines)


class RequestError(FovqaError, ValueError):
    """The request is not possible: an argument is wrong, or arguments do not go together."""


class ExperimentError(RequestError):
    """A file (an experiment, curves or a study) has mistakes. All that can be found are named."""


class InputError(FovqaError, ValueError):
    """An input is missing, cannot be read or does not fit, or an output cannot be written."""


class FovqaWarning(UserWarning):
    """Something that the user should know, such as a likely mistake."""
