"""The documents that results hold, field by field, for type checkers.

At run time each is a plain dictionary. Numbers are in SI units, angles in radians; ``None`` stands for what is missing. ``command`` and
``output`` are the units of the log's columns.
"""

from __future__ import annotations

from typing import Literal, TypeAlias, TypedDict

#: Least and largest value.
Range: TypeAlias = list[float]
#: Two ends, either of which may be open.
OpenRange: TypeAlias = list[float | None]
Drag: TypeAlias = Literal["linear", "quadratic", "mixed"]
Trust: TypeAlias = Literal["good", "widened", "doubtful"]
ErrorSource: TypeAlias = Literal["sensor-gain", "clock", "heading-error", "thrust-dynamics"]
Consistency: TypeAlias = Literal["consistent", "refuted", "undecided"]
#: Settings of a characteristic: numbers, or the points of a graph.
Parameters: TypeAlias = dict[str, float | list[Range]]


class Combined(TypedDict):
    """The practical interval: the record's scatter, twice, and the declared sources; ``std`` is a quarter of its width."""

    std: float
    low: float
    high: float


class Estimate(TypedDict):
    """A value with its 95 % interval; ``None`` where the method knows no error."""

    value: float
    std: float | None
    low: float | None
    high: float | None
    combined: Combined | None
    """The practical interval; of ``reported`` alone."""


class StatisticalInterval(TypedDict):
    """A value with its 95 % interval, right if the model is exact."""

    value: float
    std: float
    low: float
    high: float


class Interval(StatisticalInterval):
    """A value that always has its 95 % interval: ``low`` and ``high`` are the statistical one, right if the model is exact."""

    combined: Combined
    """The practical interval, the one to use."""


class DragCovariance(TypedDict):
    """Covariance of linear, quadratic and cubic drag, in this order, over all models averaged: cubic drag counts where some have it."""

    statistical: list[list[float]]
    """Of the record's scatter: on the diagonal the squares of ``std``."""
    combined: list[list[float]] | None
    """Of the practical intervals: on the diagonal the squares of ``combined["std"]``, to be taken twice."""


class BudgetEntry(TypedDict):
    """A source of error that no residual shows, and its share of the inertia."""

    source: ErrorSource
    size: float
    unit: str
    share_percent: float
    remedy: str


class Note(TypedDict):
    """A reason or warning: a short name for programs, and what to do."""

    code: str
    text: str


class RefusedMethod(TypedDict):
    """A method that gave nothing, and why."""

    method: str
    code: str
    text: str


class Reported(TypedDict):
    """The one answer to use."""

    drag: Drag
    terms: list[str]
    alpha: Interval
    """Inertia with added mass, command s^2/output."""
    beta: Interval | None
    """Linear drag, command s/output."""
    beta_quadratic: Interval | None
    """Quadratic drag, command s^2/output^2."""
    beta_cubic: Interval | None
    drag_covariance: DragCovariance | None
    """How the three vary together; ``None`` where several records do not agree."""
    skew: Interval | None
    coulomb: Interval | None
    memory: Interval | None
    memory_s: Interval | None
    stiffness: Interval | None
    lag_s: Interval | None
    ramp_s: Interval | None
    pause_s: Interval | None
    filter_s: Interval | None
    delta: Interval | None
    """Constant force, command; of the only record."""
    deltas: list[Interval]
    delay_s: Estimate
    """Delay, s; without interval where it was given."""
    budget: list[BudgetEntry]
    trust: Trust
    reasons: list[Note]


class MethodEstimate(TypedDict):
    """What one method found under one drag law."""

    method: Literal["iso", "exact", "fit"]
    drag: Drag
    record: int | None
    terms: list[str]
    alpha: Estimate
    beta: Estimate | None
    beta_quadratic: Estimate | None
    delta: Estimate | None
    deltas: list[Estimate]
    delay_s: Estimate
    fit_percent: float | None
    residual_rms: float | None
    log_likelihood: float | None


class FeatureValues(TypedDict):
    """One number for each feature of a cycle: output units and s."""

    amplitude: float
    bias: float
    period_s: float
    switch_level: float
    time_positive_s: float
    time_negative_s: float


class Features(FeatureValues):
    """Means over the steady cycles, the relay's level, and standard deviations over cycles."""

    relay: float
    std: FeatureValues


