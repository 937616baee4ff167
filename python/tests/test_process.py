"""Processes in Python, and scenes that are put together here."""

import numpy
import pytest

import espalier as es

REED = """environment wind;
lsystem: reed
derivation length: 30
axiom: ?wind(0)A
?wind(v) < A : v < 2 --> F(0.5)?wind(0)A
?wind(v) --> *
endlsystem
"""


class Wind(es.Process):
    def __init__(self, fails_at=None):
        self.steps = []
        self.fails_at = fails_at

    def answer(self, queries, answers):
        self.steps.append(queries.step)
        assert queries.position.shape == (len(answers), 3)
        assert queries.parameters.shape == answers.shape and queries.identity.dtype == numpy.uint64
        if queries.step == self.fails_at:
            raise ZeroDivisionError("no wind")
        answers[:, 0] = 1.5 * numpy.log1p(queries.position[:, 1])


def scene(wind, **options):
    reeds = [es.Plant(es.Model(text=REED), at=(x, 0, 0), name=f"reed {x}") for x in (0, 2)]
    return es.Scene(plants=reeds, processes={"wind": wind}, **options)


def test_a_process_in_python_answers_as_one_in_cpp():
    wind = Wind()
    for frame in es.World(scene(wind)).run():
        pass
    # 1.5 log(1 + y) reaches 2 at y = 2.79: the sixth internode ends at 3.
    assert [len(plant) for plant in frame.plants] == [6, 6]
    assert frame.internodes.plant.tolist() == [0] * 6 + [1] * 6
    assert frame.internodes.tip[-1].tolist() == [2, 3, 0]
    assert wind.steps[:7] == [0, 1, 2, 3, 4, 5, 6]


def test_one_that_raises_ends_the_growth_with_its_traceback():
    frames = []
    with pytest.raises(ZeroDivisionError, match="no wind") as caught:
        for frame in es.World(scene(Wind(fails_at=3))).run():
            frames.append(frame)
    assert caught.traceback[-1].name == "answer"
    assert [frame.step for frame in frames] == [0, 1, 2]


def test_one_that_raises_leaves_the_recorded_frames_whole(tmp_path):
    with pytest.raises(ZeroDivisionError):
        es.record(scene(Wind(fails_at=3)), tmp_path / "run")
    assert "failed: step 3: process 'wind' (python): ZeroDivisionError: no wind" in (tmp_path / "run" / "run.json").read_text()
    assert sorted(file.name for file in (tmp_path / "run" / "plants").glob("*.vtp"))[-1] == "0002.vtp"


def test_a_recorded_scene_has_as_many_steps_as_it_says(tmp_path):
    assert es.record(scene(Wind(), steps=7), tmp_path / "run") == 7
    with pytest.raises(es.Error):
        es.record(scene(Wind(), steps=7), tmp_path / "run")


def test_a_process_of_the_library_takes_its_settings():
    text = REED.replace("wind", "light").replace("v < 2", "v > 0.5")
    lit = es.Scene(plants=[es.Plant(es.Model(text=text))], processes={"light": es.process("voxel-shade", voxel=0.5)}, steps=3)
    for frame in es.World(lit).run():
        pass
    assert frame.field("light").voxel == [0.5, 0.5, 0.5]
    with pytest.raises(es.Error, match="voxle"):
        bad = es.Scene(plants=[es.Plant(es.Model(text=text))], processes={"light": es.process("voxel-shade", voxle=1)})
        es.World(bad)


def test_keys_of_a_process_are_those_of_a_scene_and_dicts_are_tables():
    text = "environment water;\nlsystem: 1\nderivation length: 1\naxiom: ?water(0,0)\nA --> A\nendlsystem\n"
    soil = es.process(
        "soil-water",
        domain={"lower": [-1, -1, 0], "upper": (1, numpy.float32(1), 0)},
        voxel=numpy.float64(0.5),
        initial=0.1,
        gradient_length=0.5,
        depletion=False,
        layers=[{"bottom": -1, "top": 0, "initial": 0.3}],
        regions=[{"shape": "sphere", "center": [0.75, 0.75, 0], "radius": 0.1, "value": 0.2}],
    )
    frame = next(es.World(es.Scene(es.Model(text=text), {"water": soil})).run())
    field = frame.field("water")
    points = [[-0.75, -0.75, 0], [-0.75, 0.75, 0], [0.75, 0.75, 0]]
    assert field.at(points) == pytest.approx([0.3, 0.1, 0.2])


def test_the_name_of_a_kind_is_the_process_with_its_defaults_and_other_things_are_refused():
    model = es.Model(text="environment light;\nlsystem: 1\nderivation length: 1\naxiom: ?light(1)\nA --> A\nendlsystem\n")
    assert "light.mean" in next(es.World(es.Scene(model, {"light": es.process("voxel-shade", voxel=1)})).run()).quantities()
    assert "voxel" in str(pytest.raises(es.Error, lambda: es.World(es.Scene(model, {"light": "voxel-shad"}))).value)
    with pytest.raises(es.Error, match="'light' is of type int"):
        es.Scene(model, {"light": 3})


def test_numbers_that_are_returned_are_refused_and_answers_that_are_written_count():
    class Returns(es.Process):
        def answer(self, queries, answers):
            return numpy.log1p(queries.position[:, 1])

    with pytest.raises(TypeError, match="returned ndarray.*write into `answers`"):
        list(es.World(scene(Returns())).run())

    class WritesAndReturns(Wind):
        def answer(self, queries, answers):
            super().answer(queries, answers)
            return answers

    *_, frame = es.World(scene(WritesAndReturns())).run()
    assert [len(plant) for plant in frame.plants] == [6, 6]


def test_a_process_that_gives_its_answers_another_shape_answers_the_same():
    class Reshapes(Wind):
        def answer(self, queries, answers):
            super().answer(queries, answers)
            answers.shape = (1, answers.size)

    *_, frame = es.World(scene(Reshapes())).run()
    assert [len(plant) for plant in frame.plants] == [6, 6]
