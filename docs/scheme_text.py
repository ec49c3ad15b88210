"""From the text of a scheme to linear equations, for verify_coefficients.py: a parser of the language (docs/language.md),
polynomials, kernel weights.

A polynomial is a dictionary {(z, E, C, letters): coefficient} of powers of the time shift z, of the shifts E by one
cell and of the sought parameter C. The powers of the shifts along two or three axes are one number, `packed`. A letter stands for a number or an even function of the wave that is no fraction:
sqrt(2), a sum of Gaussian weights. `letters` is a tuple of pairs (number of the letter, power).
"""
import re
from fractions import Fraction
from math import gcd, isqrt, lcm

from certificate_form import check

BITS = 320  # letters are known to so many binary digits, within a few units
ONE = 1 << BITS

ROOM = 1 << 40  # powers of E are far below


def packed(shifts):
    """Powers of the shifts along the axes as one number: sums, multiples and opposites are those of the powers."""
    return sum(e * ROOM**axis for axis, e in enumerate(shifts))


def unpacked(e):
    shifts = []
    for _ in range(3):
        shifts.append((e + ROOM//2) % ROOM - ROOM//2)
        e = (e - shifts[-1]) // ROOM
    return shifts


class Poly(dict):
    def __add__(self, other):
        total = Poly(self)
        for key, value in other.items():
            total[key] = total.get(key, 0) + value
        return Poly({key: value for key, value in total.items() if value})

    def scaled(self, factor):
        return Poly({key: factor*value for key, value in self.items()}) if factor else Poly()

    def __neg__(self):
        return self.scaled(-1)

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        total = {}
        for (z, e, c, letters), a in self.items():
            for (y, f, d, more), b in other.items():
                factor = a*b
                together = letters or more
                if letters and more:
                    powers = dict(letters)
                    for letter, power in more:
                        powers[letter] = powers.get(letter, 0) + power
                    for letter, power in powers.items():
                        root = Letters.all[letter].root
                        if root:  # sqrt(n)^2 = n
                            factor *= root**(power//2)
                            powers[letter] = power % 2
                    together = tuple(sorted((letter, power) for letter, power in powers.items() if power))
                key = z + y, e + f, c + d, together
                total[key] = total.get(key, 0) + factor
        return Poly({key: value for key, value in total.items() if value})

    def __pow__(self, exponent):
        power = number(1)
        for _ in range(exponent):
            power = power * self
        return power

    def moved(self, z=0, e=0, c=0):
        return Poly({(y + z, f + e, d + c, letters): value for (y, f, d, letters), value in self.items()})

    def conjugate(self):  # E becomes 1/E
        return Poly({(z, -e, c, letters): value for (z, e, c, letters), value in self.items()})

    def by_z(self):  # [coefficient of z^0, of z^1, ...]
        parts = [Poly() for _ in range(max((key[0] for key in self), default=0) + 1)]
        for (z, *rest), value in self.items():
            parts[z][0, *rest] = value
        return parts

    def is_number(self):
        return all(key == (0, 0, 0, ()) for key in self)

    def is_unit(self):  # a number times powers of z and E
        return len(self) == 1 and all(c == 0 and not letters for _, _, c, letters in self)

    def without_denominators(self):
        common = 1
        for value in self.values():
            common = lcm(common, Fraction(value).denominator)
        return Poly({key: int(value*common) for key, value in self.items()}), common

    def primitive(self):
        common = gcd(*self.values())
        return Poly({key: value//common for key, value in self.items()}) if common else self


def number(value):
    return Poly({(0, 0, 0, ()): value}) if value else Poly()


class Letter:
    """root: the n of sqrt(n), or 0. values: symmetric series [.., x_-1, x_0, x_1, ..] in powers of E, in units of 1/ONE;
    error: bounds the sum of the moduli of the errors of all of them, in the same units."""

    def __init__(self, values, error, root=0):
        self.values, self.error, self.root = values, error, root


class Letters:
    all, known = [], {}

    @classmethod
    def poly(cls, key, make):
        if key not in cls.known:
            cls.known[key] = len(cls.all)
            cls.all.append(make())
        return Poly({(0, 0, 0, ((cls.known[key], 1),)): 1})


def times(a, b):
    """The product of two enclosed series (values, error)."""
    (x, r), (y, q) = a, b
    product = [0] * (len(x) + len(y) - 1)
    for i, left in enumerate(x):
        for j, right in enumerate(y):
            product[i + j] += left*right
    error = sum(map(abs, x))*q + sum(map(abs, y))*r + r*q
    return [value >> BITS for value in product], (error >> BITS) + 1 + len(product)


def in_units(value):  # rounded, and the error of that
    return (value.numerator << BITS) // value.denominator


def constant_letter(value, error):
    units = int(error*ONE) + 2
    return Letters.poly(("constant", value, error), lambda: Letter([in_units(value)], units))


def root_letter(square):
    """sqrt(p/q) = sqrt(pq)/q."""
    n = square.numerator * square.denominator
    if isqrt(n)**2 == n:
        return number(Fraction(isqrt(n), square.denominator))
    root = Letters.poly(("root", n), lambda: Letter([isqrt(n << 2*BITS)], 1, n))
    return root.scaled(Fraction(1, square.denominator))


def exponential(x):
    """exp(-x) for 0 <= x <= 9, in units of 1/ONE; wrong by less than 2^22 of them."""
    total, term, n = 0, ONE, 0
    while n <= 9 or abs(term) > 1:
        total += term
        n += 1
        term = -term * x.numerator // (x.denominator * n)
    return total


def pi_in_units():  # Gauss; wrong by less than 2^16
    def arctan_of_inverse(m):
        return sum((-1)**k * (ONE // (m**(2*k + 1) * (2*k + 1))) for k in range(130))
    return 48*arctan_of_inverse(18) + 32*arctan_of_inverse(57) - 20*arctan_of_inverse(239)


# A polynomial kernel at q = distance / smoothing length: the sum of a (b - q)^p over (a, b, p) with b > q.
TRUNCATED_POWERS = {
    "cubic-spline": [(Fraction(a, 6), 2 - k, 3) for k, a in enumerate([1, -4])],
    "quartic-spline": [(Fraction(a, 24), Fraction(5, 2) - k, 4) for k, a in enumerate([1, -5, 10])],
    "quintic-spline": [(Fraction(a, 120), 3 - k, 5) for k, a in enumerate([1, -6, 15])],
    # Wendland's functions in powers of 1 - q/2.
    "wendland-c2": [(Fraction(5, 8) * a / 2**p, 2, p) for p, a in enumerate([4, -3], 3)],
    "wendland-c4": [(Fraction(3, 4) * a / 2**p, 2, p) for p, a in enumerate([14, -21, 8], 5)],
    "wendland-c6": [(Fraction(55, 64) * a / 2**p, 2, p) for p, a in enumerate([48, -108, 82, -21], 7)],
}
GAUSSIAN_SUPPORT = 3
GAUSSIAN_ERROR = Fraction(1, 2**260)  # relative; what is computed is far closer


class Lattice:
    """W[k], w[k] = -W'(k), v[k] = W''(k) by lattice distance, each (number, error), and rho."""

    def __init__(self, kernel):
        ratio, terms = Fraction(kernel["ratio"]), TRUNCATED_POWERS.get(kernel["name"])
        check(terms or kernel["name"] == "gaussian", "there is no such kernel")
        check(0 < ratio <= 50, "the ratio is not in (0, 50]")
        support = max(b for _, b, _ in terms) if terms else GAUSSIAN_SUPPORT
        self.ratio, self.weights = ratio, {"W": [], "w": [], "v": []}
        norm = None if terms else isqrt(ONE**3 // pi_in_units())  # 1/sqrt(pi)
        for k in range(int(support * ratio) + 1):
            q = k / ratio
            if terms:
                inside = [(a, b - q, p) for a, b, p in terms if b > q]
                shape = sum(a * x**p for a, x, p in inside)
                slope = sum(a * p * x**(p - 1) for a, x, p in inside)
                bend = sum(a * p * (p - 1) * x**(p - 2) for a, x, p in inside)
            else:
                shape = Fraction(exponential(q*q) * norm, ONE**2)
                slope, bend = 2*q*shape, (4*q*q - 2)*shape
            error = 0 if terms else GAUSSIAN_ERROR
            for name, x in (("W", shape / ratio), ("w", slope / ratio**2), ("v", bend / ratio**3)):
                x = Fraction(x) if name != "w" or k else Fraction(0)
                self.weights[name].append((x, abs(x)*error))
        # Neighbours on the edge of a smooth kernel have no weight.
        while len(self.weights["w"]) > 1 and not self.weights["w"][-1][0] and not self.weights["v"][-1][0]:
            for weights in self.weights.values():
                weights.pop()
        self.reach = len(self.weights["w"]) - 1
        first, *others = self.weights["W"]
        self.rho = (Fraction(1), Fraction(0))
        if kernel["density"] == "summation":
            self.rho = tuple(first[i] + 2*sum(x[i] for x in others) for i in range(2))


TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+−]?[0-9]+)?)|(?P<name>[^\W\d²³¹\u2070-\u207f][^\W²³¹\u2070-\u207f]*)"
    r"|(?P<sign>\*\*|[-+−–*·⋅×/^=,;'′’()\[\]])|(?P<line>[\r\n])|(?P<blank>[^\S\r\n]+|#[^\r\n]*|\ufeff)")
PLAIN = {"−": "-", "–": "-", "·": "*", "⋅": "*", "×": "*", "**": "^", "′": "'", "’": "'"}


def tokens(text):
    found, place, depth = [], 0, 0
    while place < len(text):
        match = TOKEN.match(text, place)
        check(match, f"the text is not understood at {text[place:place + 20]!r}")
        place, kind, word = match.end(), match.lastgroup, match.group()
        word = PLAIN.get(word, word)
        depth += (word in ("(", "[")) - (word in (")", "]"))
        check(depth <= 100, "brackets are nested too deep")
        if kind == "line":
            if depth or found and found[-1][1] in "+-*/^=,":
                continue
            kind, word = "sign", ";"
        if kind != "blank":
            found.append((kind, word))
    return found + [("end", ";")]


def written_number(word):
    mantissa, _, exponent = re.sub("[eE]", "e", word.replace("−", "-")).partition("e")
    check(abs(int(exponent or 0)) <= 400 and len(mantissa) <= 400, "a number is out of range")
    return Fraction(mantissa) * Fraction(10)**int(exponent or 0)


class Parser:
    """Trees of tuples: (operator, parts ...)."""

    def __init__(self, text):
        self.tokens, self.place = tokens(text), 0

    def next_is(self, *words):
        return self.tokens[self.place][0] in ("sign", "end") and self.tokens[self.place][1] in words

    def take(self, *words):
        check(not words or self.next_is(*words), f"{' or '.join(words)} is expected, not {self.tokens[self.place][1]}")
        self.place += 1
        return self.tokens[self.place - 1]

    def equations(self):
        found = []
        while self.place < len(self.tokens):
            if self.next_is(";"):
                self.take()
                continue
            left = self.sum()
            self.take("=")
            found.append(("-", left, self.sum()))
            self.take(";")
        return found

    def value(self):
        tree = self.sum()
        check(self.take(";")[0] == "end", "a single value is expected")
        return tree

    def sum(self):
        left = self.product()
        while self.next_is("+", "-"):
            left = (self.take()[1], left, self.product())
        return left

    def product(self):
        left = self.signed()
        while self.next_is("*", "/"):
            left = (self.take()[1], left, self.signed())
        return left

    def signs(self):
        negative = False
        while self.next_is("+", "-"):
            negative ^= self.take()[1] == "-"
        return negative

    def signed(self):
        negative = self.signs()
        power = self.power()
        return ("negative", power) if negative else power

    def power(self):
        base = self.atom()
        if not self.next_is("^"):
            return base
        self.take()
        negative = self.signs()
        exponent = self.power()
        return ("^", base, ("negative", exponent) if negative else exponent)

    def atom(self):
        kind, word = self.take()
        if kind == "number":
            return ("number", written_number(word))
        if word == "(":
            inner = self.sum()
            self.take(")")
            return inner
        check(kind == "name", f"a number, a name or a bracket is expected, not {word}")
        if self.next_is("("):
            check(word in ("sqrt", "sum"), f"there is no function {word}")
            self.take()
            index = None
            if word == "sum":
                index = self.take()
                check(index[0] == "name", "a running index is expected")
                self.take(",")
            inner = self.sum()
            self.take(")")
            return (word, inner, index and index[1])
        if self.next_is("["):
            self.take()
            items = [self.sum()]
            while self.next_is(","):
                self.take()
                items.append(self.sum())
            self.take("]")
            prime = self.next_is("'") and bool(self.take())
            return ("at", word, items, prime)
        return ("name", word)


def affine(tree):
    """A number plus multiples of names: {name: multiple}, the number under ''."""
    def combined(a, b, factor):
        return {name: a.get(name, 0) + factor*b.get(name, 0) for name in {*a, *b}}
    kind, *parts = tree
    if kind == "number":
        return {"": parts[0]}
    if kind == "name":
        return {parts[0]: Fraction(1)}
    check(kind in ("negative", "+", "-", "*", "/", "^"), "an index or exponent is not understood")
    a, *rest = map(affine, parts)
    if kind == "negative":
        return combined({}, a, -1)
    b = rest[0]
    if kind in "+-":
        return combined(a, b, 1 if kind == "+" else -1)
    if kind == "*" and not any(a[name] for name in a if name):
        a, b = b, a
    check(not any(b[name] for name in b if name), "an index or exponent is not linear")
    b = b.get("", Fraction(0))
    check(kind == "*" or b, "an index or exponent is not defined")
    if kind == "^":
        base, b = a.get("", Fraction(0)), whole(b, 100)
        check(set(a) <= {""} and abs(base) <= 1000 and base.denominator <= 1000, "an exponent is no number")
        check(base or b > 0, "a quotient by zero")
        return {"": base**b}
    return {name: multiple*b if kind == "*" else multiple/b for name, multiple in a.items()}


def whole(value, most):
    check(Fraction(value).denominator == 1 and abs(value) <= most, "a number is not whole, or too large")
    return int(value)


def plus(a, b):
    """The sum of two fractions of polynomials."""
    (p, q), (r, s) = a, b
    return (p + r, q) if q == s else (p*s + r*q, q*s)


class Reader:
    """Evaluates trees to {(place, function): fraction}. A place is None for numbers, else (unknown, time, space,
    derivative, multiple of the running index along the first axis), with times and spaces in halves; a function is None or the values of
    something that depends on the running index k = 1, 2, .., each with its error."""

    def __init__(self, parameter, values, lattice, wave):
        self.values, self.lattice, self.wave, self.unknowns = values, lattice, wave, []
        self.names = {parameter: Poly({(0, 0, 1, ()): 1})} if parameter else {}
        self.dimension = None

    def number(self, poly):
        return {(None, None): (poly, number(1))}

    def evaluate(self, tree, index=None):
        kind, *parts = tree
        if kind in ("number", "sqrt", "name", "at", "sum"):
            return getattr(self, f"read_{kind}")(*parts, index)
        a = self.evaluate(parts[0], index)
        if kind == "^":
            exponent = affine(parts[1])
            check(set(exponent) <= {""}, "an exponent is no number")
            exponent = whole(exponent.get("", 0), 100)
            base = self.inverse(a) if exponent < 0 else a
            check(max(self.size(base), 10*self.reach(base)) * abs(exponent) < 10**6, "a power is too large")
            power = self.number(number(1))
            for _ in range(abs(exponent)):
                power = self.product(power, base)
            return power
        if kind == "negative":
            return self.total(a, -1, {})
        b = self.evaluate(parts[1], index)
        if kind in "+-":
            return self.total(b, 1 if kind == "+" else -1, a)
        return self.product(a, self.inverse(b) if kind == "/" else b)

    @staticmethod
    def size(value):
        return sum(Fraction(c).numerator.bit_length() + Fraction(c).denominator.bit_length()
                   for pair in value.values() for poly in pair for c in poly.values())

    @staticmethod
    def reach(value):
        """The largest power of z, of a shift or of the parameter."""
        return max((abs(power) for pair in value.values() for poly in pair for z, e, c, _ in poly
                    for power in (z, *unpacked(e), c)), default=0)

    @staticmethod
    def total(more, sign, start):
        result = dict(start)
        for key, (p, q) in more.items():
            p = p if sign == 1 else -p
            result[key] = plus(result[key], (p, q)) if key in result else (p, q)
        return {key: value for key, value in result.items() if value[0]}

    def product(self, a, b):
        result = {}
        for (left, f), (p, q) in a.items():
            for (right, g), (r, s) in b.items():
                check(left is None or right is None, "not linear: a product of unknowns")
                function = f or g
                if f and g:  # |ab - a0 b0| <= |a| r + |b| q + q r
                    function = tuple((x*y, abs(x)*t + abs(y)*r + r*t) for (x, r), (y, t) in zip(f, g))
                key = left or right, function
                result = self.total({key: (p*r, q*s)}, 1, result)
        return result

    def inverse(self, value):
        check(value and all(place is None for place, _ in value), "a quotient by zero or by an unknown")
        functions = {function for _, function in value}
        if functions != {None}:
            check(len(functions) == 1, "inside a sum only a quotient by k or a number is understood")
            (_, function), (p, q) = next(iter(value.items()))
            check(all(x and not r for x, r in function), "inside a sum only a quotient by k or a number is understood")
            return {(None, tuple((1/Fraction(x), Fraction(0)) for x, _ in function)): (q, p)}
        p, q = value[None, None]
        if p.is_number() and q.is_number():
            return self.number(number(Fraction(q.get((0, 0, 0, ()), 0)) / p[0, 0, 0, ()]))
        enclosed = [letter for poly in (p, q) for *_, letters in poly for letter, _ in letters
                    if not Letters.all[letter].root]
        if not enclosed or any(c for poly in (p, q) for _, _, c, _ in poly):
            return {(None, None): (q, p)}
        (x, r), (y, t) = ball(p), ball(q)
        check(abs(x) > r, "a quotient by what may be zero")
        # |y/x - y0/x0| <= (|y0| r + |x0| t) / (|x0| (|x0| - r)), and the quotient is cut.
        error = (abs(y)*r + abs(x)*t) / (abs(x) * (abs(x) - r)) + Fraction(1, ONE)
        return self.number(constant_letter(Fraction(in_units(y/x), ONE), error))

    def read_number(self, value, _):
        return self.number(number(value)) if value else {}

    def read_sqrt(self, argument, _, index):
        value = self.evaluate(argument, index)
        p, q = value.get((None, None), (number(0), number(1)))
        check(set(value) <= {(None, None)} and p.is_number() and q.is_number(), "sqrt takes a fraction")
        square = Fraction(p.get((0, 0, 0, ()), 0)) / q[0, 0, 0, ()]
        check(square >= 0, "sqrt takes a fraction that is not negative")
        return self.number(root_letter(square)) if square else {}

    def enclosed(self, value, error):
        if not error:
            return self.number(number(value)) if value else {}
        return self.number(constant_letter(value, error))

    def read_name(self, name, index):
        if name == index:
            return {(None, tuple((Fraction(k), Fraction(0)) for k in range(1, self.lattice.reach + 1))):
                    (number(1), number(1))}
        if name in ("pi", "π"):
            return self.enclosed(Fraction(pi_in_units(), ONE), Fraction(2**16, ONE))
        if self.lattice and name == "ratio":
            return self.number(number(self.lattice.ratio))
        if self.lattice and name == "rho":
            return self.enclosed(*self.lattice.rho)
        check(name not in self.unknowns and name not in ("n", "i", "j"), f"{name} stands without its index")
        if name in self.names:
            return self.number(self.names[name])
        check(name in self.values, f"the parameter {name} has no value")
        return self.number(number(self.values[name])) if self.values[name] else {}

    def read_at(self, name, items, prime, index):
        items = [{key: x for key, x in affine(item).items() if x} for item in items]
        if name in ("W", "w", "v") and len(items) == 1 and not {"n", "i", "j"} & set(items[0]):
            check(self.lattice and not prime, "kernel sums need a kernel")
            weights, offset = self.lattice.weights[name], items[0]
            if set(offset) <= {""}:
                k = abs(whole(offset.get("", 0), 1000))
                return self.enclosed(*weights[k]) if k < len(weights) else {}
            check(index and offset == {index: 1}, "inside a sum over k a weight is written w[k]")
            return {(None, tuple(weights[1:])): (number(1), number(1))} if self.lattice.reach else {}
        time = None
        if "n" in items[0]:
            time, *items = items
            check(set(time) <= {"n", ""} and time["n"] == 1, "a time index is not understood")
            time = whole(2*time.get("", 0), 2000)
        check(1 <= len(items) <= 3, "one, two or three space indices are expected")
        axes = ["j", "ij", "ijk"][len(items) - 1]
        self.dimension = self.dimension or len(items)
        check(self.dimension == len(items), "all unknowns have as many space indices")
        check(index is None or index not in axes, "a running index is an axis")
        for item, axis in zip(items, axes):
            known = {axis, "", index} if axis == axes[0] else {axis, ""}
            check(set(item) <= known and item.get(axis) == 1, "a space index is not understood")
        check(time is None or not prime, "a time derivative has no time index")
        if name not in self.unknowns:
            self.unknowns.append(name)
        multiple = whole(items[0].get(index, 0), 1) if index else 0
        space = tuple(whole(2*item.get("", 0), 2000) for item in items)
        place = self.unknowns.index(name), time, space, prime, multiple
        return {(place, None): (number(1), number(1))}

    def read_sum(self, body, index, outer):
        check(self.lattice and outer is None and index not in ("n", "i", "j"), "kernel sums need a kernel")
        result = {}
        for (place, function), fraction in self.evaluate(body, index).items():
            function = function or ((Fraction(1), Fraction(0)),) * self.lattice.reach
            *base, multiple = place or (None, 0)
            for step, share in self.shares(function, multiple):
                at = None if place is None else (*base[:2], (base[2][0] + 2*step, *base[2][1:]), base[3], 0)
                share = {(at, None): (fraction[0]*share, fraction[1])} if share else {}
                result = self.total(share, 1, result)
        return result

    def shares(self, function, multiple):
        """The sum of f(k) E^(mk) by powers of E: [(power, polynomial in letters)]."""
        def poly(value, error):
            return constant_letter(value, error) if error else number(value)
        exact = not any(error for _, error in function)
        if exact or multiple == 0 or not self.wave:
            if multiple == 0:
                yield 0, poly(sum(x for x, _ in function), sum(r for _, r in function))
            else:
                yield from ((multiple*k, poly(x, r)) for k, (x, r) in enumerate(function, 1))
            return
        # E^(mk) = 1 - s (1 - cos k phi)/s + m (E - 1/E)/2 sin k phi/sin phi, s = (2 - E - 1/E)/4.
        yield 0, poly(sum(x for x, _ in function), sum(r for _, r in function))
        versines = Letters.poly(("versines", function), lambda: series_letter(function, versine))
        sines = Letters.poly(("sines", function), lambda: series_letter(function, sine))
        yield from ((step, versines.scaled(Fraction(x, 4))) for step, x in ((-1, 1), (0, -2), (1, 1)))
        yield from ((step*multiple, sines.scaled(Fraction(step, 2))) for step in (-1, 1))


def ball(poly):
    """The value of a polynomial in letters that are constants, and its error."""
    total, error = 0, 0
    for (*_, letters), factor in poly.items():
        term = [ONE], 0
        for letter, power in letters:
            for _ in range(power):
                term = times(term, (Letters.all[letter].values, Letters.all[letter].error))
        check(len(term[0]) == 1, "a quotient by what depends on the wave")
        total, error = total + factor*term[0][0], error + abs(factor)*term[1]
    return Fraction(total) / ONE, Fraction(error) / ONE


def versine(k):
    """(1 - cos k phi)/s = 2 times the sum of (k - |m|) E^m over |m| < k."""
    return {m: 2*(k - abs(m)) for m in range(1 - k, k)}


def sine(k):
    """sin k phi/sin phi = E^(1-k) + E^(3-k) + ... + E^(k-1)."""
    return {m: 1 for m in range(1 - k, k, 2)}


def series_letter(function, quotient):
    reach = len(function)
    values, error = [0] * (2*reach - 1), 0
    for k, (x, r) in enumerate(function, 1):
        terms = quotient(k)
        error += int(sum(terms.values()) * (r*ONE + 1)) + 1
        for m, factor in terms.items():
            values[m + reach - 1] += factor * in_units(x)
    return Letter(values, error)


def linear_equations(text, reader):
    """Rows {(unknown, time, space, derivative): polynomial}, with fractions cleared row by row."""
    rows = []
    trees = Parser(text).equations()
    check(trees, "there is no equation")
    for tree in trees:
        terms = reader.evaluate(tree)
        check(terms and all(place is not None for place, _ in terms), "a number is added to unknowns")
        check(all(function is None and not place[4] for place, function in terms), "an index k outside a sum")
        denominators = []
        for _, q in terms.values():
            if not q.is_number() and q not in denominators:
                denominators.append(q)
        row = {}
        for (place, _), (p, q) in terms.items():
            for other in denominators:
                p = p if other == q else p*other
            row[place[:4]] = p if not q.is_number() else p.scaled(1 / Fraction(q[0, 0, 0, ()]))
        rows.append(whole_row(row))
    check(len(rows) == len(reader.unknowns), "there must be as many equations as unknowns")
    return rows


def whole_row(row):
    """Times the denominators of its numbers."""
    common = lcm(*(poly.without_denominators()[1] for poly in row.values()))
    return {key: Poly({k: int(value*common) for k, value in poly.items()}) for key, poly in row.items()}
