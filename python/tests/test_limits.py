"""Limits, stable sets, verdicts, certificates: against the literature, and against the program where it is at hand."""

import json
import os
import pickle
import subprocess
from fractions import Fraction

import numpy as np
import pytest

import courant_stability as courant

SPACES = "upwind-1 upwind-2 upwind-3 upwind-5 upwind-7 central-2 central-4 central-6".split()
INTEGRATORS = "forward-euler rk2 rk3 rk4 rk5 rk6 rk7".split()

#: The program, where somebody has built it: `COURANT_PROGRAM=target/release/courant`.
PROGRAM = os.environ.get("COURANT_PROGRAM")


def program(*arguments):
    found = subprocess.run([PROGRAM, *arguments, "--format", "json"], capture_output=True, text=True)
    assert found.returncode in (0, 1), found.stderr
    return json.loads(found.stdout)


def test_ten_lines_are_the_table_of_56_pairs():
    pairs = [[courant.lines(space, integrator) for integrator in INTEGRATORS] for space in SPACES]
    table = courant.limits_table(pairs)
    assert table.shape == (8, 7) and (table.evidence == "proved").all()
    at = {(s, i): table.limits[a, b] for a, s in enumerate(SPACES) for b, i in enumerate(INTEGRATORS)}
    # x³ = 2/3, x⁵ = 12 … of the stability functions, and what only a proof finds to be 0.
    assert str(at["upwind-3", "rk2"]) == "(2/3)^(1/3)"
    assert at["central-2", "rk3"].exact.polynomial == (-3, 0, 1)
    assert at["central-2", "rk4"].exact.polynomial == (-8, 0, 1)
    assert at["central-2", "rk2"] == 0 and at["upwind-3", "forward-euler"] == 0
    assert at["upwind-1", "forward-euler"] == 1 and at["upwind-1", "rk2"] == Fraction(1)


def test_every_kind_of_subject():
    assert courant.scheme("godunov-sph", kernel="cubic", ratio=2).limit().exact == Fraction(15, 8)
    gaussian = courant.scheme("godunov-sph", kernel="gaussian", ratio=3).limit()
    assert gaussian.evidence == "enclosed" and gaussian.exact is None and 3.385 < gaussian < 3.386
    assert gaussian.decimal(8).startswith("3.38540")
    assert courant.scheme("lax-wendroff-2d").limit().exact.polynomial == (-1, 0, 8)
    sph = courant.particle_method("sph", "kdk", ratio="6/5", eos="tait:0").limit()
    assert sph.symbol == "c Δt/h" and sph.exact.degree == 4 and float(sph) == pytest.approx(1.8946035)
    implicit = courant.scheme("crank-nicolson").limit()
    assert implicit.unbounded and implicit.without_end and float(implicit) == np.inf and str(implicit) == "∞"


def test_stable_sets_say_what_they_hold():
    leapfrog = courant.scheme("leapfrog").stable_set()
    assert "0.99999" in leapfrog and 1 not in leapfrog and 1.1 not in leapfrog and 0 in leapfrog
    upwind = courant.scheme("upwind").stable_set()
    assert 1 in upwind and 0.1 in upwind and Fraction(10**20 + 1, 10**20) not in upwind
    assert courant.scheme("ftcs-advection").stable_set().intervals == ()


def test_verdicts_are_decided_at_the_value():
    upwind = courant.scheme("upwind")
    assert [upwind.check(C=c).verdict for c in (0.9, 1, "1.00001", 2)] == [
        "stable", "marginal", "weakly-unstable", "unstable",
    ]
    assert upwind.check(C=2).max_gain == pytest.approx(3) and not upwind.check(C=2)
    assert upwind.check(C="1.0001", growth=0.001) and not upwind.check(C="1.01", growth=0.001)
    assert "unstable" in upwind.check(C=2)._repr_html_()


def test_a_growth_budget_moves_the_limit():
    scheme = courant.scheme("lax-wendroff-sph", kernel="gaussian", ratio=3)
    assert scheme.limit() == 0
    assert float(scheme.limit(growth="0.001")) == pytest.approx(3.14673, rel=1e-5)


def test_certificates_hold_until_they_are_changed():
    certificate = courant.scheme("heat-ftcs").certificate()
    assert len(certificate.verify()) == len(certificate.certificates) == 2
    forged = courant.Certificate(certificate.text.replace('"1/2"', '"2/3"'))
    assert forged.text != certificate.text
    with pytest.raises(ValueError, match="certificate"):
        forged.verify()


