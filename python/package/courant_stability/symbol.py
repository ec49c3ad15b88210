"""The equation that a scheme solves."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class ModifiedEquation:
    """The modified equation and the orders of accuracy.

    Attributes
    ----------
    text, latex : str or None
        The equation; nothing where there is none, and `reason` says why.
    terms : tuple
        Pairs of how often it is differentiated (along each axis, in several dimensions) and the factor as text.
    order : int or None
        At a fixed parameter.
    order_in_space, order_in_time : int or None
        As one is refined at a given other.
    record : dict
        What ``courant symbol --format json`` says, key by key.

    Examples
    --------
    >>> import courant_stability as courant
    >>> equation = courant.scheme("lax-wendroff").modified_equation()
    >>> print(equation)
    Δt ∂t u = -C Δx ∂x u - C (1 - C) (1 + C)/6 Δx^3 ∂x^3 u - C^2 (1 - C) (1 + C)/8 Δx^4 ∂x^4 u + …
    >>> equation.order, equation.terms[1]
    (2, (3, '-C (1 - C) (1 + C)/6'))
    """

    text: str | None
    latex: str | None = field(repr=False)
    terms: tuple[tuple[Any, str], ...] = field(repr=False)
    record: dict[str, Any] = field(repr=False)

    @classmethod
    def _of_json(cls, text: str) -> ModifiedEquation:
        answer = json.loads(text)
        record = answer["record"]

        def derivative(of: Any) -> Any:
            return tuple(of) if isinstance(of, list) else of

        terms = record["modified_equation"] or []
        return cls(
            text=answer["text"],
            latex=answer["latex"],
            terms=tuple((derivative(term["derivative"]), term["coefficient"]) for term in terms),
            record=record,
        )

    @property
    def reason(self) -> str | None:
        """Why there is no equation."""
        return self.record.get("modified_equation_reason")

    def _order(self, of: str) -> int | None:
        orders = self.record["order"]
        return None if orders is None else orders[of]

    @property
    def order(self) -> int | None:
        return self._order("overall")

    @property
    def order_in_space(self) -> int | None:
        return self._order("space")

    @property
    def order_in_time(self) -> int | None:
        return self._order("time")

    def __str__(self) -> str:
        return self.text if self.text is not None else f"no modified equation: {self.reason}"

    def _repr_latex_(self) -> str:
        return f"${self.latex}$" if self.latex is not None else str(self)
