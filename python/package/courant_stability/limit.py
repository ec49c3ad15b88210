"""Limits and stable sets."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Union

from .exact import AlgebraicNumber, decimal_text, exact_text

Number = Union[Fraction, AlgebraicNumber]


@dataclass(frozen=True)
class Limit:
    """A value of a parameter at which a property ends, with what stands behind it.

    ``float(limit)`` is the largest float that, as a decimal, is not above the limit; infinite where none was met.

    Attributes
    ----------
    symbol : str
        The parameter.
    exact : Fraction or AlgebraicNumber or None
        The limit itself, where it is known exactly.
    lower, upper : float
        The property holds up to the one and is lost above the other.
    evidence : str
        ``proved``, ``enclosed``, ``sampled``, ``measured`` or ``undecided``.
    cause : str or None
        The wave that binds: ``long-wave``, ``interior`` or ``shortest-wave``.
    critical_phase : float or tuple of float or None
        Its phase in radians, along each axis.
    included : bool
        Whether the property holds at the limit itself.
    record : dict
        What ``courant limits --format json`` says, key by key.

    Examples
    --------
    >>> import courant_stability as courant
    >>> limit = courant.scheme("leapfrog").limit()
    >>> limit
    Limit(C = 1, proved, interior)
    >>> limit.exact, limit.included, limit == 1
    (Fraction(1, 1), False, True)
    >>> courant.lines("upwind-3", "rk4").limit().exact
    AlgebraicNumber(1.7452686221768496: a root of a polynomial of degree 47)
    """

    symbol: str
    exact: Number | None
    record: dict[str, Any] = field(repr=False, compare=False)
    enclosure: tuple[Fraction, Fraction] | None = field(repr=False, compare=False)
    latex: str | None = field(repr=False, compare=False)

    @classmethod
    def _of(cls, answer: dict[str, Any]) -> Limit:
        record, ends, polynomial = answer["record"], answer["enclosure"], answer["polynomial"]
        enclosure = None if ends is None else (Fraction(ends[0]), Fraction(ends[1]))
        exact: Number | None = None
        if enclosure is not None and polynomial is not None and enclosure[0] < enclosure[1]:
            exact = AlgebraicNumber(polynomial, *enclosure, closed_form=record["exact"])
        elif enclosure is not None and enclosure[0] == enclosure[1]:
            exact = enclosure[0]
        return cls(answer["symbol"], exact, record, enclosure, answer["latex"])

    def __float__(self) -> float:
        value = self.record["value"]
        return math.inf if value is None else float(value)

    @property
    def value(self) -> float:
        """``float(limit)``."""
        return float(self)

    @property
    def lower(self) -> float:
        return float(self.record["lower"])

    @property
    def upper(self) -> float:
        upper = self.record["upper"]
        return math.inf if upper is None else float(upper)

    @property
    def evidence(self) -> str:
        return str(self.record["evidence"])

    @property
    def cause(self) -> str | None:
        cause: str | None = self.record["cause"]
        return cause

    @property
    def critical_phase(self) -> float | tuple[float, ...] | None:
        phase = self.record["critical_phase"]
        return tuple(phase) if isinstance(phase, list) else phase

    @property
    def included(self) -> bool:
        return bool(self.record["included"])

    @property
    def unbounded(self) -> bool:
        """Whether no limit was met in the range looked at."""
        return bool(self.record["unbounded"])

    @property
    def without_end(self) -> bool:
        """Whether it is proved that there is none at all."""
        return bool(self.record.get("without_end", False))

    def decimal(self, digits: int = 11) -> str:
        """Digits, cut off: no more than the enclosure settles.

        Examples
        --------
        >>> import courant_stability as courant
        >>> courant.lines("upwind-3", "rk4").limit().decimal(25)
        '1.745268622176849578702107'
        """
        if isinstance(self.exact, AlgebraicNumber):
            return self.exact.decimal(digits)
        if self.exact is not None:
            return decimal_text(self.exact, digits)
        if self.enclosure is None or math.isinf(self.upper):
            return "∞" if math.isinf(self.upper) else repr(float(self))
        for count in range(digits, 0, -1):
            texts = {decimal_text(end, count) for end in self.enclosure}
            if len(texts) == 1:
                return texts.pop()
        return repr(float(self))

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Limit):
            return (self.symbol, self.exact, self.record) == (other.symbol, other.exact, other.record)
        if self.exact is not None and isinstance(other, (int, float, Fraction, AlgebraicNumber)):
            return bool(self.exact == other)
        return NotImplemented

    def __hash__(self) -> int:
        return hash((self.symbol, float(self)))

    def __lt__(self, other: Any) -> bool:
        return bool(self._number < _number_of(other))

    def __gt__(self, other: Any) -> bool:
        return bool(self._number > _number_of(other))

    def __le__(self, other: Any) -> bool:
        return bool(self._number <= _number_of(other))

    def __ge__(self, other: Any) -> bool:
        return bool(self._number >= _number_of(other))

    @property
    def _number(self) -> Any:
        return float(self) if self.exact is None else self.exact

    def __str__(self) -> str:
        if self.exact is None:
            return self.decimal()
        text = self.record["exact"]
        return text if text is not None and len(text) <= 24 else self.decimal()

    def __repr__(self) -> str:
        cause = f", {self.cause}" if self.cause else ""
        return f"Limit({self.symbol} = {self}, {self.evidence}{cause})"

    def _repr_latex_(self) -> str:
        name = self.symbol.replace("Δ", r"\Delta ")
        value = self.latex
        if value is None:
            value = r"\infty" if math.isinf(self.upper) else self.decimal() + r"\ldots"
        return f"${name} \\le {value}$"


def _number_of(other: Any) -> Any:
    return other._number if isinstance(other, Limit) else other


@dataclass(frozen=True)
class Interval:
    """Stable values from one limit to another, both included unless they say otherwise."""

    begin: Limit
    end: Limit

    def __repr__(self) -> str:
        left = "[" if self.begin.included or self.begin == 0 else "("
        right = "]" if self.end.included else ")"
        return f"{left}{self.begin}, {self.end}{right}"


@dataclass(frozen=True)
class StableSet:
    """All values of a parameter at which a property holds.

    Attributes
    ----------
    limit : Limit
        The end of the interval that begins at 0.
    intervals : tuple of Interval
        Those of positive length, ascending.
    undecided : tuple of (float, float)
        What could not be decided.
    at_zero : bool
        Whether 0 itself belongs to it.
    neutral : bool
        Whether no wave grows or decays whatever the value.
    evidence : str
        What stands behind it.

    Examples
    --------
    >>> import courant_stability as courant
    >>> courant.scheme("lax-wendroff").stable_set()
    StableSet([0, 1], proved)
    >>> 0.7 in courant.scheme("lax-wendroff").stable_set()
    True
    """

    limit: Limit
    intervals: tuple[Interval, ...]
    undecided: tuple[tuple[float, float], ...]
    at_zero: bool
    neutral: bool
    evidence: str

    @classmethod
    def _of_json(cls, text: str) -> StableSet:
        return cls._of(json.loads(text))

    @classmethod
    def _of(cls, answer: dict[str, Any]) -> StableSet:
        return cls(
            limit=Limit._of(answer["limit"]),
            intervals=tuple(Interval(*(Limit._of(end) for end in ends)) for ends in answer["intervals"]),
            undecided=tuple((low, high) for low, high in answer["undecided"]),
            at_zero=answer["at_zero"],
            neutral=answer["neutral"],
            evidence=answer["evidence"],
        )

    def __contains__(self, value: Any) -> bool:
        """Whether a value is known to belong to it; at an enclosed end only the inner side counts."""
        value = value if isinstance(value, AlgebraicNumber) else Fraction(exact_text(value))
        if value == 0:
            return self.at_zero
        for interval in self.intervals:
            above = _certain(value, interval.begin, 1)
            below = _certain(value, interval.end, 0)
            if above and below:
                return True
        return False

    def __repr__(self) -> str:
        parts = [repr(interval) for interval in self.intervals]
        if not parts:
            parts = ["{0}" if self.at_zero else "∅"]
        return f"StableSet({' ∪ '.join(parts)}, {self.evidence})"

    def _repr_latex_(self) -> str:
        def end(limit: Limit) -> str:
            if limit.latex is not None:
                return limit.latex
            return r"\infty" if math.isinf(limit.upper) else limit.decimal()

        def interval(one: Interval) -> str:
            left = "[" if one.begin.included or one.begin == 0 else "("
            right = "]" if one.end.included else ")"
            return f"{left}{end(one.begin)}, {end(one.end)}{right}"

        parts = [interval(one) for one in self.intervals]
        return "$" + (r" \cup ".join(parts) or (r"\{0\}" if self.at_zero else r"\emptyset")) + "$"


def _certain(value: Any, end: Limit, side: int) -> bool:
    """Whether a value lies on the inner side of an end; `side` 1 for a beginning, 0 for an end."""
    number: Any = end.exact
    if number is None:
        if side == 0 and math.isinf(end.upper):
            return bool(value <= end.lower) or end.without_end
        number = end.enclosure[side] if end.enclosure else (end.upper if side else end.lower)
    inside = value >= number if side else value <= number
    # An end that does not belong to the set.
    return bool(inside) and (end.included or value != number)
