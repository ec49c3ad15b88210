"""Maps of gain and stability over a plane of two parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from .blocks import column, pack
from .exact import exact_text
from .progress import Progress, reporting
from .subject import Scheme

Axis = tuple[str, ArrayLike]


@dataclass(frozen=True)
class StabilityMap:
    """Gains over a plane, and which of its points are stable.

    Arrays are ``[x, y]``; of a map made by `courant_stability.dask` they are Dask's, and `compute` makes numbers of them.

    Attributes
    ----------
    x_name, y_name : str
        The axes.
    x, y : ndarray
        Their values.
    largest : ndarray
        ``max |z|`` over all waves.
    lowest : ndarray
        What is left of the wave that is damped most.
    stable : ndarray of bool or None
        Decided in exact arithmetic, point by point.
    limits : ndarray or None
        The limit of y for each x, of `blocks.limit_dtype`.
    """

    scheme: Scheme
    x_name: str
    x: np.ndarray
    y_name: str
    y: np.ndarray
    largest: Any
    lowest: Any
    stable: Any = None
    limits: Any = None

    @property
    def growth(self) -> Any:
        """``max |z| − 1``."""
        return self.largest - 1.0

    def compute(self, **options: Any) -> StabilityMap:
        """The same with numbers in place of Dask's arrays."""
        from dask.base import compute

        parts = compute(self.largest, self.lowest, self.stable, self.limits, **options)
        return StabilityMap(self.scheme, self.x_name, self.x, self.y_name, self.y, *parts)

    def plot(self, ax: Any = None) -> Any:
        """Draws the gain in colours and the proved limit as a line; needs matplotlib.

        Parameters
        ----------
        ax : matplotlib Axes, optional

        Returns
        -------
        matplotlib Axes
        """
        from .plotting import stability_map as draw

        return draw(self, ax)


def floats(values: ArrayLike) -> np.ndarray:
    """Exact values as floats."""
    array = np.asarray(values)
    if array.dtype.kind in "fiu":
        return array.astype(float).ravel()
    from fractions import Fraction

    return np.array([float(Fraction(exact_text(value))) for value in array.ravel().tolist()])


def highest(values: ArrayLike) -> str:
    """The largest value, exactly: how far limits are looked for."""
    array = np.asarray(values)
    return exact_text(array.ravel().tolist()[int(np.argmax(floats(array)))])


def stability_map(
    scheme: Scheme, x: Axis, y: Axis, *, decide: bool = True, progress: Progress = None
) -> StabilityMap:
    """The gain over a plane of two parameters, and the proved limit along the second for each value of the first.

    Parameters
    ----------
    scheme : Scheme
        All its other parameters have values.
    x : (str, array_like)
        A parameter, or ``"ratio"`` of a scheme with kernel sums, and its values.
    y : (str, array_like)
        Another parameter and its values.
    decide : bool
        Whether stability is decided as well; without it there are only gains.
    progress : bool or callable, optional
        See `progress`.

    Returns
    -------
    StabilityMap

    Examples
    --------
    >>> import numpy as np
    >>> import courant_stability as courant
    >>> diffusion = courant.Scheme("u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])")
    >>> found = courant.stability_map(diffusion, ("r", np.linspace(0.1, 0.6, 6)), ("C", np.linspace(0.1, 1.2, 12)))
    >>> found.largest.shape, int(found.stable.sum())
    ((6, 12), 35)
    >>> bool(((found.growth < 1e-12) == found.stable).all())
    True
    """
    (x_name, xs), (y_name, ys) = x, y
    subject, numbers = scheme._subject, floats(ys)
    with reporting(progress, "gains") as report:
        gains = _native.gains(subject, x_name, column(xs), y_name, numbers, report)
    found = StabilityMap(
        scheme, x_name, floats(xs), y_name, numbers, gains["largest"], gains["lowest"]
    )
    if not decide:
        return found
    with reporting(progress, "limits") as report:
        answer = _native.stable(subject, x_name, column(xs), y_name, column(ys), highest(ys), report)
    limits = pack(answer, (len(found.x),))
    return StabilityMap(
        scheme, x_name, found.x, y_name, found.y, found.largest, found.lowest, answer["stable"], limits
    )
