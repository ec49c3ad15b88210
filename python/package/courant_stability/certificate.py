"""Proofs that others can check."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _native


@dataclass(frozen=True)
class Certificate:
    """A file of certificates: of every limit of a scheme what is needed to check it without trusting this package.

    ``docs/verify_certificate.py`` and ``docs/verify_coefficients.py`` of the project check the same text with nothing but fractions.

    Examples
    --------
    >>> import courant_stability as courant
    >>> certificate = courant.scheme("leapfrog").certificate()
    >>> certificate.verify()
    ('u[n+1,j] = u[n-1,j] - C*(u[n,j+1] - u[n,j-1]): |z| <= 1 + 0 for all waves up to C = 1 and not just above',)
    >>> forged = courant.Certificate(certificate.text.replace('"1"', '"2"'))
    >>> forged.verify()
    Traceback (most recent call last):
    ValueError: ...
    """

    text: str

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Certificate:
        """Reads a file without believing it."""
        return cls(Path(path).read_text(encoding="utf-8"))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file that ``courant verify`` and the checkers in Python read."""
        Path(path).write_text(self.text, encoding="utf-8")

    def verify(self) -> tuple[str, ...]:
        """The theorems that hold, one for each certificate.

        Raises
        ------
        ValueError
            Naming the first part that does not hold.
        """
        return tuple(_native.verify(self.text)[0])

    @property
    def certificates(self) -> list[dict[str, Any]]:
        """The certificates as dictionaries."""
        found: list[dict[str, Any]] = json.loads(self.text)["certificates"]
        return found

    def __repr__(self) -> str:
        return f"Certificate({len(self.certificates)} of {len(self.text)} bytes)"
