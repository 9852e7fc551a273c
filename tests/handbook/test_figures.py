from docs.handbook.figures import compact


def test_a_drawing_has_few_digits_and_no_point_twice() -> None:
    drawing = '<path d="M 1.5 2.25 L 10.111 20.222 \nL 10.112 20.221 L 10.1 20.2 \nL 30 40 "/>'
    assert compact(drawing) == '<path d="M 1.5 2.2 L 10.1 20.2 L 30 40 "/>\n'


def test_names_do_not_change() -> None:
    assert compact('<g id="m0123456789"/> <use href="#m0123456789"/>') == '<g id="m0"/> <use href="#m0"/>\n'
