"""What the package refuses, as exceptions that name the value, the limit and the remedy."""

from __future__ import annotations

import re

from ._names import near

__all__ = ["NoLimitCycle", "OutOfDomain", "RecordRefused", "SelfoscError", "UnreadableLog", "UsageError"]


class SelfoscError(ValueError):
    """Anything that the package refuses.

    Attributes
    ----------
    code : str
        Short name for programs; it does not change with the wording of the message.
    quantity, unit : str or None
        The number that is out of its domain, where one is the reason.
    value : float or None
        What it is, in ``unit``.
    limit, remedy : str or None
        What it has to be, and what to do.

    Examples
    --------
    >>> import selfosc
    >>> try:
    ...     selfosc.predict(alpha=-1.0, beta=1.0, relay=1.0, half_width=0.2)
    ... except selfosc.SelfoscError as error:
    ...     print(error.code, error.quantity, error.value, error.limit)
    out-of-domain alpha -1.0 a finite number above 0
    """

    def __init__(
        self,
        text: str,
        code: str = "usage",
        quantity: str | None = None,
        value: float | None = None,
        unit: str | None = None,
        limit: str | None = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(text)
        self.text, self.code = text, code
        self.quantity, self.value, self.unit, self.limit, self.remedy = quantity, value, unit, limit, remedy

    def __reduce__(self):  # so that it comes back whole from a worker process
        fields = (self.text, self.code, self.quantity, self.value, self.unit, self.limit, self.remedy)
        return type(self), fields


class OutOfDomain(SelfoscError):
    """A number outside its domain."""


class UsageError(SelfoscError):
    """Arguments that contradict each other or that nothing is known of."""


class RecordRefused(SelfoscError):
    """A record or its model that is refused; ``code`` says why."""


class NoLimitCycle(SelfoscError):
    """There is no limit cycle, or none that is exact to rounding."""


class UnreadableLog(SelfoscError):
    """A log that is damaged, truncated, empty or of another format."""


#: Codes that name wrong arguments; the others are answers.
_USAGE = {
    "usage", "mixed-needs-fit", "needs-bounded", "unknown-characteristic", "unknown-parameter", "missing-parameter", "parameter-kind",
    "output-is-input",
}  # fmt: skip


#: Flags of the command whose Python argument has another name.
_ARGUMENTS = {"from": "from_s", "to": "to_s", "jitter": "jitter_s", "num": "plant", "den": "plant"}
#: Flags that are switched on.
_SWITCHES = {"any-input", "degrees", "even-stamps", "hold-command", "invert", "radians", "skip-bad-rows", "wrap"}
#: What the command does, as Python does it.
_CALLS = {
    ", --budget and --certificate are": " and --budget are",
    "`selfosc autotune LOG`": "selfosc.autotune",
    "`selfosc df --list`": "selfosc.catalogue()",
    "; write them as 0.5,2": "; give (0.5, 2)",
    "`selfosc identify LOG --json > RESULT.json`": "selfosc.identify",
    "`selfosc verify --certificates DIR`": "the command `selfosc verify`",
    "`selfosc verify` without --claim": "selfosc.verify()",
}


def _in_python(text: str) -> str:
    """A message of the command with Python's names of the arguments."""
    for command, call in _CALLS.items():
        text = text.replace(command, call)
    text = text.split("\n\nUsage:")[0].split("\n\nFor more information")[0].removeprefix("error: ")

    def named(flag: re.Match[str]) -> str:
        name, value = flag["name"], flag["value"]
        argument = _ARGUMENTS.get(name, name.replace("-", "_"))
        if name in _SWITCHES:
            return f"{argument}=True"
        return f"{argument}={value}" if value else argument

    # A name that is not known stands before those that are.
    text = re.sub(r"`(?P<name>[^`]+)`; (?:known|it has): (?P<known>.+)", _meant, text)
    # A flag of which a message shows what it takes.
    text = re.sub(r"(?<=')(--[a-z-]+) <[^'>]+>(?:\.\.\.)?(?=')", r"\1", text)
    # The sentences of the command's parser.
    text = re.sub(r"the following required arguments were not provided:\s+<?(.+)", _missing, text)
    text = re.sub(r"the argument '--([a-z-]+)' cannot be used with '--([a-z-]+)'", r"--\1 must not be given with --\2; give one of them", text)
    text = re.sub(r"\s+\[possible values: (.+)\]", r": must be one of \1", text)
    text = re.sub(r"\s+tip: a similar value exists: '(.+)'", r"; did you mean \1?", text)
    text = re.sub(r"none is named (?P<name>[^ ,]+) among (?P<known>.+?); name one of these", _column, text)
    # A value stands in the parentheses of a remedy; elsewhere a word that follows is one of the sentence.
    text = re.sub(r"(?<=\()--(?P<name>[a-z][a-z-]*)(?: (?P<value>[^\s,)]+))?(?=[,)])", named, text)
    text = text.replace("--set ", "")
    text = re.sub(r"--(?P<name>[a-z][a-z-]*)(?P<value>)", named, text)
    # `alpha: alpha is -1` says it once.
    return re.sub(r"^(\w+): (?=\1 )", "", text).replace("(plant, plant)", "(plant)")


def _missing(flags: re.Match[str]) -> str:
    names = [name.replace("-", "_") for name in re.findall(r"--([a-z-]+)", flags[1]) if name != "num"]
    return f"{names[0]} is None: must be a value; give one" if len(names) == 1 else f"none of {', '.join(names)} is given: must be one; give one"


def _column(unknown: re.Match[str]) -> str:
    meant = near(unknown["name"], unknown["known"].split(", "))
    return unknown[0] if meant is None else f"none is named {unknown['name']} among {unknown['known']}; did you mean {meant}? Name one of these"


def _meant(unknown: re.Match[str]) -> str:
    meant = near(unknown["name"], unknown["known"].split(", "))
    return unknown[0] if meant is None else f"`{unknown['name']}`; did you mean {meant}? There are: {unknown['known']}"


def of(code: str, text: str, number: tuple[str, float, str, str, str] | None = None, record: bool = False) -> SelfoscError:
    """The exception of a refusal by the native half."""
    text = _in_python(text)
    if number is not None:
        return (RecordRefused if record else OutOfDomain)(text, code, *number)
    if code == "unreadable":
        return UnreadableLog(text, code)
    if code in _USAGE:
        return UsageError(text, code)
    return (RecordRefused if record else SelfoscError)(text, code)
