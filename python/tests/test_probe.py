"""Programs that nobody wrote down as equations."""

import numpy as np
import pytest

import courant_stability as courant


def upwind(u, C):
    return u - C * (u - np.roll(u, 1))


def test_a_function_is_a_scheme():
    found = courant.Scheme.probe(upwind, values=["0.9", 1, 1.1])
    assert found.recognised and found.equations == ["u[n+1,j] = C*u[n,j-1] + (1 - C)*u[n,j]"]
    assert found.limit().evidence == "measured" and found.limit() == 1
    assert list(found.verdicts.values()) == ["stable", "stable", "unstable"]
    assert found.check("1.00001") == "weakly-unstable"
    # What is proved of its equations.
    assert found.scheme.limit() == courant.scheme("upwind").limit() == 1
    assert 1 in found.monotone_set()


def test_levels_unknowns_and_dimensions():
    def leapfrog(u, C):
        old, now = u
        return old - C * (np.roll(now, -1) - np.roll(now, 1))

    found = courant.probe(leapfrog, levels=2, size=24)
    assert found.limit() == 1 and not found.limit().included

    def acoustics(state, C):
        p, u, v = state
        u = u - C * (np.roll(p, -1, axis=0) - p)
        v = v - C * (np.roll(p, -1, axis=1) - p)
        p = p - C * (u - np.roll(u, 1, axis=0) + v - np.roll(v, 1, axis=1))
        return np.stack([p, u, v])

    found = courant.probe(acoustics, unknowns=["p", "u", "v"], size=(8, 8))
    assert found.limit().exact.polynomial == (-1, 0, 2)
    heat = courant.probe(
        lambda u, r: u + r * sum(np.roll(u, s, axis=a) - u for a in range(3) for s in (1, -1)),
        parameter="r",
        size=(5, 6, 7),
        fit=["1/16", "1/8", "3/16", "1/4", "5/16"],
    )
    assert str(heat.limit()) == "1/6"


def test_one_step_is_judged_as_it_is_and_keywords_go_through():
    found = courant.probe(lambda u, C, k: upwind(u, C) * k, parameter=None, C=0.5, k=1.0)
    assert found.verdicts == {None: "stable"}
    with pytest.raises(ValueError, match="verdicts"):
        found.limit()


def test_answers_that_are_no():
    def limited(u, C):
        slope = np.sign(np.roll(u, -1) - u) * np.minimum(abs(np.roll(u, -1) - u), abs(u - np.roll(u, 1)))
        return u - C * (u - np.roll(u, 1)) - 0.5 * C * (1 - C) * (slope - np.roll(slope, 1))

    for step, words in [
        (lambda u, C: u - C * u * (u - np.roll(u, 1)), "not linear.*about"),
        (limited, "add up"),
        (lambda u, C: u * np.linspace(0, 1, 32), "not the same everywhere"),
        (lambda u, C: upwind(u, 1 / (1 + C)), "no polynomial"),
        (lambda u, C: u[:-1], "shape"),
        (lambda u, C: u / 0 * 0, "NaN"),
    ]:
        with np.errstate(all="ignore"), pytest.raises(ValueError, match=words):
            courant.probe(step)
    with pytest.raises(ValueError, match="at least 4"):
        courant.probe(upwind, size=3)


def test_a_step_is_linearised():
    def burgers(u, C):
        return u - C / 2 * (u**2 - np.roll(u, 1) ** 2)

    found = courant.probe(burgers, about=0.5)
    assert float(found.limit()) == pytest.approx(2, rel=1e-6) and found.limit().evidence == "measured"


def test_what_the_program_raises_is_raised():
    class Own(Exception):
        pass

    calls = []

    def step(u, C):
        calls.append(C)
        if len(calls) == 3:
            raise Own("at the third call")
        return upwind(u, C)

    with pytest.raises(Own, match="third"):
        courant.probe(step)
    assert len(calls) == 3
    told = []
    courant.probe(upwind, progress=lambda done, of: told.append((done, of)))
    assert told[-1][0] == told[-1][1] == len(told)


def test_states_are_what_numpy_says():
    seen = set()

    def step(u, C):
        seen.add((u.shape, u.dtype.str, u.flags.c_contiguous))
        return np.asfortranarray(u)

    courant.probe(step, size=(4, 6), unknowns=["a", "b"], values=[0.5])
    assert seen == {((2, 4, 6), "<f8", True)}
