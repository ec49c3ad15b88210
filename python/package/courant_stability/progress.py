"""A bar for long work, where tqdm is installed."""

from __future__ import annotations

import contextlib
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import Optional, Union

#: ``True`` shows a bar where tqdm is installed, ``None`` only where somebody looks at a terminal or a notebook; or a function of what is
#: done and of what there is to do.
Progress = Union[bool, None, Callable[[int, int], object]]


@contextlib.contextmanager
def reporting(progress: Progress, name: str) -> Iterator[Optional[Callable[[int, int], object]]]:
    """What the native half is to call."""
    if callable(progress):
        yield progress
        return
    watched = "ipykernel" in sys.modules or sys.stderr.isatty()
    if progress is False or (progress is None and not watched):
        yield None
        return
    try:
        with warnings.catch_warnings():
            # A notebook without widgets gets the bar of a terminal: no news to whoever reads it.
            warnings.simplefilter("ignore")
            from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    # What is done at once needs no bar.
    with tqdm(desc=name, leave=False, delay=0.5) as bar:

        def report(done: int, of: int) -> None:
            bar.total = of
            bar.update(done - bar.n)

        yield report
