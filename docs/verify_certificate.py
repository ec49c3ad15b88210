"""Checks certificates: python3 verify_certificate.py FILE.json ...; exit code 0 when all of them hold, 1 otherwise.
That each limit follows from the coefficients is shown here, in exact fractions; that these are the coefficients of
the scheme that is named, in certificate_coefficients.py. docs/proved.md explains every step."""
import json, sys
from fractions import Fraction as F
from itertools import zip_longest
from math import ceil, isqrt, lcm
from certificate_coefficients import check, check_coefficients, number, numbers

def bernstein(p, a, b):  # positive multiples of the Bernstein coefficients of p(a + (b - a)u)
    d, q, r = lcm(a.denominator, b.denominator), [], []
    for i, value in enumerate(reversed(p)):  # Horner's rule, then u^i = u^i (u + (1 - u))^(n-i)
        q = [x*int(a*d) + y*int((b - a)*d) for x, y in zip(q + [0], [0] + q)]
        q[0] += value * d**i
    for value in q:
        r = [x + y for x, y in zip(r + [0], [0] + r)]
        r[-1] += value
    return "".join("-0+"[(x > 0) - (x < 0) + 1] for x in r), r

def check_cover(boxes, a, b, signs):  # side by side from a to b, the signs as stated and none negative
    ends = [a] + [number(box["to"]) for box in boxes]
    check(boxes and ends[-1] == b and all(number(x["from"]) == e < number(x["to"]) for x, e in zip(boxes, ends)), "no cover")
    for box in boxes:
        found = signs(number(box["from"]), number(box["to"]))
        check(box["signs"] == found and "-" not in "".join(found), "a box has other signs than stated")

def check_monotonicity(c, proof, lower, upper):
    stencils, at = c["symbol"]["stencils"], lambda x, k: number(x[k]) if 0 <= k < len(x) else F(0)
    def row(k, side):  # the coefficient at offset k in powers of C, moved by its radius; whole numbers
        p = [at(s["coefficients"], k - s["lowest"]) + side * at(s["radius"], k - s["lowest"]) for s in stencils]
        return [int(x * lcm(*(y.denominator for y in p))) for x in p]
    offsets = [k for k in range(-1000, 1001) if any(row(k, 1)) or any(row(k, -1))]
    check([x["offset"] for x in proof["coefficients"]] == (offsets if lower else []), "other offsets than expected")
    for x in proof["coefficients"]: check_cover(x["boxes"], F(0), lower, lambda a, b: [bernstein(row(x["offset"], -1), a, b)[0]])
    if upper is not None:
        binding, to = proof["binding"]["offset"], number(proof["binding"]["to"])
        check(upper < to <= upper + (upper or 1) / 2**18 and binding == next(k for k in offsets
              if set(bernstein(row(k, 1), upper, to)[0]) in ({"-"}, {"-", "0"})), "another coefficient binds")

