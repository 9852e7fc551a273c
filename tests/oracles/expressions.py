"""Formulas as a reader takes them: text in, number out, by Python's own parser.

The plain text is an expression of Python as it stands. The LaTeX is rewritten to one: a space is a product unless a
sign stands beside it. Both know nothing but the legend: what each symbol is, in words of other symbols or as a number.
"""

import ast
import math
import re
from collections.abc import Mapping, Sequence

FUNCTIONS = {name: getattr(math, name) for name in ("cos", "sin", "sqrt", "acos", "atan2", "pi")}


def namespace(legend: Sequence[Mapping[str, object]], q: Sequence[float]) -> dict[str, float]:
    """Every symbol's value at a configuration: q1 … qn, and what the legend explains by them."""
    names = {f"q{i}": value for i, value in enumerate(q, start=1)}
    waiting = {str(entry["plain"]): entry for entry in legend}
    while waiting:
        before = len(waiting)
        for plain, entry in list(waiting.items()):
            if entry["value"] is not None:
                names[plain] = float(str(entry["value"]))
                del waiting[plain]
            elif plain in names:
                del waiting[plain]
            else:
                words = set(re.findall(r"[a-z]\w*", str(entry["meaning"]))) - FUNCTIONS.keys()
                if words <= names.keys():
                    names[plain] = value(str(entry["meaning"]), names)
                    del waiting[plain]
        assert len(waiting) < before, f"the legend does not explain {sorted(waiting)}"
    return names


def value(expression: str, names: Mapping[str, float]) -> float:
    """What an expression of arithmetic, cos, sin, sqrt, acos, atan2 and pi is."""
    tree = ast.parse(expression, mode="eval")
    allowed = (ast.Expression, ast.BinOp, ast.UnaryOp, ast.Call, ast.Name, ast.Constant, ast.operator, ast.unaryop)
    for node in ast.walk(tree):
        assert isinstance(node, (*allowed, ast.expr_context)), ast.dump(node)
    return float(eval(compile(tree, "formula", "eval"), {"__builtins__": {}}, {**FUNCTIONS, **names}))  # noqa: S307


def latex_value(latex: str, legend: Sequence[Mapping[str, object]], names: Mapping[str, float]) -> float:
    """What a formula in LaTeX is."""
    symbols = {str(entry["latex"]): str(entry["plain"]) for entry in legend}
    symbols |= {f"q_{{{name[1:]}}}": name for name in names if re.fullmatch(r"q\d+", name)}
    text = latex
    for symbol in sorted(symbols, key=len, reverse=True):
        text = text.replace(symbol, f" {symbols[symbol]} ")
    text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", text)
    text = re.sub(r"\\sqrt\{(\w+)\}", r" sqrt(\1) ", text)
    text = re.sub(r"\\(cos|sin)\^\{(\d+)\}\\left\(([^()]*)\\right\)", r" (\1(\3))**\2 ", text)
    text = re.sub(r"\\cdot 10\^\{(-?\d+)\}", r"* 10.0**(\1)", text)
    text = text.replace(r"\left(", "(").replace(r"\right)", ")").replace("\\cos", " cos").replace("\\sin", " sin")
    text = re.sub(r"\s*\^\{(\d+)\}", r"**\1", text)
    assert "\\" not in text, text
    return value(_with_products(text), names)


def latex_entries(latex: str) -> list[list[str]]:
    """The entries of a matrix."""
    inner = re.fullmatch(r"\\begin\{bmatrix\} (.*) \\end\{bmatrix\}", latex)
    assert inner is not None, latex
    return [row.split(" & ") for row in inner[1].split(r" \\ ")]


def _with_products(text: str) -> str:
    """A star between two factors that stand side by side."""
    words = re.findall(r"\d+\.?\d*(?:e-?\d+)?|[a-z]\w*|\*\*|[-+*/(),]", text)
    result = ""
    for before, word in zip(["", *words], words, strict=False):
        ends = before == ")" or re.fullmatch(r"[\w.]+", before)
        begins = word == "(" or re.fullmatch(r"[\w.]+", word)
        if ends and begins and not (before in {"cos", "sin", "sqrt"} and word == "("):
            result += "*"
        result += word
    return result