class CycleStatistics(TypedDict):
    """Mean over cycles, and the standard deviation of one cycle's value."""

    mean: float
    std: float


class SteadyCycles(TypedDict):
    """The steady cycles of an experiment on board: units of the reading and s."""

    cycles: int
    start_up_cycles: int
    amplitude: CycleStatistics
    bias: CycleStatistics
    reference: CycleStatistics
    period_s: CycleStatistics
    switch_level: CycleStatistics
    time_positive_s: CycleStatistics
    time_negative_s: CycleStatistics


class ExactAxis(TypedDict):
    """An axis whose exact limit cycle has the features of an experiment, in the units of reading and command."""

    drag: Literal["linear", "quadratic"]
    alpha: float
    beta: float
    beta_quadratic: float
    delta: float


class AllRecords(TypedDict):
    """All records together."""

    samples: int
    duration_s: float
    cycles_used: int | None


class Predicted(TypedDict):
    """How well a model predicts a record."""

    fit_percent: float
    rms: float
    disturbance: float


class RecordSummary(AllRecords):
    """One record."""

    file: str
    skipped_rows: int
    features: Features | None
    predicted: Predicted | None


class Validated(TypedDict):
    """A record that took no part in the estimate."""

    file: str
    prediction: Predicted | None


class LogLikelihood(TypedDict):
    """Log-likelihood of each law less that of the likeliest."""

    linear: float | None
    quadratic: float | None
    mixed: float | None
    records: int


class DragChoice(TypedDict):
    """The drag law, and what speaks for it."""

    drag: Literal["linear", "quadratic", "mixed", "not-distinguishable"] | None
    confidence: float | None
    log_likelihood: LogLikelihood


class Contradicting(TypedDict):
    """A reading that contradicts others."""

    record: int
    sample: int
    model_above: bool
    share: float


class Outlier(TypedDict):
    """A reading that is in error by any amount."""

    record: int
    sample: int


class GuaranteedBounds(TypedDict):
    """What the method ``bounded`` found: ranges that hold under what is assumed."""

    verdict: Consistency
    drag: Drag
    search_box: dict[str, Range]
    alpha: Range | None
    beta: Range | None
    beta_quadratic: Range | None
    delta: Range | None
    deltas: list[Range]
    beta_cubic: Range | None
    stiffness: Range | None
    lag_s: Range | None
    delay_s: Range | None
    witness: dict[str, float] | None
    error: float
    error_factor: list[float | None]
    contradicting: list[Contradicting]
    outliers_allowed: int
    outliers: list[Outlier]


class Units(TypedDict):
    """Units of the numbers."""

    output: str
    alpha: str
    beta: str
    beta_quadratic: str
    beta_cubic: str
    stiffness: str
    delta: str


#: A quantity's name, and for one that each record has its own of, also the record's number: ``{"delta": 0}``.
Quantity: TypeAlias = str | dict[str, int]


class QuantityRange(TypedDict):
    """A range of a named quantity."""

    quantity: Quantity
    low: float
    high: float


class Point(TypedDict):
    """A parameter of the model, quantity by quantity, and the largest share of the error granted that it needs."""

    values: list[list[Quantity | float]]
    misfit: float


class FirstHarmonic(TypedDict):
    """A cycle by harmonic balance: output units and s."""

    amplitude: float
    bias: float
    period_s: float


class Cycle(TypedDict):
    """An exact limit cycle: output units and s."""

    amplitude: float
    bias: float
    maximum: float
    minimum: float
    period_s: float
    time_positive_s: float
    time_negative_s: float
    switch_level: float
    multiplier: float


class CycleEnclosure(TypedDict):
    """Ranges that contain the exact cycle's numbers."""

    amplitude: Range
    bias: Range
    maximum: Range
    minimum: Range
    period_s: Range
    time_positive_s: Range
    time_negative_s: Range
    switch_level: Range
    multiplier: Range


class CycleProof(TypedDict):
    """What is proved of a cycle."""

    unique: bool
    attracting: bool
    starts: str
    enclosure: CycleEnclosure


class OrbitEnclosure(TypedDict):
    """Ranges that contain the exact orbit's numbers."""

    period_s: Range
    time_high_s: Range
    time_low_s: Range
    amplitude: Range
    bias: Range


