"""A reading that is masked, null or NA is no number: refused, or left out where that is asked for; never taken for data."""

import numpy as np
import pytest

import selfosc


def masked(values, holes):
    """Readings of which some are missing; under the mask stand numbers that would be believed."""
    values = np.array(values, dtype=float)
    mask = np.zeros(len(values), dtype=bool)
    mask[holes] = True
    values[holes] = 3.0
    return np.ma.MaskedArray(values, mask)


def pandas_na(values, holes):
    import pandas as pd

    column = pd.Series(values, dtype="Float64")
    column[holes] = pd.NA
    return column


def objects_with_na(values, holes):
    import pandas as pd

    return np.array([pd.NA if place in holes else value for place, value in enumerate(values)], dtype=object)


def pandas_of_arrow(values, holes):
    import pandas as pd

    return pd.Series(pyarrow_null(values, holes), dtype="double[pyarrow]")


def polars_null(values, holes):
    import polars as pl

    return pl.Series([None if place in holes else value for place, value in enumerate(values)])


def pyarrow_null(values, holes):
    import pyarrow as pa

    return pa.array([None if place in holes else value for place, value in enumerate(values)])


def none(values, holes):
    return [None if place in holes else value for place, value in enumerate(values)]


MAKERS = [masked, pandas_na, objects_with_na, pandas_of_arrow, polars_null, pyarrow_null, none]
HOLES = [40, 41, 120]


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize("column", [0, 1, 2], ids=["time", "output", "input"])
def test_refused(record, make, column):
    name = list(record)[column]
    with pytest.raises(selfosc.RecordRefused) as refusal:
        selfosc.identify({**record, name: make(record[name], HOLES)}, method="fit")
    assert refusal.value.code == "not-finite"
    assert "skip_bad_rows=True" in str(refusal.value)


@pytest.mark.parametrize("make", MAKERS)
def test_left_out_where_asked(record, make):
    gaps = {**record, "heading_deg": make(record["heading_deg"], HOLES)}
    left = {name: [value for place, value in enumerate(values) if place not in HOLES] for name, values in record.items()}
    found = selfosc.identify(gaps, method="fit", skip_bad_rows=True)
    assert found.records[0]["skipped_rows"] == len(HOLES)
    assert found.reported == selfosc.identify(left, method="fit").reported


def test_a_mask_that_hides_nothing_is_none(record):
    whole = {name: np.ma.MaskedArray(values, mask=False) for name, values in record.items()}
    assert selfosc.identify(whole, method="fit") == selfosc.identify(record, method="fit")


def test_masked_integers(record):
    counts = np.ma.MaskedArray(np.round(record["heading_deg"]).astype(int), mask=False)
    counts[7] = np.ma.masked
    with pytest.raises(selfosc.RecordRefused) as refusal:
        selfosc.identify({**record, "heading_deg": counts}, method="fit")
    assert refusal.value.code == "not-finite"


def test_complex_readings(record):
    with pytest.raises(selfosc.RecordRefused) as refusal:
        selfosc.identify({**record, "heading_deg": np.array(record["heading_deg"]) * (1 + 1j)})
    assert refusal.value.code == "not-a-number"


def test_masked_amplitudes():
    with pytest.raises(selfosc.SelfoscError):
        selfosc.describing_function("relay", np.ma.MaskedArray([1.0, 2.0], mask=[False, True]))
    with pytest.raises(selfosc.SelfoscError):
        selfosc.fit_characteristic(np.ma.MaskedArray([1.0, 2.0, 3.0], mask=[0, 0, 1]), [1.0, 0.5, 0.3])
