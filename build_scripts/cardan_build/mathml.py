"""Formulas for the documentation: a small subset of TeX's notation to MathML, which browsers draw by themselves.

Known: letters, words (two letters and more, upright), numbers, operators, ``_`` and ``^`` (in this order), ``{...}``,
``'``, ``\\frac{}{}``, ``\\sqrt{}``, ``\\text{}``, ``\\quad``, Greek letters and function names.
"""

from __future__ import annotations

import re
from html import escape

GREEK = {"beta": "β", "theta": "θ", "kappa": "κ", "varphi": "φ", "psi": "ψ", "omega": "ω",
         "delta": "δ"}
FUNCTIONS = frozenset({"sin", "cos", "tan"})
OPERATORS = {"cdot": "·", "partial": "∂"}
_SPACE = '<mspace width="0.17em"></mspace>'
_TOKEN = re.compile(r"\s*(\\[A-Za-z]+|[A-Za-z]{2,}[0-9]*|[0-9]+(?:\.[0-9]+)?|.)", re.DOTALL)
_TEXT = re.compile(r"\\text\{([^}]*)\}")


def mathml(formula: str) -> str:
    """Return a ``math`` element for a formula that stands on a line of its own.

    Parameters
    ----------
    formula : str
        In the notation of this module; it also goes in as the text for readers that cannot draw it.

    Raises
    ------
    ValueError
        A command is unknown or a brace is not closed.
    """
    reader = _Reader(formula)
    body = reader.row(until="")
    return f'<math display="block" alttext="{escape(formula)}"><mrow>{body}</mrow></math>'


class _Reader:
    """Reads a formula from left to right."""

    def __init__(self, formula: str) -> None:
        self.formula = formula
        self.texts = iter(_TEXT.findall(formula))
        self.tokens = _TOKEN.findall(_TEXT.sub(r"\\text ", formula).strip())
        self.place = 0

    def peek(self) -> str:
        return self.tokens[self.place] if self.place < len(self.tokens) else ""

    def take(self) -> str:
        token = self.peek()
        if not token:
            raise ValueError(f"formula ends too early: {self.formula}")
        self.place += 1
        return token

    def row(self, until: str) -> str:
        """Terms up to the token `until`, which is taken."""
        found: list[str] = []
        while self.peek() != until:
            name = self.peek()[1:] if self.peek().startswith("\\") else ""
            term = self.term()
            if name in FUNCTIONS:
                before = _SPACE if found and not found[-1].startswith("<mo") else ""
                term = before + term + ("" if self.peek() == "(" else _SPACE)
            found.append(term)
        if until:
            self.take()
        return "".join(found)

    def term(self) -> str:
        """An atom with its subscript and superscript."""
        base = self.atom()
        lower = self.script("_")
        upper = self.script("^")
        primes = ""
        while self.peek() == "'":
            self.take()
            primes += "&#8242;"
        if primes:
            upper = f"<mo>{primes}</mo>"
        if lower and upper:
            return f"<msubsup>{base}{lower}{upper}</msubsup>"
        if lower:
            return f"<msub>{base}{lower}</msub>"
        return f"<msup>{base}{upper}</msup>" if upper else base

    def script(self, sign: str) -> str:
        if self.peek() != sign:
            return ""
        self.take()
        return self.atom()

    def group(self) -> str:
        if self.take() != "{":
            raise ValueError(f"a brace is missing: {self.formula}")
        return f"<mrow>{self.row(until='}')}</mrow>"

    def atom(self) -> str:
        token = self.take()
        if token == "{":
            return f"<mrow>{self.row(until='}')}</mrow>"
        if token.startswith("\\"):
            return self.command(token[1:])
        if token[0].isdigit():
            return f"<mn>{token}</mn>"
        if token[0].isalpha():
            return f"<mi>{token}</mi>"
        if token in "()[]|":
            return f'<mo stretchy="false" lspace="0" rspace="0">{token}</mo>'
        return f"<mo>{'&#8722;' if token == '-' else escape(token)}</mo>"

    def command(self, name: str) -> str:
        if name == "frac":
            return f"<mfrac>{self.group()}{self.group()}</mfrac>"
        if name == "sqrt":
            return f"<msqrt>{self.group()}</msqrt>"
        if name == "text":
            return f"<mtext>{escape(next(self.texts))}</mtext>"
        if name == "quad":
            return '<mspace width="1.6em"></mspace>'
        if name in GREEK:
            return f"<mi>{GREEK[name]}</mi>"
        if name in FUNCTIONS:
            return f"<mi>{name}</mi>"
        if name in OPERATORS:
            return f"<mo>{OPERATORS[name]}</mo>"
        raise ValueError(f"\\{name} is unknown in the formula {self.formula}")
