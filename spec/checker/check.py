"""Verifies the certificates that `selfosc verify --certificates DIR` writes. See README.md."""

import json
import random
import sys
from pathlib import Path

from flint import arb

import statements
from arithmetic import Bend, Jet
from expression import evaluate, names, parse
from range import Range

FORMAT = 1
VARIABLES = 3
MOST_BOXES = 20_000
POINTS = 60
AGREEMENT = arb("1e-12")
HALVINGS = 12


class Refused(Exception):
    """Why a certificate is not accepted."""


def require(condition, reason):
    if not condition:
        raise Refused(reason)


def read(path):
    """The JSON of a file; no number is endless or beyond a double, and no name stands twice."""

    def refuse(text):
        raise ValueError(f"{text[:20]} is no number")

    def finite(text):
        value = float(text)
        return value if abs(value) < float("inf") else refuse(text)

    def fields(pairs):
        require(len(dict(pairs)) == len(pairs), "a field stands twice")
        return dict(pairs)

    whole = lambda text: int(text) if len(text) < 17 else refuse(text)
    return json.loads(Path(path).read_text(), parse_constant=refuse, parse_float=finite, parse_int=whole, object_pairs_hook=fields)


def checked(check, path, *given):
    """The answer of a check of a file. Whatever a file makes fail is a reason to refuse it."""
    try:
        return check(read(path), *given)
    except Refused:
        raise
    except Exception as fault:
        raise Refused(f"malformed: {fault!r:.200}") from fault


def margin(form, formula, box):
    """What is positive, over a box."""
    if form["kind"] in ("value", "enclosed"):
        return formula(*box)
    if form["kind"] == "over-power" and float(box[0].upper) > form["near"]:
        return formula(*box)
    if form["kind"] == "over-power":
        at_zero = formula(Jet.variable(Range(0)), *box[1:])
        require(all(term.vanishes() for term in at_zero.terms[: form["order"]]), "the zero at zero is of a lower order")
        return formula(Jet.variable(box[0].join(Range(0))), *box[1:]).terms[form["order"]]
    by, over = form["by"], formula(*Bend.variables(box))
    middle = [side.middle() for side in box]
    if None in middle:
        return over.slopes[by]
    centred = formula(*Bend.variables(middle)).slopes[by]
    for bend, side, centre in zip(over.bends[by], box, middle):
        centred = centred + bend * (side - centre)
    return over.slopes[by].meet(centred)


def shown(form, formula, box, bound, halvings=HALVINGS):
    """Whether the margin is at least the bound on the box, halved where one evaluation does not tell."""
    try:
        if margin(form, formula, box).lower >= bound:
            return True
    except ValueError:
        pass
    sizes = [float(side.upper - side.lower) for side in box]
    place = max(range(len(box)), key=sizes.__getitem__)
    middle = box[place].middle()
    if halvings == 0 or middle is None or sizes[place] == 0.0:
        return False
    halves = [Range(box[place].lower, middle.lower), Range(middle.upper, box[place].upper)]
    return all(shown(form, formula, box[:place] + [half] + box[place + 1 :], bound, halvings - 1) for half in halves)


