"""The third checker of certificates: writes each inequality of a certificate as a theorem, which Coq's kernel accepts or refuses.
usage: certificates.py CERTIFICATES OUT

CERTIFICATES is a folder written by `selfosc verify --certificates`; OUT gets one theory a certificate. A theorem says what the
certificate says: its bound, expression, form and domain; of a curve, that its margin is above zero. The boxes are not used. Python's
standard library suffices."""

import json
import re
import sys
from fractions import Fraction
from pathlib import Path

HEAD = """\
(** {claim}: {statement}.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import {tactics}.
Open Scope R_scope.
"""
TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d+)?(?:e-?\d+)?)|([A-Za-z_]\w*)|([-+*/^(),]))")
FUNCTIONS = {
    **{name: name for name in ("exp", "ln", "sqrt", "sin", "cos", "atan", "tanh", "cosh")},
    "abs": "Rabs", "ln_1p": "ln_1p", "exp_m1": "exp_m1", "atanh": "atanh",
}


def number(text):
    """A number of a file is a double: its value, exactly."""
    value = Fraction(float(text))
    return str(value.numerator) if value.denominator == 1 else f"({value.numerator} / {value.denominator})"


class Formula:
    """An expression of a certificate as a term of Coq. Two factors side by side are multiplied; `x/y z` is `(x/y) z`."""

    def __init__(self, text):
        self.tokens, place = [], 0
        while text[place:].strip():
            found = TOKEN.match(text, place)
            if not found:
                raise ValueError(f"`{text[place:]}` is no formula")
            self.tokens.append(found.group().strip())
            place = found.end()
        self.tokens.append("")
        self.term = self.sum()
        self.take("")

    def take(self, *wanted):
        if wanted and self.tokens[0] not in wanted:
            raise ValueError(f"`{self.tokens[0]}` where `{wanted[0]}` is expected")
        return self.tokens.pop(0)

    def sum(self):
        term = f"- {self.take() and self.product()}" if self.tokens[0] == "-" else self.product()
        while self.tokens[0] in ("+", "-"):
            term += f" {self.take()} {self.product()}"
        return term

    def product(self):
        term = self.factor()
        while self.tokens[0] not in ("+", "-", ")", ",", ""):
            sign = self.take("/") if self.tokens[0] == "/" else "*"
            term += f" {sign} {self.factor()}"
        return term

    def factor(self):
        first = self.take()
        if first == "(":
            term = f"({self.sum()})"
            self.take(")")
        elif first[:1].isdigit():
            term = number(first)
        elif self.tokens[0] == "(" and first in FUNCTIONS:
            self.take()
            argument = self.sum()
            term = f"({FUNCTIONS[first]} {argument if argument.isidentifier() else f'({argument})'})"
            self.take(")")
        elif first.isidentifier():
            term = "PI" if first == "pi" else first
        else:
            raise ValueError(f"`{first}` is no factor")
        return f"{term} ^ {self.take('^') and self.take()}" if self.tokens[0] == "^" else term


def between(name, lower, upper, strict=False):
    below = f"{number(lower)} {'<' if strict else '<='} {name}"
    return below if upper is None else f"{below} <= {number(upper)}"


def lemma(inequality):
    """What a certificate says of one inequality, and the tactic for its form."""
    form, kind = inequality["form"], inequality["form"]["kind"]
    sides = [(name, *side) for name, side in zip(inequality["variables"], inequality["domain"]) if name]
    names, bound, term = [side[0] for side in sides], number(inequality["bound"]), Formula(inequality["expression"]).term
    # A curve's formula is 0/0 at zero; of a curve the theorem says that the margin is positive beside.
    domain = " -> ".join(between(*side, strict=kind == "enclosed" and side[1] == 0) for side in sides)
    if kind == "value":
        says = f"{bound} <= {term}"
    elif kind == "enclosed":
        says = f"0 < {term}"
    elif kind == "slope":
        by = names[form["by"]]
        says = f"exists slope, is_derive (fun {by} : R => {term}) {by} slope /\\ {bound} <= slope"
    elif kind == "over-power":
        first, near, upper = names[0], form["near"], inequality["domain"][0][1]
        says = f"{bound} * {first} ^ {form['order']} <= {term}"
        if upper is None or upper > near:
            near = number(near)
            says = f"({first} <= {near} -> {says}) /\\ ({near} <= {first} -> {bound} <= {term})"
    else:
        raise ValueError(f"no lemma is known for the form {kind}")
    return f"forall {' '.join(names)} : R, {domain} ->\n  {says}", names


def theory(certificate):
    curve = "_".join(certificate["claim"].split("-"))
    curves = any(inequality["form"]["kind"] == "enclosed" for inequality in certificate["inequalities"])
    yield HEAD.format(tactics="Margins Curves" if curves else "Margins", **certificate)
    for inequality in certificate["inequalities"]:
        says, names = lemma(inequality)
        kind = inequality["form"]["kind"].replace("-", "_")
        tactic = curve if kind == "enclosed" else f"{kind}_of"
        name = inequality["inequality"].replace("-", "_")
        yield f"(** {inequality['statement']} *)\nTheorem {name} : {says}.\nProof. {tactic} {' '.join(names)}. Qed.\n"


def main(folder, out):
    for path in sorted(Path(folder).glob("*.json")):
        certificate = json.loads(path.read_text())
        name = certificate["claim"].replace("-", "_")
        Path(out, f"Certificate_{name}.v").write_text("\n".join(theory(certificate)))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
