"""What a sweep does on one block: functions of arrays that can be pickled, the same in one process and in many."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from .exact import exact_text
from .subject import Scheme


def limit_dtype(dimension: int) -> np.dtype:
    """A limit as numbers: ``evidence`` and ``cause`` are places in `EVIDENCE` and `CAUSES`, a cause of −1 is none."""
    return np.dtype(
        [
            ("value", "f8"),
            ("lower", "f8"),
            ("upper", "f8"),
            ("phase", "f8", (dimension,)),
            ("evidence", "i1"),
            ("cause", "i1"),
            ("included", "?"),
            ("unbounded", "?"),
        ]
    )


#: The gain of the wave that grows most and of the one that is damped most.
GAIN_DTYPE = np.dtype([("largest", "f8"), ("lowest", "f8")])


def column(values: ArrayLike) -> np.ndarray | list[str]:
    """Values for the native half: floats as they are, anything else as text."""
    array = np.asarray(values)
    if array.dtype.kind == "f":
        return np.ascontiguousarray(array, dtype=np.float64).ravel()
    return [exact_text(value) for value in array.ravel().tolist()]


def pack(answer: dict[str, Any], shape: tuple[int, ...]) -> np.ndarray:
    """The arrays of an answer as one."""
    packed = np.empty(answer["value"].shape, dtype=limit_dtype(answer["phase"].shape[1]))
    for name in packed.dtype.names or ():
        packed[name] = answer[name]
    return packed.reshape(shape)


def limits_block(
    *arrays: ArrayLike,
    scheme: Scheme,
    names: tuple[str, ...],
    max: str | None = None,
    growth: str = "0",
    budget: int | None = None,
    records: list[dict[str, Any]] | None = None,
    report: Any = None,
) -> np.ndarray:
    """Limits of one scheme at arrays of parameters, which are broadcast together.

    Parameters
    ----------
    *arrays : array_like
        One for each name.
    scheme : Scheme
    names : tuple of str
        Parameters, or ``"ratio"``.
    records : list, optional
        Everything about each limit is put here.

    Returns
    -------
    ndarray
        Of `limit_dtype`.
    """
    together = np.broadcast_arrays(*(np.asarray(array) for array in arrays)) if arrays else []
    shape = together[0].shape if arrays else ()
    if arrays and not together[0].size:
        return np.empty(shape, dtype=limit_dtype(scheme.dimension))
    columns = [column(array) for array in together]
    answer = _native.limits(
        scheme._subject, list(names), columns, max, growth, budget, records is not None, report
    )
    if records is not None:
        records.extend(json.loads(answer["records"]))
    return pack(answer, shape)


def gains_block(
    x: ArrayLike, y: ArrayLike, *, scheme: Scheme, x_name: str, y_name: str
) -> np.ndarray:
    """The largest and the lowest gain over all waves, of `GAIN_DTYPE`, for values of two axes that are broadcast along the other."""
    xs, ys = column(x), np.asarray(y, dtype=float).ravel()
    shape = (len(xs), len(ys))
    packed = np.empty(shape, dtype=GAIN_DTYPE)
    if packed.size:
        answer = _native.gains(scheme._subject, x_name, xs, y_name, ys, None)
        packed["largest"], packed["lowest"] = answer["largest"], answer["lowest"]
    return packed


def stable_block(
    x: ArrayLike, y: ArrayLike, *, scheme: Scheme, x_name: str, y_name: str, max: str
) -> np.ndarray:
    """Which points of a plane are stable: decided, not read off gains."""
    xs, ys = column(x), column(y)
    if not (len(xs) and len(ys)):
        return np.empty((len(xs), len(ys)), dtype=bool)
    answer = _native.stable(scheme._subject, x_name, xs, y_name, ys, max, None)
    return np.asarray(answer["stable"])
