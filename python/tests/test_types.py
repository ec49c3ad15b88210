"""The types of the package, of its native half, and of what a user writes, where mypy is installed."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")

CONFIGURATION = str(Path(__file__).parent.parent / "pyproject.toml")

SCRIPT = """
from fractions import Fraction

import numpy as np
import numpy.typing as npt

import courant_stability as courant

leapfrog = courant.Scheme("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")
exact: Fraction | courant.AlgebraicNumber | None = leapfrog.limit(growth=0).exact
verdict: str = leapfrog.check(C=0.9, growth="1e-3").verdict
sph = courant.particle_method("sph", "kdk", ratio=Fraction(6, 5), alpha=1)
scheme: courant.Scheme = courant.scheme("godunov-sph", kernel="cubic-spline", ratio=2)(ratio=3)
inside: bool = 0.5 in leapfrog.stable_set()
multipliers: npt.NDArray[np.complex128] = leapfrog.multipliers(np.linspace(0, 3, 5), C=0.5)
table = courant.limits_table([["upwind", courant.lines("central-2", "rk4")]])
plane = courant.stability_map(sph, ("ratio", [1, 2]), ("C", np.linspace(0, 1, 3)), progress=lambda done, of: None)
probe: courant.Probe = courant.probe(lambda u, C: u - C * (u - np.roll(u, 1)), values=[0.9, 1.1])
"""


@pytest.fixture
def run(tmp_path):
    """Runs a module, which leaves what it remembers elsewhere."""

    def run(*arguments):
        found = subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=tmp_path)
        assert found.returncode == 0, found.stdout + found.stderr

    return run


def test_the_stub_is_what_the_native_half_is(run):
    run("mypy.stubtest", "courant_stability._native")


def test_the_package_keeps_its_types(run):
    run("mypy", "--config-file", CONFIGURATION, "-p", "courant_stability")


def test_a_script_of_a_user_has_types(run, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    run("mypy", "--strict", str(script))
