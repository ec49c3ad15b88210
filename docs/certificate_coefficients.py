"""The coefficients of a scheme from the names of scheme, kernel and ratio, and whether a certificate states them."""
from fractions import Fraction as F
from math import isqrt

SPLINES = {"cubic-spline": (4, 6, [1, -4]), "quartic-spline": (5, 24, [1, -5, 10]), "quintic-spline": (6, 120, [1, -6, 15])}
WENDLAND = {"wendland-c2": (F(5, 8), 3, [4, -3]), "wendland-c4": (F(3, 4), 5, [14, -21, 8]),
            "wendland-c6": (F(55, 64), 7, [48, -108, 82, -21])}

def check(holds, otherwise):
    if not holds: raise ValueError(otherwise)

def number(text):  # a number has one spelling
    check(isinstance(text, str) and str(F(text)) == text, f"{text!r} is not a fraction in lowest terms")
    return F(text)

def numbers(texts): return [number(text) for text in texts]

def gaussian(x, one=2**320):  # exp(-x)/sqrt(pi): the exponential series and Gauss's arctangents, off by less than 2^-290
    total, term, n = 0, one, 0
    while n <= 9 or abs(term) > 1: total, n, term = total + term, n + 1, -term * x.numerator // (x.denominator * (n + 1))
    arctan = lambda m: sum((-1)**k * (one // (m**(2*k + 1) * (2*k + 1))) for k in range(130))
    return F(total * isqrt(one**3 // (48*arctan(18) + 32*arctan(57) - 20*arctan(239))), one**2)

def weights(kernel, l):  # {k: w_k}, {k: v_k} and their relative error
    terms = []  # a polynomial kernel is the sum of a (b - q)^p over the b above q
    if kernel in SPLINES:
        order, factorial, factors = SPLINES[kernel]
        terms = [(F(a, factorial), F(order, 2) - k, order - 1) for k, a in enumerate(factors)]
    elif kernel in WENDLAND:
        norm, lowest, factors = WENDLAND[kernel]
        terms = [(norm * a / 2**p, F(2), p) for p, a in enumerate(factors, lowest)]
    else: check(kernel == "gaussian", "unknown kernel")
    check(0 < l <= 50, "the ratio is out of range")
    w, v = {}, {}
    for k in range(int(max([b for _, b, _ in terms], default=3) * l) + 1):
        q = k / l
        shape = 0 if terms else gaussian(q*q)
        w[k] = (2*q*shape + sum(a * p * (b - q)**(p - 1) for a, b, p in terms if b > q)) / l**2
        v[k] = ((4*q*q - 2)*shape + sum(a * p * (p - 1) * (b - q)**(p - 2) for a, b, p in terms if b > q)) / l**3
    return {k: x for k, x in w.items() if k}, v, F(0) if terms else F(1, 2**260)

def coefficients(scheme, w, v, slack):  # [{offset: (value, error)}] by power of C; errors of the even and the odd parts
    error = slack * sum(w.values())
    if scheme == "godunov-sph":
        first = {0: (-2*sum(w.values()), 2*error), **{-k: (2*x, 2*x*slack) for k, x in w.items()}}
        return [{0: (F(1), F(0))}, first], [0, 4*error], [0, 2*error]
    check(scheme in ("euler-sph", "lax-wendroff-sph"), "unknown scheme")
    first = {s*k: (-s*x, x*slack) for k, x in w.items() for s in (1, -1)}
    second = {s*k: (x/2, abs(x)/2*slack) for k, x in v.items() for s in (1, -1)} if scheme == "lax-wendroff-sph" else {}
    return [{0: (F(1), F(0))}, first, second], [0, 0, sum(e for _, e in second.values())], [0, 2*error, 0]

def check_coefficients(c):
    symbol, subject = c["symbol"], c["subject"]
    even, odd = numbers(symbol["even_radius"]), numbers(symbol["odd_radius"])
    check(len(even) == len(odd) == len(symbol["stencils"]) > 0, "two radii for each power of C")
    stencils, exact = [], not any(even + odd)
    for stencil, e, o in zip(symbol["stencils"], even, odd):
        a, r = numbers(stencil["coefficients"]), numbers(stencil["radius"])
        check(len(a) == len(r) and all(0 <= x <= e + o for x in r) and 0 <= e <= sum(r) and 0 <= o <= sum(r), "radii")
        stencils.append({k: (x, y) for k, (x, y) in enumerate(zip(a, r), stencil["lowest"])})
    keeps = all(sum(x for x, _ in a.values()) == (j == 0) for j, a in enumerate(stencils))
    check(symbol["keeps_constants"] is keeps or keeps and not exact, "keeps_constants is stated wrongly")
    check(c["evidence"] == ("proved" if exact else "enclosed"), "the evidence is not the one the radii give")
    if subject is None: return
    check(exact or symbol["keeps_constants"] is (subject["scheme"] != "lax-wendroff-sph"), "keeps_constants is stated wrongly")
    expected, *slacks = coefficients(subject["scheme"], *weights(subject["kernel"], number(subject["ratio"])))
    at = lambda x, j, default: x[j] if j < len(x) else default
    for j in range(max(len(expected), len(stencils))):
        a, mine = at(stencils, j, {}), at(expected, j, {})
        offsets = {s*k for k in [*a, *mine] for s in (1, -1)}
        gap = {k: a.get(k, (0, 0))[0] - mine.get(k, (0, 0))[0] for k in offsets}
        check(all(abs(gap[k]) + mine.get(k, (0, 0))[1] <= a.get(k, (0, 0))[1] for k in offsets), "not the named scheme")
        for sign, radius, slack in zip((1, -1), (even, odd), slacks):
            error = sum(abs(gap[k] + sign*gap[-k]) for k in offsets)/2 + at(slack, j, 0)
            check(error <= at(radius, j, 0), "the radii do not cover the named scheme")
