"""What a file of certificates looks like, strictly: used by verify_certificate.py and verify_coefficients.py.

Every number that may be long is text in lowest terms, of at most 20,000 characters; counts are whole numbers up
to 1000; no key is missing, repeated or unknown. So neither checker can be led astray by true for 1, by 2/4 for
1/2 or by a count of 10^30. docs/proved.md says what the entries mean.
"""
import json
import re
import sys
from fractions import Fraction

SCHEMA = "courant.certificate/3"
sys.set_int_max_str_digits(0)


def check(holds, otherwise):
    if not holds:
        sys.exit(f"refused: {otherwise}")


def rational(value):
    good = isinstance(value, str) and len(value) <= 20000 and re.fullmatch("-?[0-9]+(/[0-9]+)?", value)
    check(good and not re.fullmatch(".*/0+", value) and str(Fraction(value)) == value, f"{value!r} is no fraction in lowest terms")


def end(value):
    """15/8, sqrt(8/3) where that is no fraction, or inf."""
    root = re.fullmatch(r"sqrt\((.*)\)", value) if isinstance(value, str) else None
    rational(root[1] if root else "0" if value == "inf" else value)
    check(not root or is_no_square(Fraction(root[1])), f"{value!r} is a fraction")


def is_no_square(x):
    return x > 0 and any(isqrt(part)**2 != part for part in (x.numerator, x.denominator))


def isqrt(n):
    from math import isqrt
    return isqrt(n)


def count(value):
    check(type(value) is int and 0 <= value <= 1000, f"{value!r} is no count")


def text(*choices, most=20000):
    def shape(value):
        good = value in choices if choices else True
        check(isinstance(value, str) and len(value) <= most and good, f"{value!r} is not expected")
    return shape


def many(entry, most=20000):
    def shape(value):
        check(isinstance(value, list) and len(value) <= most, "a list is expected, and no longer one")
        for each in value:
            entry(each)
    return shape


def optional(entry):
    return lambda value: value is None or entry(value)


def record(**entries):
    def shape(value):
        check(isinstance(value, dict) and set(value) == set(entries), f"exactly {', '.join(entries)} are expected")
        for key, entry in entries.items():
            entry(value[key])
    return shape


def named(value):
    check(isinstance(value, dict) and len(value) <= 12, "values by name are expected")
    for name, number in value.items():
        text(most=200)(name)
        rational(number)


def integrator(value):
    row = many(text(most=400), 64)
    table = many(row, 64)
    kinds = {
        "runge-kutta": record(A=table, b=row),
        "multistep": record(alpha=row, beta=row),
        "nystrom": record(c=row, position=table, velocity=table, position_weights=row, velocity_weights=row),
    }
    one_of(**kinds)(value)


def one_of(**kinds):
    def shape(value):
        check(isinstance(value, dict) and len(value) == 1 and set(value) < {*kinds, ""}, "another kind is expected")
        for kind, entry in value.items():
            kinds[kind](entry)
    return shape


def multiple(value):
    check(type(value) is int and abs(value) <= 1000, f"{value!r} is no multiple")


WAVE = record(inequality=count, s=rational, value=rational)
MARGIN = record(
    phase_power=count, complement_power=count, neutral_waves=many(rational, 1000), courant_power=count, stride=count,
    denominator=rational, coefficients=many(many(rational, 1000), 1000), radius=many(rational, 1000))
LINE = record(
    inequalities=many(record(
        level=count, condition=text(most=40), square=many(many(rational, 1000), 1000), weight=many(rational, 1000),
        margin=MARGIN), 2000),
    below=optional(WAVE),
    covers=many(record(begin=rational, pieces=many(record(end=end, waves=many(rational))))),
    above=optional(record(s=rational, wave=WAVE)))
POINT = record(
    wave=record(inequality=count, cube=text(most=3), way=text(most=400), point=many(rational, 3)), value=rational)
TORUS = record(
    stride=count,
    inequalities=many(record(
        level=count, condition=text(most=40), square=text(),
        margin=many(record(power=count, k=many(multiple, 3), value=rational)),
        cells=many(record(
            cube=text(most=3), begin=rational,
            pieces=many(record(end=end, cuts=many(text(most=200_000), 1000)))), 64)), 2000),
    below=optional(POINT), above=optional(POINT))
CERTIFICATE = record(
    subject=record(
        equations=text(),
        kernel=optional(record(name=text(most=40), ratio=rational, density=text("summation", "mass-per-spacing"))),
        integrator=optional(integrator), values=named, parameter=text(most=200)),
    question=text("stability", "monotonicity"), growth=rational, evidence=text("proved", "enclosed"),
    levels=many(record(rule=text("jury", "schur-cohn"), split=optional(record(inside=text(), circle=text()))), 64),
    interval=record(begin=end, lower=end, upper=optional(end)),
    proof=one_of(line=LINE, torus=TORUS))


def read(path):
    def no_key_twice(pairs):
        check(len(dict(pairs)) == len(pairs), "a key stands twice")
        return dict(pairs)

    with open(path, encoding="utf-8") as file:
        content = json.load(file, object_pairs_hook=no_key_twice)
    record(schema=text(SCHEMA), certificates=many(CERTIFICATE))(content)
    check(content["certificates"], "there is no certificate in it")
    return content["certificates"]


def main(verify, usage, conclusion):
    """For every file named on the command line."""
    for path in sys.argv[1:] or sys.exit(usage):
        print(end=f"{path}: ", flush=True)
        certificates = read(path)
        for certificate in certificates:
            verify(certificate)
        print(len(certificates), conclusion)
