"""Tables of answers: what they earn, and what is refused."""

import csv
import io
from collections import defaultdict

import pytest

from gelenk.errors import InvalidField, KinematicsError, TooLarge
from gelenk.exercises.grading import graded
from gelenk.exercises.mistakes.catalogue import mistake
from gelenk.language import language
from gelenk.sheets.grades import grades_table
from gelenk.sheets.key import key_table, written
from tests.exercises.forms import sent
from tests.sheets.examples import SECRET, homework

GEAR = "actuators.gear"
HEAD = "participant,exercise,field,answer\n"


def read(table: str, delimiter: str = ",") -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(table), delimiter=delimiter))


def test_the_key_earns_all_points() -> None:
    one = homework(participants=("Ada", "@home", "=1+1", "Müller; Öz"))
    grades = read(grades_table(key_table(one), SECRET))
    assert len(grades) == sum(len(variant.fields) for sheet in one.sheets for variant in sheet.variants)
    assert [grade for grade in grades if grade["points"] != grade["max_points"] or grade["mistake"]] == []
    assert {grade["participant"] for grade in grades} == {"Ada", "'@home", "'=1+1", "Müller; Öz"}


@pytest.mark.slow
def test_another_secret_earns_little() -> None:
    grades = read(grades_table(key_table(homework()), "some other phrase"))
    assert sum(float(grade["points"]) for grade in grades) < 0.7 * sum(float(grade["max_points"]) for grade in grades)


@pytest.mark.slow
def test_mistakes_have_their_names() -> None:
    """Those of the grades of one variant, in the current language."""
    one, rows, expected = homework(), [], {}
    for sheet in one.sheets:
        for variant in sheet.variants:
            for field in variant.fields:
                if field.kind in ("number", "choice") and (wrong := variant.mistakes(field)):
                    code, answer = max(wrong.items())
                    rows.append((sheet.participant, variant.exercise.id, field.name, answer))
                    expected[sheet.participant, variant.exercise.id, field.name] = code
    assert len(expected) > 20
    with language("de"):
        grades = read(grades_table(written(("participant", "exercise", "field", "answer"), rows), SECRET))
        assert all(one["text"] == mistake(one["mistake"]).text for one in grades if one["mistake"] in expected.values())
    found = {(one["participant"], one["exercise"], one["field"]): one for one in grades}
    assert {place: found[place]["mistake"] for place in expected} == expected


def test_grades_are_those_of_one_variant() -> None:
    (variant,) = homework(GEAR, participants=("Ada",)).sheets[0].variants
    names = [field.name for field in variant.fields]
    answers = {names[0]: 1.0, names[1]: sent(variant.answers[names[1]])}
    table = HEAD + "".join(f"Ada,{GEAR},{name},{value}\n" for name, value in answers.items())
    expected = graded(variant, answers)
    found = [(row["field"], float(row["points"])) for row in read(grades_table(table, SECRET))]
    assert found == [(one.name, one.points) for one in expected.fields]


@pytest.mark.parametrize(
    "form",
    [
        "{} {} {} {} {}",
        "{}; {}; {}; {}; {}",
        "[{}, {}, {}, {}, {}]",
        "({} {} {} {} {})",
        "({},0; {},0; {},0; {},0; {},0)",
        " {}  {} {},0 {} {} ",
    ],
)
def test_vectors_are_read_in_many_forms(form: str) -> None:
    (variant,) = homework("mobility.pairs", participants=("Ada",)).sheets[0].variants
    answer = form.format(*variant.answers["constraints"])
    (row,) = read(grades_table(HEAD + f'Ada,mobility.pairs,constraints,"{answer}"\n', SECRET))
    assert row["points"] == row["max_points"], answer


def test_matrices_are_read_by_rows() -> None:
    ids = [variant for sheet in homework().sheets for variant in sheet.variants]
    variant = next(one for one in ids if any(len(field.shape()) == 2 for field in one.fields))
    field = next(field for field in variant.fields if len(field.shape()) == 2)
    rows = sent(variant.answers[field.name])
    for answer in (rows, "\n; ".join("\t".join(map(str, row)).replace(".", ",") for row in rows)):
        table = HEAD + f'Ada,{variant.exercise.id},{field.name},"{answer}"\n'
        row = next(one for one in read(grades_table(table, SECRET)) if one["field"] == field.name)
        assert row["points"] == row["max_points"], answer


