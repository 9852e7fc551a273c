r"""Formulas in LaTeX as plain text, with Unicode for letters and signs: \frac{v}{a} as v/a, \vartheta_1 as ϑ_1.

This reads the part of LaTeX that the project writes; an unknown command raises KeyError, so that a test of every
example finds it.
"""

import re
from collections.abc import Iterator
from functools import lru_cache

_LETTERS = (
    "alpha beta gamma delta varepsilon epsilon eta vartheta theta kappa lambda mu nu xi pi rho sigma tau varphi phi "
    "psi chi omega zeta Delta Gamma Sigma Omega Theta Phi Psi Lambda Pi"
)
_GREEK = dict(zip(_LETTERS.split(), "αβγδεϵηϑθκλμνξπρστφϕψχωζΔΓΣΩΘΦΨΛΠ", strict=True))
_SIGNS = {
    "cdot": "·", "times": "×", "le": "≤", "ge": "≥", "ne": "≠", "approx": "≈", "gg": "≫", "ll": "≪", "pm": "±",
    "mp": "∓", "to": "→", "Rightarrow": "⇒", "Leftrightarrow": "⇔", "in": "∈", "oplus": "⊕", "cup": "∪", "cap": "∩",
    "varnothing": "∅", "partial": "∂", "nabla": "∇", "infty": "∞", "circ": "°", "dots": "…", "ldots": "…", "cdots": "⋯",
    "vdots": "⋮", "lVert": "‖", "rVert": "‖", "Vert": "‖", "lvert": "|", "rvert": "|", "vert": "|", "lceil": "⌈",
    "rceil": "⌉", "lfloor": "⌊", "rfloor": "⌋", "sum": "Σ", "prod": "Π", "int": "∫", "ell": "ℓ", "perp": "⊥",
    "quad": "\u2003", "qquad": "\u2003", "left": "", "right": "", "hline": "", "top": "ᵀ", "prime": "'",
    "forall": "∀", "mid": "|", "equiv": "≡", "propto": "∝", "angle": "∠", "star": "*", "dagger": "⁺", "sharp": "#",
}  # fmt: skip
_BINARIES = "cdot times le ge ne approx gg ll pm mp to Rightarrow Leftrightarrow in oplus cup cap equiv propto"
_BINARY = frozenset(_BINARIES.split())
_NAMED = "sin cos tan arcsin arccos arctan max min log ln exp det dim ker rank mod arg"
_FUNCTIONS = frozenset(_NAMED.split())
_FACES = "mathrm mathsf mathbf mathbb mathcal mathit text textbf boldsymbol operatorname"
_FONTS = frozenset(_FACES.split())
_ACCENTS = {"dot": "\u0307", "ddot": "\u0308", "dddot": "\u20db", "hat": "\u0302", "bar": "\u0304", "tilde": "\u0303"}
_SPACES = {",", ";", ":", "", "!"}
_ROOTS = {"3": "∛", "4": "∜"}
_APPLIED = "\u2061"
"""Stands behind the name of a function until it is known whether its argument needs a space."""
_COMMA, _NEXT = "\u2063", "\u2064"
"""A decimal comma, and what separates the entries of a row, until the rows are read."""
_TOKEN = re.compile(r"\\(?:[A-Za-z]+\s*|.)|\s+|.", re.DOTALL)
_SUPERSCRIPTS = str.maketrans("0123456789+-=()ni", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁿⁱ")
_RAISED = set("0123456789+-=()ni")


@lru_cache(maxsize=1024)  # the formulas without numbers come again and again
def plain(latex: str) -> str:
    r"""Return a formula as plain text; rows of a matrix stand in brackets, separated by semicolons."""
    text = re.sub(_APPLIED + r"(?=[^\W_⁰¹²³⁴⁵⁶⁷⁸⁹]|√)", " ", _Reader(latex).group()).replace(_APPLIED, "")
    text = re.sub(r"(?<=[^\s:])(?=[=≤≥] )|(?<=[α-ωϑϕϵ])(?=[+-] )", " ", text)
    # At the beginning of a formula, a bracket or an argument a sign belongs to what follows.
    text = re.sub(r"(?:(^|[(\[{])\s*|([,;=]\s*))([±∓]) ", r"\1\2\3", text)
    text = text.replace(_NEXT, "\u2003" if _COMMA in text else ",").replace(_COMMA, ",")
    return re.sub(r" *\u2003 *", "  ", re.sub(r" +", " ", text)).strip()


class _Reader:
    """Reads a formula from left to right."""

    def __init__(self, latex: str) -> None:
        closed = re.sub(r"\s+(?=\\r(?:Vert|vert|ceil|floor)\b)", "", latex)
        self._tokens: Iterator[str] = iter([part.strip() or " " for part in _TOKEN.findall(closed)])

    def group(self) -> str:
        """Read to the closing brace, the end of an environment or the end of the formula."""
        parts = []
        while (part := next(self._tokens, None)) is not None and part != "}":
            if part == r"\end":
                self._argument()
                break
            parts.append(self._read(part))
        return "".join(parts)

    def _argument(self) -> str:
        part = next(self._tokens)
        return self._argument() if part == " " else self.group() if part == "{" else self._read(part)

    def _read(self, part: str) -> str:
        if part == "{":
            inner = self.group()
            return _COMMA if inner == "," else inner
        if part == "^":
            return _raised(self._argument())
        if part == "_":
            return _lowered(self._argument())
        if part == "&":
            return _NEXT
        if not part.startswith("\\"):
            return part
        return self._command(part[1:])

    def _command(self, name: str) -> str:
        if name in _GREEK:
            return _GREEK[name]
        if name in ("frac", "tfrac", "dfrac"):
            return f"{_factor(self._argument())}/{_factor(self._argument())}"
        if name == "sqrt":
            return self._root()
        if name in _ACCENTS:
            inner = self._argument()
            return inner[:1] + _ACCENTS[name] + inner[1:] if len(inner) <= 2 else f"d/dt({inner})"
        if name in _FONTS:
            return self._argument()
        if name in _FUNCTIONS:
            return name + _APPLIED
        if name == "begin":
            self._environment()
            return f"[{_rows(self.group())}]"
        if name in _SPACES:
            return " "
        if not name.isalpha():
            return "; " if name == "\\" else name
        return f" {_SIGNS[name]} " if name in _BINARY else _SIGNS[name]

    def _root(self) -> str:
        part = next(self._tokens)
        if part != "[":
            return f"√({self.group() if part == '{' else self._read(part)})"
        root = "".join(iter(lambda: next(self._tokens), "]"))
        return f"{_ROOTS.get(root, root + '√')}({self._argument()})"

    def _environment(self) -> None:
        if "array" in self._argument():
            self._argument()


def _rows(text: str) -> str:
    """Return the rows of a matrix, without the space that its source has around `&` and line ends."""
    return re.sub(rf"\s*([{_NEXT},;])\s*", r"\1 ", text).strip().removesuffix(";")


def _factor(text: str) -> str:
    return text if re.fullmatch(r"[^\s+\-·/×=,]+|\(.*\)", text) else f"({text})"


def _raised(text: str) -> str:
    if text in ("T", "ᵀ"):
        return "ᵀ"
    if text == "°":
        return text
    return text.translate(_SUPERSCRIPTS) if set(text) <= _RAISED else f"^{text}" if len(text) == 1 else f"^({text})"


def _lowered(text: str) -> str:
    text = text if text.count("(") > 1 else re.sub(r"^\((.*)\)$", r"\1", text.strip())
    return f"_{text}" if re.fullmatch(r"[^\s,+\-]+", text) else f"_({text})"
