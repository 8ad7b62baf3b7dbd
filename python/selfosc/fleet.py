"""Many records: one pure function over Arrow, and the few lines that give it to Spark, Dask or Ray.

A record is a table with the columns that :func:`selfosc.identify` reads. Whatever happens to it, the result is one row of
:data:`SCHEMA`: a refused record is a row with a code.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import pyarrow as pa

from . import __version__, _arguments
from .errors import SelfoscError, UsageError
from .identification import identify

if TYPE_CHECKING:
    import pyspark.sql

__all__ = ["SCHEMA", "identify_dask", "identify_ray", "identify_record", "identify_spark", "identify_tables"]

_PARAMETERS = ("alpha", "beta", "beta_quadratic", "delta", "delay_s")

#: One row for each record. Units as in :func:`selfosc.identify`; what is missing is null.
SCHEMA = pa.schema(
    [
        pa.field("record", pa.string(), nullable=False),
        pa.field("samples", pa.int64()),
        pa.field("duration_s", pa.float64()),
        pa.field("drag", pa.string()),
        *(pa.field(f"{name}{end}", pa.float64()) for name in _PARAMETERS for end in ("", "_std", "_low", "_high")),
        pa.field("trust", pa.string()),
        pa.field("reasons", pa.string()),
        pa.field("warnings", pa.string()),
        pa.field("refused", pa.string()),
        pa.field("text", pa.string()),
        pa.field("version", pa.string(), nullable=False),
    ]
)


def identify_record(table: pa.Table, record: str = "record", **settings: Any) -> pa.Table:
    """One record as one row.

    Parameters
    ----------
    table : pyarrow.Table
        Time, output and command.
    record : str
        Its name.
    **settings
        As for :func:`selfosc.identify`. One that there is not is no fault of the record, and raises.

    Returns
    -------
    pyarrow.Table
        One row of :data:`SCHEMA`. The same record and settings give the same bytes, wherever they are worked on.

    Examples
    --------
    >>> import pyarrow as pa
    >>> from selfosc import simulate
    >>> from selfosc.fleet import identify_record
    >>> good = pa.table(simulate(alpha=1, beta=0.5, relay=1, half_width=0.3, cycles=8, noise=0.003, hold=True))
    >>> identify_record(good, "dive 7", method="fit").column("refused")[0].as_py() is None
    True
    >>> identify_record(good.slice(0, 5), "dive 8").column("refused")[0].as_py()
    'too-short'
    """
    _arguments.check(identify, settings)
    if not isinstance(table, pa.Table):
        raise UsageError(f"table is {_arguments.shown(table)}: must be a pyarrow.Table; give one")
    row: dict[str, Any] = {"record": _arguments.text(record, "record"), "version": __version__}
    try:
        row |= _row(identify(table, **settings).to_dict())
    except SelfoscError as refusal:
        # The shape of any frame: Arrow, pandas, polars.
        row |= {"samples": getattr(table, "shape", (None,))[0], "refused": refusal.code, "text": str(refusal)}
    return pa.Table.from_pylist([row], schema=SCHEMA)


def _row(document: dict[str, Any]) -> dict[str, Any]:
    answer = document["reported"] or {}
    row = {"samples": document["record"]["samples"], "duration_s": document["record"]["duration_s"]}
    row |= {"drag": answer.get("drag"), "trust": answer.get("trust")}
    for name in _PARAMETERS:
        for end, field in (("", "value"), ("_std", "std"), ("_low", "low"), ("_high", "high")):
            number = (answer.get(name) or {}).get(field)
            row[f"{name}{end}"] = number if number is not None and math.isfinite(number) else None
    row["reasons"] = " ".join(reason["code"] for reason in answer.get("reasons", ()))
    row["warnings"] = " ".join(warning["code"] for warning in document["warnings"])
    return row


def identify_tables(records: Iterable[tuple[str, pa.Table]], **settings: Any) -> pa.Table:
    """Records one after the other: names and tables in, one row for each, in their order."""
    rows = [identify_record(table, record, **settings) for record, table in _pairs(records)]
    return pa.concat_tables(rows) if rows else SCHEMA.empty_table()


def _pairs(records: Any) -> list[tuple[str, pa.Table]]:
    try:
        return [(record, table) for record, table in records]
    except (TypeError, ValueError) as error:
        raise UsageError(f"records is {_arguments.shown(records)}: must be pairs of a name and a table; give these") from error


def identify_spark(frame: pyspark.sql.DataFrame, key: str, **settings: Any) -> pyspark.sql.DataFrame:
    """Records of a Spark frame, told apart by the column ``key``; one row of :data:`SCHEMA` each, in no order.

    Spark works on a lost worker's records again elsewhere.
    """
    from_arrow_schema = _arguments.required(lambda: __import__("pyspark.sql.pandas.types", fromlist=["types"]), "spark").from_arrow_schema

    def work(name: tuple[Any, ...], table: pa.Table) -> pa.Table:
        # What is shuffled has lost its order.
        return identify_record(_by_time(table.drop_columns([key]), settings), str(name[0].as_py()), **settings)

    return frame.groupBy(key).applyInArrow(work, schema=from_arrow_schema(SCHEMA))


def _by_time(table: pa.Table, settings: dict[str, Any]) -> pa.Table:
    names = [settings.get("time") or "", "time_s", "time", "t"]
    time = next((name for name in names if name in table.column_names), None)
    return table if time is None else table.sort_by(time)


def identify_dask(records: Iterable[tuple[str, pa.Table]], client: Any, *, retries: int = 3, **settings: Any) -> pa.Table:
    """Records over the workers of a ``dask.distributed.Client``, in their order.

    Dask works on a lost worker's records again elsewhere, ``retries`` times.
    """
    if not hasattr(client, "submit"):
        raise UsageError(f"client is {_arguments.shown(client)}: must be a dask.distributed.Client; give one")
    pairs = _pairs(records)
    futures = [client.submit(identify_record, table, record, **settings, retries=retries, pure=False) for record, table in pairs]
    rows = client.gather(futures)
    return pa.concat_tables(rows) if rows else SCHEMA.empty_table()


def identify_ray(records: Iterable[tuple[str, pa.Table]], *, retries: int = 3, **settings: Any) -> pa.Table:
    """Records over the workers of the Ray cluster that is connected, in their order.

    Ray works on a lost worker's records again elsewhere, ``retries`` times.
    """
    ray = _arguments.required(lambda: __import__("ray"), "ray")
    work = ray.remote(max_retries=retries)(identify_record)
    rows = ray.get([work.remote(table, record, **settings) for record, table in _pairs(records)])
    return pa.concat_tables(rows) if rows else SCHEMA.empty_table()
