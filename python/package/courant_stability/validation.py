"""Prediction against a run."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Validation:
    """Predicted multipliers against what the equations do, stepped as they were typed by code that knows nothing of waves.

    Attributes
    ----------
    value : float
        Of the parameter in question.
    passed : bool
        Whether every multiplier of every wave agrees within its round-off.
    max_error, tolerance : float
        The largest error, and how large it may be.
    predicted, measured : ndarray of complex
        One for each wave and branch.

    Examples
    --------
    >>> import courant_stability as courant
    >>> run = courant.scheme("crank-nicolson").validate(C=0.5)[0]
    >>> run.passed, run.max_error < 1e-13, run.predicted.shape
    (True, True, (17,))
    """

    value: float
    passed: bool
    max_error: float
    tolerance: float
    predicted: np.ndarray = field(repr=False)
    measured: np.ndarray = field(repr=False)
    rows: list[dict[str, Any]] = field(repr=False)
    failure: str | None = None

    @classmethod
    def _all_of_json(cls, text: str) -> list[Validation]:
        def multipliers(rows: list[dict[str, Any]], which: str) -> np.ndarray:
            pairs = [(row[which]["gain"], row[which]["phase"]) for row in rows]
            gain, phase = np.array(pairs, dtype=float).T
            return np.asarray(gain * np.exp(1j * phase))

        return [
            cls(
                value=value,
                passed=found["passed"],
                max_error=found["max_error"],
                tolerance=found["tolerance"],
                predicted=multipliers(found["rows"], "predicted"),
                measured=multipliers(found["rows"], "measured"),
                rows=found["rows"],
                failure=found["failure"],
            )
            for value, found in json.loads(text)
        ]

    def __bool__(self) -> bool:
        return self.passed
