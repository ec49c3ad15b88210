"""Maps and tables against brute force, and long work that is watched."""

import _thread
import threading
import time
from fractions import Fraction

import numpy as np
import pytest

import courant_stability as courant

DIFFUSION = "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])"


def test_a_map_is_what_sampling_sees():
    r, c = np.linspace(0.05, 0.6, 12), np.linspace(0.05, 1.2, 24)
    found = courant.stability_map(courant.Scheme(DIFFUSION), ("r", r), ("C", c))
    phi = np.linspace(0, np.pi, 4001)
    gain = np.abs(1 - 2 * r[:, None, None] * (1 - np.cos(phi)) - 1j * c[:, None] * np.sin(phi))
    assert found.largest.shape == (12, 24) and found.largest.flags.c_contiguous
    assert (found.largest >= gain.max(axis=2) - 1e-12).all()
    assert np.abs(found.largest - gain.max(axis=2)).max() < 1e-5
    assert np.abs(found.lowest - gain.min(axis=2)).max() < 2e-3
    # C² ≤ 2 r ≤ 1, with the decimals that the floats stand for.
    exact = lambda values: np.array([Fraction(repr(v)) for v in values.tolist()])
    stable = (exact(c) ** 2 <= 2 * exact(r)[:, None]) & (exact(r)[:, None] <= Fraction(1, 2))
    assert (found.stable == stable.astype(bool)).all()
    limit = np.where(r <= 0.5, np.sqrt(2 * r), 0)
    reached = limit < c.max()
    assert np.allclose(found.limits["value"][reached], limit[reached], rtol=1e-15)


def test_a_map_over_the_ratio_of_a_kernel():
    ratios, c = [1, Fraction(3, 2), 2], np.linspace(0.1, 3, 30)
    scheme = courant.scheme("godunov-sph", kernel="cubic-spline", ratio=1)
    found = courant.stability_map(scheme, ("ratio", ratios), ("C", c))
    alone = [scheme(ratio=ratio).limit() for ratio in ratios]
    assert found.limits["value"].tolist() == [float(limit) for limit in alone]
    assert ((found.growth < 1e-9) == found.stable).all()
    only = courant.stability_map(scheme, ("ratio", ratios), ("C", c), decide=False)
    assert only.stable is None and (only.largest == found.largest).all()


def test_tables_have_the_axes_of_schemes_and_of_parameters():
    schemes = [courant.scheme(name, kernel="cubic-spline", ratio=1) for name in ("godunov-sph", "lax-wendroff-sph")]
    table = courant.limits_table(schemes, ratio=np.array([1.0, 2.0, 3.0]))
    assert table.shape == (2, 3) and table.limits[0, 1] == Fraction(15, 8)
    assert np.asarray(table).tolist() == table.value.tolist()
    assert "15/8" in table._repr_html_() and table.cause[0, 0] == "long-wave"
    numbers = courant.limits_table(schemes, ratio=np.array([1.0, 2.0, 3.0]), exact=False)
    assert numbers.limits is None and (numbers.data == table.data)[~np.isnan(table.data["phase"][..., 0])].all()
    plane = courant.limits_table("lax-wendroff-2d")
    assert plane.shape == () and plane.data["phase"].shape == (2,)
    diffusion = courant.scheme("advection-diffusion-ftcs")
    two = courant.limits_table(diffusion, r=["1/8", "1/2"])
    assert [str(limit) for limit in two.limits] == ["1/2", "1"]


def test_bad_axes_are_named():
    scheme = courant.Scheme(DIFFUSION)
    for x, y, words in [
        (("q", [1.0]), ("C", [1.0]), "q"),
        (("r", [np.nan]), ("C", [1.0]), "r"),
        (("r", [0.1]), ("C", [np.inf]), "C"),
    ]:
        with pytest.raises(ValueError, match=words):
            courant.stability_map(scheme, x, y)


def test_work_is_watched_and_stops():
    scheme = courant.scheme("godunov-sph", kernel="cubic-spline", ratio=1)
    ratios = np.linspace(1, 12, 400)
    told = []
    courant.limits_table(scheme, ratio=ratios[:50], progress=lambda done, of: told.append((done, of)))
    assert told[-1] == (50, 50) and told == sorted(told)

    class Enough(Exception):
        pass

    def enough(done, of):
        raise Enough

    with pytest.raises(Enough):
        courant.limits_table(scheme, ratio=np.linspace(8, 12, 2000), progress=enough)


def test_an_interrupt_ends_long_work_and_the_lock_is_free():
    scheme = courant.scheme("lax-wendroff-sph", kernel="wendland-c6", ratio=1)
    beats = []
    stop = threading.Event()

    def beat():
        while not stop.is_set():
            beats.append(time.monotonic())
            time.sleep(0.01)

    heart = threading.Thread(target=beat)
    heart.start()
    timer = threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    start = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            courant.limits_table(scheme, ratio=np.linspace(20, 40, 100_000), exact=False)
    finally:
        stop.set()
        heart.join()
        timer.cancel()
    # A hundred thousand limits would take minutes; meanwhile other threads ran.
    assert time.monotonic() - start < 30 and len(beats) > 10


def test_pictures():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    found = courant.stability_map(
        courant.Scheme(DIFFUSION), ("r", np.linspace(0.1, 0.6, 6)), ("C", np.linspace(0.1, 1.2, 7))
    )
    ax = found.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("r", "C")
