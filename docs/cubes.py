"""Does a limit in two or three dimensions follow from the cosine series stated? For verify_certificate.py.

A cube of waves has a letter for each axis: h, a half turn by x = sin^2(phi/2), where the series is even in this phase
alone, or 0 to 3, the quarter turn phi = q pi/2 + theta by x = tan(theta/2). On it the series is a polynomial in
coordinates from 0 to 1 and in t, times a positive function: a dictionary {(power of x, of y, .., of t): whole number}.
"""
from fractions import Fraction as F
from itertools import permutations, product
from math import comb, lcm

from certificate_form import check

AXES = "xyz"


def linear_power(a, b, n):  # (a + b x)^n
    return [comb(n, i) * a**(n - i) * b**i for i in range(n + 1)]


def times(p, q):
    result = [0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            result[i + j] += a*b
    return result


def degree(form, axis):
    return max((powers[axis] for powers in form), default=0)


def substituted(form, axis, row):
    """Each power of a variable replaced by a polynomial in it."""
    rows, result = [row(power) for power in range(degree(form, axis) + 1)], {}
    for powers, value in form.items():
        for power, factor in enumerate(rows[powers[axis]]):
            if factor:
                key = *powers[:axis], power, *powers[axis + 1:]
                result[key] = result.get(key, 0) + value*factor
    return {powers: value for powers, value in result.items() if value}


def flipped(form, axis):  # 1 - x for x
    return substituted(form, axis, lambda power: linear_power(1, -1, power))


def half(form, axis, upper):  # x/2 or (1 + x)/2 for x
    n = degree(form, axis)
    return substituted(form, axis, lambda power: [c << (n - power) for c in linear_power(upper, 1, power)])


def chart(form, axes, leader):
    """The other axes as multiples of the leader, whose largest power is divided out."""
    total = {powers: sum(powers[axis] for axis in axes) for powers in form}
    order = min(total.values(), default=0)
    moved = {(*powers[:leader], total[powers] - order, *powers[leader + 1:]): value for powers, value in form.items()}
    check(degree(moved, leader) <= 400, "a chart in a chart in a chart")
    return moved


def is_positive(form, dimension):
    """No Bernstein coefficient on the cube is negative: they are positive multiples of those of (1 + u)^n p(u/(1 + u))."""
    for axis in range(dimension):
        n = degree(form, axis)
        form = substituted(form, axis, lambda power: [0] * power + linear_power(1, 1, n - power))
    return min(form.values(), default=0) >= 0


def in_last(form, low, high):
    """The Bernstein coefficients in t from low to high, polynomials in the others: t = (a + b u)/(d + d u)."""
    axis = len(next(iter(form))) - 1
    n, d = degree(form, axis), lcm(low.denominator, high.denominator)
    a, b = int(low*d), int(high*d)
    mixed = substituted(form, axis, lambda power: times(linear_power(a, b, power), linear_power(d, d, n - power)))
    rows = [{} for _ in range(n + 1)]
    for (*powers, t), value in mixed.items():
        rows[t][tuple(powers)] = value
    return rows


class Signs:
    """A text read sign by sign."""

    def __init__(self, text, dimension):
        self.text, self.place, self.axes = text, 0, AXES[:dimension]

    def next(self):
        check(self.place < len(self.text), "cuts end too soon")
        self.place += 1
        return self.text[self.place - 1]

    def axis(self, letter=None):
        letter = letter or self.next()
        check(letter in self.axes, f"there is no axis {letter!r}")
        return self.axes.index(letter)

    def set(self):  # up to the closing bracket
        axes = []
        while (letter := self.next()) != "}":
            axes.append(self.axis(letter))
        check(axes and axes == sorted(set(axes)), "no set of axes")
        return axes


def nowhere_negative(form, cuts, dimension):
    """Replays cuts: what takes the place of a cube waits behind all that are waiting."""
    waiting, signs = [form], Signs(cuts, dimension)
    for cube in waiting:  # grows
        while (sign := signs.next()) == "~":
            cube = flipped(cube, signs.axis())
        if sign == ".":
            check(is_positive(cube, dimension), "a box is not decided")
        elif sign == "{":
            axes = signs.set()
            waiting += [chart(cube, axes, leader) for leader in axes]
        else:
            axis = signs.axis(sign)
            waiting += [half(cube, axis, 0), half(cube, axis, 1)]
    check(signs.place == len(cuts), "there are more cuts than cubes")


def normal(k):  # of k and -k the one that begins with a positive number
    return tuple(-x for x in k) if next((x for x in k if x), 0) < 0 else tuple(k)


class Margin:
    """The sum of value t^power cos(k phi)."""

    def __init__(self, stated, stride):
        self.stride, self.terms, margin = stride, {}, stated["margin"]
        check(margin and 1 <= len(margin[0]["k"]) <= 3, "a polynomial that is zero says nothing")
        self.dimension, lowest = len(margin[0]["k"]), min(term["power"] for term in margin)
        common = lcm(*(F(term["value"]).denominator for term in margin))
        for term in margin:
            k, power, value = term["k"], term["power"] - lowest, F(term["value"])
            sound = len(k) == self.dimension and max(map(abs, k)) <= 64 and power % stride == 0
            check(sound, "a term of a cosine series is not understood")
            key = power // stride, tuple(k)
            check(value and normal(k) == tuple(k) and key not in self.terms, "a term stands twice")
            self.terms[key] = int(value*common)
        identity = tuple(range(self.dimension))
        mirrors = list(product((1, -1), repeat=self.dimension))
        self.symmetries = [(order, signs) for order in permutations(identity) for signs in mirrors
                           if self.terms == {(power, normal([s*k[a] for a, s in zip(order, signs)])): value
                                             for (power, k), value in self.terms.items()}]
        self.even = [(identity, tuple(-1 if a == axis else 1 for a in identity)) in self.symmetries for axis in identity]

    def covers_all_waves(self, cubes):
        check(all(len(cube) == self.dimension for cube in cubes), "there is no such cube")
        covered = {tuple(str(3 - int(cube[a])) if s < 0 and cube[a] in "0123" else cube[a] for a, s in zip(order, signs))
                   for order, signs in self.symmetries for cube in cubes}
        check(covered >= set(product(*("h" if even else "0123" for even in self.even))), "not all waves are covered")

    def on_cube(self, cube):
        check(len(cube) == self.dimension, "there is no such cube")
        turns = []
        for axis, letter in enumerate(cube):
            check(letter in "0123" or letter == "h" and self.even[axis], "there is no such cube")
            multiples = {k[axis] for _, k in self.terms}
            n = max(map(abs, multiples))
            turns.append({k: half_turn(k) if letter == "h" else quarter_turn(k, n, int(letter)) for k in multiples})
        form = {}
        for (power, k), value in self.terms.items():
            parts = {(): (value, 0)}  # real and imaginary
            for turn, multiple in zip(turns, k):
                parts = {(*powers, i): (a*c - b*d, a*d + b*c)
                         for powers, (a, b) in parts.items() for i, (c, d) in enumerate(turn[multiple])}
            for powers, (real, _) in parts.items():
                form[*powers, power] = form.get((*powers, power), 0) + real
        return {powers: value for powers, value in form.items() if value}

    def holds(self, cell):
        """Checks a cube; gives the squares of the values of C where its cover begins and ends."""
        form, begin = self.on_cube(cell["cube"]), F(cell["begin"])
        check(begin >= 0 and cell["pieces"], "an interval is not covered")
        t0 = begin
        for piece in cell["pieces"]:
            check(t0 is not None, "something beyond everything")
            if piece["end"] == "inf":  # from t0 on: t^n P(1/t) from 0 to 1/t0
                check(t0 > 0, "an interval is not covered")
                n = degree(form, self.dimension)
                rows = in_last({(*x, n - power): value for (*x, power), value in form.items()}, F(0), 1/t0)
                t0 = None
            else:
                t1 = F(piece["end"])
                check(t0 < t1, "an interval is not covered")
                rows, t0 = in_last(form, t0, t1), t1
            check(len(rows) == len(piece["cuts"]), "cuts for each coefficient in t")
            for row, cuts in zip(rows, piece["cuts"]):
                nowhere_negative(row, cuts, self.dimension)
        return begin**(2//self.stride), t0 and t0**(2//self.stride)

    def at(self, wave):
        """The polynomial in t at a wave, times a positive number."""
        form, point, signs = self.on_cube(wave["cube"]), list(map(F, wave["point"])), Signs(wave["way"], self.dimension)
        check(len(point) == self.dimension and min(point) >= 0 and max(point) <= 1, "there is no such wave")
        while signs.place < len(wave["way"]):
            sign = signs.next()
            if sign == "~":
                form = flipped(form, signs.axis())
            elif sign == "{":
                axes, leader = signs.set(), signs.axis()
                check(leader in axes, "a leader is none of its axes")
                form = chart(form, axes, leader)
            else:
                axis, part = signs.axis(sign), signs.next()
                check(part in "<>", "a way is not understood")
                form = half(form, axis, int(part == ">"))
        for axis in range(self.dimension):
            form = chart(form, [axis], axis)
        values = [F(0)] * (degree(form, self.dimension) + 1)
        for (*powers, power), value in form.items():
            for x, exponent in zip(point, powers):
                value *= x**exponent
            values[power] += value
        return values


def half_turn(k):
    """cos k phi = Re (cos phi/2 + i sin phi/2)^(2k) in powers of x = sin^2(phi/2), as pairs (real, imaginary)."""
    k, row = abs(k), [0] * (abs(k) + 1)
    for m in range(k + 1):
        for i, c in enumerate(linear_power(1, -1, k - m)):
            row[m + i] += (-1)**m * comb(2*k, 2*m) * c
    return [(c, 0) for c in row]


def quarter_turn(k, n, quarter):
    """(1 + x^2)^n e^(ik phi) = i^(qk) (1 + ix)^(n+k) (1 - ix)^(n-k), as pairs (real, imaginary)."""
    plus, minus = linear_power(1, 1, n + k), linear_power(1, -1, n - k)
    pairs = []
    for power, c in enumerate(times(plus, minus)):  # the coefficient of (ix)^power
        turn = (power + quarter*k) % 4
        pairs.append([(c, 0), (0, c), (-c, 0), (0, -c)][turn])
    return pairs
