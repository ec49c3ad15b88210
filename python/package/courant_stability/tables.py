"""Limits of many schemes at many values of their parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from .blocks import limits_block
from .exact import ExactLike, exact_text
from .limit import Limit
from .progress import Progress, reporting
from .subject import Scheme, scheme as named

EVIDENCE: tuple[str, ...] = tuple(_native.EVIDENCE)
CAUSES: tuple[str, ...] = tuple(_native.CAUSES)


@dataclass(frozen=True)
class LimitsTable:
    """Limits as arrays: the axes of the schemes first, then those of the parameters.

    Attributes
    ----------
    data : ndarray
        Of `blocks.limit_dtype`.
    limits : ndarray of Limit or None
        Everything about each.
    schemes : ndarray of Scheme
    parameters : dict of ndarray
        Broadcast together.
    """

    data: np.ndarray
    schemes: np.ndarray = field(repr=False)
    parameters: dict[str, np.ndarray] = field(repr=False)
    limits: np.ndarray | None = field(repr=False, default=None)

    @property
    def value(self) -> np.ndarray:
        """The limits as floats, none above the limit."""
        return np.asarray(self.data["value"])

    @property
    def evidence(self) -> np.ndarray:
        """What stands behind each, in words."""
        return np.asarray(np.array(EVIDENCE)[self.data["evidence"]])

    @property
    def cause(self) -> np.ndarray:
        """Which wave binds, in words; empty where none does."""
        return np.asarray(np.array([*CAUSES, ""])[self.data["cause"]])

    @property
    def shape(self) -> tuple[int, ...]:
        return self.data.shape

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        return np.array(self.value, dtype=dtype)

    def _repr_html_(self) -> str:
        if self.data.ndim > 2 or self.data.size > 10_000:
            return f"<p>{self.data.size} limits, {self.shape}</p>"
        rows = self.limits if self.limits is not None else self.value
        rows = np.atleast_2d(rows)

        def cell(limit: Any) -> str:
            if not isinstance(limit, Limit):
                return f"<td>{limit:.6g}</td>"
            return f"<td title='{limit!r}'>{float(limit):.6g}</td>"

        def name(of: Any) -> str:
            return f"<th>{of.title}</th>" if isinstance(of, Scheme) else ""

        heads: Any = self.schemes[:, 0] if self.schemes.ndim == 2 and self.schemes.shape == rows.shape else []
        lines = []
        for index, row in enumerate(rows):
            head = name(heads[index]) if len(heads) else ""
            lines.append("<tr>" + head + "".join(cell(one) for one in row) + "</tr>")
        return "<table>" + "".join(lines) + "</table>"


def limits_table(
    schemes: Any,
    *,
    growth: ExactLike = 0,
    max: ExactLike | None = None,
    budget: int | None = None,
    exact: bool = True,
    progress: Progress = None,
    **parameters: ArrayLike,
) -> LimitsTable:
    """The limit of every scheme at every value of its parameters.

    Parameters
    ----------
    schemes : Scheme or str or nested sequence of them
        The first axes of the table.
    growth, max, budget
        As of `Scheme.limit`.
    exact : bool
        Whether to keep everything about each limit; numbers alone are a tenth of the work for a table of millions.
    **parameters
        Arrays that are broadcast together: the last axes. ``ratio`` is that of a kernel. Floats stand for their shortest decimals.

    Returns
    -------
    LimitsTable

    Examples
    --------
    >>> import numpy as np
    >>> import courant_stability as courant
    >>> table = courant.limits_table(
    ...     [[courant.lines(space, integrator) for integrator in ("rk3-ssp", "rk4")] for space in ("upwind-1", "upwind-3")]
    ... )
    >>> table.value.round(5).tolist(), str(table.evidence[0, 0])
    ([[1.25637, 1.39265], [1.62589, 1.74527]], 'proved')
    >>> sph = courant.scheme("godunov-sph", kernel="cubic-spline", ratio=1)
    >>> [str(limit) for limit in courant.limits_table(sph, ratio=[1, 2, 3]).limits]
    ['1', '15/8', '227/81']
    """
    array = np.array(schemes, dtype=object)
    flat = [named(one) if isinstance(one, str) else one for one in array.ravel()]
    names = tuple(parameters)
    together = np.broadcast_arrays(*(np.asarray(values) for values in parameters.values())) if names else []
    shape = together[0].shape if names else ()
    blocks: list[np.ndarray] = []
    records: list[dict[str, Any]] | None = [] if exact else None
    with reporting(progress, "limits") as report:

        def told(done: int, of: int) -> None:
            if report is not None:
                report(len(blocks) * of + done, len(flat) * of)

        for one in flat:
            blocks.append(
                limits_block(
                    *together,
                    scheme=one,
                    names=names,
                    max=None if max is None else exact_text(max),
                    growth=exact_text(growth),
                    budget=budget,
                    records=records,
                    report=told,
                )
            )
    data = np.stack(blocks).reshape(array.shape + shape)
    limits: np.ndarray | None = None
    if records is not None:
        limits = np.empty(len(records), dtype=object)
        limits[:] = [Limit._of(record) for record in records]
        limits = limits.reshape(data.shape)
    kept = np.empty(len(flat), dtype=object)
    kept[:] = flat
    return LimitsTable(data, kept.reshape(array.shape), dict(zip(names, together)), limits)
