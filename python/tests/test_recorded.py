"""Recorded runs."""

import pathlib

import numpy
import pytest

import espalier as es

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHOOT = "lsystem: shoot\nderivation length: 4\naxiom: A(1)\nA(x) --> F(x)A(x/2)\nendlsystem\n"


@pytest.fixture(scope="module")
def shoot(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded") / "shoot"
    es.record(es.Scene(plants=[es.Plant(es.Model(text=SHOOT), name="shoot")]), folder)
    return es.open(folder)


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded") / "course"
    es.record(ROOT / "environments" / "course-light.toml", folder)
    return es.open(folder)


def test_the_statistics_of_a_run_are_a_table_of_pandas(shoot):
    pytest.importorskip("pandas")
    assert shoot.statistics["step"].tolist() == [0, 1, 2, 3, 4]
    assert shoot.statistics["height"].tolist() == [0, 1, 1.5, 1.75, 1.875]


def test_frames_are_read_back_as_the_world_had_them(course):
    recorded = course.frames
    for frame in es.World(ROOT / "environments" / "course-light.toml").run():
        back = recorded[frame.step]
        assert (back.step, back.time) == (frame.step, frame.time)
        order = numpy.argsort(frame.internodes.identity)
        back_order = numpy.argsort(back.internodes.identity)
        assert (frame.internodes.identity[order] == back.internodes.identity[back_order]).all()
        assert (frame.internodes.tip[order].astype(numpy.float32) == back.internodes.tip[back_order]).all()
    assert len(recorded) == 11 and len(back.internodes) == len(frame.internodes) > 0
    assert list(back.internodes.parameters) == ["light"]
    assert set(back.internodes.symbols) == {"F"}


def test_arrays_of_recorded_frames_live_longer_than_the_run(shoot):
    internodes = shoot.frames[-1].internodes
    tip, bearer = internodes.tip, internodes.bearer
    del internodes
    assert tip[:, 1].tolist() == [1, 1.5, 1.75, 1.875] and bearer.tolist() == [-1, 0, 1, 2]
    with pytest.raises(ValueError):
        tip[0, 0] = 1


def test_a_recorded_field_is_that_of_the_world(course):
    for frame in es.World(ROOT / "environments" / "course-light.toml").run():
        pass
    live, recorded = frame.field("light"), course.field("light")
    centres = numpy.argwhere(numpy.ones_like(recorded.values, bool)) * recorded.voxel + recorded.origin
    centres += 0.5 * numpy.array(recorded.voxel)
    assert numpy.allclose(recorded.at(centres), recorded.values.ravel())
    between = centres[recorded.values.ravel().argsort()[:20]] + 0.03
    assert numpy.allclose(recorded.at(between), live.at(between), atol=1e-5)
    assert recorded.values.min() < recorded.values.max()
    assert course.frames[4].field("light").values.shape == course.field("light", 4).values.shape
    with pytest.raises(es.Error, match="water"):
        course.field("water")
    with pytest.raises(es.Error, match="99"):
        course.field("light", 99)


def test_an_organ_has_a_history(shoot):
    identity = shoot.frames[-1].internodes.identity[1]
    history = shoot.history(identity)
    assert (history.symbol, history.birth, history.death) == ("F", 2, None)
    assert history.table["step"].tolist() == [2, 3, 4]
    assert history.table["length"].tolist() == [0.5, 0.5, 0.5]
    assert shoot.history(identity, "shoot").rows == history.rows
    with pytest.raises(es.Error, match="no organ 5"):
        shoot.history(5)


def test_organs_are_a_table_and_plants_a_graph(shoot):
    assert shoot.organs["length"].tolist() == [1, 0.5, 0.25, 0.125]
    assert sorted(set(shoot.organs_at("all")["step"])) == [1, 2, 3, 4]
    graph = shoot.to_mtg()
    assert "\nCODE:" in graph and graph.count("I") > 4


def test_frames_show_themselves(shoot):
    for frame in es.World(es.Scene(plants=[es.Plant(es.Model(text=SHOOT))])).run(2):
        pass
    assert frame._repr_png_()[:4] == shoot.frames[2]._repr_png_()[:4] == b"\x89PNG"


def test_a_folder_without_a_run_is_an_error(tmp_path):
    with pytest.raises(es.Error, match="no recorded run"):
        es.open(tmp_path)
