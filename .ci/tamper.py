"""Changes one place of a certificate at a time: python3 .ci/tamper.py FILE.json ...

Takes the shortest certificate of each kind, proved and enclosed, stability and monotonicity; the files must have
all four. At least one of the two checkers in docs has to refuse every change.
"""
import copy
import json
import pathlib
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "docs"))
import verify_certificate
import verify_coefficients


def other_texts(text):
    try:
        number = Fraction(text)
    except ValueError:
        return [text + "0", text.replace("+", "-", 1), text.replace("u", "w", 1), ""]
    unreduced = f"{2 * number.numerator}/{2 * number.denominator}"
    return [str(number + 1), str(number - 1), str(-number), unreduced, "0/0", "+" + text]


def others(value):
    """What else could stand in one place."""
    if value is None:
        return ["1", {}]
    if isinstance(value, bool):
        return [not value, int(value), None]
    if isinstance(value, int):
        return [value + 1, value - 1, float(value) + 0.5, str(value), None]
    if isinstance(value, str):
        return [other for other in other_texts(value) if other != value] + [None]
    if isinstance(value, list):
        return [value[:-1], value + value[:1], []]
    return [{key: value[key] for key in value if key != removed} for removed in value] + [None]


def changes(value):
    """Copies of a value, each changed in one place, and the name of that place."""
    for other in others(value):
        if other != value or type(other) is not type(value):
            yield "", other
    if isinstance(value, (dict, list)):
        for key in value if isinstance(value, dict) else range(len(value)):
            for place, other in changes(value[key]):
                changed = copy.copy(value)
                changed[key] = other
                yield f"/{key}{place}", changed


def is_refused(certificate):
    for checker in (verify_certificate, verify_coefficients):
        try:
            checker.verify(certificate)
        except (Exception, SystemExit):
            return True
    return False


def shortest_of_each_kind(paths):
    shortest = {}
    for path in paths:
        for certificate in json.loads(pathlib.Path(path).read_text())["certificates"]:
            kind = f"{certificate['evidence']} {certificate['proof']['question']}"
            known = shortest.get(kind, certificate)
            shortest[kind] = min(certificate, known, key=lambda each: len(json.dumps(each)))
    return shortest


certificates = shortest_of_each_kind(sys.argv[1:])
if len(certificates) < 4:
    sys.exit(f"only {', '.join(certificates)}")
passed = False
for kind, certificate in certificates.items():
    if is_refused(certificate):
        sys.exit(f"{kind}: refused as it is")
    count = 0
    for place, changed in changes(certificate):
        # Without a name it is about a scheme given by its coefficients, and still holds.
        if place == "/subject" and changed["subject"] is None:
            continue
        count += 1
        if not is_refused(changed):
            passed = True
            print(f"{kind}: a change at {place} passes")
    print(f"{kind}: {count} changes")
sys.exit(passed)
