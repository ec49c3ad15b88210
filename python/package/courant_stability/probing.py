"""A program of one's own as a scheme: one time step, measured and analysed."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from .exact import ExactLike, exact_text
from .limit import Limit, StableSet
from .progress import Progress, reporting
from .subject import Scheme


class Probe:
    """What is known of a step that was measured; `probe` makes one.

    Attributes
    ----------
    equations : list of str
        The step in the language of schemes, one equation for each unknown.
    recognised : bool
        Whether all coefficients are fractions; else they are decimals within the tolerance.
    record : dict
        What ``courant probe --format json`` says, key by key.
    """

    def __init__(self, found: _native.Probe) -> None:
        self._native = found
        self.record: dict[str, Any] = json.loads(found.record())
        self.equations: list[str] = self.record["equations"]
        self.recognised: bool = self.record["recognised"]

    @property
    def scheme(self) -> Scheme:
        """The equations as a scheme: what is proved of it holds for the program as far as they are the program's."""
        return Scheme("; ".join(self.equations))

    def stable_set(self) -> StableSet:
        """All values of the parameter for which no wave grows; the evidence is ``measured``."""
        return _found(self._native.stable_set())

    def monotone_set(self) -> StableSet:
        """All values for which no coefficient is negative."""
        return _found(self._native.monotone_set())

    def limit(self) -> Limit:
        """The end of the stable values that begin at 0."""
        return self.stable_set().limit

    def check(self, value: ExactLike) -> str:
        """The verdict on a value of the parameter."""
        return str(json.loads(self._native.check(exact_text(value)))["verdict"])

    @property
    def verdicts(self) -> dict[Any, str]:
        """The verdicts on the values that were asked for; under ``None`` that on the only step there is."""
        return {row["value"]: row["verdict"] for row in self.record["rows"]}

    def __repr__(self) -> str:
        known = "; ".join(self.equations)
        known = known if len(known) <= 120 else f"{len(self.record['coefficients'])} coefficients"
        limit = f", {self.limit()!r}" if self.record["stability"] else ""
        return f"Probe({known}{limit})"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td><code>{equation}</code></td></tr>" for equation in self.equations)
        limit = f"<p>{self.limit()!r}</p>" if self.record["stability"] else f"<p>{self.verdicts}</p>"
        return f"<table>{rows}</table>{limit}"


def _found(text: str | None) -> StableSet:
    if text is None:
        raise ValueError("no coefficient depends on the parameter, or none was sought: see verdicts")
    return StableSet._of_json(text)


def probe(
    step: Callable[..., Any],
    *,
    size: int | Sequence[int] = 32,
    unknowns: str | Sequence[str] = "u",
    levels: int = 1,
    parameter: str | None = "C",
    values: Sequence[ExactLike] = (),
    fit: Sequence[ExactLike] = ("1/8", "1/4", "3/8", "1/2", "5/8", "3/4", "7/8", "1"),
    about: ArrayLike | None = None,
    tolerance: float | None = None,
    max: ExactLike = 100,
    budget: int | None = None,
    progress: Progress = None,
    **fixed: Any,
) -> Probe:
    """Measures one time step of any program and analyses what was measured.

    Parameters
    ----------
    step : callable
        ``step(state, C=…)`` returns the new level on a periodic lattice. `state` is an array of float64: the cells, with several
        unknowns an axis of them before, with several levels an axis of those, oldest first, before that. It is called in the thread of
        the caller, a few dozen times, and must keep nothing between calls.
    size : int or sequence of int
        Cells along each axis: one to three.
    unknowns : str or sequence of str
        Their names, in the order of their axis.
    levels : int
        Time levels that a step starts from.
    parameter : str or None
        The keyword whose limit is sought; with ``None`` the one step there is is judged.
    values : sequence of number
        Values of it to be judged.
    fit : sequence of number
        Values of it through which coefficients are fitted as polynomials.
    about : array_like, optional
        The state about which a step that is not linear is linearised: one number, one for each unknown, or a whole state.
    tolerance : float, optional
        How far a measured number may be wrong, as a share of the largest.
    max : number
        Look for stable values up to here.
    **fixed
        Other keywords for `step`.

    Returns
    -------
    Probe

    Raises
    ------
    ValueError
        Where the step is not linear, not the same everywhere, or no polynomial in the parameter.

    Examples
    --------
    >>> import numpy as np
    >>> import courant_stability as courant
    >>> def step(u, C):
    ...     return u - C * (u - np.roll(u, 1))
    >>> courant.probe(step, values=[0.9, 1.1])
    Probe(u[n+1,j] = C*u[n,j-1] + (1 - C)*u[n,j], Limit(C = 1, measured, long-wave))
    """
    names = [unknowns] if isinstance(unknowns, str) else list(unknowns)
    cells = [int(one) for one in np.atleast_1d(size)]
    answer_shape = tuple(([len(names)] if len(names) > 1 else []) + cells)
    state_shape = tuple(([levels] if levels > 1 else []) + list(answer_shape))

    def call(value: float, state: np.ndarray) -> np.ndarray:
        sought = {} if parameter is None else {parameter: value}
        answer = np.asarray(step(state.reshape(state_shape), **sought, **fixed), dtype=np.float64)
        if answer.shape != answer_shape:
            raise ValueError(f"the step returned an array of shape {answer.shape}; {answer_shape} is needed")
        if not np.isfinite(answer).all():
            raise ValueError("the step's answer holds NaN or infinity; about=… starts from another state than zeros")
        return np.ascontiguousarray(answer).ravel()

    base = None if about is None else np.asarray(about, dtype=float).ravel().tolist()
    with reporting(progress, "probe") as report:
        found = _native.Probe(
            call,
            names,
            cells,
            levels,
            parameter,
            [exact_text(value) for value in fit],
            [exact_text(value) for value in values],
            base,
            tolerance,
            exact_text(max),
            budget,
            report,
        )
    return Probe(found)
