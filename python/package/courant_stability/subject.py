"""What is judged: a scheme, with everything that completes it."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from .certificate import Certificate
from .exact import ExactLike, exact_text
from .limit import Limit, StableSet
from .symbol import ModifiedEquation
from .validation import Validation
from .verdict import Verdict

if TYPE_CHECKING:
    from .probing import Probe

class _State(NamedTuple):
    """A scheme as it is pickled."""

    kind: str
    source: str
    integrator: str | None = None
    kernel: str | None = None
    ratio: str | None = None
    density: str | None = None
    eos: str | None = None
    values: tuple[tuple[str, str], ...] = ()
    parameter: str | None = None


@functools.lru_cache(maxsize=256)
def _read(state: _State) -> _native.Subject:
    """Once a process."""
    return _native.Subject(*state)


class Scheme:
    """A linear scheme with constant coefficients, in one to three dimensions.

    Parameters
    ----------
    text : str or path
        Equations in the language of schemes (``docs/language.md``), or a file of them (``.toml``).
    integrator : str or path, optional
        What completes equations with ``u[j]'``: a name of the catalogue, or a file.
    kernel : str, optional
        The kernel of sums over neighbours; the cubic spline where none is named.
    ratio : number, optional
        Its smoothing length over the spacing.
    parameter : str, optional
        The parameter in question, where it is not clear which: the file's, ``C``, or the only one without a value.
    **values
        Values of parameters. A float stands for its shortest decimal (0.1 is one tenth), a text such as ``"1/3"`` for what it says.

    Examples
    --------
    >>> import courant_stability as courant
    >>> leapfrog = courant.Scheme("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])")
    >>> leapfrog.limit()
    Limit(C = 1, proved, interior)
    >>> diffusion = courant.Scheme("u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])")
    >>> diffusion(r=0.18).limit().exact
    Fraction(3, 5)
    """

    __slots__ = ("_state",)

    def __init__(
        self,
        text: str | os.PathLike[str],
        *,
        integrator: str | os.PathLike[str] | None = None,
        kernel: str | None = None,
        ratio: ExactLike | None = None,
        parameter: str | None = None,
        **values: ExactLike,
    ) -> None:
        source = _text_of(text)
        kind = "equation" if source is text else "scheme"
        self._state = _state(
            kind, source, integrator=integrator, kernel=kernel, ratio=ratio, parameter=parameter, values=values
        )

    @classmethod
    def _of(cls, state: _State) -> Scheme:
        scheme = cls.__new__(cls)
        scheme._state = state
        return scheme

    def __reduce__(self) -> tuple[Any, ...]:
        return Scheme._of, (self._state,)

    def __eq__(self, other: object) -> bool:
        return self._state == other._state if isinstance(other, Scheme) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._state)

    @property
    def _subject(self) -> _native.Subject:
        return _read(self._state)

    def __call__(self, *, parameter: str | None = None, **values: ExactLike) -> Scheme:
        """The same scheme with values for parameters: ``ratio`` is the kernel's.

        Examples
        --------
        >>> import courant_stability as courant
        >>> courant.scheme("heat-theta")(theta="1/4").limit().exact
        Fraction(1, 1)
        """
        return self._with(values, parameter)

    def _with(self, values: dict[str, ExactLike], parameter: str | None = None) -> Scheme:
        if not values and parameter is None:
            return self
        state, texts = self._state, _texts(values)
        if state.ratio is not None:
            state = state._replace(ratio=texts.pop("ratio", state.ratio))
        known = {**dict(state.values), **texts}
        state = state._replace(values=tuple(known.items()), parameter=parameter or state.parameter)
        _read(state)
        return Scheme._of(state)

    # What it is.

    @property
    def name(self) -> str:
        """Its name in the catalogue, or its equations."""
        return self._subject.name

    @property
    def title(self) -> str:
        """Its title, with what completes it."""
        return self._subject.title

    @property
    def equations(self) -> str:
        """Its text."""
        return self._subject.equations

    @property
    def dimension(self) -> int:
        """The number of space dimensions."""
        return self._subject.dimension

    @property
    def unknowns(self) -> list[str]:
        """The names of the unknowns."""
        return self._subject.unknowns

    @property
    def parameter(self) -> str:
        """The parameter in question."""
        return self._subject.parameter

    @property
    def parameters(self) -> dict[str, Fraction | None]:
        """All parameters with their values or defaults, nothing for those that are open."""
        return {
            name: None if value is None else Fraction(value) for name, value in self._subject.parameters
        }

    def __repr__(self) -> str:
        return f"Scheme({self.title!r})"

    def _repr_latex_(self) -> str:
        return f"$\\chi(z):\\ {self.modified_equation().record['characteristic']}$"

    def _repr_html_(self) -> str:
        known = ", ".join(
            name if value is None else f"{name} = {value}" for name, value in self.parameters.items()
        )
        return f"<b>{self.title}</b><pre>{self.equations}</pre>parameters: {known or 'none'}"

    # Decisions.

    def limit(
        self,
        *,
        growth: ExactLike = 0,
        max: ExactLike | None = None,
        budget: int | None = None,
    ) -> Limit:
        """The largest value of the parameter up to which no wave grows, proved where the scheme is exact.

        Parameters
        ----------
        growth : number
            What is permitted per step: ``|z| ≤ 1 + growth``.
        max : number, optional
            Look up to here; 100 where nothing else is known.
        budget : int, optional
            Boxes that one decision may look at.

        Returns
        -------
        Limit

        Examples
        --------
        >>> import courant_stability as courant
        >>> courant.scheme("godunov-sph", kernel="cubic-spline", ratio=2).limit().exact
        Fraction(15, 8)
        """
        return self.stable_set(growth=growth, max=max, budget=budget).limit

    def stable_set(
        self,
        *,
        growth: ExactLike = 0,
        max: ExactLike | None = None,
        budget: int | None = None,
    ) -> StableSet:
        """All values of the parameter for which no wave grows; arguments as of `limit`."""
        text = _native.stable_set(self._subject, _optional(max), exact_text(growth), budget)
        return StableSet._of_json(text)

    def monotone_set(self, *, max: ExactLike | None = None, budget: int | None = None) -> StableSet:
        """All values for which no coefficient is negative, of explicit schemes between two levels for one unknown.

        Examples
        --------
        >>> import courant_stability as courant
        >>> courant.scheme("upwind").monotone_set()
        StableSet([0, 1], proved)
        """
        return StableSet._of_json(_native.monotone_set(self._subject, _optional(max), budget))

    def check(
        self,
        *,
        growth: ExactLike | None = None,
        max: ExactLike | None = None,
        budget: int | None = None,
        **values: ExactLike,
    ) -> Verdict:
        """Judges one value of the parameter in question, decided at the value itself.

        Parameters
        ----------
        growth : number, optional
            Accept growth up to this much per step.
        **values
            The value to be judged, and others: ``check(C=0.9)``.

        Returns
        -------
        Verdict
            True where no wave grows exponentially.

        Examples
        --------
        >>> import courant_stability as courant
        >>> [courant.scheme("leapfrog").check(C=C).verdict for C in ("0.9", "1", "1.1")]
        ['stable', 'marginal', 'unstable']
        """
        scheme = self._with(values)
        return Verdict._of_json(
            _native.check(scheme._subject, _optional(max), _optional(growth), budget)
        )

    def certificate(
        self,
        *,
        growth: Sequence[ExactLike] = (),
        max: ExactLike | None = None,
        budget: int | None = None,
    ) -> Certificate:
        """The proofs of its limits: of stability, within each budget for growth, and of monotonicity."""
        budgets = [exact_text(one) for one in growth]
        return Certificate(_native.certify(self._subject, _optional(max), budgets, budget))

    # Waves.

    def _arrays(
        self, phases: Sequence[ArrayLike], values: dict[str, Any]
    ) -> tuple[_native.Subject, list[str], list[np.ndarray]]:
        """Parameters whose values are single are set exactly; the others become arrays."""
        exact: dict[str, ExactLike] = {}
        names: list[str] = []
        arrays: list[np.ndarray] = []
        for name, value in values.items():
            if isinstance(value, (str, int, float, Fraction)) or np.ndim(value) == 0 and not isinstance(value, np.ndarray):
                exact[name] = value
            else:
                names.append(name)
                arrays.append(np.asarray(value, dtype=float))
        arrays.extend(np.asarray(phase, dtype=float) for phase in phases)
        scheme = self._with(exact)
        return scheme._subject, names, arrays

    def multipliers(self, *phases: ArrayLike, **values: Any) -> np.ndarray:
        """The multipliers of waves: what one step does to ``exp(i φ j)``.

        Parameters
        ----------
        *phases : array_like
            Radians a cell, one array for each axis.
        **values
            Parameters, single or arrays. All arrays are broadcast together.

        Returns
        -------
        ndarray of complex
            With a last axis for the multipliers, those with a negative imaginary part first.

        Examples
        --------
        >>> import numpy as np
        >>> import courant_stability as courant
        >>> z = courant.scheme("upwind").multipliers(np.pi, C=np.array([0.25, 0.5, 1.5]))
        >>> z.shape, z[:, 0].real.round(12).tolist()
        ((3, 1), [0.5, 0.0, -2.0])
        """
        return _native.multipliers(*self._arrays(phases, values))

    def gain(self, *phases: ArrayLike, **values: Any) -> np.ndarray:
        """The largest modulus among the multipliers; arguments as of `multipliers`.

        Examples
        --------
        >>> import numpy as np
        >>> import courant_stability as courant
        >>> phase = np.linspace(0, np.pi, 5)
        >>> courant.scheme("lax-friedrichs").gain(phase[:, None], C=np.array([0.5, 1.0])).shape
        (5, 2)
        """
        return _native.gain(*self._arrays(phases, values))

    def phase_error(self, *phases: ArrayLike, **values: Any) -> np.ndarray:
        """The relative error of the phase speed of the branch that follows the equation, negative where waves lag; arguments as of
        `multipliers`. Not a number at phase 0, and where the equation moves no wave.

        Examples
        --------
        >>> import numpy as np
        >>> import courant_stability as courant
        >>> error = courant.scheme("lax-wendroff").phase_error(np.array([0.1, 1.0]), C=0.5)
        >>> error.round(6).tolist()
        [-0.001248, -0.112505]
        """
        return _native.speeds(*self._arrays(phases, values))[0] - 1.0

    def group_speed(self, *phases: ArrayLike, **values: Any) -> np.ndarray:
        """The group speed of the branch that follows the equation, over that of the equation; arguments as of `multipliers`.

        Examples
        --------
        >>> import numpy as np
        >>> import courant_stability as courant
        >>> courant.scheme("leapfrog").group_speed(np.array([np.pi / 3]), C=0.1).round(3).tolist()
        [0.502]
        """
        return _native.speeds(*self._arrays(phases, values))[1]

    def modified_equation(self, terms: int | None = None) -> ModifiedEquation:
        """The equation that the scheme solves, with `terms` terms or as many as show the first errors in amplitude and speed."""
        return ModifiedEquation._of_json(_native.symbol(self._subject, terms))

    # Runs.

    def validate(
        self,
        *,
        cells: int | Sequence[int] | None = None,
        steps: int | None = None,
        **values: ExactLike,
    ) -> list[Validation]:
        """Steps the typed equations on a torus and compares every wave with its predicted multipliers.

        Parameters
        ----------
        cells : int or sequence of int, optional
            Along each axis.
        steps : int, optional
            Of the runs on each branch.
        **values
            A value of the parameter in question; about the limit where none is given.

        Returns
        -------
        list of Validation
            One for each value.
        """
        scheme = self._with(values)
        size = None if cells is None else np.atleast_1d(cells).tolist()
        if size is not None and len(size) == 1:
            size = size * self.dimension
        return Validation._all_of_json(_native.validate(scheme._subject, [], size, steps))

    @staticmethod
    def probe(step: Callable[..., Any], **options: Any) -> Probe:
        """Measures one step of a program and analyses what was measured; arguments as of `courant_stability.probe`."""
        from .probing import probe

        return probe(step, **options)

    def plot(self, *phases: ArrayLike, axes: Any = None, **values: Any) -> Any:
        """Gain, phase error and group speed over the phase, in one dimension; needs matplotlib.

        Parameters
        ----------
        *phases : array_like, optional
            The phases; all up to the shortest wave where none are given.
        axes : sequence of three matplotlib axes, optional
            Where to draw.
        **values
            Parameters, each single.

        Returns
        -------
        matplotlib Figure
        """
        from .plotting import waves

        return waves(self, phases, values, axes)


def _texts(values: dict[str, ExactLike]) -> dict[str, str]:
    return {name: exact_text(value) for name, value in values.items()}


def _state(
    kind: str,
    source: str,
    *,
    integrator: str | os.PathLike[str] | None = None,
    ratio: ExactLike | None = None,
    values: dict[str, ExactLike],
    **words: str | None,
) -> _State:
    """Read by the native half, which complains of what does not go together."""
    state = _State(
        kind,
        source,
        integrator=None if integrator is None else _text_of(integrator),
        ratio=_optional(ratio),
        values=tuple(_texts(values).items()),
        **words,
    )
    _read(state)
    return state


def _optional(value: ExactLike | None) -> str | None:
    return None if value is None else exact_text(value)


def _text_of(source: str | os.PathLike[str]) -> str:
    """The text of a file, or the text itself."""
    if isinstance(source, str) and ("\n" in source or not source.endswith(".toml")):
        return source
    return Path(source).read_text(encoding="utf-8")


def scheme(
    name: str,
    *,
    kernel: str | None = None,
    ratio: ExactLike | None = None,
    parameter: str | None = None,
    **values: ExactLike,
) -> Scheme:
    """A scheme of the catalogue; `schemes` has the names.

    Parameters
    ----------
    name : str
        Such as ``"lax-wendroff"``, ``"yee-3d"``, ``"godunov-sph"``.
    kernel, ratio, parameter, **values
        As of `Scheme`.

    Examples
    --------
    >>> import courant_stability as courant
    >>> courant.scheme("yee-3d").limit().exact
    AlgebraicNumber(0.5773502691896257 = sqrt(1/3): 3 x^2 - 1 = 0)
    """
    return Scheme._of(_state("scheme", name, kernel=kernel, ratio=ratio, parameter=parameter, values=values))


def lines(
    space: str,
    integrator: str | os.PathLike[str],
    *,
    kernel: str | None = None,
    ratio: ExactLike | None = None,
    parameter: str | None = None,
    **values: ExactLike,
) -> Scheme:
    """The method of lines: equations in space, completed by an integrator.

    Parameters
    ----------
    space : str
        A name of the catalogue (`spaces`) or equations: ``"u[j]' = -C*(u[j] - u[j-1])"``.
    integrator : str or path
        A name of the catalogue (`integrators`) or a file.

    Examples
    --------
    >>> import courant_stability as courant
    >>> courant.lines("central-2", "rk4").limit().exact
    AlgebraicNumber(2.8284271247461903 = sqrt(8): x^2 - 8 = 0)
    """
    return Scheme._of(
        _state(
            "space",
            _text_of(space),
            integrator=integrator,
            kernel=kernel,
            ratio=ratio,
            parameter=parameter,
            values=values,
        )
    )


def particle_method(
    name: str,
    integrator: str | os.PathLike[str],
    *,
    ratio: ExactLike,
    kernel: str | None = None,
    eos: str | None = None,
    density: str | None = None,
    **values: ExactLike,
) -> Scheme:
    """A particle method (``sph``, ``sph-av``, ``gph``) on a line of equal particles; limits are of ``C = c Δt/h``.

    Parameters
    ----------
    ratio : number
        Smoothing length over spacing.
    eos : str, optional
        ``isothermal``, ``ideal:7/5``, ``tait:0``.
    density : str, optional
        ``summation`` or ``continuity``.

    Examples
    --------
    >>> import courant_stability as courant
    >>> print(courant.particle_method("sph", "kdk", ratio="6/5").limit())
    1.0632206863
    """
    return Scheme._of(
        _state("method", name, integrator=integrator, kernel=kernel, ratio=ratio, density=density, eos=eos, values=values)
    )