class Orbit(TypedDict):
    """An orbit of a relay loop with one switching each way in a period; a complex multiplier is its real and imaginary part."""

    period_s: float
    time_high_s: float
    time_low_s: float
    amplitude: float
    bias: float
    maximum: float
    minimum: float
    multipliers: list[float | Range]
    attracting: bool | None
    shown: str
    enclosure: OrbitEnclosure


class ProvedOscillation(TypedDict):
    """A box that is proved to hold an oscillation: amplitude of the first harmonic, frequency, and the mean square left for all others."""

    shown: bool
    amplitude: Range
    omega_rad_s: Range
    highest_harmonic: int
    remainder: float


class UnprovedOscillation(TypedDict):
    """Why no box is proved near an intersection."""

    shown: bool
    reason: str
    detail: str


class Intersection(TypedDict):
    """An oscillation that harmonic balance predicts; ``stable`` by the multipliers of the exact orbit, or by Loeb's criterion.

    ``existence`` is ``None`` where the characteristic has no bounded slope or is not odd.
    """

    amplitude: float
    omega_rad_s: float
    stable: bool | None
    stability_by: str
    unstable_roots: int | None
    exact: Orbit | None
    existence: ProvedOscillation | UnprovedOscillation | None


class DescribingFunctionEnclosure(TypedDict):
    """Ranges that contain the exact values."""

    f0: Range
    p: Range
    q: Range


class AmplitudeOfGain(TypedDict):
    """An amplitude that has the gain, input units, and the describing function there."""

    amplitude: float
    f0: float
    p: float
    q: float


class FittedCharacteristic(TypedDict):
    """A characteristic fitted to gains; the residual is in their units."""

    nonlinearity: str
    params: Parameters
    residual: float


class Parameter(TypedDict):
    """A parameter of a characteristic."""

    name: str
    meaning: str
    domain: str
    default: float | None


class Gains(TypedDict):
    """A controller: gains in command units per output unit, their derivative and integral, and a filter, s."""

    structure: Literal["pd", "pid", "ipd"]
    proportional: float
    integral: float
    derivative: float
    filter_s: float


class WorstMargin(TypedDict):
    """Margins of a loop; ``None`` where no factor makes it unstable."""

    gain: float | None
    gain_reduction: float | None
    phase_rad: float
    delay_s: float


class Margins(WorstMargin):
    """Margins of the nominal loop."""

    crossover_rad_s: float


class StepResponse(TypedDict):
    """The answer to a step of the reference: output units and s."""

    size: float
    rise_s: float | None
    overshoot_percent: float
    settling_s: float | None
    final_error: float
    top_speed: float


class Verified(TypedDict):
    """What was found of the loop without the design's equations."""

    poles: list[Range]
    bandwidth_rad_s: float | None
    step: StepResponse


class WorstCase(TypedDict):
    """Margins over every axis in the intervals: a bound from below, and the least that was met."""

    top_speed: float
    at_least: WorstMargin
    met: WorstMargin
    proved: bool


class SensitivityRange(TypedDict):
    """Largest sensitivity: the worst met, and a bound proved for every process of the intervals."""

    met: float
    proved_upper: float | None


class SensitivityLimit(TypedDict):
    """Largest sensitivity asked for, and the bound that is proved for every process of the intervals."""

    limit: float
    proved_upper: float | None


class ProcessStructure(TypedDict):
    """A structure of a process, its share of the evidence, and its parameters: gain, dead time, time constants, s."""

    family: Literal["first-order", "second-order", "equal-lags", "second-order-zero", "integrator", "integrator-lag"]
    weight: float
    parameters: dict[str, StatisticalInterval]


class ProcessRange(TypedDict):
    """A value of the likeliest process, and its range over every process of the intervals; it has no standard deviation."""

    value: float
    std: None
    low: float
    high: float


class Ultimate(TypedDict):
    """Ultimate gain and frequency, over every process of the intervals."""

    gain: ProcessRange
    omega_rad_s: ProcessRange


class ProcessGains(TypedDict):
    """Gains in parallel form: command units per output unit, per s and times s, and the derivative's filter, s."""

    form: Literal["parallel"]
    proportional: float
    integral: float
    derivative: float
    filter_s: float


class RuleOfThumb(TypedDict):
    """Gains of a classic rule, with the largest sensitivity of the likeliest process; ``None`` where the loop is not stable."""

    name: str
    proportional: float
    integral: float
    derivative: float
    sensitivity: float | None


