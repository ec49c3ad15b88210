"""Exact numbers in pure Python against floats and against each other."""

import pickle
from decimal import Decimal
from fractions import Fraction

import pytest

from courant_stability import AlgebraicNumber
from courant_stability.exact import decimal_text, exact_text


def square_root(radicand):
    return AlgebraicNumber([-radicand, 0, 1], Fraction(0), Fraction(radicand))


def test_numbers_are_read_as_people_mean_them():
    assert [exact_text(value) for value in (0.1, 3, Fraction(1, 3), Decimal("0.30"), " 2/7 ")] == [
        "0.1", "3", "1/3", "0.30", "2/7",
    ]
    for no_number in (None, [1], square_root(2)):
        with pytest.raises(ValueError):
            exact_text(no_number)


@pytest.mark.parametrize("radicand", [2, 3, 5, 6, 7, 8, 10, 99, 10**12 + 1])
def test_a_root_is_its_square_root(radicand):
    root = square_root(radicand)
    assert float(root) == pytest.approx(radicand**0.5, rel=1e-15)
    # Cut off, so that the square is below, and one unit more is above.
    digits = 40
    cut = Fraction(root.decimal(digits))
    unit = Fraction(1, 10 ** (digits - 1)) * 10 ** (len(str(int(cut))) - 1)
    assert cut**2 < radicand < (cut + unit) ** 2


def test_comparisons_are_exact():
    two, three = square_root(2), square_root(3)
    assert two < three and three > two and two != three and two <= two and max(two, three) is three
    # The float nearest to the root is not the root.
    assert two != float(two) and (two < float(two)) == (float(two) ** 2 > 2)
    assert two < Fraction(99, 70) and two > Fraction(140, 99) and two > 1 and two < 1.5
    # (x² − 2)(x − 5): the same root of another polynomial, in another interval.
    other = AlgebraicNumber([10, -2, -5, 1], Fraction(1), Fraction(3, 2))
    assert other == two and hash(other) == hash(two) and other < three
    # x² − 2 and x² − 2 + 10⁻³⁰: apart by 3.5e-31.
    near = AlgebraicNumber([1 - 2 * 10**30, 0, 10**30], Fraction(1), Fraction(2))
    assert near != two and near < two
    # 8/4 is met by halving: a fraction.
    assert square_root(4) == 2 and square_root(4).decimal(5) == "2.0000"


def test_what_is_printed_is_the_polynomial():
    root = AlgebraicNumber([-2, -1, 4], Fraction(0), Fraction(1))
    assert root.equation("C") == "4 C^2 - C - 2 = 0" and root.degree == 2
    assert pickle.loads(pickle.dumps(root)) == root
    with pytest.raises(ValueError, match="no change of sign"):
        AlgebraicNumber([-2, 0, 1], Fraction(2), Fraction(3))


def test_decimals_are_cut_off():
    for value, text in [
        (Fraction(2, 3), "0.6666"), (Fraction(0), "0"), (Fraction(1, 3000), "0.0003333"),
        (Fraction(99999), "9.999e4"), (Fraction(9999), "9999"), (Fraction(1, 10**7), "1.000e-7"),
    ]:
        assert decimal_text(value, 4) == text
