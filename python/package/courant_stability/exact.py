"""Exact numbers: fractions, and roots of integer polynomials."""

from __future__ import annotations

import functools
import numbers
from decimal import Decimal
from fractions import Fraction
from typing import Any, Union

#: What is read as an exact number: a float stands for its shortest decimal, 1/10 for 0.1.
ExactLike = Union[int, float, str, Fraction, Decimal, "numbers.Real"]


def exact_text(value: Any) -> str:
    """A number as the native half reads it.

    Examples
    --------
    >>> exact_text(0.1), exact_text(Fraction(2, 3)), exact_text("3/2")
    ('0.1', '2/3', '3/2')
    """
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, (numbers.Rational, Decimal)):
        return str(value)
    if isinstance(value, AlgebraicNumber):
        raise ValueError(f"{value}: a root of a polynomial is no exact value of a parameter; take float(…)")
    if isinstance(value, numbers.Real):
        return repr(float(value))
    raise ValueError(f"{value!r} is no number")


#: The longest equation that is printed where nobody asks for it.
_LONGEST = 120


def _value(polynomial: tuple[int, ...], at: Fraction) -> int:
    """The polynomial at a fraction times a positive integer: its sign."""
    total, power = 0, 1
    for coefficient in reversed(polynomial):
        total = total * at.numerator + coefficient * power
        power *= at.denominator
    return total


