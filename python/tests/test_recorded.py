"""Recorded runs."""

import pytest

import espalier as es


def test_the_statistics_of_a_run_are_a_table_of_pandas(tmp_path):
    pytest.importorskip("pandas")
    model = es.Model(text="lsystem: shoot\nderivation length: 4\naxiom: A(1)\nA(x) --> F(x)A(x/2)\nendlsystem\n")
    es.record(es.Scene(plants=[es.Plant(model)]), tmp_path / "run")
    table = es.open(tmp_path / "run").statistics
    assert table["step"].tolist() == [0, 1, 2, 3, 4]
    assert table["height"].tolist() == [0, 1, 1.5, 1.75, 1.875]


def test_a_folder_without_a_run_is_an_error(tmp_path):
    with pytest.raises(es.Error, match="no recorded run"):
        es.open(tmp_path)
