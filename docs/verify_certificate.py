"""Does each limit follow from the polynomials stated? python3 verify_certificate.py FILE.json ...

In exact fractions; docs/proved.md explains it. Whose polynomials they are: verify_coefficients.py."""
from fractions import Fraction as F
from math import lcm

from certificate_form import CERTIFICATE, check, main
from cubes import Margin


def value(p, x):
    return sum(c * x**i for i, c in enumerate(p))


def bernstein(p, a, b):
    # (d + du)^n p(x) in powers of u, where x = (a + bu)/(1 + u): if none is negative, nor is p from a to b.
    d, result, power = lcm(a.denominator, b.denominator), [], [1]
    low, high = int(a*d), int(b*d)
    for c in reversed(p):
        result = [low*x + high*y + c*z for x, y, z in zip(result + [0], [0] + result, power)]
        power = [d*x + d*y for x, y in zip(power + [0], [0] + power)]
    return result


def square(end):  # of a number such as 15/8 or sqrt(8/3)
    return F(end[5:-1]) if end.startswith("sqrt") else F(end)**2


def nowhere_negative(p):  # on [0, 1], by halving
    pending, boxes = [(F(0), F(1))], 0
    while pending:
        a, b = pending.pop()
        boxes += 1
        check(boxes < 4096 and value(p, a) >= 0, "a weight is negative")
        if min(bernstein(p, a, b)) < 0:
            pending += [(a, (a + b)/2), ((a + b)/2, b)]


class Inequality:
    """s^a (1 - s)^b H(s)^2 C^c P(s, C^stride) >= 0, and with it Q(s, C)^2 W(s) times that."""

    def __init__(self, stated):
        m = stated["margin"]
        self.a, self.b, self.stride = m["phase_power"], m["complement_power"], m["stride"]
        self.weight, self.squared = list(map(F, stated["weight"])), [list(map(F, row)) for row in stated["square"]]
        self.neutral, self.radius = list(map(F, m["neutral_waves"])), list(map(F, m["radius"]))
        self.rows = [list(map(F, row)) for row in m["coefficients"]]
        check(self.stride in (1, 2) and F(m["denominator"]) > 0 and min(self.radius) >= 0, "no margin")
        check(len(self.radius) == len(self.rows) and len(set(map(len, self.rows))) == 1, "no rectangle")
        check(all(x.denominator == 1 for row in [*self.rows, self.radius] for x in row), "no whole numbers")
        self.rows = [list(map(int, row)) for row in self.rows]
        self.radius = list(map(int, self.radius))
        nowhere_negative(self.weight)

    def at(self, s):  # P in powers of t at one wave, raised by the radii
        return [value(row, s) + r for row, r in zip(self.rows, self.radius)]

    def factor(self, s, courant):
        q = sum(value(row, s) * courant**i for i, row in enumerate(self.squared))
        trivial = s**self.a * (1 - s)**self.b * value(self.neutral, s)**2
        return trivial * value(self.weight, s) * q**2 * courant

    def holds(self, cover):
        """Checks a cover; gives the squares of the values of C where it begins and ends."""
        rows = [[row[0] - r, *row[1:]] for row, r in zip(self.rows, self.radius)]
        check(any(map(any, rows)), "a polynomial that is zero says nothing")
        begin = t0 = F(cover["begin"])
        check(begin >= 0 and cover["pieces"], "an interval is not covered")
        for piece in cover["pieces"]:
            check(t0 is not None, "something beyond everything")
            if piece["end"] == "inf":  # from t0 on: t^n P(1/t) from 0 to 1/t0
                check(t0 > 0, "an interval is not covered")
                t1, low, high, ordered = None, F(0), 1/t0, rows[::-1]
            else:
                low, high, ordered = t0, (t1 := F(piece["end"])), rows
                check(low < high, "an interval is not covered")
            ends = [F(0), *map(F, piece["waves"])]
            check(ends[-1] == 1 and ends == sorted(set(ends)), "not all waves are covered")
            for s0, s1 in zip(ends, ends[1:]):
                columns = zip(*(bernstein(row, s0, s1) for row in ordered))
                check(all(min(bernstein(column, low, high)) >= 0 for column in columns), "a box is not decided")
            t0 = t1
        to_c2 = (lambda t: t**2) if self.stride == 1 else (lambda t: t)
        return to_c2(begin), t0 and to_c2(t0)

    def grows(self, wave):
        """The polynomial is negative at this wave and value, and no factor vanishes."""
        s, courant = F(wave["s"]), F(wave["value"])
        check(courant > 0 < s <= 1 and self.factor(s, courant) > 0 > value(self.at(s), courant**self.stride),
              "no growing wave")
        return courant**2


