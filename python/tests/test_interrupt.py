"""Ctrl-C in the middle of work."""

import signal
import threading

import numpy as np
import pytest

import courant_stability as courant


def interrupted(work):
    """Asks for something that takes minutes, and presses Ctrl-C meanwhile."""
    key = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    key.start()
    with pytest.raises(KeyboardInterrupt):
        work()
    key.join()


def upwind(axis):
    """The third-order difference along an axis of three."""
    at = [",".join(index + (shift if other == axis else "") for other, index in enumerate("ijk")) for shift in ("+1", "", "-1", "-2")]
    return "(2*u[{}] + 3*u[{}] - 6*u[{}] + u[{}])/6".format(*at)


LONG = courant.lines(f"u[i,j,k]' = -C*({' + '.join(map(upwind, range(3)))})", "rk3-ssp")


def test_one_long_decision_stops_and_leaves_everything_whole():
    interrupted(LONG.limit)
    assert courant.scheme("lax-wendroff").limit() == 1


def test_a_verdict_and_a_certificate_stop():
    interrupted(lambda: LONG.check(C=1))
    interrupted(LONG.certificate)


def test_arrays_of_waves_stop():
    phases = np.linspace(0.01, 3.1, 3000)
    scheme = courant.lines("dg-2", "rk4")
    interrupted(lambda: scheme.gain(phases[:, None], C=np.linspace(0.1, 0.2, 3000)))
    assert scheme.gain(0.1, C=0.1) <= 1


def test_what_progress_raises_stops_the_work():
    def report(done, of):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        courant.limits_table(courant.lines("kappa", "rk3"), kappa=np.linspace(-1, 1, 10_000), progress=report)