def _remainder(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
    a = list(a)
    while len(a) >= len(b):
        factor = a[-1] / b[-1]
        for place, coefficient in enumerate(b):
            a[len(a) - len(b) + place] -= factor * coefficient
        a.pop()
        while a and not a[-1]:
            a.pop()
    return a


def _common_factor(a: tuple[int, ...], b: tuple[int, ...]) -> list[Fraction]:
    """Euclid's algorithm."""
    first, second = [Fraction(c) for c in a], [Fraction(c) for c in b]
    while second:
        first, second = second, _remainder(first, second)
        second = [c / second[-1] for c in second] if second else second
    return first


def _product_text(polynomial: tuple[int, ...], variable: str, power: str) -> str:
    """``4 x^2 - x - 2``."""
    text = ""
    for exponent in range(len(polynomial) - 1, -1, -1):
        coefficient = polynomial[exponent]
        if not coefficient:
            continue
        sign = ("-" if coefficient < 0 else "") if not text else (" - " if coefficient < 0 else " + ")
        size = "" if abs(coefficient) == 1 and exponent else str(abs(coefficient))
        name = "" if not exponent else variable if exponent == 1 else f"{variable}^{power.format(exponent)}"
        text += sign + " ".join(part for part in (size, name) if part)
    return text


@functools.total_ordering
class AlgebraicNumber:
    """The only root of an integer polynomial between two fractions.

    It prints its polynomial, compares exactly with numbers and with others of its kind, and is as long as a decimal as one likes.

    Parameters
    ----------
    polynomial : sequence of int
        Coefficients, the constant first.
    lower, upper : Fraction
        The root lies strictly between, and the polynomial changes sign.
    closed_form : str, optional
        How people write it: ``sqrt(3)``.

    Examples
    --------
    >>> root = AlgebraicNumber([-2, 0, 0, 1], Fraction(1), Fraction(2))
    >>> root
    AlgebraicNumber(1.2599210498948732: x^3 - 2 = 0)
    >>> root < Fraction(63, 50), root == AlgebraicNumber([6, 0, 0, -5, 0, 0, 1], Fraction(1), Fraction(13, 10))
    (True, True)
    >>> root.decimal(30)
    '1.25992104989487316476721060727'
    """

    __slots__ = ("closed_form", "lower", "polynomial", "upper")

    def __init__(
        self,
        polynomial: Any,
        lower: Fraction,
        upper: Fraction,
        closed_form: str | None = None,
    ) -> None:
        self.polynomial: tuple[int, ...] = tuple(int(c) for c in polynomial)
        self.lower, self.upper, self.closed_form = Fraction(lower), Fraction(upper), closed_form
        if _value(self.polynomial, self.lower) * _value(self.polynomial, self.upper) >= 0:
            raise ValueError(f"{self.equation()}: no change of sign from {lower} to {upper}")

    @property
    def degree(self) -> int:
        """The degree of the polynomial; a smaller one is not claimed not to exist."""
        return len(self.polynomial) - 1

    def equation(self, variable: str = "x") -> str:
        """The equation it solves: ``4 x^2 - x - 2 = 0``."""
        return _product_text(self.polynomial, variable, "{}") + " = 0"

    def enclosure(self, width: Fraction) -> tuple[Fraction, Fraction]:
        """Two fractions around the number that are no further apart than `width`; equal where it is a fraction that was met."""
        lower, upper = self.lower, self.upper
        sign = _value(self.polynomial, lower) > 0
        while upper - lower > width:
            middle = (lower + upper) / 2
            at_middle = _value(self.polynomial, middle)
            if not at_middle:
                return middle, middle
            if (at_middle > 0) == sign:
                lower = middle
            else:
                upper = middle
        return lower, upper

    def decimal(self, digits: int) -> str:
        """The first significant digits, cut off and not rounded."""
        width = Fraction(1, 10**digits)
        while True:
            lower, upper = self.enclosure(width * self.upper / 4)
            texts = {decimal_text(lower, digits), decimal_text(upper, digits)}
            if len(texts) == 1 or lower == upper:
                return texts.pop()
            width /= 10**6

    def compare(self, other: Any) -> int:
        """−1, 0 or 1, decided exactly."""
        if isinstance(other, AlgebraicNumber):
            return self._compare_root(other)
        if isinstance(other, float):
            if other != other:
                raise ValueError("not a number")
            if other in (float("inf"), float("-inf")):
                return -1 if other > 0 else 1
        value = Fraction(other)
        if value <= self.lower:
            return 1
        if value >= self.upper:
            return -1
        at_value = _value(self.polynomial, value)
        if not at_value:
            return 0
        return 1 if (at_value > 0) == (_value(self.polynomial, self.lower) > 0) else -1

    def _compare_root(self, other: AlgebraicNumber) -> int:
        lower, upper = max(self.lower, other.lower), min(self.upper, other.upper)
        if lower < upper:
            common = _common_factor(self.polynomial, other.polynomial)
            ends = []
            for end in (lower, upper):
                total = Fraction(0)
                for coefficient in reversed(common):
                    total = total * end + coefficient
                ends.append(total)
            if len(common) > 1 and ends[0] * ends[1] < 0:
                return 0
        # They differ: narrow enclosures are apart.
        width = Fraction(1, 2**20)
        while True:
            mine, theirs = self.enclosure(width), other.enclosure(width)
            if mine[1] <= theirs[0]:
                return -1
            if theirs[1] <= mine[0]:
                return 1
            width /= 2**20

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, (AlgebraicNumber, numbers.Rational, Decimal, float)):
            return NotImplemented
        return self.compare(other) == 0

    def __lt__(self, other: Any) -> bool:
        return self.compare(other) < 0

    def __hash__(self) -> int:
        # Equal numbers may have different polynomials.
        return hash(float(self))

    def __float__(self) -> float:
        lower, upper = self.lower, self.upper
        width = upper / 2**64
        while float(lower) != float(upper):
            lower, upper = self.enclosure(width)
            width /= 2**64
        return float(lower)

    def _shown(self, equation: str) -> str:
        return equation if len(equation) <= _LONGEST else f"a root of a polynomial of degree {self.degree}"

    def __str__(self) -> str:
        return self.closed_form or f"{float(self)!r}, {self._shown(self.equation())}"

    def __repr__(self) -> str:
        closed = f" = {self.closed_form}" if self.closed_form else ""
        return f"AlgebraicNumber({float(self)!r}{closed}: {self._shown(self.equation())})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.polynomial, self.lower, self.upper, self.closed_form)

    def _repr_latex_(self) -> str:
        equation = _product_text(self.polynomial, "x", "{{{}}}") + " = 0"
        shown = equation if len(equation) <= _LONGEST else rf"\text{{{self._shown(equation)}}}"
        return f"${self.decimal(12)}\\ldots:\\ {shown}$"


def decimal_text(value: Fraction, digits: int) -> str:
    """The first significant digits of a number that is not negative, cut off.

    Examples
    --------
    >>> decimal_text(Fraction(2, 3), 5), decimal_text(Fraction(15, 8), 11)
    ('0.66666', '1.8750000000')
    """
    if not value:
        return "0"
    exponent = len(str(value.numerator)) - len(str(value.denominator))
    while Fraction(10) ** exponent > value:
        exponent -= 1
    while Fraction(10) ** (exponent + 1) <= value:
        exponent += 1
    scaled = int(value / Fraction(10) ** (exponent - digits + 1))
    text = str(scaled)
    if exponent < -4 or exponent >= digits:
        return f"{text[0]}.{text[1:]}e{exponent}" if digits > 1 else f"{text}e{exponent}"
    if exponent >= 0:
        whole, rest = text[: exponent + 1], text[exponent + 1 :]
    else:
        whole, rest = "0", "0" * (-exponent - 1) + text
    return f"{whole}.{rest}" if rest else whole
