"""The checker refuses what is wrong. Certificates come from the folder named by SELFOSC_CERTIFICATES."""

import copy
import json
import os
from pathlib import Path

import pytest

import check
import statements
from expression import evaluate, parse
from range import Range

FOLDER = Path(os.environ["SELFOSC_CERTIFICATES"])
CLAIM = "orbit-quadratic-disturbed"
ORIGINAL = json.loads((FOLDER / f"{CLAIM}.json").read_text())


def item(certificate, name):
    return next(item for item in certificate["inequalities"] if item["inequality"] == name)


def longest(certificate):
    return max(certificate["inequalities"], key=lambda item: len(item["boxes"]))


def shrink(certificate):
    box = longest(certificate)["boxes"][0]
    box[0][1] = box[0][0] + 0.75 * (box[0][1] - box[0][0])


def change_domain(certificate):
    item(certificate, "braking")["domain"][0] = [-0.5, 0.5]


CHANGES = {
    "a raised bound": lambda c: item(c, "braking").update(bound=1.1),
    "a bound of zero": lambda c: item(c, "braking").update(bound=0.0),
    "a missing box": lambda c: longest(c)["boxes"].pop(),
    "a box too small": shrink,
    "another domain": change_domain,
    "a wrong expression": lambda c: item(c, "braking").update(expression="mu/2 - 1 - drag"),
    "a wrong factor": lambda c: item(c, "force-slow").update(expression="1 - 9/10 (linear_share + speed - linear_share speed) speed"),
    "a constant": lambda c: item(c, "braking").update(expression="1"),
    "another form": lambda c: item(c, "excess-first").update(form={"kind": "value"}),
    "another variable": lambda c: item(c, "excess-first").update(form={"kind": "slope", "by": 2}),
    "another statement": lambda c: c.update(statement="Every loop oscillates"),
    "another claim": lambda c: c.update(claim="orbit-linear"),
    "another format": lambda c: c.update(format=2),
    "a missing inequality": lambda c: c["inequalities"].pop(),
    "a missing field": lambda c: c.pop("inequalities"),
}


def test_what_the_command_writes_is_accepted():
    assert check.check(ORIGINAL, CLAIM) > 0


@pytest.mark.parametrize("change", CHANGES)
def test_refused(change, tmp_path):
    certificate = copy.deepcopy(ORIGINAL)
    CHANGES[change](certificate)
    path = tmp_path / f"{CLAIM}.json"
    path.write_text(json.dumps(certificate))
    with pytest.raises(check.Refused):
        check.check_file(path)


def test_the_words_of_the_table_are_those_that_the_command_writes():
    for claim in [*statements.CLAIMS, *statements.CURVES]:
        written = json.loads((FOLDER / f"{claim}.json").read_text())
        inequalities = {item["inequality"]: item["statement"] for item in written["inequalities"]}
        assert statements.WORDS[claim] == {"domain": written["domain"], "by_hand": written["by_hand"], "inequalities": inequalities}
    assert set(statements.WORDS) == {*statements.CLAIMS, *statements.CURVES}


def test_a_curve_with_too_narrow_a_bound_is_refused():
    certificate = json.loads((FOLDER / "method-bias-alpha-linear.json").read_text())
    item(certificate, "at-one")["bound"] = 0.1
    with pytest.raises(check.Refused):
        check.check(certificate, "method-bias-alpha-linear")


def test_a_curve_with_another_expression_is_refused():
    certificate = json.loads((FOLDER / "method-bias-alpha-linear.json").read_text())
    curve = item(certificate, "at-one")
    curve["expression"] = curve["expression"].replace("16 ", "15 ")
    with pytest.raises(check.Refused):
        check.check(certificate, "method-bias-alpha-linear")


def test_a_missing_file_and_an_unknown_one_are_refused(tmp_path, capsys):
    (tmp_path / "another.json").write_text("{}")
    assert check.main(tmp_path) == 1
    said = capsys.readouterr().out
    assert said.count("refused") == 1 + len(statements.CLAIMS) + len(statements.CURVES)


def test_expressions_are_read_as_they_are_printed():
    of = {"x": Range(3), "y_1": Range(5)}
    for text, value in [
        ("1 - 2 x^2/(3 y_1) + exp(0)", 1.0 - 18.0 / 15.0 + 1.0),
        ("-x y_1/2", -7.5),
        ("2 (x + y_1) x", 48.0),
        ("-(x - y_1)^2", -4.0),
        ("1.5e-3 x", 0.0045),
    ]:
        found = evaluate(parse(text), of)
        assert abs(float(found.lower) - value) < 1e-14, text
    for text in ["", "1 +", "(x", "x^y_1", "sin(x)", "x ) 2"]:
        with pytest.raises(ValueError):
            evaluate(parse(text), of)


def test_gaps_are_seen():
    square = [(0.0, 1.0), (0.0, 1.0)]
    left, right = [(0.0, 0.5), (0.0, 1.0)], [(0.5, 1.0), (0.0, 1.0)]
    assert check.covered(square, [left, right])
    assert not check.covered(square, [left])
    assert not check.covered(square, [left, [(0.5, 1.0), (0.0, 0.999)]])
    assert not check.covered(square, [[(0.0, 0.5), (0.0, 0.5)], [(0.5, 1.0), (0.5, 1.0)]])
