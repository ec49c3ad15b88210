"""Sweeps that outgrow one machine, as Dask's graphs.

Every task is one call of a function of `blocks` on one block of the axes: the bits are those of one process, whatever the blocks and
wherever they run, and what a lost worker had is computed again. `docs/python-clusters.md` of the project says how to size blocks.
"""

from __future__ import annotations

import functools
from typing import Any

import dask.array as da
import numpy as np

from .blocks import GAIN_DTYPE, gains_block, limit_dtype, limits_block, stable_block
from .exact import ExactLike, exact_text
from .maps import Axis, StabilityMap, floats, highest
from .subject import Scheme

__all__ = ["limits_table", "stability_map"]


def _blocked(values: Any, chunks: Any) -> da.Array:
    if isinstance(values, da.Array):
        return values
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        # Fractions and texts travel as text.
        texts = [exact_text(value) for value in array.ravel().tolist()]
        array = np.array(texts, dtype=object).reshape(array.shape)
    return da.from_array(array, chunks=chunks)


def limits_table(
    scheme: Scheme,
    *,
    growth: ExactLike = 0,
    max: ExactLike | None = None,
    budget: int | None = None,
    chunks: Any = "auto",
    **parameters: Any,
) -> da.Array:
    """The limits of a scheme at arrays of its parameters, block by block.

    Parameters
    ----------
    scheme : Scheme
    growth, max, budget
        As of `Scheme.limit`.
    chunks
        Dask's word for the size of blocks, for arrays that are not Dask's yet.
    **parameters
        Arrays of NumPy or Dask that are broadcast together; ``ratio`` is that of a kernel.

    Returns
    -------
    dask Array
        Of `blocks.limit_dtype`: ``table["value"]`` are the limits.

    Examples
    --------
    >>> import numpy as np
    >>> import courant_stability as courant
    >>> import courant_stability.dask
    >>> scheme = courant.scheme("advection-diffusion-ftcs")
    >>> table = courant.dask.limits_table(scheme, r=np.linspace(0.1, 0.5, 5), chunks=2)
    >>> table["value"].compute(scheduler="synchronous").round(3).tolist()
    [0.447, 0.632, 0.775, 0.894, 1.0]
    """
    arrays = da.broadcast_arrays(*(_blocked(values, chunks) for values in parameters.values()))
    block = functools.partial(
        limits_block,
        scheme=scheme,
        names=tuple(parameters),
        max=None if max is None else exact_text(max),
        growth=exact_text(growth),
        budget=budget,
    )
    dtype = limit_dtype(scheme.dimension)
    return da.map_blocks(block, *arrays, dtype=dtype, meta=np.empty((0,) * arrays[0].ndim, dtype))


def stability_map(
    scheme: Scheme, x: Axis, y: Axis, *, decide: bool = True, chunks: Any = ("auto", -1)
) -> StabilityMap:
    """A map whose arrays are Dask's; ``.compute()`` makes numbers of them. Arguments as of `courant_stability.stability_map`.

    Parameters
    ----------
    chunks : pair
        Dask's words for the blocks of the two axes. Rows are the work: a block takes all of the second axis where nothing is said.
    """
    (x_name, xs), (y_name, ys) = x, y
    rows, columns = _blocked(xs, (chunks[0],)), _blocked(ys, (chunks[1],))
    plane = rows[:, None], columns[None, :]
    names = {"scheme": scheme, "x_name": x_name, "y_name": y_name}

    def over(function: Any, dtype: Any, **more: Any) -> da.Array:
        block = functools.partial(function, **names, **more)
        return da.map_blocks(block, *plane, dtype=dtype, meta=np.empty((0, 0), dtype))

    gains = over(gains_block, GAIN_DTYPE)
    stable = limits = None
    if decide:
        most = highest(ys)
        stable = over(stable_block, bool, max=most)
        sought, axes = scheme(parameter=y_name), dict[str, Any]({x_name: rows})
        limits = limits_table(sought, max=most, **axes)
    return StabilityMap(
        scheme, x_name, floats(xs), y_name, floats(ys), gains["largest"], gains["lowest"], stable, limits
    )
