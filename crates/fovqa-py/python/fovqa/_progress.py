"""Progress of long calls, through a callback or a bar."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

#: How long something takes, in seconds, before it gets a bar.
DELAY_S = 0.5

#: What callers may give: a function, or whether there is a bar.
Progress = bool | Callable[[int, int, str], Any]

#: What the native part calls: what is done, how many are done, and how many there are.
Told = Callable[[str, int, int], None]


class Reporter:
    """Tells a callback, or shows a bar if tqdm is installed. It is to be closed at the end."""

    def __init__(self, progress: Progress) -> None:
        self._bar: Any = None
        self._what = ""
        self.callback: Told | None = None
        if callable(progress):
            tell = progress
            self.callback = lambda what, done, total: tell(done, total, what)
        elif not isinstance(progress, bool):
            raise TypeError(f"progress is a function, True or False, not {type(progress).__name__}")
        elif progress:
            try:
                with warnings.catch_warnings():
                    # In a notebook without widgets, the bar is of text.
                    warnings.simplefilter("ignore")
                    from tqdm.auto import tqdm
            except ImportError:
                return
            self._tqdm = tqdm
            self.callback = self._show

    def _show(self, what: str, done: int, total: int) -> None:
        # A single frame needs no bar.
        if total < 2:
            return
        if self._bar is None or self._what != what:
            self._close_bar()
            self._what = what
            self._bar = self._tqdm(total=total, desc=f"fovqa: {what}", leave=False, delay=DELAY_S)
        self._bar.update(done - self._bar.n)

    def _close_bar(self) -> None:
        if self._bar is not None:
            self._bar.update(self._bar.total - self._bar.n)
            self._bar.close()
            self._bar = None

    def __enter__(self) -> Told | None:
        return self.callback

    def __exit__(self, error: type[BaseException] | None, *_: object) -> None:
        if error is not None and self._bar is not None:
            self._bar.close()
        elif self._bar is not None:
            self._close_bar()
