#!/usr/bin/env python3
"""Checks stability certificates: verify_certificate.py FILE.json ... (exit code 0: all hold, 1: one does not).

Recomputes each one from the names of scheme, kernel and ratio in exact fractions. docs/proved.md explains it."""
import json, sys
from fractions import Fraction as F
from math import comb, isqrt, lcm

SLACK = F(1, 2**260)  # relative error granted to a weight of the Gaussian; it is computed to 2^-300
SPLINE = {"cubic-spline": (4, [1, -4]), "quartic-spline": (5, [1, -5, 10]), "quintic-spline": (6, [1, -6, 15])}
WENDLAND = {"wendland-c2": (F(5, 8), 3, [4, -3]), "wendland-c4": (F(3, 4), 5, [14, -21, 8]),
            "wendland-c6": (F(55, 64), 7, [48, -108, 82, -21])}

def require(holds, otherwise):
    if not holds: raise ValueError(otherwise)

def number(text):
    value = F(text)
    require(str(value) == text, f"{text} is not in lowest terms")
    return value

def gaussian(x, bits=320):  # exp(-x)/sqrt(pi) by the exponential series and Gauss's arctangents
    one, n, total = 2**bits, 0, 0
    term = one
    while n <= 9 or abs(term) > 1:
        total, n = total + term, n + 1
        term = -term * x.numerator // (x.denominator * n)
    atan = lambda m: sum((-1)**k * (one // (m**(2*k + 1) * (2*k + 1))) for k in range(130))
    return F(total * isqrt(2**(3*bits) // (48*atan(18) + 32*atan(57) - 20*atan(239))), 2**(2*bits))

def scheme(name, kernel, l):  # {power of C: {offset: (coefficient, error)}}, then errors of even and odd parts
    terms = []  # the kernel is the sum of a (b - q)^p over b > q
    if kernel in SPLINE:
        n, factors = SPLINE[kernel]
        terms = [(F(a, [6, 24, 120][n - 4]), F(n, 2) - k, n - 1) for k, a in enumerate(factors)]
    elif kernel in WENDLAND:
        norm, p, factors = WENDLAND[kernel]
        terms = [(norm * a / 2**(p + k), F(2), p + k) for k, a in enumerate(factors)]
    else: require(kernel == "gaussian", "unknown kernel")
    require(0 < l <= 50, "ratio out of range")
    slack, w, v = (F(0) if terms else SLACK), {}, {}
    for k in range(int(max([b for _, b, _ in terms], default=F(3)) * l) + 1):
        q = k / l
        w[k] = (sum(a * p * (b - q)**(p - 1) for a, b, p in terms if b > q) if terms else 2*q*gaussian(q*q)) / l**2
        v[k] = (sum(a * p * (p - 1) * (b - q)**(p - 2) for a, b, p in terms if b > q) if terms
                else (4*q*q - 2) * gaussian(q*q)) / l**3
    del w[0]
    error = slack * sum(w.values())
    if name == "godunov-sph":
        first = {0: (-2*sum(w.values()), 2*error), **{-k: (2*x, 2*x*slack) for k, x in w.items()}}
        return [{0: (F(1), F(0))}, first], [0, 4*error], [0, 2*error]
    require(name in ("euler-sph", "lax-wendroff-sph"), "unknown scheme")
    first = {s*k: (-s*x, x*slack) for k, x in w.items() for s in (1, -1)}
    second = {s*k: (x/2, abs(x)/2*slack) for k, x in v.items() for s in (1, -1)} if name[0] == "l" else {}
    return [{0: (F(1), F(0))}, first, second], [0, 0, sum(e for _, e in second.values())], [0, 2*error, 0]

def bernstein(values, a, b):  # positive multiples of the Bernstein coefficients on [a, b]
    d = lcm(a.denominator, b.denominator)
    start, width, shifted = int(a*d), int((b - a)*d), []
    for i, value in enumerate(reversed(values)):
        shifted = [x*start + y*width for x, y in zip(shifted + [0], [0] + shifted)]
        shifted[0] += value * d**i
    n = len(values) - 1
    result = []
    for value in shifted:
        result = [x + y for x, y in zip(result + [0], [0] + result)]
        result[-1] += value
    return result

def signs(values): return "".join("-0+"[(x > 0) - (x < 0) + 1] for x in values)
def times(p, q):
    r = [F(0)] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q): r[i + j] += x*y
    return r
def covers(boxes, a, b):
    ends = [a] + [number(box["to"]) for box in boxes]
    return boxes and ends[-1] == b and ends == sorted(set(ends)) and all(number(box["from"]) == x for box, x in zip(boxes, ends))

def verify(c):
    symbol, proof, radii = c["symbol"], c["proof"], []
    stencils = [({s["lowest"] + i: number(x) for i, x in enumerate(s["coefficients"])},
                 {s["lowest"] + i: number(x) for i, x in enumerate(s["radius"])}) for s in symbol["stencils"]]
    radii = [[number(x) for x in symbol[key]] for key in ("even_radius", "odd_radius")]
    for s, (a, r), even, odd in zip(symbol["stencils"], stencils, *radii, strict=True):
        require(len(s["coefficients"]) == len(s["radius"]) and all(0 <= x <= even + odd for x in r.values())
                and 0 <= even <= sum(r.values()) and 0 <= odd <= sum(r.values()), "the radii contradict each other")
    exact = not any(map(any, radii))
    require(c["evidence"] == ("proved" if exact else "enclosed"), "the evidence does not match the radii")
    keeps = all(sum(a.values()) == (j == 0) for j, (a, r) in enumerate(stencils))
    require(symbol["keeps_constants"] == keeps or (keeps and not exact), "keeps_constants is wrong")
    if c["subject"] is not None:
        name, kernel = c["subject"]["scheme"], c["subject"]["kernel"]
        powers, *slack = scheme(name, kernel, number(c["subject"]["ratio"]))
        require(exact or symbol["keeps_constants"] == (name != "lax-wendroff-sph"), "keeps_constants is wrong")
        for j in range(max(len(powers), len(stencils))):
            (a, r), mine = stencils[j] if j < len(stencils) else ({}, {}), powers[j] if j < len(powers) else {}
            gap = lambda k: a.get(k, 0) - mine.get(k, (0, 0))[0]
            offsets = {s*k for k in [*a, *mine] for s in (1, -1)}
            require(all(abs(gap(k)) + mine.get(k, (0, 0))[1] <= r.get(k, 0) for k in offsets), "wrong coefficient")
            for sign, radius, extra in zip((1, -1), radii, slack):
                error = sum(abs(gap(k) + sign*gap(-k)) for k in offsets) / 2 + (extra[j] if j < len(extra) else 0)
                require(error <= (radius[j] if j < len(radius) else 0), "the radii are too small")
    limit = proof["limit"]
    lower, upper = number(limit["lower"]), limit["upper"] and number(limit["upper"])
    stride = proof["margin"]["stride"] if proof["question"] == "stability" else 1
    require(stride in (1, 2) and (upper is None or 0 <= upper - lower <= lower / 2**20), "the ends are far apart")
    reading = None
    if lower == upper:
        root = F(isqrt(lower.numerator), isqrt(lower.denominator))
        reading = str(lower) if stride == 1 else str(root) if root**2 == lower else f"sqrt({lower})"
    require(limit["courant_number"] == reading, "the closed form is not that of the limit")
    near = lambda x: x > upper and x <= upper + (upper or 1) / 2**18
    if proof["question"] == "monotonicity":
        offsets = {k for a, r in stencils for k in a if a[k] or r[k]}
        row = lambda k, sign: [a.get(k, F(0)) + sign * r.get(k, F(0)) for a, r in stencils]
        whole = lambda values: [int(x * lcm(*(y.denominator for y in values))) for x in values]
        require(not lower or sorted(offsets) == sorted(x["offset"] for x in proof["coefficients"]), "offsets")
        require(lower or not proof["coefficients"], "a limit of 0 leaves nothing to cover")
        for each in proof["coefficients"]:
            require(covers(each["boxes"], F(0), lower), "the boxes do not cover the interval")
            for box in each["boxes"]:
                found = signs(bernstein(whole(row(each["offset"], -1)), number(box["from"]), number(box["to"])))
                require(box["signs"] == [found] and "-" not in found, "a box has other signs than stated")
        require((proof["binding"] is None) == (upper is None), "an upper end comes with a binding coefficient")
        if upper is not None:
            to = number(proof["binding"]["to"])
            found = signs(bernstein(whole(row(proof["binding"]["offset"], 1)), upper, to)) if near(to) else "+"
            require("+" not in found and "-" in found, "the binding coefficient is not negative above the limit")
        return
    require(proof["question"] == "stability", "unknown question")
    m, growth = proof["margin"], number(proof["growth"])
    require(growth >= 0, "negative growth")
    # (1 + growth)^2 - |g|^2 in powers of C and s = (1 - cos phi)/2, with cos(m phi) = T_m(1 - 2s)
    common = lcm(*(x.denominator for a, _ in stencils for x in a.values()))
    terms = [(j, k, int(x * common)) for j, (a, _) in enumerate(stencils) for k, x in a.items()]
    low, high = (f(k for _, r in stencils for k in [0, *r]) for f in (min, max))
    cosines = [[0] * (high - low + 1) for _ in range(2*len(stencils) - 1)]
    for i, k, x in terms:
        for j, l, y in terms: cosines[i + j][abs(k - l)] += x*y
    chebyshev = [[1], [1, -2]]
    while len(chebyshev) <= high - low:
        p, q = chebyshev[-1], chebyshev[-2] + [0, 0]
        chebyshev.append([2*x - 4*y - z for x, y, z in zip(p + [0], [0] + p, q)])
    margin = [[F(-sum(r * t[i] for r, t in zip(row, chebyshev) if i < len(t)), common**2)
               for i in range(high - low + 1)] for row in cosines]
    margin[0][0] += (1 + growth)**2
    # the stated factors
    rows, denominator = [[number(x) for x in row] for row in m["coefficients"]], number(m["denominator"])
    radius, neutral = [number(x) for x in m["radius"]], [number(x) for x in m["neutral_waves"]]
    require(all(x.denominator == 1 for x in sum(rows, [denominator] + radius)) and denominator > 0
            and len({len(row) for row in rows}) == 1 and len(rows) == len(radius) and any(neutral), "shape")
    factor = [F(0)] * m["phase_power"] + [F(1)]
    for p in [[F(1), F(-1)]] * m["complement_power"] + [neutral, neutral]: factor = times(factor, p)
    stated = {m["courant_power"] + stride*j: times(factor, row) for j, row in enumerate(rows)}
    require(max(stated) < len(margin), "too many powers of C")
    for j, row in enumerate(margin):
        left = [x / denominator for x in stated.get(j, [])]
        size = max(len(left), len(row))
        require(left + [0]*(size - len(left)) == row + [0]*(size - len(row)), "the factors do not multiply to the margin")
    require(exact or (not m["complement_power"] and len(neutral) == 1 and (not m["phase_power"] or (
        m["phase_power"] == 1 and symbol["keeps_constants"] and not growth))), "a factor that the true symbol need not have")
    bounds = [F(0)] * len(margin)
    for sign, r in zip((1, -1), radii):
        norm = [sum(abs(a.get(k, 0) + sign*a.get(-k, 0)) for k in {s*k for k in a for s in (1, -1)}) / 2 for a, _ in stencils]
        for i in range(len(r)):
            for j in range(len(r)): bounds[i + j] += norm[i]*r[j] + norm[j]*r[i] + r[i]*r[j]
    stretch = 2*(high - low)**2 if m["phase_power"] else 1
    declared = {m["courant_power"] + stride*j: x for j, x in enumerate(radius)}
    for j, bound in enumerate(bounds):
        require(declared.get(j, 0) == -(-bound*denominator // 1) * stretch, "the radii do not follow from the symbol")
    moved = lambda sign: [[int(row[0] + sign*r), *map(int, row[1:])] for row, r in zip(rows, radius)]
    start = number(proof["from"])
    if lower:
        require(0 <= start < lower and covers(proof["boxes"], F(0), F(1)), "the boxes do not cover all waves")
        for box in proof["boxes"]:
            in_s = [bernstein(row, number(box["from"]), number(box["to"])) for row in moved(-1)]
            found = [signs(row) for row in zip(*(bernstein(list(column), start, lower) for column in zip(*in_s)))]
            require(box["signs"] == found and "-" not in "".join(found), "a box has other signs than stated")
    else: require(not start and not proof["boxes"], "a limit of 0 leaves nothing to cover")
    claim = proof["unstable"]
    require((claim is None) == (upper is None), "an upper end comes with a growing wave")
    if claim is not None:
        s, witness, beyond = number(claim["s"]), number(claim["witness_s"]), number(claim["witness_courant_number"])**stride
        at = lambda s: [sum(x * s**i for i, x in enumerate(row)) * s.denominator**len(row) for row in moved(1)]
        require(number(claim["witness_courant_number"]) > 0 and near(beyond) and 0 <= s <= 1, "not just above the limit")
        found = signs(bernstein([int(x) for x in at(s)], upper, beyond))
        require("+" not in found and "-" in found, "the wave at s does not grow throughout")
        require(0 < witness <= 1 and (witness < 1 or not m["complement_power"]) and sum(x * witness**i for i, x in
                enumerate(neutral)) and sum(x * beyond**j for j, x in enumerate(at(witness))) < 0, "the witness does not grow")

if __name__ == "__main__":
    failed = 0
    for path in sys.argv[1:]:
        try:
            with open(path) as file: content = json.load(file)
            require(content["schema"] == "courant.certificate/1", "not a file of certificates")
            require(content["certificates"], "the file holds no certificate")
            for index, certificate in enumerate(content["certificates"]):
                try: verify(certificate)
                except Exception as error: raise ValueError(f"certificate {index}: {error}") from error
            print(f"{path}: {len(content['certificates'])} certificates hold")
        except Exception as error:
            failed = 1
            print(f"{path}: {error}", file=sys.stderr)
    sys.exit(failed if sys.argv[1:] else 2)
