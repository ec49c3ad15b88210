"""What becomes of the waves at one value of a parameter."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from .limit import StableSet


@dataclass(frozen=True)
class Verdict:
    """The answer of ``check``: true where no wave grows exponentially.

    Attributes
    ----------
    verdict : str
        ``stable``, ``marginal``, ``weakly-unstable``, ``unstable`` or ``undecided``.
    stable_set : StableSet
        All stable values.
    monotone_set : StableSet or None
        All values without a negative coefficient; nothing where that is not asked.
    record : dict
        What ``courant check --format json`` says, key by key.

    Examples
    --------
    >>> import courant_stability as courant
    >>> verdict = courant.scheme("lax-wendroff").check(C=1.01)
    >>> verdict
    Verdict(unstable, |z| up to 1.0402)
    >>> bool(verdict), round(verdict.steps_to_double, 2), verdict.record["critical_phase"]
    (False, 17.59, 3.141592653589793)
    """

    verdict: str
    stable_set: StableSet = field(repr=False)
    monotone_set: StableSet | None = field(repr=False)
    record: dict[str, Any] = field(repr=False)

    @classmethod
    def _of_json(cls, text: str) -> Verdict:
        answer = json.loads(text)
        monotone = answer["monotone_set"]
        return cls(
            verdict=answer["record"]["verdict"],
            stable_set=StableSet._of(answer["stable_set"]),
            monotone_set=None if monotone is None else StableSet._of(monotone),
            record=answer["record"],
        )

    def __bool__(self) -> bool:
        within = self.record.get("within_growth")
        return self.verdict in ("stable", "marginal") if within is None else within == "yes"

    @property
    def monotone(self) -> bool | None:
        """Whether no coefficient is negative; nothing where that is not asked, or not decided."""
        known: bool | None = self.record["monotone"]
        return known

    @property
    def max_gain(self) -> float | None:
        """The largest modulus of a multiplier."""
        known: float | None = self.record["max_gain"]
        return known

    @property
    def growth_per_step(self) -> float | None:
        """``max |z| − 1``."""
        known: float | None = self.record["growth_per_step"]
        return known

    @property
    def steps_to_double(self) -> float | None:
        """Steps until the fastest wave has doubled; nothing where none is known to grow."""
        known: float | None = self.record["steps_to_double"]
        return known

    @property
    def critical_phase(self) -> float | tuple[float, ...] | None:
        """The phase of the wave that grows, or of the one that binds the limit."""
        phase = self.record["critical_phase"]
        return tuple(phase) if isinstance(phase, list) else phase

    def __repr__(self) -> str:
        gain = "" if self.max_gain is None else f", |z| up to {self.max_gain:.8g}"
        return f"Verdict({self.verdict}{gain})"

    def _repr_html_(self) -> str:
        rows = {
            "verdict": self.verdict,
            "stability limit": f"{self.stable_set.limit} ({self.stable_set.limit.evidence})",
            "largest |z|": self.max_gain,
            "steps to double": self.steps_to_double,
            "monotone": self.monotone,
        }
        cells = "".join(
            f"<tr><th style='text-align:left'>{name}</th><td>{value}</td></tr>"
            for name, value in rows.items()
            if value is not None
        )
        return f"<table>{cells}</table>"