def covered(whole, boxes):
    """Whether boxes cover one, of pairs of floats: cut at an end of a box until each part lies in a single one."""
    open_parts = [(whole, boxes)]
    while open_parts:
        part, boxes = open_parts.pop()
        meets = lambda box: all(a < t and f < b or f == t == a == b for (f, t), (a, b) in zip(box, part))
        boxes = [box for box in boxes if meets(box)]
        if any(all(f <= a and b <= t for (f, t), (a, b) in zip(box, part)) for box in boxes):
            continue
        cuts = [(end, i) for box in boxes for i, side in enumerate(box) for end in side if part[i][0] < end < part[i][1]]
        if not cuts:
            return False
        end, i = sorted(cuts)[len(cuts) // 2]
        for side in ((part[i][0], end), (end, part[i][1])):
            open_parts.append((part[:i] + [side] + part[i + 1 :], boxes))
    return True


def agree(form, formula, other, domain):
    """Whether two formulas are the same at points of the domain, by their values; the other may be an enclosure with a width."""
    draw = random.Random(1)
    for _ in range(POINTS):
        ends = [(lower, min(upper, lower + 30.0)) for lower, upper in domain]
        point = [Range(arb(draw.uniform(*side))) for side in ends]
        enclosed = other(*point)
        difference, size = formula(*point) - enclosed, formula(*point).size().upper + 1
        if not difference.size().upper <= AGREEMENT * size + (enclosed.upper - enclosed.lower):
            return False
    return True


def pairs(sides, count):
    """The sides of a box as pairs of floats; those beyond `count` must be zero."""
    sides = [(float("-inf") if a is None else float(a), float("inf") if b is None else float(b)) for a, b in sides]
    require(len(sides) == VARIABLES and all(a <= b for a, b in sides), "a box is malformed")
    require(all(side == (0.0, 0.0) for side in sides[count:]), "an unused variable is not zero")
    return sides[:count]


def check_inequality(item, form, variables, own):
    """One inequality against the table's form, variables and formula; the number of boxes."""
    name = item["inequality"]
    require(item["form"] == form, f"{name}: another form")
    used = [variable for variable in item["variables"] if variable]
    require(used == [variable[0] for variable in variables], f"{name}: other variables")
    domain = pairs(item["domain"], len(used))
    require(domain == [(lower, upper) for _, lower, upper in variables], f"{name}: another domain")
    bound = arb(item["bound"])
    # Constants of an expression are rounded to doubles, those of the table are not.
    formulas = [(own, bound - AGREEMENT)]
    require(item["expression"] is not None, f"{name}: no expression")
    tree = parse(item["expression"])
    require(names(tree) <= set(used) | {"pi"}, f"{name}: the expression has other variables")
    printed = lambda *at: evaluate(tree, dict(zip(used, at)) | {"pi": statements.PI})
    require(agree(form, printed, own, domain), f"{name}: the expression is not the formula")
    # A curve's expression is 0/0 at zero: its values there are the table's.
    if form["kind"] != "enclosed":
        formulas.append((printed, bound))
    require(bound > AGREEMENT, f"{name}: the bound is not above zero")
    require(len(item["boxes"]) <= MOST_BOXES, f"{name}: more than {MOST_BOXES} boxes")
    boxes = [pairs(box, len(used)) for box in item["boxes"]]
    require(covered(domain, boxes), f"{name}: the boxes do not cover the domain")
    for box in boxes:
        sides = [Range(arb(lower), arb(upper)) for lower, upper in box]
        for formula, least in formulas:
            require(shown(form, formula, sides, least), f"{name}: not at least {item['bound']} on {box}")
    return len(boxes)


def check(certificate, claim):
    """The number of boxes, or Refused."""
    require(certificate["format"] == FORMAT, "another format")
    require(certificate["claim"] == claim, "another claim")
    require(certificate["statement"] == statements.statement(claim), "another statement")
    table, words = statements.inequalities(claim), statements.WORDS[claim]
    found = [item["inequality"] for item in certificate["inequalities"]]
    require(sorted(found) == sorted(table), f"inequalities {found}, not {list(table)}")
    for name in ("domain", "by_hand"):
        require(certificate[name] == words[name], f"another {name}")
    for item in certificate["inequalities"]:
        require(item["statement"] == words["inequalities"][item["inequality"]], f"{item['inequality']}: another statement")
    return sum(check_inequality(item, *table[item["inequality"]]) for item in certificate["inequalities"])


def check_file(path):
    return checked(check, path, Path(path).stem)


def main(folder):
    claims = [*statements.CLAIMS, *statements.CURVES]
    width, accepted = max(map(len, claims)), True
    for claim in claims:
        path = Path(folder, f"{claim}.json")
        try:
            print(f"{claim:{width}}  accepted  {check_file(path)} boxes")
            for step in statements.WORDS[claim]["by_hand"]:
                print(f"{'':{width}}  by hand   {step}")
        except Refused as reason:
            accepted = False
            print(f"{claim:{width}}  refused   {reason}")
    for path in sorted(Path(folder).glob("*.json")):
        if path.stem not in claims:
            accepted = False
            print(f"{path.stem:{width}}  refused   no such statement in the table")
    return 0 if accepted else 1


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