def test_runs_agree_with_predictions():
    for run in courant.scheme("leapfrog").validate():
        assert run and run.max_error <= run.tolerance
        assert np.abs(run.predicted - run.measured).max() <= 2 * run.tolerance
    assert courant.scheme("wave-2-2d").validate(C=0.5, cells=(6, 5), steps=10)[0].passed


def test_values_that_are_missing_or_wrong_are_named():
    diffusion = courant.scheme("advection-diffusion-ftcs")
    for ask, words in [
        (lambda: courant.scheme("upwnd"), "upwnd"),
        (lambda: courant.lines("upwind-3", "rk44"), "rk44"),
        (lambda: courant.scheme("upwind", ratio=2), "no kernel"),
        (lambda: courant.scheme("godunov-sph"), "ratio"),
        (lambda: courant.scheme("godunov-sph", ratio=1000), "ratio"),
        (lambda: courant.scheme("upwind", D=1), "D"),
        (lambda: courant.scheme("upwind").check(), "missing"),
        (lambda: courant.scheme("upwind", C=1).limit(), "C is the"),
        (lambda: courant.scheme("upwind", C="one"), "one"),
        (lambda: courant.scheme("upwind").check(C=-1), "negative"),
        (lambda: diffusion(C=float("nan")), "nan"),
        (lambda: courant.scheme("leapfrog").monotone_set(), "positive"),
        (lambda: courant.Scheme("u[n+1,j] = a*u[n,j] + b*u[n,j-1]").limit(), "a, b"),
    ]:
        with pytest.raises(ValueError, match=words):
            ask()


def test_an_error_shows_its_place():
    text = "u[n+1,j] = u[n,j]\n  - C*(u[n,j] - u[n,j-1]"
    with pytest.raises(courant.TextError) as raised:
        courant.Scheme(text)
    error = raised.value
    assert error.line == 2 and str(error).splitlines()[-1].strip() == "^"
    assert pickle.loads(pickle.dumps(error)).column == error.column
    with pytest.raises(courant.TextError) as raised:
        courant.Scheme("u[n+1,j] = ü*u[n,j] + ?")
    assert raised.value.column == 23


def test_files_are_schemes(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text('name = "own"\nequations = "u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])"\n')
    for path in (file, str(file)):
        own = courant.Scheme(path)
        assert own.name == "own" and own.limit() == 1
    assert pickle.loads(pickle.dumps(own)) == own


def test_schemes_are_pickled_by_what_they_are():
    for scheme in (
        courant.scheme("godunov-sph", kernel="wendland-c2", ratio="3/2"),
        courant.lines("u[j]' = -C*(u[j] - u[j-1])", "rk4"),
        courant.particle_method("gph", "kdk", ratio=1.2),
    ):
        copy = pickle.loads(pickle.dumps(scheme))
        assert copy == scheme and hash(copy) == hash(scheme) and copy.limit() == scheme.limit()
    limit = courant.scheme("yee-3d").limit()
    assert pickle.loads(pickle.dumps(limit)) == limit


def test_pictures_of_text():
    scheme = courant.scheme("lax-wendroff")
    assert "E" in scheme._repr_latex_() and "C" in scheme._repr_html_()
    assert scheme.limit()._repr_latex_() == r"$C \le 1$"
    assert r"\sqrt" in courant.scheme("yee-3d").limit()._repr_latex_()
    assert scheme.stable_set()._repr_latex_() == "$[0, 1]$"
    assert scheme.modified_equation()._repr_latex_().startswith("$")


@pytest.mark.skipif(not PROGRAM, reason="COURANT_PROGRAM names no program")
def test_the_program_says_the_same():
    for name, options in [("leapfrog", {}), ("yee-3d", {}), ("godunov-sph", {"kernel": "gaussian", "ratio": "2"})]:
        scheme = courant.scheme(name, **options)
        words = [word for key, value in options.items() for word in (f"--{key}", value)]
        row = program("limits", "--scheme", name, *words)["rows"][0]
        assert scheme.limit().record == row["stability"]
        answer = program("check", "--scheme", name, *words, "--cfl", "0.3")
        schema = answer.pop("schema", None)
        assert scheme.check(**{scheme.parameter: "0.3"}).record == answer, schema
    symbol = program("symbol", "--scheme", "lax-wendroff")
    symbol.pop("schema", None)
    assert courant.scheme("lax-wendroff").modified_equation().record == symbol
