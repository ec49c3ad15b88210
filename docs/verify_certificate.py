"""Does each limit follow from the coefficients stated? python3 verify_certificate.py FILE.json ...
In exact fractions; docs/proved.md explains it. Whose coefficients they are: verify_coefficients.py."""
import json, math, sys
from fractions import Fraction as F

def check(holds, otherwise): holds or sys.exit(f"refused: {otherwise}")

def value(p, x): return sum(c * x**i for i, c in enumerate(p))

def bernstein(p, a, b):
    # (d + du)^n p(x) in powers of u, where x = (a + bu)/(1 + u): if none is negative, nor is p from a to b.
    d, result, power = math.lcm(a.denominator, b.denominator), [], [1]
    low, high = int(a*d), int(b*d)
    for c in reversed(p):
        result = [low*x + high*y + c*z for x, y, z in zip(result + [0], [0] + result, power)]
        power = [d*x + d*y for x, y in zip(power + [0], [0] + power)]
    return result

def turns_negative(p, limit, to):  # between the two, which are close
    return max(b := bernstein(p, limit, to)) <= 0 > min(b) and 0 < (to - limit) * 2**18 <= (limit or 1)

def steps(parts, start, end):  # each part begins where the one before it ends
    ends = [start, *(F(part["to"]) for part in parts)]
    check((parts or not end) and ends[-1] == end and ends == sorted(set(ends)), "an interval is not covered")
    return zip(parts, ends, ends[1:])

def check_cover(rows, boxes, s_end, t0, t1):  # rows[j] is the polynomial in s that stands at t^j
    for box, s0, s1 in steps(boxes, 0, s_end):
        columns = zip(*(bernstein(row, s0, s1) for row in rows), strict=True)
        table = zip(*(bernstein(column, t0, t1) for column in columns))
        signs = ["".join("-0+"[(x > 0) - (x < 0) + 1] for x in line) for line in table]
        check(F(box["from"]) == s0 and box["signs"] == signs and "-" not in str(signs), "a wrong box")

def monotonicity(stencils, proof, lower, upper):
    # c_k in powers of C, moved by its radii
    def moved(k, sign): return [x + sign*r for x, r in (s.get(k, (0, 0)) for s in stencils)]
    offsets = sorted(k for k in set().union(*stencils) if any(moved(k, 1) + moved(k, -1)))
    check([x["offset"] for x in proof["coefficients"]] == (offsets if lower else []), "other offsets")
    for x in proof["coefficients"]: check_cover([moved(x["offset"], -1)], x["boxes"], lower, 0, 1)
    if upper is not None:
        negative = [k for k in offsets if turns_negative(moved(k, 1), upper, F(proof["binding"]["to"]))]
        check(proof["binding"]["offset"] == negative[0], "another coefficient turns negative first")

def stability(stencils, proof, lower, upper):
    m, growth, start = proof["margin"], F(proof["growth"]), F(proof["from"])
    a, b, c, stride = (int(m[x]) for x in ("phase_power", "complement_power", "courant_power", "stride"))
    rows, radius = [[int(x) for x in row] for row in m["coefficients"]], [int(r) for r in m["radius"]]
    check(min(a, b, c, growth, start) >= 0 < F(m["denominator"]) and stride in (1, 2), "no margin")
    def factor(s): return s**a * (1 - s)**b * value(map(F, m["neutral_waves"]), s)**2 / F(m["denominator"])
    def at(s, sign): return [value(row, s) + sign*r for row, r in zip(rows, radius, strict=True)]
    def g(z): return [sum(x * z**k for k, (x, _) in s.items()) for s in stencils]
    # |g|^2 = g(z) g(1/z) for z = e^(i phi). Both sides are polynomials in s = (2 - z - 1/z)/4 and C: they are
    # equal if they agree at more values of each than the degree, whatever the values are.
    offsets, degree = set().union(*stencils), a + b + 2*len(m["neutral_waves"]) + max(map(len, rows))
    for z in map(F, range(1, 2 + max(degree, max(offsets) - min(offsets)))):
        wave, conjugate, s = g(z), g(1/z), (2 - z - 1/z) / 4
        for courant in range(max(2*len(stencils), c + stride*len(rows))):
            product = factor(s) * courant**c * value(at(s, 0), courant**stride)
            check((1 + growth)**2 - value(wave, courant) * value(conjugate, courant) == product, "factors")
    lowered = [[p[0] - r, *p[1:]] for p, r in zip(rows, radius)]
    for piece, t0, t1 in steps(proof["pieces"], start, lower): check_cover(lowered, piece["boxes"], 1, t0, t1)
    def grows(wave):
        s, courant = F(wave["s"]), F(wave["courant_number"])
        check(courant > 0 < s <= 1 and value(at(s, 1), courant**stride) < 0 < factor(s), "no growing wave")
        return courant**stride
    if start: check(0 < (start - grows(proof["below"])) * 2**18 <= start, "not just below the interval")
    if upper is not None:
        s, to = F(proof["unstable"]["s"]), grows(proof["unstable"]["witness"])
        check(0 <= s <= 1 and turns_negative(at(s, 1), upper, to), "the wave at s does not grow throughout")

def verify(certificate):
    proof, limit = certificate["proof"], certificate["proof"]["limit"]
    lower, upper = F(limit["lower"]), limit["upper"] and F(limit["upper"])
    root = F(math.isqrt(lower.numerator), math.isqrt(lower.denominator))
    squared = int(proof.get("margin", {"stride": 1})["stride"]) == 2
    closed = str(lower) if not squared else str(root) if root**2 == lower else f"sqrt({lower})"
    check(limit["courant_number"] == (closed if lower == upper else None), "not the closed form")
    stencils = [dict(enumerate(zip(map(F, s["coefficients"]), map(F, s["radius"]), strict=True), s["lowest"]))
                for s in certificate["symbol"]["stencils"]]
    {"stability": stability, "monotonicity": monotonicity}[proof["question"]](stencils, proof, lower, upper)

if __name__ == "__main__":
    for path in sys.argv[1:] or sys.exit(__doc__):
        print(end=f"{path}: ", flush=True)
        with open(path) as file: certificates = json.load(file)["certificates"]
        for certificate in certificates: verify(certificate)
        print(len(certificates), "limits follow from the coefficients stated")
