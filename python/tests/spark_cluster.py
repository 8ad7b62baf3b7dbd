"""Spark on a local cluster of two workers, each a process of its own, one of which is killed."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pyarrow as pa

from selfosc import fleet


def identify_with_a_worker_killed(
    records: list[tuple[str, pa.Table]], folder: Path, **settings: Any
) -> tuple[pa.Table, bool, float]:
    """The rows, in Spark's order, whether an executor was killed while they were worked on, and when the cluster had started."""
    from pyspark.sql import SparkSession

    os.environ["PYSPARK_PYTHON"] = sys.executable
    session = (
        SparkSession.builder.master("local-cluster[2,1,1024]")
        .config("spark.ui.enabled", "false")
        .config("spark.sql.shuffle.partitions", "8")
        .config("spark.sql.execution.arrow.pyspark.enabled", "true")
        .config("spark.sql.warehouse.dir", str(folder / "warehouse"))
        .config("spark.local.dir", str(folder / "local"))
        .config("spark.executorEnv.PYTHONPATH", os.pathsep.join(sys.path))
        .getOrCreate()
    )
    begun = time.perf_counter()
    try:
        tables = [table.append_column("vehicle", pa.array([name] * table.num_rows)) for name, table in records]
        frame = session.createDataFrame(pa.concat_tables(tables).to_pandas())
        killed = threading.Event()
        threading.Thread(target=_kill_an_executor, args=(session.sparkContext._gateway.proc.pid, killed), daemon=True).start()
        rows = fleet.identify_spark(frame, "vehicle", **settings).toArrow()
        return rows, killed.is_set(), begun
    finally:
        session.stop()


def _kill_an_executor(driver: int, killed: threading.Event) -> None:
    """Kills the first executor that works, one of the processes that this session started."""
    while not killed.is_set():
        time.sleep(0.2)
        for pid in _descendants(driver):
            command = Path(f"/proc/{pid}/cmdline")
            try:
                executes = b"CoarseGrainedExecutorBackend" in command.read_bytes()
            except OSError:
                continue
            # A Python worker below it says that it is at work.
            if executes and any(b"pyspark" in _command(child) for child in _descendants(pid)):
                os.kill(pid, signal.SIGKILL)
                killed.set()
                return


def _command(pid: int) -> bytes:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


def _descendants(root: int) -> list[int]:
    children: dict[int, list[int]] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        children.setdefault(int(fields[1]), []).append(int(folder.name))
    found, waiting = [], [root]
    while waiting:
        below = children.get(waiting.pop(), [])
        found += below
        waiting += below
    return found
