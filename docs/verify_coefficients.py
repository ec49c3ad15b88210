"""Are the coefficients those of the scheme that is named? python3 verify_coefficients.py FILE.json ...

A certificate states the stencils of a scheme and how far each number may be off. Here they are derived again
from the names of scheme, kernel and ratio, and the radii are carried over to the polynomial that decides. The
form of the file is checked as well: everything in it has one spelling. That the limits follow is for
verify_certificate.py to say; docs/proved.md explains both.
"""
import json
import re
import sys
from fractions import Fraction
from itertools import zip_longest
from math import ceil, isqrt

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
GAUSSIAN_ERROR = Fraction(1, 2**260)  # relative; `gaussian` is far closer


def check(holds, otherwise):
    if not holds:
        sys.exit(f"refused: {otherwise}")


def numbers(texts):
    return [Fraction(text) for text in texts]


def gaussian(x, one=2**320):
    """exp(-x)/sqrt(pi) for 0 <= x <= 9, in steps of 1/one."""
    total, term, n = 0, one, 0
    while n <= 9 or abs(term) > 1:  # the exponential series
        total += term
        n += 1
        term = -term * x.numerator // (x.denominator * n)

    def arctan_of_inverse(m):
        return sum((-1)**k * (one // (m**(2*k + 1) * (2*k + 1))) for k in range(130))

    pi = 48*arctan_of_inverse(18) + 32*arctan_of_inverse(57) - 20*arctan_of_inverse(239)  # Gauss
    return Fraction(total * isqrt(one**3 // pi), one**2)


def weights(kernel, ratio):
    """-W'(k)/l^2 for k >= 1 and W''(k)/l^3 for k >= 0 by lattice distance k, and their relative error."""
    terms = TRUNCATED_POWERS.get(kernel)
    check(terms or kernel == "gaussian", f"there is no kernel {kernel!r}")
    check(0 < ratio <= 50, "the ratio is not in (0, 50]")
    support = max(b for _, b, _ in terms) if terms else GAUSSIAN_SUPPORT
    slopes, curvatures = {}, {}
    for k in range(int(support * ratio) + 1):
        q = k / ratio
        if terms:
            inside = [(a, b - q, p) for a, b, p in terms if b > q]
            slope = sum(a * p * rest**(p - 1) for a, rest, p in inside)
            curvature = sum(a * p * (p - 1) * rest**(p - 2) for a, rest, p in inside)
        else:
            shape = gaussian(q * q)
            slope, curvature = 2*q*shape, (4*q*q - 2)*shape
        if k > 0:
            slopes[k] = slope / ratio**2
        curvatures[k] = curvature / ratio**3
    return slopes, curvatures, Fraction(0) if terms else GAUSSIAN_ERROR


def derived_stencils(scheme, kernel, ratio):
    """By power of C: {offset: (coefficient, error)}, and the errors of the even and of the odd part."""
    w, v, slack = weights(kernel, ratio)
    total = sum(w.values())
    one = {0: (Fraction(1), Fraction(0))}
    if scheme == "godunov-sph":
        upwind = {0: (-2*total, 2*total*slack)}
        upwind.update({-k: (2*x, 2*x*slack) for k, x in w.items()})
        return [one, upwind], [0, 4*total*slack], [0, 2*total*slack]
    central = {sign*k: (-sign*x, x*slack) for k, x in w.items() for sign in (1, -1)}
    if scheme == "euler-sph":
        return [one, central], [0, 0], [0, 2*total*slack]
    check(scheme == "lax-wendroff-sph", f"there is no scheme {scheme!r}")
    second = {sign*k: (x/2, abs(x)/2*slack) for k, x in v.items() for sign in (1, -1)}
    return [one, central, second], [0, 0, sum(e for _, e in second.values())], [0, 2*total*slack, 0]


def check_stencils(certificate):
    """The three kinds of radii agree, evidence and keeps_constants follow; gives stencils and radii."""
    symbol = certificate["symbol"]
    even, odd = numbers(symbol["even_radius"]), numbers(symbol["odd_radius"])
    check(len(even) == len(odd) == len(symbol["stencils"]) > 0, "a symbol has two radii for each power of C")
    stencils = []
    for stencil, e, o in zip(symbol["stencils"], even, odd):
        values, radii = numbers(stencil["coefficients"]), numbers(stencil["radius"])
        check(len(values) == len(radii), "a stencil has a radius for each coefficient")
        check(all(0 <= radius <= e + o for radius in radii) and 0 <= e <= sum(radii) and 0 <= o <= sum(radii),
              "the radii of a stencil contradict each other")
        stencils.append(dict(enumerate(zip(values, radii), stencil["lowest"])))
    exact = not any(even + odd)
    check(certificate["evidence"] == ("proved" if exact else "enclosed"), "the radii give other evidence")
    sums = [sum(value for value, _ in stencil.values()) for stencil in stencils]
    kept = sums == [1] + [0] * (len(sums) - 1)
    # Coefficients that are enclosed may miss a constant that their midpoints keep.
    check(symbol["keeps_constants"] is kept or kept and not exact, "keeps_constants is stated wrongly")
    return stencils, even, odd


def check_names(subject, keeps_constants, stencils, even, odd):
    """Every derived coefficient is within its stated radius, and so are the even and the odd part."""
    derived, even_errors, odd_errors = derived_stencils(
        subject["scheme"], subject["kernel"], Fraction(subject["ratio"]))
    if subject["kernel"] == "gaussian":
        kept = subject["scheme"] != "lax-wendroff-sph"
        check(keeps_constants is kept, "keeps_constants is stated wrongly")
    # A scheme without neighbours has fewer powers of C than its formula.
    columns = zip_longest(stencils, derived, even, odd, even_errors, odd_errors)
    for stated, expected, even_radius, odd_radius, even_error, odd_error in columns:
        stated, expected = stated or {}, expected or {}
        offsets = {sign*k for k in [*stated, *expected] for sign in (1, -1)}
        gap = {k: stated.get(k, (0, 0))[0] - expected.get(k, (0, 0))[0] for k in offsets}
        for k in offsets:
            check(abs(gap[k]) + expected.get(k, (0, 0))[1] <= stated.get(k, (0, 0))[1],
                  "a coefficient is not that of the named scheme")
        even_gap = sum((abs(gap[k] + gap[-k]) for k in offsets), Fraction(0)) / 2
        odd_gap = sum((abs(gap[k] - gap[-k]) for k in offsets), Fraction(0)) / 2
        check(even_gap + (even_error or 0) <= (even_radius or 0), "the even part is not that of the scheme")
        check(odd_gap + (odd_error or 0) <= (odd_radius or 0), "the odd part is not that of the scheme")


def check_radii_of_margin(margin, growth, keeps_constants, stencils, even, odd):
    """How far (1 + growth)^2 - |g|^2 may be off by power of C, and so the polynomial that is left of it."""
    # |g|^2 is the square of the even part plus the square of the odd part; |ab - a'b'| <= |a|r + |b|q + qr.
    errors = [Fraction(0)] * (2*len(stencils) - 1)
    for sign, radii in ((1, even), (-1, odd)):
        sizes = []
        for stencil in stencils:
            values = {k: value for k, (value, _) in stencil.items()}
            offsets = {s*k for k in values for s in (1, -1)}
            parts = (abs(values.get(k, 0) + sign*values.get(-k, 0)) for k in offsets)
            sizes.append(sum(parts, Fraction(0)) / 2)
        for i, r in enumerate(radii):
            for j, q in enumerate(radii):
                errors[i + j] += sizes[i]*q + sizes[j]*r + r*q
    if any(even + odd):
        # Only a factor that the true coefficients have too may be taken out: the s of kept constants.
        taken_out = margin["complement_power"] > 0 or len(margin["neutral_waves"]) > 1
        check(not taken_out and margin["phase_power"] <= (keeps_constants and growth == 0),
              "a factor was taken out that the true scheme need not have")
    # Dividing by s divides 1 - cos k phi, which is at most 2 k^2 s.
    offsets = [k for stencil in stencils for k in stencil]
    stretch = 2*(max(offsets) - min(offsets))**2 if margin["phase_power"] else 1
    first, stride = margin["courant_power"], margin["stride"]
    stated = {first + stride*j: Fraction(radius) for j, radius in enumerate(margin["radius"])}
    for power, error in enumerate(errors):
        check(stated.get(power, 0) == ceil(error * Fraction(margin["denominator"])) * stretch,
              "the radii of the polynomial do not follow from those of the coefficients")


def check_form_of_margin(margin, unstable):
    """Whole numbers in a rectangle, and no freedom where the polynomial leaves some."""
    rows, h = [numbers(row) for row in margin["coefficients"]], numbers(margin["neutral_waves"])
    powers = [margin[key] for key in ("phase_power", "complement_power", "courant_power", "stride")]
    check(all(type(power) is int and power >= 0 for power in powers), "a power is not a natural number")
    whole = sum(rows, numbers(margin["radius"])) + numbers([margin["denominator"]])
    check(all(x.denominator == 1 for x in whole), "the polynomial is not written in whole numbers")
    check(len({len(row) for row in rows}) == 1, "the rows of the polynomial differ in length")
    check(margin["stride"] == 1 or len(rows) > 1, "a single row has no stride")
    check(unstable is None or len(rows[0]) > 1 or unstable["s"] == "0", "s plays no role")
    check(h and h[-1] > 0, "of H and -H, whose squares agree, the one with a positive leading coefficient")
    trivial = sum(powers) == margin["stride"] and h == [1] and margin["denominator"] == "1"
    check(any(map(any, rows)) or trivial, "a polynomial that is zero has no factors")


def check_spelling(value, key=None):
    """Every number that is text is in lowest terms, wherever it stands."""
    if isinstance(value, dict):
        for key, entry in value.items():
            check_spelling(entry, key)
    elif isinstance(value, list):
        for entry in value:
            check_spelling(entry, key)
    elif isinstance(value, str) and key != "signs" and not re.fullmatch(r"[a-z][a-z0-9-]*|sqrt\(.*\)", value):
        check(str(Fraction(value)) == value, f"{value!r} is not a number in lowest terms")


def check_form(proof):
    """The limit is tight, and what may be absent is absent exactly where there is nothing to say."""
    limit, stability = proof["limit"], proof["question"] == "stability"
    if limit["upper"] is not None:
        lower, upper = numbers([limit["lower"], limit["upper"]])
        check(0 <= upper - lower <= lower / 2**20, "the ends of the limit are far apart")
    reason = proof["unstable" if stability else "binding"]
    check((reason is None) == (limit["upper"] is None), "an upper end comes with a reason")
    if stability:
        check((proof["below"] is None) == (proof["from"] == "0"), "a beginning above 0 comes with a reason")
        check_form_of_margin(proof["margin"], reason)


def verify(certificate):
    subject, proof, symbol = certificate["subject"], certificate["proof"], certificate["symbol"]
    check_spelling(certificate)
    check_form(proof)
    radii = check_stencils(certificate)
    if subject is not None:
        check_names(subject, symbol["keeps_constants"], *radii)
    if proof["question"] == "stability":
        check_radii_of_margin(proof["margin"], Fraction(proof["growth"]), symbol["keeps_constants"], *radii)


if __name__ == "__main__":
    for path in sys.argv[1:] or sys.exit(__doc__):
        print(end=f"{path}: ", flush=True)
        with open(path) as file:
            content = json.load(file)
        certificates = content["certificates"]
        check(content["schema"] == "courant.certificate/1" and certificates, "no certificates in it")
        for certificate in certificates:
            verify(certificate)
        print(len(certificates), "certificates state the coefficients of the schemes they name")
