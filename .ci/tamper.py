"""Changes one place of a certificate at a time: python3 .ci/tamper.py FILE.json ... [--program PATH]

Takes the shortest certificate of each kind: of a line, proved and enclosed, stability and monotonicity; of a torus, with
a wave of its own and with a direction of long waves. The files must have all six. At least one of the two checkers in docs has to refuse every change, or what is left must prove the same: an
interval may be covered in another way. Then everything malformed (analysis/src/certificate/malformed.json) has to be
refused for its form or its content by the checkers, and by `PATH verify` if a program is given.
"""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile
from fractions import Fraction

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs"))
import certificate_form
import verify_certificate
import verify_coefficients


def other_texts(text):
    try:
        number = Fraction(text)
    except ValueError:
        return [text + "0", text.replace("+", "-", 1), text.replace("u", "w", 1), "", text[:-1], text[::-1], text + "."]
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
    try:
        certificate_form.CERTIFICATE(certificate)
        verify_certificate.verify(certificate)
        verify_coefficients.verify(certificate)
    except (Exception, SystemExit):
        return True
    return False


def claim(certificate):
    return [certificate[key] for key in ("subject", "question", "growth", "evidence", "interval")]


def shortest_of_each_kind(paths):
    shortest = {}
    for path in paths:
        for certificate in json.loads(pathlib.Path(path).read_text())["certificates"]:
            kind = f"{certificate['evidence']} {certificate['question']}"
            (where, proof), = certificate["proof"].items()
            if where == "torus":
                kind += " on a torus" + (", long waves" if proof["above"]["wave"]["way"] else "")
            elif certificate["question"] == "stability":
                rows = [row for one in proof["inequalities"] for row in one["margin"]["coefficients"]]
                if min(map(len, rows)) < 2:
                    continue  # no wave to speak of
            known = shortest.get(kind, certificate)
            shortest[kind] = min(certificate, known, key=lambda each: len(json.dumps(each)))
    return shortest


def malformed(line, torus):
    for change in json.loads((ROOT / "analysis/src/certificate/malformed.json").read_text()):
        certificate = torus if change["path"][1:2] == ["torus"] else line
        changed = copy.deepcopy(certificate)
        *path, last = change["path"]
        place = changed
        for key in path:
            place = place[key]
        long = "repeated" in change  # parts of a long text, each with how often it stands there
        place[last] = "".join(part*times for part, times in change["repeated"]) if long else change["value"]
        yield change["name"], certificate, changed


def refused_by(program, certificate):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"schema": certificate_form.SCHEMA, "certificates": [certificate]}, file)
        file.flush()
        answer = subprocess.run([program, "verify", file.name], capture_output=True, timeout=60)
    return answer.returncode in (1, 2)


arguments, program = sys.argv[1:], None
if "--program" in arguments:
    place = arguments.index("--program")
    program = arguments[place + 1]
    del arguments[place:place + 2]
certificates = shortest_of_each_kind(arguments)
if len(certificates) < 6:
    sys.exit(f"only {', '.join(certificates)}")
passed = False
for kind, certificate in certificates.items():
    if is_refused(certificate):
        sys.exit(f"{kind}: refused as it is")
    count = 0
    for place, changed in changes(certificate):
        count += 1
        if not is_refused(changed) and claim(changed) != claim(certificate):
            passed = True
            print(f"{kind}: a change at {place} passes")
    print(f"{kind}: {count} changes")
valid, count = [certificates[f"proved stability{kind}"] for kind in ("", " on a torus, long waves")], 0
if program and any(refused_by(program, certificate) for certificate in valid):
    sys.exit("refused by the program as it is")
for name, certificate, changed in malformed(*valid):
    count += 1
    if json.dumps(changed) == json.dumps(certificate):
        sys.exit(f"malformed: {name} changes nothing")
    if not is_refused(changed) or program and not refused_by(program, changed):
        passed = True
        print(f"malformed: {name} passes")
print(f"malformed: {count}")
sys.exit(passed)