class Line:
    """Functions of one phase."""

    def __init__(self, stated):
        self.stated, self.inequalities = stated, list(map(Inequality, stated["inequalities"]))

    def covers(self, nothing):
        covers = self.stated["covers"]
        check(len(covers) == (0 if nothing else len(self.inequalities)), "a cover for each inequality")
        return [inequality.holds(cover) for inequality, cover in zip(self.inequalities, covers)]

    def of(self, wave):
        check(wave["inequality"] < len(self.inequalities), "there is no such inequality")
        return self.inequalities[wave["inequality"]]

    def below(self, wave):  # the square of the value
        return self.of(wave).grows(wave)

    def above(self, claim, upper):
        wave, s = claim["wave"], F(claim["s"])
        inequality = self.of(wave)
        check(0 <= s <= 1, "there is no such wave")
        grows_throughout(inequality.at(s), upper, F(wave["value"]), inequality.stride)
        return inequality.grows(wave)


class Torus:
    """Functions of several phases."""

    def __init__(self, stated):
        self.stated, self.stride = stated, stated["stride"]
        check(self.stride in (1, 2), "no stride")
        self.margins = [Margin(one, self.stride) for one in stated["inequalities"]]

    def covers(self, nothing):
        found = []
        for margin, one in zip(self.margins, self.stated["inequalities"]):
            check(not nothing or not one["cells"], "an interval of nothing is covered")
            if not nothing:
                margin.covers_all_waves([cell["cube"] for cell in one["cells"]])
                found += map(margin.holds, one["cells"])
        return found

    def at(self, wave):
        check(wave["inequality"] < len(self.margins), "there is no such inequality")
        return self.margins[wave["inequality"]].at(wave)

    def below(self, grows):
        courant = F(grows["value"])
        check(courant > 0 > value(self.at(grows["wave"]), courant**self.stride), "no growing wave")
        return courant**2

    def above(self, grows, upper):
        courant = F(grows["value"])
        check(courant > 0, "no growing wave")
        grows_throughout(self.at(grows["wave"]), upper, courant, self.stride)
        return courant**2


def grows_throughout(p, upper, courant, stride):
    """A polynomial in t = C^stride is negative from an end to a value."""
    check(stride == 2 or not upper.startswith("sqrt"), "t is no fraction")
    t = square(upper) if stride == 2 else F(upper)
    check(t < courant**stride, "not just above the limit")
    common = lcm(*(F(x).denominator for x in p))
    signs = bernstein([int(x*common) for x in p], t, courant**stride)
    check(max(signs) <= 0 > min(signs), "the wave does not grow throughout")


def verify(certificate):
    (kind, stated), = certificate["proof"].items()
    proof = {"line": Line, "torus": Torus}[kind](stated)
    interval = certificate["interval"]
    growth, begin = F(certificate["growth"]), square(interval["begin"])
    forever, upper = interval["lower"] == "inf", interval["upper"]
    lower = None if forever else square(interval["lower"])
    check(growth >= 0 and "-" not in interval["begin"] + interval["lower"] + (upper or ""), "a negative number")
    check(forever or begin < lower or begin == lower == 0, "the interval ends before it begins")
    # Stable in between.
    for low, high in proof.covers(lower == 0):
        check(low <= begin and (high is None or not forever and lower <= high), "an interval is not covered")
    # Not stable just below.
    below, above = stated["below"], stated["above"]
    check((below is None) == (begin == 0) and (above is None) == (upper is None), "an end comes with a reason")
    if below is not None:
        gap = begin - proof.below(below)
        check(0 < gap * 2**16 <= begin, "not just below the interval")
    # Not stable just above.
    if above is not None:
        check(not forever and upper != "inf", "above what?")
        end = square(upper)
        check(lower <= end and (end - lower) * 2**18 <= lower, "the ends of the limit are far apart")
        gap = proof.above(above, upper) - end
        check(0 < gap * 2**16 <= (end or 1), "not just above the limit")


if __name__ == "__main__":
    main(verify, __doc__, "limits follow from the polynomials stated")
