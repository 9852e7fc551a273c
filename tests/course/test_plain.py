"""Formulas as plain text."""

import pytest

from gelenk.course.plain import plain


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"\frac{v}{a}", "v/a"),
        (r"T = \frac{L a + v^2}{a v} = \frac{2 \cdot 1.6 + 0.8^2}{3}", "T = (L a + v²)/(a v) = (2 · 1.6 + 0.8²)/3"),
        (r"\vartheta_1^2 + \dot{q}_{12} \ge \ddot q", "ϑ_1² + q̇_12 ≥ q̈"),
        (r"\begin{bmatrix} a & b \\ c & d \end{bmatrix}", "[a, b; c, d]"),
        (r"\begin{array}{c|cc} i & a \\ \hline 1 & 2 \end{array}", "[i, a; 1, 2]"),
        (r"J^{\#} = J^{\mathsf T}(J J^T)^{-1},\quad x", "J^# = Jᵀ(J Jᵀ)⁻¹,  x"),
        (r"t = \sqrt{\frac{L}{a}} = 3\,\mathrm{m/s}", "t = √(L/a) = 3 m/s"),
        (r"q_\mathrm{max}\left(a\right) \in \{1, 2\}", "q_max(a) ∈ {1, 2}"),
        (r"\lVert x \rVert \le 90^\circ", "‖x‖ ≤ 90°"),
        (r"\det J_{(v_x, v_y)} + [r]_{\times}^2", "det J_(v_x, v_y) + [r]_×²"),
        (r"\sqrt[3]{\frac{q}{j}} + \sqrt2", "∛(q/j) + √(2)"),
        (r"\sigma = \cos 2 + \max(a,\ b)", "σ = cos 2 + max(a, b)"),
        (r"x^{i-1}_{i+1} \frac12", "xⁱ⁻¹_(i+1) 1/2"),
        (r"\rho = 2, \sum_i \sigma_i", "ρ = 2, Σ_i σ_i"),
        (r"\varphi - \cos^2 \psi + x", "φ - cos² ψ + x"),
        (r"x = \pm\sqrt{a} \pm b", "x = ±√(a) ± b"),
        (r"f(\pm y, \mp x)", "f(±y, ∓x)"),
        (r"(0{,}3;\; 1)\begin{bmatrix} 0{,}5 & 1 \\ 2 & 3 \end{bmatrix}^2", "(0,3; 1)[0,5  1; 2  3]²"),
        (r"\det J = \det(J^T), \dim = 1", "det J = det(Jᵀ), dim = 1"),
    ],
)
def test_a_formula_reads_the_same_without_latex(latex: str, expected: str) -> None:
    """Fractions, scripts, matrices, letters and signs become Unicode."""
    assert plain(latex) == expected


def test_an_unknown_command_is_an_error() -> None:
    """So that a formula which cannot be converted is found by the tests of the examples."""
    with pytest.raises(KeyError, match="unknowncommand"):
        plain(r"\unknowncommand{x}")
