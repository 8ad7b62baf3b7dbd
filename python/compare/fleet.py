"""A thousand records by one process, Dask, Spark and Ray, a worker of each of the first two clusters killed: the same bytes, and the time.

python compare/fleet.py [records] [iso|exact|fit] [one|dask|spark|ray ...]
"""

import hashlib
import io
import os
import sys
import tempfile
import time
from pathlib import Path

import pyarrow as pa

import selfosc
from selfosc import fleet

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))


def records(count):
    """Short records of vehicles that differ; one in fifty is cut off."""
    for number in range(count):
        record = selfosc.simulate(
            alpha=1.0 + 0.5 * number / count, beta=0.5, relay=1, half_width=0.3, cycles=5, hold=True, noise=0.005, seed=number
        )
        table = pa.table(record)
        yield f"{number:05}", table.slice(0, 10) if number % 50 == 17 else table


def digest(rows):
    rows = rows.sort_by("record").cast(fleet.SCHEMA).combine_chunks()
    sink = io.BytesIO()
    with pa.ipc.new_stream(sink, fleet.SCHEMA) as writer:
        writer.write_table(rows)
    return hashlib.sha256(sink.getvalue()).hexdigest()[:16]


def by_dask(given, **settings):
    import distributed

    with (
        tempfile.TemporaryDirectory() as folder,
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=folder) as cluster,
        distributed.Client(cluster) as client,
    ):
        begin = time.perf_counter()
        client.submit(_die, retries=3, pure=False, flag=f"{folder}/flag")
        rows = fleet.identify_dask(given, client, **settings)
        return rows, time.perf_counter() - begin, os.path.exists(f"{folder}/flag")


def _die(flag):
    if not os.path.exists(flag):
        Path(flag).touch()
        os._exit(1)


def by_spark(given, **settings):
    from spark_cluster import identify_with_a_worker_killed

    with tempfile.TemporaryDirectory() as folder:
        rows, killed, begun = identify_with_a_worker_killed(given, Path(folder), **settings)
        return rows, time.perf_counter() - begun, killed


def by_ray(given, **settings):
    import ray

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        begin = time.perf_counter()
        rows = fleet.identify_ray(given, **settings)
        return rows, time.perf_counter() - begin, False
    finally:
        ray.shutdown()


def by_one(given, **settings):
    begin = time.perf_counter()
    rows = fleet.identify_tables(given, **settings)
    return rows, time.perf_counter() - begin, False


def main(count=1000, method="fit", *ways):
    given = list(records(int(count)))
    print(f"{count} records of about {given[0][1].num_rows} samples, method {method}, linear drag", flush=True)
    for way in ways or ("one", "dask", "spark"):
        work = {"one": by_one, "dask": by_dask, "spark": by_spark, "ray": by_ray}[way]
        begin = time.perf_counter()
        rows, spent, killed = work(given, method=method, drag="linear")
        start = time.perf_counter() - begin - spent
        refused = sum(code is not None for code in rows["refused"].to_pylist())
        print(
            f"{way:6} {rows.num_rows} rows, {refused} refused, {1e3 * spent / len(given):.2f} ms per record "
            f"and {start:.0f} s for start and end, worker killed: {killed}, rows {digest(rows)}",
            flush=True,
        )


if __name__ == "__main__":
    main(*sys.argv[1:])