class LoopCurves(TypedDict):
    """Curves of the loop with proved gains: open loop ``[real, imaginary]`` and answer to a load of one command unit.

    ``open_loop`` and ``load_step`` are those of the likeliest process; ``open_loops`` and ``load_step_range`` of the ends of the confidence set.
    """

    omega_rad_s: list[float]
    open_loop: list[Range]
    open_loops: list[list[Range]]
    time_s: list[float]
    load_step: list[float]
    load_step_range: list[Range]


class ProcessRecord(TypedDict):
    """The record behind gains: samples used, changes of the command, standard deviation of the residuals, output units."""

    name: str
    columns: list[str]
    samples: int
    changes: int
    residual: float
    interval_s: float


class UnderForce(TypedDict):
    """The step under the constant force, and the command that takes that force up."""

    delta: float
    feed_forward: float
    step: StepResponse


class Deviations(TypedDict):
    """Expected standard deviations; ``"inf"`` where a record tells nothing."""

    alpha: float | str
    beta: float | str
    beta_quadratic: float | str
    delay_s: float | str


class RelayRun(TypedDict):
    """One relay experiment and what it would tell."""

    relay_level: float
    half_width: float
    amplitude: float
    period_s: float
    locks: bool
    std: Deviations


class SecondRun(TypedDict):
    """A second level, which tells the drag laws apart."""

    run: RelayRun
    together: Deviations
    linear_needed: float
    quadratic_needed: float


class Proposal(TypedDict):
    """One experiment, and a second beside it."""

    first: RelayRun
    second: SecondRun | None


class ClaimPart(TypedDict):
    """A part of a claim's domain."""

    part: str
    text: str


# `from` is a word of Python.
ClaimVariable = TypedDict("ClaimVariable", {"name": str, "unit": str, "from": "float | str | None", "to": "float | str | None"})


class EstablishedPart(TypedDict):
    """A part of a domain on which a claim is established."""

    name: str
    text: str
    variables: list[ClaimVariable]


class Claim(TypedDict):
    """What was found of a claim."""

    id: str
    equation: str
    kind: str
    statement: str
    as_printed: str
    as_corrected: str
    evidence: str
    cases: int | None
    boxes: int | None
    residual_bound: float | None
    margin: float | None
    by_hand: list[str] | None
    kernel_checked: str | None
    not_proved: str | None
    domain: list[ClaimPart]
    established: list[EstablishedPart]
    witness: dict[str, float] | None
    as_stated: bool


class ClaimSummary(TypedDict):
    """How many claims have which verdict."""

    claims: int
    proved: int
    proved_in_part: int
    exhausted: int
    sampled: int
    kernel_checked: int
    undecided: int
    refuted: int
    refuted_as_printed: int
    not_as_stated: int


class Yaw(TypedDict):
    """Inertia, linear and quadratic drag of the paper's yaw axis."""

    alpha: float
    beta_r: float
    beta_rr: float


class Table4Row(Yaw):
    """One experiment of the paper."""

    experiment: int
    alpha_raised: float
    printed: Yaw


class Table4(TypedDict):
    """The paper's table 4, recomputed."""

    rows: list[Table4Row]
    mean: Yaw
    std_percent: Yaw
    recomputed_mean: Yaw
    recomputed_std_percent: Yaw
    level_offset: float
    level_offset_residual_percent: float


class Counts(TypedDict):
    """Choices of a drag law by one criterion of the paper's figure 15."""

    criterion: int
    correct: int
    wrong: int
    undecided: int


class JointRow(TypedDict):
    """All experiments of the paper fitted together under one law."""

    drag: str
    delay_estimated: bool
    alpha: float
    beta: float | None
    beta_quadratic: float | None
    delay_s: float
    residual_rms: float
    alpha_interval: Range | None
    beta_interval: Range | None
    beta_quadratic_interval: Range | None
    delay_interval_s: Range | None


class AuditItem(TypedDict):
    """A printed number beside what it should be."""

    group: str
    item: str
    printed: float
    recomputed: float
    range: Range
    agrees: bool
    note: str


class PaperConsistency(TypedDict):
    """Whether the printed numbers can be of one vehicle."""

    question: str
    allowed: str
    verdict: str
    searched: list[Range]
    delay_s: Range | None
    level_offset: Range | None
    growth: list[float | None] | None
    contradicting: list[int]