def test_a_table_as_spreadsheets_write_it_is_read() -> None:
    (variant,) = homework(GEAR, participants=("Zoë",)).sheets[0].variants
    field = variant.fields[0].name
    value = str(variant.answers[field]).replace(".", ",")
    table = f"\ufeffname;Participant;exercise;field;answer;\r\nx;Zoë;{GEAR};{field};{value};\r\n;;;;;\r\n"
    row = read(grades_table(table, SECRET), ";")[0]
    assert row["points"] == row["max_points"]


WRONG: dict[str, tuple[str, str, str]] = {
    "no head": ("", "row 1", "there is no column 'participant'"),
    "column": ("participant,exercise,answer\n", "row 1", "no column 'field'"),
    "exercise": (f"{HEAD}Ada,{GEAR},motor_speed,1\nAda,a.b,c,1\n", "row", ""),
    "unknown exercise": (f"{HEAD}Ada,a.b,c,1\n", "row 2", "there is no exercise 'a.b'"),
    "unknown field": (f"{HEAD}Ada,{GEAR},colour,1\n", "row 2", "has no field 'colour'; it has"),
    "twice": (f"{HEAD}Ada,{GEAR},a,1\n\nAda,{GEAR},a,2\n", "row 4", "has an answer in row 2 already"),
    "nobody": (f"{HEAD},{GEAR},a,1\n", "row 2", "1 to 80 characters"),
    "long name": (f"{HEAD}{'A' * 81},{GEAR},a,1\n", "row 2", "1 to 80 characters"),
    "short row": (f"{HEAD}Ada\n", "row 2", "there is no exercise ''"),
    "quotes": (f'{HEAD}Ada,"{GEAR}"x,a,1\n', "csv", "no CSV"),
    "open quote": (f'{HEAD}Ada,"{GEAR}\n', "csv", "no CSV"),
    "long cell": (f"{HEAD}Ada,{GEAR},a,{'1' * 200_000}\n", "csv", "no CSV"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_named(name: str) -> None:
    table, field, reason = WRONG[name]
    with pytest.raises(InvalidField) as error:
        grades_table(table, SECRET)
    assert error.value.field.startswith(field)
    assert reason in error.value.reason


def test_there_are_bounds() -> None:
    with pytest.raises(TooLarge):
        grades_table(HEAD + "\n" * 20_001, SECRET)
    with pytest.raises(TooLarge):
        grades_table(HEAD + "".join(f"p{i},{GEAR},a,1\n" for i in range(1001)), SECRET)


@pytest.mark.parametrize("answer", ["", "=1+1", "x" * 3000, "nan", "1e999", "[[[", ";;;", "\0", "1 2 3 4 5 6 7", "٣"])
def test_no_answer_is_an_error(answer: str) -> None:
    cell = answer.replace('"', '""')
    table = HEAD + f'Ada,mobility.pairs,constraints,"{cell}"\nAda,mobility.chain,loops,"{cell}"\n'
    try:
        grades = read(grades_table(table, SECRET))
    except KinematicsError as error:
        assert "\0" in answer, error  # csv itself refuses it in some versions of Python
    else:
        assert all(float(grade["points"]) == 0.0 for grade in grades if grade["field"] in ("constraints", "loops"))
        assert all(grade["mistake"] for grade in grades if answer == "")


def test_no_cell_is_a_formula() -> None:
    given = ["=1", "+1+1", "-1", "-1-1", "@a", "\tx", "\rx", "-0.5", "a=1", "'=1", "-inf"]
    rows = read(written(("cell",), [(one,) for one in given]))
    protected: dict[bool, list[str]] = defaultdict(list)
    for one, row in zip(given, rows, strict=True):
        protected[row["cell"] == one].append(one)
        assert row["cell"] in (one, f"'{one}")
    assert protected[True] == ["-1", "-0.5", "a=1", "'=1"]


def test_numbers_in_the_key_read_back() -> None:
    one = homework(GEAR, participants=("Ada",))
    (variant,) = one.sheets[0].variants
    found = {row["field"]: float(row["answer"]) for row in read(key_table(one))}
    assert found == pytest.approx(dict(variant.answers), rel=1e-11)
