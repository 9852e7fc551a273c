"""The printed pages."""

import re
from html import unescape
from html.parser import HTMLParser

import pytest

from gelenk.language import language
from gelenk.sheets.document import booklet_page, formula, marked_up, sheets_page
from tests.sheets.examples import SIGNS, homework, odd

MARKS = dict.fromkeys(map(ord, "^_()"))
VOID = {"meta", "img", "br", "mspace", "wbr"}


class Reader(HTMLParser):
    """Checks that elements nest, and keeps what a reader sees."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.all: list[tuple[str, dict[str, str | None]]] = []
        self.texts: list[str] = []
        self.feed(re.sub(r"</?su[bp]>", "", page))
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.all.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.texts.append(data)

    def has(self, text: str) -> bool:
        """Whether a reader sees a text, whose indices are written small."""
        return text.translate(MARKS) in [found.translate(MARKS) for found in self.texts]

    def count(self, tag: str, kind: str | None = None) -> int:
        return sum(name == tag and kind in (None, attrs.get("class")) for name, attrs in self.all)


@pytest.mark.slow
def test_each_participant_has_a_sheet_with_all_exercises_and_no_solution() -> None:
    one = homework()
    page = sheets_page(one)
    found = Reader(page)
    assert found.count("section", "sheet") == 2
    assert found.count("article") == 2 * len(one.exercises)
    assert found.count("math") == 0
    for sheet in one.sheets:
        assert sheet.participant in found.texts
        for variant in sheet.variants:
            first = variant.exercise.text(variant.numbers).split("\n\n")[0]
            assert found.has(first)
            assert all(found.has(field.label) for field in variant.fields)
            assert not {step.text for step in variant.exercise.steps(variant.numbers)} & set(found.texts)


@pytest.mark.slow
def test_the_booklet_has_every_answer_and_every_step() -> None:
    one = homework()
    found = Reader(booklet_page(one))
    formulas = 0
    for sheet in one.sheets:
        for variant in sheet.variants:
            steps = variant.exercise.steps(variant.numbers)
            assert all(step.title in found.texts for step in steps)
            formulas += sum(len(step.latex) for step in steps)
            for field in variant.fields:
                if choices := field.choices():
                    assert choices[variant.answers[field.name]] in found.texts
    assert found.count("div", "formula") == formulas


def test_texts_stay_texts() -> None:
    for page in (sheets_page(odd()), booklet_page(odd())):
        found = Reader(page)
        assert SIGNS in found.texts
        assert "<b>&\"'" in found.texts
        assert found.count("script") == 0
        assert "src=" not in re.sub(r'src="data:image/svg\+xml;base64,[A-Za-z0-9+/=]+"', "", page)
    assert Reader(sheets_page(odd())).count("img") == 1


def test_there_is_a_box_for_each_number() -> None:
    found = Reader(sheets_page(odd()))
    assert found.count("span", "box") == 1 + 3 + 6 + 2 * 8
    assert found.count("span", "choice") == 3


def test_pages_are_in_the_current_language() -> None:
    with language("de"):
        page = booklet_page(homework("actuators.gear", title=""))
    assert '<html lang="de">' in page
    assert "Ein Getriebe zwischen Motor und Gelenk" in page


def test_a_degree_is_no_raised_ring() -> None:
    assert formula(r"\alpha = 30^\circ") == formula(r"\alpha = 30^{\circ}")
    assert "msup" not in formula(r"\alpha = 30^\circ")


def maths(latex: str) -> list[str]:
    return re.findall(r"<math.*?</math>", formula(latex))


def test_a_long_formula_breaks_where_a_reader_would_break_it() -> None:
    assert len(maths(r"q = a + b")) == 1
    assert len(maths(r"q = a + b = c,\quad r = s")) == 3
    assert len(maths(r"v = (1,\; -2,\; 3)")) == 3
    assert (
        len(maths(r"x = \begin{bmatrix} a = b,\; c & d \end{bmatrix},\quad \max\left(a,\; b = c = d\right) = 1")) == 2
    )
    pieces = unescape("".join(maths(r"p_w = p - d_6 = \frac{a = b}{c} = 2")))
    assert re.findall(r"<m[ino]>(.*?)</m", pieces) == list("pw=p\u2212d6=a=bc=2")


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("R^3_6 from p_wx", "R<sup>3</sup><sub>6</sub> from p<sub>wx</sub>"),
        ("A^0_(i-1), k_t < ω_z", "A<sup>0</sup><sub>i-1</sub>, k<sub>t</sub> &lt; ω<sub>z</sub>"),
        ("joint_1, J#, q1, x^, a__b, 2_3, tool_link", "joint_1, J#, q1, x^, a__b, 2_3, tool_link"),
    ],
)
def test_the_indices_of_letters_are_small(text: str, html: str) -> None:
    assert marked_up(text) == html