def check_stability(c, proof, m, lower, upper):
    symbol, growth, stride, h = c["symbol"], number(proof["growth"]), m["stride"], numbers(m["neutral_waves"])
    rows, radius, scale = [numbers(row) for row in m["coefficients"]], numbers(m["radius"]), number(m["denominator"])
    check(growth >= 0 and scale > 0 and any(h) and len({len(row) for row in rows}) == 1 and len(rows) == len(radius)
          and all(x.denominator == 1 for x in sum(rows, radius + [scale])) and 1 <= stride <= min(2, len(rows)), "no margin")
    check(any(map(any, rows)) or (scale, h, m["phase_power"] + m["complement_power"] + m["courant_power"]) == (1, [1], 0), "factors of zero")
    # (1 + growth)^2 - |g|^2 in powers of C and of s = (1 - cos phi)/2: cos((k - l) phi) = T_(k-l)(1 - 2s)
    stencils = [dict(enumerate(numbers(s["coefficients"]), s["lowest"])) for s in symbol["stencils"]]
    common = lcm(*(x.denominator for a in stencils for x in a.values()))
    terms = [(j, k, int(x * common)) for j, a in enumerate(stencils) for k, x in a.items()]
    n = max(k for _, k, _ in terms) - min(k for _, k, _ in terms)
    cosines = [[0]*(n + 1) for _ in range(2*len(stencils) - 1)]
    for i, k, x in terms:
        for j, l, y in terms: cosines[i + j][abs(k - l)] += x*y
    chebyshev = [[1], [1, -2]]
    for p, q in ((chebyshev[-1], chebyshev[-2]) for _ in range(n)):
        chebyshev.append([2*x - 4*y - z for x, y, z in zip(p + [0], [0] + p, q + [0, 0])])
    margin = [[(1 + growth)**2 * (i + j == 0) - F(sum(x * p[i] for x, p in zip(row, chebyshev) if i < len(p)), common**2)
               for i in range(n + 1)] for j, row in enumerate(cosines)]
    def times(p, q): return [sum(p[i] * q[k - i] for i in range(len(p)) if 0 <= k - i < len(q)) for k in range(len(p) + len(q) - 1)]
    factor = [F(0)]*m["phase_power"] + [F(1)]
    for p in [[F(1), F(-1)]]*m["complement_power"] + [h, h]: factor = times(factor, p)
    stated = {m["courant_power"] + stride*j: [x / scale for x in times(factor, row)] for j, row in enumerate(rows)}
    check(max(stated) < len(margin) and all(a == b for j, row in enumerate(margin) for a, b in zip_longest(
        stated.get(j, []), row, fillvalue=0)), "the factors do not multiply to (1 + growth)^2 - |g|^2")
    # how far |g|^2 may be off, from |ab - a'b'| <= |a|r + |b|q + qr for its even and its odd part
    errors, exact = [F(0)]*len(margin), c["evidence"] == "proved"
    for sign, r in ((1, numbers(symbol["even_radius"])), (-1, numbers(symbol["odd_radius"]))):
        norm = [sum(abs(a.get(k, 0) + sign*a.get(-k, 0)) for k in {s*k for k in a for s in (1, -1)})/2 for a in stencils]
        for i in range(len(r)):
            for j in range(len(r)): errors[i + j] += norm[i]*r[j] + norm[j]*r[i] + r[i]*r[j]
    stretch, declared = 2*n*n if m["phase_power"] else 1, dict(zip(stated, radius))  # |1 - cos k phi| <= 2 k^2 s
    check(all(declared.get(j, 0) == ceil(e * scale) * stretch for j, e in enumerate(errors)), "the radii do not follow")
    check(exact or m["complement_power"] == 0 and len(h) == 1 and m["phase_power"] <= (symbol["keeps_constants"]
          and growth == 0), "a factor was taken out that the true coefficients need not have")
    moved = lambda sign: [[int(row[0] + sign*r), *map(int, row[1:])] for row, r in zip(rows, radius)]
    def at(s): return [sum(int(x * s**i * s.denominator**len(row)) for i, x in enumerate(row)) for row in moved(1)]
    def grows(wave):
        s, t = number(wave["s"]), number(wave["courant_number"])**stride
        check(number(wave["courant_number"]) > 0 and 0 < s <= 1 and (s < 1 or not m["complement_power"]) and sum(x * s**i
              for i, x in enumerate(h)) and sum(x * t**j for j, x in enumerate(at(s))) < 0, "the witness does not grow")
        return t
    start, lowered = number(proof["from"]), moved(-1)
    def signs(a, b):  # over reached <= t <= to
        columns = zip(*(bernstein(row, a, b)[1] for row in lowered))
        return list(map("".join, zip(*(bernstein(list(column), reached, to)[0] for column in columns))))
    check(0 <= start < lower if lower else not start and not proof["pieces"], "the interval has no length")
    reached = start
    for piece in proof["pieces"]:
        to = number(piece["to"])
        check(reached < to, "the pieces do not follow each other")
        check_cover(piece["boxes"], F(0), F(1), signs)
        reached = to
    check(reached == lower, "the pieces do not reach the limit")
    check((proof["below"] is None) == (start == 0) and (proof["unstable"] is None) == (upper is None), "a witness is missing")
    if start: check(start - start/2**18 <= grows(proof["below"]) < start, "not just below the interval")
    if upper is not None:
        beyond, s = grows(proof["unstable"]["witness"]), number(proof["unstable"]["s"])
        check(upper < beyond <= upper + (upper or 1)/2**18 and 0 <= s <= min(1, len(rows[0]) - 1), "not just above the limit")
        check(set(bernstein(at(s), upper, beyond)[0]) in ({"-"}, {"-", "0"}), "the wave at s does not grow throughout")

def verify(c):
    check_coefficients(c)
    proof, limit = c["proof"], c["proof"]["limit"]
    lower, upper = number(limit["lower"]), None if limit["upper"] is None else number(limit["upper"])
    margin = proof.get("margin", {"stride": 1})
    check(lower >= 0 and (upper is None or 0 <= upper - lower <= lower/2**20), "the ends of the limit are far apart")
    root = F(isqrt(lower.numerator), isqrt(lower.denominator))
    closed = str(lower) if margin["stride"] == 1 else str(root) if root**2 == lower else f"sqrt({lower})"
    check(limit["courant_number"] == (closed if lower == upper else None), "the closed form is not that of the limit")
    if proof["question"] == "stability": check_stability(c, proof, margin, lower, upper)
    else: check(proof["question"] == "monotonicity", "unknown question"); check_monotonicity(c, proof, lower, upper)

if __name__ == "__main__":
    for path in sys.argv[1:]:
        try:
            with open(path) as file: content = json.load(file)
            check(content["schema"] == "courant.certificate/1" and content["certificates"], "not a file of certificates")
            for certificate in content["certificates"]: verify(certificate)
        except Exception as error: sys.exit(f"{path}: {error!r}")
        print(f"{path}: {len(content['certificates'])} certificates hold")
