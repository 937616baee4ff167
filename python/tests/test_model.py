"""Models and their strings."""

import pathlib

import numpy
import pytest

import espalier as es

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROW = """#define R 2
lsystem: row
derivation length: 3
axiom: A(1)
A(x) : x > 0 --> F(x)A(x*R)
endlsystem
"""


def test_a_string_has_length_text_modules_and_slices():
    string = es.Model(text=ROW).derive()
    assert str(string) == "F(1)F(2)F(4)A(8)"
    assert len(string) == 4
    assert [module.symbol for module in string] == ["F", "F", "F", "A"]
    assert string[-1].parameters == [8.0]
    assert str(string[1:3]) == "F(2)F(4)"
    assert str(string[::-1]) == "A(8)F(4)F(2)F(1)"
    assert (string[1:3].identity == string.identity[1:3]).all()
    assert len(set(string.identity.tolist())) == 4
    with pytest.raises(IndexError):
        string[4]


def test_columns_hold_the_parameters_of_one_symbol():
    string = es.Model(text=ROW).derive(5)
    column = string.column("F.1")
    assert column.dtype == numpy.float64
    assert column[:5].tolist() == [1, 2, 4, 8, 16]
    assert numpy.isnan(column[5])
    assert numpy.isnan(string.column("F.2")).all()
    with pytest.raises(es.Error, match="names no parameter"):
        string.column("F")


def test_defines_replace_those_of_the_file():
    assert str(es.Model(text=ROW, R=3).derive(2)) == "F(1)F(3)A(9)"
    with pytest.raises(es.Error):
        es.Model(text=ROW, NOTHING=3)


def test_an_error_says_file_line_and_column(tmp_path):
    file = tmp_path / "bad.l"
    file.write_text("lsystem: 1\nderivation length: 2\naxiom: A(1)\nA(x) --> B(x+)\nendlsystem\n")
    with pytest.raises(es.Error) as caught:
        es.Model(file)
    assert caught.value.file.endswith("bad.l")
    assert caught.value.line == 4
    assert caught.value.column == 14
    assert issubclass(es.RunError, es.Error)


def test_a_growth_that_cannot_go_on_is_a_run_error():
    with pytest.raises(es.RunError, match="0"):
        es.Model(text="lsystem: 1\nderivation length: 2\naxiom: A(0)\nA(x) --> A(1/x)\nendlsystem\n").derive()


@pytest.mark.parametrize("extension", ["l", "pgraph", "sdl", "species"])
def test_models_of_every_notation_are_read(extension):
    file = sorted((ROOT / "models").rglob(f"*.{extension}"))[0]
    assert len(es.Model(file).derive(1)) > 0


def test_parameters_are_a_mapping_of_columns():
    string = es.Model(text=ROW).derive()
    assert list(string.parameters) == ["F.1", "A.1"] and "F.1" in string.parameters
    assert dict(string.parameters)["A.1"][-1] == 8
    assert (string.parameters["F.1"][:3] == [1, 2, 4]).all()
    with pytest.raises(KeyError):
        string.parameters["F.2"]
