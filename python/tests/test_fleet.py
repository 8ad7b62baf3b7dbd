"""The same bytes from one process and from workers, one of which dies."""

import io
import os
import shutil

import pyarrow as pa
import pytest

import selfosc
from selfosc import fleet


def records(count, broken=(3,)):
    for number in range(count):
        record = selfosc.simulate(
            alpha=1.0 + 0.02 * number, beta=0.5, relay=1, half_width=0.3, cycles=6, hold=True, noise=0.005, seed=number
        )
        table = pa.table(record)
        yield f"dive {number}", table.slice(0, 5) if number in broken else table


def written(table):
    """The bytes of a table in one piece."""
    sink = io.BytesIO()
    with pa.ipc.new_stream(sink, fleet.SCHEMA) as writer:
        writer.write_table(table.cast(fleet.SCHEMA).combine_chunks())
    return sink.getvalue()


@pytest.fixture(scope="module")
def alone():
    return fleet.identify_tables(records(12), method="fit", drag="linear")


def test_a_row_for_each(alone):
    rows = alone.to_pylist()
    assert alone.schema == fleet.SCHEMA
    assert [row["record"] for row in rows] == [f"dive {number}" for number in range(12)]
    assert rows[3]["refused"] == "too-short"
    assert rows[3]["alpha"] is None
    assert all(row["refused"] is None and row["alpha_low"] < row["alpha"] < row["alpha_high"] for row in rows[:3])


def test_a_row_is_the_identification(alone):
    name, table = next(records(1))
    found = selfosc.identify(table, method="fit", drag="linear").reported
    row = alone.to_pylist()[0]
    assert (row["record"], row["alpha"], row["beta_std"]) == (name, found["alpha"]["value"], found["beta"]["std"])


def test_no_records():
    assert fleet.identify_tables([]) == fleet.SCHEMA.empty_table()


def test_dask_with_a_worker_killed(alone, tmp_path):
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=tmp_path) as cluster,
        distributed.Client(cluster) as client,
    ):
        flag = tmp_path / "killed"
        client.submit(_die_once, str(flag), retries=3, pure=False)
        rows = fleet.identify_dask(records(12), client, method="fit", drag="linear")
    assert flag.exists()
    assert written(rows) == written(alone)


def _die_once(flag):
    """Kills the worker that it runs on, the first time."""
    if not os.path.exists(flag):
        open(flag, "w").close()
        os._exit(1)


@pytest.mark.skipif("SELFOSC_TEST_SPARK" not in os.environ, reason="takes minutes; set SELFOSC_TEST_SPARK=1")
def test_spark_with_a_worker_killed(alone, tmp_path):
    pytest.importorskip("pyspark")
    if shutil.which("java") is None:
        pytest.skip("there is no Java")
    from spark_cluster import identify_with_a_worker_killed

    rows, killed, _ = identify_with_a_worker_killed(list(records(12)), tmp_path, method="fit", drag="linear")
    assert killed
    order = {name: place for place, (name, _) in enumerate(records(12))}
    rows = rows.take(sorted(range(rows.num_rows), key=lambda place: order[rows["record"][place].as_py()]))
    assert written(rows) == written(alone)


def test_ray(alone):
    ray = pytest.importorskip("ray")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        rows = fleet.identify_ray(records(12), method="fit", drag="linear")
    finally:
        ray.shutdown()
    assert written(rows) == written(alone)
