"""Multipliers and speeds against the formulas of the literature, and NumPy's rules for shapes."""

import numpy as np
import pytest

import courant_stability as courant

PHASE = np.linspace(0.05, np.pi - 0.05, 40)


def test_multipliers_broadcast():
    courant_numbers = np.array([0.25, 0.5, 1.0])
    z = courant.scheme("lax-wendroff").multipliers(PHASE[:, None], C=courant_numbers)
    assert z.shape == (40, 3, 1) and z.dtype == complex
    c, phi = courant_numbers, PHASE[:, None]
    expected = 1 - c**2 * (1 - np.cos(phi)) - 1j * c * np.sin(phi)
    assert np.abs(z[..., 0] - expected).max() < 1e-15
    scalar = courant.scheme("lax-wendroff").multipliers(1.0, C=0.5)
    assert scalar.shape == (1,)
    strided = courant.scheme("lax-wendroff").multipliers(PHASE[::-2], C=np.float32(0.5))
    assert strided.shape == (20, 1) and strided[0, 0] == pytest.approx(
        1 - 0.25 * (1 - np.cos(PHASE[-1])) - 0.5j * np.sin(PHASE[-1])
    )
    assert courant.scheme("upwind").gain(np.empty((0, 3)), C=0.5).shape == (0, 3)


def test_several_levels_and_dimensions():
    z = courant.scheme("leapfrog").multipliers(PHASE, C=0.5)
    # The product of the two is −1, their sum −2 i C sin φ.
    assert z.shape == (40, 2)
    assert np.abs(z.prod(axis=1) + 1).max() < 1e-14
    assert np.abs(z.sum(axis=1) + 1j * np.sin(PHASE)).max() < 1e-14
    gain = courant.scheme("heat-ftcs-2d").gain(PHASE[:, None], PHASE, r=0.2)
    expected = np.abs(1 - 0.8 * (np.sin(PHASE[:, None] / 2) ** 2 + np.sin(PHASE / 2) ** 2))
    assert gain.shape == (40, 40) and np.abs(gain - expected).max() < 1e-15


def test_speeds_are_those_of_the_exact_multiplier():
    c = np.array([[0.2], [0.8]])
    scheme = courant.scheme("lax-wendroff")
    error, group = scheme.phase_error(PHASE, C=c), scheme.group_speed(PHASE, C=c)
    g = 1 - c**2 * (1 - np.cos(PHASE)) - 1j * c * np.sin(PHASE)
    speed = -np.unwrap(np.angle(g), axis=1) / (c * PHASE)
    slope = -c**2 * np.sin(PHASE) - 1j * c * np.cos(PHASE)
    assert error.shape == (2, 40) and np.abs(error - (speed - 1)).max() < 1e-12
    assert np.abs(group - (-(slope / g).imag / c)).max() < 1e-12
    # Waves to the left are waves to the right.
    assert np.abs(scheme.phase_error(-PHASE, C=0.2) - error[0]).max() < 1e-12
    assert np.isnan(scheme.phase_error(0.0, C=0.2))
    # Leapfrog's sawtooth moves backwards.
    assert courant.scheme("leapfrog").group_speed(3.1, C=0.5) < -0.9


def test_speeds_in_a_direction():
    phases = 0.3 * np.cos(np.pi / 6), 0.3 * np.sin(np.pi / 6)
    error = courant.scheme("wave-2-2d").phase_error(*phases, C=0.5)
    omega = 2 * np.arcsin(0.5 * np.sqrt(np.sin(phases[0] / 2) ** 2 + np.sin(phases[1] / 2) ** 2))
    assert error == pytest.approx(omega / (0.5 * 0.3) - 1, rel=1e-9)


def test_what_does_not_fit_is_refused():
    upwind = courant.scheme("upwind")
    for ask, words in [
        (lambda: upwind.gain(PHASE), "C"),
        (lambda: upwind.gain(PHASE, PHASE, C=0.5), "2 phases"),
        (lambda: upwind.gain(PHASE, C=np.ones(3)), "do not go together"),
        (lambda: upwind.gain(PHASE, C=0.5, D=np.ones(40)), "D"),
    ]:
        with pytest.raises(ValueError, match=words):
            ask()


def test_pictures():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    figure = courant.scheme("fromm").plot(C=0.5)
    assert [ax.get_ylabel() for ax in figure.axes] == ["largest |z|", "phase error", "group speed / exact"]
    with pytest.raises(ValueError, match="2 space dimensions"):
        courant.scheme("wave-2-2d").plot(C=0.5)
