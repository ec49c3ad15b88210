"""Are the polynomials those of the scheme in the text? python3 verify_coefficients.py FILE.json ...

A certificate states a scheme as equations, a kernel, an integrator and values, and functions of the wave and the sought
parameter C that must not be negative: polynomials in s = (1 - cos phi)/2, or cosine series in several phases. Here these are derived again: the equations are read
(scheme_text.py), completed by the integrator, the determinant chi(z) is taken, and the conditions of Schur and Cohn or
Jury for its roots to lie in the unit disc (or, for monotonicity, its coefficients) are held against the certificate.
That the limits follow is for verify_certificate.py to say; docs/proved.md explains both.
"""
from fractions import Fraction

from certificate_form import CERTIFICATE, check, main
from scheme_text import (BITS, ONE, ROOM, Lattice, Letters, Parser, Poly, Reader, linear_equations, number, packed, times,
                         unpacked, whole_row)

Z = Poly({(1, 0, 0, ()): 1})


# Matrices are lists of rows.

def without_units(matrix, columns):
    """Solves equations for the unknowns `columns` where one stands with a number times powers of z and E; gives the
    unknowns left. The determinant keeps its value up to such a factor."""
    left, columns = list(range(len(matrix[0]))), list(columns)
    while True:
        units = [((sum(map(bool, row)) - 1) * sum(bool(other[left.index(c)]) for other in matrix), i, c)
                 for i, row in enumerate(matrix) for c in columns if row[left.index(c)].is_unit()]
        if not units:
            return left
        _, i, c = min(units)
        place, pivot_row = left.index(c), matrix.pop(i)
        for number_of_row, row in enumerate(matrix):
            if row[place]:
                new = [x*pivot_row[place] - row[place]*y for x, y in zip(row, pivot_row)]
                matrix[number_of_row] = dict_row(new)
        for row in matrix + [left]:
            del row[place]
        columns.remove(c)


