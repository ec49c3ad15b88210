"""The map of Figure 1 from Python, beside the NumPy script of the same map, in turn: the least of seven each."""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import sys
import time
from pathlib import Path

import numpy as np

import courant_stability as courant

sys.path.insert(0, str(Path(__file__).parent.parent / "numpy"))
from figure1 import figure_1

RATIOS, COURANT_NUMBERS = np.round(1 + 0.0225 * np.arange(401), 4), np.round(0.03 * np.arange(401), 2)
SCHEME = courant.scheme("godunov-sph", kernel="cubic-spline", ratio=1)


def plane(**options):
    return courant.stability_map(SCHEME, ("ratio", RATIOS), ("C", COURANT_NUMBERS), **options)


def script():
    figure_1(RATIOS, COURANT_NUMBERS, np.linspace(0, np.pi, 1000))


def seconds(work):
    """On the clock, and of all processors."""
    start, used = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - start, time.process_time() - used


if __name__ == "__main__":
    runs = [[seconds(work) for work in (script, lambda: plane(decide=False), plane)] for _ in range(7)]
    least = np.min(runs, axis=0)
    for name, (clock, processors) in zip(("NumPy script", "gains", "gains and 401 proved limits"), least):
        times = least[0] / (clock, processors)
        print(f"{name:<28} {clock:.3f} s, {times[0]:.1f} times less; {processors:.3f} s of processors, {times[1]:.1f} times less")
