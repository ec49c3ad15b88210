"""Von Neumann stability of numerical schemes, with proof, on NumPy arrays.

>>> import courant_stability as courant
>>> courant.Scheme("u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1])").limit()
Limit(C = 1, proved, interior)

A scheme is typed (`Scheme`), of the catalogue (`scheme`, `lines`, `particle_method`), or a program that is measured (`probe`).
`limits_table` and `stability_map` sweep over arrays of parameters; `courant_stability.dask` does so on a cluster.
"""

from ._native import names as _names
from .blocks import limit_dtype
from .certificate import Certificate
from .errors import TextError
from .exact import AlgebraicNumber
from .limit import Interval, Limit, StableSet
from .maps import StabilityMap, stability_map
from .probing import Probe, probe
from .subject import Scheme, lines, particle_method, scheme
from .symbol import ModifiedEquation
from .tables import CAUSES, EVIDENCE, LimitsTable, limits_table
from .validation import Validation
from .verdict import Verdict

#: The names of the catalogue.
schemes, spaces, methods, integrators, kernels = (tuple(names) for names in _names())

__all__ = [
    "CAUSES",
    "EVIDENCE",
    "AlgebraicNumber",
    "Certificate",
    "Interval",
    "Limit",
    "LimitsTable",
    "ModifiedEquation",
    "Probe",
    "Scheme",
    "StabilityMap",
    "StableSet",
    "TextError",
    "Validation",
    "Verdict",
    "integrators",
    "kernels",
    "limit_dtype",
    "limits_table",
    "lines",
    "methods",
    "particle_method",
    "probe",
    "scheme",
    "schemes",
    "spaces",
    "stability_map",
]