def dict_row(row):
    """Without the number that all entries share."""
    from math import gcd
    common = gcd(*(value for poly in row for value in poly.values()))
    return [Poly({key: value//common for key, value in poly.items()}) for poly in row] if common > 1 else row


def determinant(matrix):
    matrix = [list(row) for row in matrix]
    if len(matrix) > 1:
        without_units(matrix, range(len(matrix)))
    check(len(matrix) <= 12, "a determinant is too large")
    minors = {0: number(1)}  # by the set of columns, for as many rows from the top
    for row in matrix:
        new = {}
        for columns, minor in minors.items():
            for c, entry in enumerate(row):
                if entry and not columns >> c & 1:
                    odd = bin(columns >> c + 1).count("1") % 2
                    term = entry*minor
                    with_c = columns | 1 << c
                    new[with_c] = new.get(with_c, Poly()) + (-term if odd else term)
        minors = new
    return minors.get((1 << len(matrix)) - 1, Poly())


# The matrix of a scheme: one row for each equation, one column for each unknown.

def matrix_of(rows, unknowns):
    """Powers of z and E for the levels and offsets; a derivative counts as z."""
    parity = {}
    matrix = [[Poly() for _ in unknowns] for _ in rows]
    for row, target in zip(rows, matrix):
        for (unknown, time, space, derivative), poly in row.items():
            own = (time or 0) % 2, *(halves % 2 for halves in space)
            check(parity.setdefault(unknown, own) == own, "an unknown stands at whole and at half indices")
            z = (time or 0) // 2 if time is not None else int(derivative)
            target[unknown] = target[unknown] + poly.moved(z, packed(halves // 2 for halves in space))
    return matrix


def numbers(texts):
    reader = Reader(None, {}, None, True)
    found = []
    for text in texts:
        p, q = reader.evaluate(Parser(text).value()).get((None, None), (number(0), number(1)))
        found.append((p, q))
    return found


def weighted(pairs):
    """The sum of entries times fractions of polynomials, as one fraction."""
    from scheme_text import plus
    total = Poly(), number(1)
    for entry, (p, q) in pairs:
        total = plus(total, (entry*p, q))
    return total


def cleared(fractions):
    """A row of fractions of polynomials times their denominators."""
    denominators = []
    for _, q in fractions:
        if not q.is_number() and q not in denominators:
            denominators.append(q)
    row = {}
    for column, (p, q) in enumerate(fractions):
        for other in denominators:
            p = p if other == q else p*other
        row[column] = p if not q.is_number() else p.scaled(1 / Fraction(q[0, 0, 0, ()]))
    whole = whole_row(row)
    return [whole[column] for column in range(len(fractions))]


def complete(matrix, unknowns, integrator):
    """The matrix of M U' = L U with U' counted as z, completed by an integrator."""
    derived = [c for c in range(len(unknowns)) if any(z for row in matrix for z, *_ in row[c])]
    kept = without_units(matrix, [c for c in range(len(unknowns)) if c not in derived])
    check(kept == derived, "an unknown without a derivative is not given by an equation")
    part = [[entry.by_z() + [Poly(), Poly()] for entry in row] for row in matrix]
    mass, rates = ([[sign*1 and entry[power].scaled(sign) for entry in row] for row in part] for power, sign in ((1, 1), (0, -1)))
    (kind, table), size = next(iter(integrator.items())), len(derived)
    one, one_minus_z = (number(1), number(1)), number(1) - Z
    if kind == "multistep":
        alpha, beta = numbers(table["alpha"]), numbers(table["beta"])
        check(len(alpha) == len(beta) >= 2, "as many alpha as beta")
        return [cleared([weighted([(m.moved(k), a) for k, a in enumerate(alpha)] + [(-l.moved(k), b) for k, b in enumerate(beta)])
                         for m, l in zip(mass[i], rates[i])]) for i in range(size)]
    if kind == "runge-kutta":
        b, a = numbers(table["b"]), [numbers(row) for row in table["A"]]
        stages = len(b)
        check(stages == len(a) > 0 and all(len(row) <= stages for row in a), "no Butcher table")
        if size == 1:
            # One number lambda = L/M enters, here in the place of C.
            operator, none = Poly({(0, 0, 1, ()): 1}), number(0)
            mass, rates, ring = [[number(1)]], [[operator]], (mass[0][0], rates[0][0])
        zero = [(Poly(), number(1))]
        rows = []
        for u in range(size):
            row = zero * (size*(stages + 1))
            row[u] = weighted([(-one_minus_z, one)])
            for i in range(stages):
                row[size*(i + 1) + u] = weighted([(number(-1), b[i])])
            rows.append(cleared(row))
        for i in range(stages):
            for equation in range(size):
                row = zero * (size*(stages + 1))
                for u in range(size):
                    m, l = mass[equation][u], -rates[equation][u]
                    row[u] = l, number(1)
                    for j in range(stages):
                        entry = a[i][j] if j < len(a[i]) else (Poly(), number(1))
                        row[size*(j + 1) + u] = weighted([(m, one)] * (i == j) + [(l, entry)])
                rows.append(cleared(row))
        if size > 1:
            return rows
        whole, (m, l), total = determinant(rows), ring, Poly()
        degree = max(c for _, _, c, _ in whole)
        powers = {}
        for (z, e, c, letters), value in whole.items():
            if c not in powers:
                powers[c] = l**c * m**(degree - c)
            total = total + Poly({(z, e, 0, letters): value}) * powers[c]
        return [[total]]
    # Positions and velocities: x' = v, M v' = F x + D v.
    check(size == 2, "positions and velocities are two unknowns")
    found = [(row, x) for row, x in ((0, 0), (1, 1), (0, 1), (1, 0))
             if not mass[row][1 - x] and not rates[row][x] and not mass[1 - row][x]
             and mass[row][x] == rates[row][1 - x] and len(mass[row][x]) == 1]
    check(found, "no equation x' = v")
    (row, x), c = found[0], numbers(table["c"])
    v, dynamic, stages = 1 - x, 1 - row, len(c)
    inertia, force, drag = mass[dynamic][v], -rates[dynamic][x], -rates[dynamic][v]
    rows = []
    for unknown, weights in ((x, "position_weights"), (v, "velocity_weights")):
        weights = numbers(table[weights])
        check(len(weights) == stages, "as many weights as stages")
        line = [(Poly(), number(1))] * 2 + [weighted([(number(-1), w)]) for w in weights]
        line[unknown] = -one_minus_z, number(1)
        if unknown == x:
            line[v] = number(-1), number(1)
        rows.append(cleared(line))
    check(len(table["position"]) == len(table["velocity"]) == stages, "as many rows as stages")
    for i in range(stages):
        p, q = numbers(table["position"][i]), numbers(table["velocity"][i])
        line = [(Poly(), number(1))] * (2 + stages)
        line[x] = force, number(1)
        line[v] = weighted([(force, c[i]), (drag, one)])
        for j in range(stages):
            parts = [(inertia, one)] if i == j else []
            parts += [(entry, row[j]) for entry, row in ((force, p), (drag, q)) if j < len(row)]
            line[2 + j] = weighted(parts)
        rows.append(cleared(line))
    return rows


def characteristic(subject, wave):
    """chi(z) = [coefficient of z^0, ...] of the scheme, and the number of axes."""
    Letters.all, Letters.known = [], {}
    lattice = subject["kernel"] and Lattice(subject["kernel"])
    values = {name: Fraction(value) for name, value in subject["values"].items()}
    check(subject["parameter"] not in values, "the sought parameter has a value")
    reader = Reader(subject["parameter"], values, lattice, wave)
    rows = linear_equations(subject["equations"], reader)
    of_lines = {place[1] is None for row in rows for place in row}
    check(of_lines == {subject["integrator"] is not None}, "an integrator completes the method of lines, and nothing else")
    matrix = matrix_of(rows, reader.unknowns)
    if subject["integrator"] is not None:
        matrix = complete(matrix, reader.unknowns, subject["integrator"])
    chi = determinant(matrix)
    check(chi, "the determinant vanishes")
    coefficients = chi.primitive().moved(-min(z for z, *_ in chi)).by_z()
    check(len(coefficients) > 1, "nothing is advanced in time")
    return coefficients, reader.dimension


# Conditions: [(level, name, polynomial)].

def proportional(p, q):
    return len(p) == len(q) and all(p[-1]*b == q[-1]*a for a, b in zip(p, q))


def reversed_conjugate(p):
    return [coefficient.conjugate() for coefficient in reversed(p)]


def product(p, q):
    result = [Poly() for _ in range(len(p) + len(q) - 1)]
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            result[i + j] = result[i + j] + a*b
    return result


def polynomial_in_z(text, parameter, dimension):
    reader = Reader(parameter, {}, None, True)
    names = ["E"] if dimension == 1 else [f"E_{axis + 1}" for axis in range(dimension)]
    reader.names.update({name: Poly({(0, ROOM**axis, 0, ()): 1}) for axis, name in enumerate(names)}, z=Z)
    p, q = reader.evaluate(Parser(text).value()).get((None, None), (Poly(), number(1)))
    check(p and q.is_unit(), "a factor is no polynomial")
    ((z, e, *_), q), = q.items()
    check(z == 0 and min(z for z, *_ in p) >= 0, "a factor is no polynomial")
    p = p.moved(0, -e)
    return p.scaled(1 / Fraction(q)).without_denominators()[0].by_z()


def conditions(p, dimension, certificate):
    """Where they are not negative, and none vanishes identically, all roots lie in the closed disc."""
    growth, level = Fraction(certificate["growth"]) + 1, 0
    degree = len(p) - 1
    p = [c.scaled(growth.numerator**m * growth.denominator**(degree - m)) for m, c in enumerate(p)]
    while len(p) > 1:
        check(level < len(certificate["levels"]), "a level is missing")
        stated = certificate["levels"][level]
        if stated["split"]:
            inside, circle = (polynomial_in_z(stated["split"][part], certificate["subject"]["parameter"], dimension)
                              for part in ("inside", "circle"))
            check(proportional(p, product(inside, circle)), "the factors do not multiply to chi")
            check(proportional(circle, reversed_conjugate(circle)), "a factor is not self-inversive")
        elif proportional(p, reversed_conjugate(p)):
            inside, circle = [number(1)], p
        else:
            inside, circle = p, [number(1)]
        if len(inside) > 1:
            yield from ((level, *each) for each in {"jury": jury, "schur-cohn": schur_cohn}[stated["rule"]](inside))
        # Cohn: the roots of a self-inversive polynomial lie on the circle where those of its derivative lie in the disc.
        p, level = [c.scaled(m) for m, c in enumerate(circle)][1:], level + 1
    check(level == len(certificate["levels"]), "there are fewer levels")


def schur_cohn(a):
    degree = len(a) - 1
    bar = [coefficient.conjugate() for coefficient in a]

    def entry(i, j):
        total = Poly()
        for k in range(min(i, j) + 1):
            total = total + a[degree - i + k]*bar[degree - j + k] - bar[i - k]*a[j - k]
        return total
    for size in range(1, degree + 1):
        yield f"minor-{size}", determinant_whole([[entry(i, j) for j in range(size)] for i in range(size)])


def determinant_whole(matrix):
    """Without dropping units: their sign matters here."""
    total = Poly()
    if len(matrix) == 1:
        return matrix[0][0]
    for c, entry in enumerate(matrix[0]):
        if entry:
            minor = determinant_whole([row[:c] + row[c + 1:] for row in matrix[1:]])
            total = total + (entry*minor).scaled((-1)**c)
    return total


def jury(a):
    degree, leading = len(a) - 1, a[-1]
    low, high = ([end(axis) for axis in zip(*(unpacked(e) for _, e, *_ in leading))] for end in (min, max))
    check(all((x + y) % 2 == 0 for x, y in zip(low, high)), "the coefficients are not real")
    a = [coefficient.moved(0, -packed((x + y)//2 for x, y in zip(low, high))) for coefficient in a]
    check(all(coefficient == coefficient.conjugate() for coefficient in a), "the coefficients are not real")
    leading = a[-1]
    for name, sign in (("plus-one", 1), ("minus-one", -1)):
        total = Poly()
        for m, coefficient in enumerate(a):
            total = total + coefficient.scaled(sign**m)
        yield name, (total*leading).scaled(sign**degree)
    size = degree - 1
    for sign in (1, -1):
        for margin in range((size + 1)//2):
            if size == 1 and sign == 1:
                continue  # half the sum of the first two
            inner = range(margin, size - margin)

            def entry(i, j):
                upper = a[degree - (j - i)] if j >= i else Poly()
                return upper + a[i + j + 1 - size].scaled(sign) if i + j + 1 >= size else upper
            value = determinant_whole([[entry(i, j) for j in inner] for i in inner])
            yield f"inner-{len(inner)}{'+' if sign == 1 else '-'}", value*leading if len(inner) % 2 else value


def coefficients(p, dimension):
    """Of an explicit step for one unknown between two levels, by offset."""
    check(len(p) == 2 and p[1].is_unit(), "not explicit, or not of one level")
    (_, shift, *_), unit = next(iter(p[1].items()))  # its size is the same positive factor for all
    by_offset = {}
    for (_, e, c, letters), value in p[0].items():
        by_offset.setdefault(e - shift, Poly())[0, 0, c, letters] = -value if unit > 0 else value
    for offset in sorted(by_offset, key=unpacked):
        yield 0, f"coefficient {','.join(map(str, unpacked(offset)[:dimension]))}", by_offset[offset]


# Comparison with the polynomials stated.

def over(series, root):
    """A symmetric series in E divided by s = -(E - 1)^2/(4E) for the root 1, by 1 - s = (E + 1)^2/(4E) for -1."""
    for _ in range(2):
        quotient, carry = [], 0
        for value in series:
            carry = value + root*carry
            quotient.append(carry)
        check(quotient.pop() == 0, "a factor does not divide")
        series = [root*value for value in quotient]
    return [4*root*-value for value in series] if root == 1 else [4*-root*value for value in series]


def in_powers_of_s(series):
    """[.., x_-1, x_0, x_1, ..] with cos m phi = T_m(1 - 2s)."""
    middle = len(series) // 2
    result, before, current = [0] * (middle + 1), [1, -2], [1]
    for m in range(middle + 1):
        for i, value in enumerate(current):
            result[i] += value * series[middle + m] * (2 if m else 1)
        following = [2*a - 4*b for a, b in zip(current + [0], [0] + current)]
        before, current = current, [a - b for a, b in zip(following, before + [0] * len(following))]
    return result


def in_powers_of_e(row):
    """A polynomial in s as a symmetric series."""
    series = [Fraction(0)]
    for value in reversed(row):  # s = (2 - E - 1/E)/4
        wide = [0, 0] + series + [0, 0]
        series = [(2*wide[i] - wide[i - 1] - wide[i + 1])/4 for i in range(1, len(wide) - 1)]
        series[len(series)//2] += value
    return series


def groups_of(poly):
    """Symmetric series of whole numbers or fractions by power of C and letters."""
    groups, reach = {}, max((abs(e) for _, e, *_ in poly), default=0)
    check(reach <= 10**6, "a function of several phases")
    for (_, e, c, letters), value in poly.items():
        groups.setdefault((c, letters), [0] * (2*reach + 1))[reach + e] = value
    check(all(series == series[::-1] for series in groups.values()), "not a real function of the wave")
    return groups


def stated_rows(stated):
    """The polynomials in s by power of C that a margin stands for, all factors in."""
    def multiply(p, q):
        result = [Fraction(0)] * (len(p) + len(q) - 1)
        for i, a in enumerate(p):
            for j, b in enumerate(q):
                result[i + j] += a*b
        return result
    def add(rows, power, row):
        known = rows.get(power, [])
        longer, shorter = (known, row) if len(known) > len(row) else (row, known)
        rows[power] = [a + b for a, b in zip(longer, shorter + [0] * len(longer))]
    m, factor = stated["margin"], list(map(Fraction, stated["weight"]))
    neutral = list(map(Fraction, m["neutral_waves"]))
    check(neutral and neutral[-1] > 0 and Fraction(m["denominator"]) > 0, "H begins with a positive number")
    factor = multiply(multiply(factor, neutral), neutral)
    for _ in range(m["complement_power"]):
        factor = multiply(factor, [1, -1])
    factor = [Fraction(0)] * m["phase_power"] + [value / Fraction(m["denominator"]) for value in factor]
    rows, squares = {}, {}
    for j, row in enumerate(m["coefficients"]):
        add(rows, m["courant_power"] + m["stride"]*j, multiply(factor, list(map(Fraction, row))))
    q = [list(map(Fraction, row)) for row in stated["square"]]
    if q == [[1]]:
        return rows
    for i, a in enumerate(q):
        for j, b in enumerate(q):
            add(squares, i + j, multiply(a, b))
    result = {}
    for i, a in squares.items():
        for j, b in rows.items():
            add(result, i + j, multiply(a, b))
    return result


def compare(poly, stated):
    """The condition derived is Q^2 W s^a (1 - s)^b H^2 C^c P within the radii; gives whether it is known exactly."""
    poly = poly.without_denominators()
    (poly, common), m = poly, stated["margin"]
    groups = groups_of(poly)
    radius = list(map(Fraction, m["radius"]))
    if not any(letters for _, letters in groups):
        rows = stated_rows(stated)
        check(not any(radius), "what is exact needs no radius")
        for power in {*rows, *(c for c, _ in groups)}:
            derived = [Fraction(x, common) for x in in_powers_of_s(groups.get((power, ()), [0]))]
            given = rows.get(power, [])
            length = max(len(derived), len(given))
            check(derived + [0] * (length - len(derived)) == given + [0] * (length - len(given)),
                  "a polynomial is not that of the scheme")
        return True
    trivial = stated["square"] == [["1"]] and stated["weight"] == ["1"] and m["neutral_waves"] == ["1"]
    check(trivial, "a factor was taken out that the true scheme need not have")
    sums = {}
    for (c, letters), series in groups.items():
        for root, power in ((1, m["phase_power"]), (-1, m["complement_power"])):
            for _ in range(power):
                series = over(series, root)
        term = [value << BITS for value in series], 0
        for letter, power in letters:
            for _ in range(power):
                term = times(term, (Letters.all[letter].values, Letters.all[letter].error))
        values, error = sums.get(c, ([0], 0))
        sums[c] = added(values, term[0]), error + term[1]
    for power in {*sums, *(m["courant_power"] + m["stride"]*j for j in range(len(radius)))}:
        j, remainder = divmod(power - m["courant_power"], m["stride"])
        there = remainder == 0 <= j < len(radius)
        given = in_powers_of_e(list(map(Fraction, m["coefficients"][j]))) if there else [Fraction(0)]
        values, error = sums.get(power, ([0], 0))
        values = [Fraction(value, common*ONE) for value in values]
        given = [-value/Fraction(m["denominator"]) for value in given]
        distance = sum(map(abs, added(values, given))) + Fraction(error, common*ONE)
        allowed = (radius[j] if there else 0) / Fraction(m["denominator"])
        check(distance <= allowed, "a polynomial is not that of the scheme within its radius")
    return False


def compare_on_torus(poly, stated, parameter, dimension):
    """The condition derived is |Q|^2 times the sum of value C^power cos(k phi)."""
    check(not any(letters for *_, letters in poly), "in several dimensions numbers are fractions")
    root, *with_z = polynomial_in_z(stated["square"], parameter, dimension)
    check(not with_z, "a factor depends on z")
    twice = Poly()
    for term in stated["margin"]:
        check(len(term["k"]) == dimension, "a wave has a phase for each axis")
        for sign in (1, -1):
            key = 0, sign*packed(term["k"]), term["power"], ()
            twice = twice + Poly({key: Fraction(term["value"])})
    check(root*root.conjugate()*twice == poly.scaled(2), "a polynomial is not that of the scheme")
    return True


def added(a, b):
    a, b = (a, b) if len(a) >= len(b) else (b, a)
    gap = (len(a) - len(b)) // 2
    return [x + (b[i - gap] if 0 <= i - gap < len(b) else 0) for i, x in enumerate(a)]


def verify(certificate):
    stability, subject = certificate["question"] == "stability", certificate["subject"]
    chi, dimension = characteristic(subject, stability)
    check(stability or certificate["growth"] == "0" and not certificate["levels"], "no growth and no level here")
    derived = list(conditions(chi, dimension, certificate) if stability else coefficients(chi, dimension))
    (kind, proof), = certificate["proof"].items()
    stated = proof["inequalities"]
    check([(level, name) for level, name, _ in derived] == [(x["level"], x["condition"]) for x in stated],
          "the conditions are others")
    exact = [compare(poly, each) if kind == "line" else compare_on_torus(poly, each, subject["parameter"], dimension)
             for (_, _, poly), each in zip(derived, stated)]
    check(certificate["evidence"] == ("proved" if all(exact) else "enclosed"), "the radii give other evidence")


if __name__ == "__main__":
    main(verify, __doc__, "certificates state the polynomials of the schemes they name")
