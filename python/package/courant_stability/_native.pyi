"""The native half. Nothing here is public: it may change with every version."""

from collections.abc import Callable, Sequence
from typing import Any, final

import numpy as np

__all__ = [
    "CAUSES",
    "EVIDENCE",
    "Probe",
    "Subject",
    "certify",
    "check",
    "gain",
    "gains",
    "limits",
    "monotone_set",
    "multipliers",
    "names",
    "speeds",
    "stable",
    "stable_set",
    "symbol",
    "validate",
    "verify",
]

EVIDENCE: list[str]
CAUSES: list[str]

_Report = Callable[[int, int], object] | None
_Column = np.ndarray | Sequence[str]

@final
class Subject:
    def __new__(
        cls,
        kind: str,
        source: str,
        integrator: str | None,
        kernel: str | None,
        ratio: str | None,
        density: str | None,
        eos: str | None,
        values: Sequence[tuple[str, str]],
        parameter: str | None,
    ) -> Subject: ...
    name: str
    title: str
    equations: str
    source: str
    dimension: int
    unknowns: list[str]
    parameters: list[tuple[str, str | None]]
    parameter: str
    symbol: str

@final
class Probe:
    def __new__(
        cls,
        step: Callable[[float, np.ndarray], np.ndarray],
        unknowns: Sequence[str],
        size: Sequence[int],
        levels: int,
        parameter: str | None,
        fit: Sequence[str],
        judged: Sequence[str],
        about: Sequence[float] | None,
        tolerance: float | None,
        max: str,
        budget: int | None,
        report: _Report,
    ) -> Probe: ...
    def record(self) -> str: ...
    def check(self, value: str) -> str: ...
    def stable_set(self) -> str | None: ...
    def monotone_set(self) -> str | None: ...

def names() -> list[list[str]]: ...
def stable_set(subject: Subject, max: str | None, growth: str | None, budget: int | None) -> str: ...
def monotone_set(subject: Subject, max: str | None, budget: int | None) -> str: ...
def check(subject: Subject, max: str | None, growth: str | None, budget: int | None) -> str: ...
def symbol(subject: Subject, terms: int | None) -> str: ...
def certify(subject: Subject, max: str | None, growth: Sequence[str], budget: int | None) -> str: ...
def verify(text: str) -> tuple[list[str], int]: ...
def validate(
    subject: Subject, values: Sequence[float], cells: Sequence[int] | None, steps: int | None
) -> str: ...
def multipliers(subject: Subject, names: Sequence[str], arrays: Sequence[np.ndarray]) -> np.ndarray: ...
def gain(subject: Subject, names: Sequence[str], arrays: Sequence[np.ndarray]) -> np.ndarray: ...
def speeds(
    subject: Subject, names: Sequence[str], arrays: Sequence[np.ndarray]
) -> tuple[np.ndarray, np.ndarray]: ...
def limits(
    subject: Subject,
    names: Sequence[str],
    columns: Sequence[_Column],
    max: str | None,
    growth: str | None,
    budget: int | None,
    records: bool,
    report: _Report,
) -> dict[str, Any]: ...
def gains(
    subject: Subject, x: str, xs: _Column, y: str, ys: np.ndarray, report: _Report
) -> dict[str, np.ndarray]: ...
def stable(
    subject: Subject, x: str, xs: _Column, y: str, ys: _Column, max: str, report: _Report
) -> dict[str, np.ndarray]: ...
