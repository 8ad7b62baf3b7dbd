"""Expressions as the crate prints them, parsed into a tree and evaluated in any arithmetic."""

import re

from arithmetic import call
from range import Range

TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d+)?(?:e[+-]?\d+)?)|([A-Za-z_]\w*)|(.))")


def parse(text):
    """A tree of tuples: ("number", float), ("name", str), (operator, ...), ("call", name, arguments)."""
    tokens = []
    for number, name, other in TOKEN.findall(text):
        tokens.append(("number", float(number)) if number else ("name", name) if name else ("symbol", other))
    tree, rest = total(tokens)
    if rest:
        raise ValueError(f"`{text}`: {rest[0][1]!r} is out of place")
    return tree


def is_symbol(tokens, symbols):
    return bool(tokens) and tokens[0][0] == "symbol" and tokens[0][1] in symbols


def total(tokens):
    tree, tokens = quotient(tokens)
    while is_symbol(tokens, "+-"):
        operator = tokens[0][1]
        term, tokens = quotient(tokens[1:])
        tree = (operator, tree, term)
    return tree, tokens


def quotient(tokens):
    if is_symbol(tokens, "-"):
        tree, tokens = quotient(tokens[1:])
        return ("neg", tree), tokens
    tree, tokens = power(tokens)
    while tokens:
        if is_symbol(tokens, "/"):
            divisor, tokens = power(tokens[1:])
            tree = ("/", tree, divisor)
        elif tokens[0][0] != "symbol" or is_symbol(tokens, "("):
            factor, tokens = power(tokens)
            tree = ("*", tree, factor)
        else:
            break
    return tree, tokens


def power(tokens):
    tree, tokens = atom(tokens)
    if is_symbol(tokens, "^"):
        kind, exponent = tokens[1]
        if kind != "number" or not 0 < exponent < 10 or exponent != int(exponent):
            raise ValueError("an exponent is a whole number below ten")
        return ("^", tree, int(exponent)), tokens[2:]
    return tree, tokens


def atom(tokens):
    if not tokens:
        raise ValueError("the expression ends early")
    kind, value = tokens[0]
    if kind == "number":
        return ("number", value), tokens[1:]
    if kind == "name" and not is_symbol(tokens[1:], "("):
        return ("name", value), tokens[1:]
    if kind == "name":
        argument, tokens = total(tokens[2:])
        return ("call", value, argument), closed(tokens)
    if is_symbol(tokens, "("):
        tree, tokens = total(tokens[1:])
        return tree, closed(tokens)
    raise ValueError(f"{value!r} is out of place")


def closed(tokens):
    if not is_symbol(tokens, ")"):
        raise ValueError("a bracket is not closed")
    return tokens[1:]


def names(tree):
    """The variables that occur."""
    if tree[0] == "name":
        return {tree[1]}
    return set().union(*(names(part) for part in tree[1:] if isinstance(part, tuple)))


def evaluate(tree, of):
    """The value, with `of` giving the values of variables."""
    kind, *parts = tree
    if kind == "number":
        return Range(parts[0])
    if kind == "name":
        return of[parts[0]]
    if kind == "call":
        return call(parts[0], evaluate(parts[1], of))
    if kind == "neg":
        return -evaluate(parts[0], of)
    if kind == "^":
        result = base = evaluate(parts[0], of)
        for _ in range(parts[1] - 1):
            result = result * base
        return result
    a, b = (evaluate(part, of) for part in parts)
    return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: a / b}[kind]()
