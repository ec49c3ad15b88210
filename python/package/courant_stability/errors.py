"""What is wrong with a text, and where."""

from __future__ import annotations


class TextError(ValueError):
    """A text that is no scheme, with the place of the problem.

    Attributes
    ----------
    problem : str
        What is wrong and what would be accepted.
    text : str
        The whole text.
    line, column : int
        Where the problem begins, both from 1.

    Examples
    --------
    >>> import courant_stability as courant
    >>> courant.Scheme("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]")
    Traceback (most recent call last):
    courant_stability.errors.TextError: line 1, column 41: `)` is missing
      u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1]
                                              ^
    """

    def __init__(self, problem: str, text: str = "", start: int = 0, end: int = 0) -> None:
        self.problem, self.text = problem, text
        before = text[:start]
        self.line = before.count("\n") + 1
        begin = before.rfind("\n") + 1
        self.column = start - begin + 1
        shown = text[begin:].split("\n", 1)[0]
        width = max(1, min(end, begin + len(shown)) - start)
        caret = " " * (start - begin) + "^" * width
        super().__init__(f"line {self.line}, column {self.column}: {problem}\n  {shown}\n  {caret}")
        self._place = (start, end)

    @classmethod
    def at_bytes(cls, problem: str, text: str, start: int, end: int) -> TextError:
        """With places counted in bytes of UTF-8, as the parser counts them."""
        encoded = text.encode()

        def characters(place: int) -> int:
            return len(encoded[:place].decode(errors="ignore"))

        return cls(problem, text, characters(start), characters(end))

    def __reduce__(self) -> tuple[type[TextError], tuple[str, str, int, int]]:
        return type(self), (self.problem, self.text, *self._place)
