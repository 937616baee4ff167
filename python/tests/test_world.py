"""Worlds, frames and fields."""

import gc
import pathlib
import pickle
import threading

import numpy
import pytest

import espalier as es

ROOT = pathlib.Path(__file__).resolve().parents[2]
TREES = ROOT / "environments" / "two-trees.toml"
SHOOT = "lsystem: shoot\nderivation length: 4\naxiom: A(1)\nA(x) --> F(x)A(x/2)\nendlsystem\n"


@pytest.fixture
def shoot(tmp_path):
    file = tmp_path / "shoot.l"
    file.write_text(SHOOT)
    return file


def test_internodes_lie_where_the_turtle_drew_them(shoot):
    frames = list(es.World(shoot).run())
    assert [frame.step for frame in frames] == [0, 1, 2, 3, 4]
    internodes = frames[-1].internodes
    assert numpy.allclose(internodes.tip, [[0, 1, 0], [0, 1.5, 0], [0, 1.75, 0], [0, 1.875, 0]])
    assert numpy.allclose(internodes.base[1:], internodes.tip[:-1])
    assert internodes.parameters["F.1"].tolist() == [1, 0.5, 0.25, 0.125]
    assert len(internodes) == 4 and internodes.radius.shape == (4,)
    assert (internodes.identity == frames[-1].plants[0].string.identity[:4]).all()


def test_a_view_is_no_copy_and_cannot_be_written(shoot):
    for frame in es.World(shoot).run():
        pass
    one, other = frame.internodes.tip, frame.internodes.tip
    assert one.ctypes.data == other.ctypes.data
    with pytest.raises(ValueError):
        one[0, 0] = 1


def test_a_view_keeps_its_values_when_the_world_goes_on_and_dies(shoot):
    world = es.World(shoot)
    views = [(frame.internodes.tip, frame.internodes.tip.copy()) for frame in world.run()]
    del world
    gc.collect()
    for view, copy in views:
        assert (view == copy).all()


def test_run_goes_on_where_it_stopped():
    world = es.World(TREES, seed=3)
    assert [frame.step for frame in world.run(6)] == [0, 1, 2, 3, 4, 5, 6]
    assert [frame.step for frame in world.run(2)] == [7, 8]
    with pytest.raises(es.Error, match="no-such-scene"):
        es.World(ROOT / "environments" / "no-such-scene.toml")


def test_a_field_samples_to_its_own_voxels_and_ends_with_its_step():
    world = es.World(TREES)
    frames = world.run(12)
    for frame in frames:
        if frame.step == 10:
            break
    field = frame.field("light")
    values = field.values
    assert field.voxel == [0.5, 0.5, 0.5]
    assert values.ndim == 3 and values.dtype == numpy.float32 and values.min() < values.max()
    index = numpy.argwhere(numpy.ones_like(values, bool))
    centres = numpy.array(field.origin) + (index + 0.5) * field.voxel
    assert numpy.allclose(field.at(centres), values.ravel(), atol=1e-6)
    next(frames)
    assert (field.values == values).all()
    with pytest.raises(es.Error, match="step 10"):
        frame.field("light")


def test_two_worlds_in_two_threads_give_what_each_gives_alone():
    def tips(seed):
        for frame in es.World(TREES, seed=seed).run(20):
            pass
        return frame.internodes.tip.tobytes()

    alone = [tips(1), tips(2)]
    together = [None, None]

    def grow(place):
        together[place] = tips(place + 1)

    threads = [threading.Thread(target=grow, args=(place,)) for place in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone and len(alone[0]) > 0


def test_a_bar_of_progress_ends_with_the_last_step(shoot, capsys):
    world = es.World(shoot)
    assert len(list(world.run(2, progress=True))) == 3
    assert capsys.readouterr().err.splitlines()[-1].startswith("[" + "#" * 30 + "] step 2/2")
    assert [frame.step for frame in world.run()] == [3, 4]
    assert capsys.readouterr().err == ""
    assert len(list(es.World(shoot).run(6))) == 7


def test_a_setting_of_a_file_is_changed_as_set_does():
    def voxels(**changes):
        world = es.World(TREES, seed=3, set=changes)
        next(world.run(1))
        return world.frame.field("light").voxel[0]

    assert voxels(**{"environment.light.voxel": 0.25}) == 0.25
    assert voxels(**{"environment.light": {"process": "voxel-shade", "voxel": 1.5}}) == 1.5
    with pytest.raises(es.Error, match="did you mean 'voxel'"):
        voxels(**{"environment.light.voxl": 1})
    with pytest.raises(es.Error, match="not object"):
        voxels(**{"environment.light.voxel": object()})
    with pytest.raises(es.Error, match="settings already"):
        es.World(es.Scene(), set={"a": 1})


def test_a_changed_file_is_recorded_and_pickled_as_changed(tmp_path):
    scene = es.Scene.of(TREES, set={"plant.0.name": "oak"})
    es.record(pickle.loads(pickle.dumps(scene)), tmp_path / "run", steps=1)
    assert "oak" in set(es.open(tmp_path / "run").statistics["name"])
    es.record(TREES, tmp_path / "other", steps=1, set={"plant.0.name": "elm"})
    assert "elm" in set(es.open(tmp_path / "other").statistics["name"])


def test_a_plant_a_model_or_its_file_is_a_scene(shoot):
    model = es.Model(shoot)
    for scene in (model, es.Plant(model), es.Plant(shoot), es.Scene(model), es.Scene(es.Plant(shoot)), es.Scene([model]), es.Scene(shoot)):
        assert len(list(es.World(scene).run())[-1].internodes) == 4
    with pytest.raises(es.Error, match="ANGLE=40"):
        es.World(model, set={"plant.0.define.X": 1})


def test_time_has_its_step_and_unit(shoot, tmp_path):
    scene = es.Scene(shoot, dt=0.5, time_unit="day")
    assert [frame.time for frame in es.World(scene).run()] == [0, 0.5, 1, 1.5, 2]
    es.record(scene, tmp_path / "run")
    assert es.open(tmp_path / "run").record["time_unit"] == "day"
    with pytest.raises(es.Error, match="dt"):
        es.Scene(shoot, dt=0)


def test_quantities_are_those_of_the_statistics(tmp_path):
    world = es.World(TREES, seed=3)
    for frame in world.run(4):
        pass
    es.record(TREES, tmp_path / "run", seed=3, steps=4)
    row = es.open(tmp_path / "run").statistics.query("step == 4 and plant == 1").iloc[0]
    quantities = frame.quantities(1)
    assert quantities["light.mean"] == pytest.approx(row["light.mean"])
    with pytest.raises(es.Error, match="no plant 2"):
        frame.quantities(2)
    list(world.run(1))
    with pytest.raises(es.Error, match="are gone"):
        frame.quantities()


def test_things_say_what_they_are_in_a_cell(shoot):
    model = es.Model(text=SHOOT)
    assert repr(model.derive(1)) == "F(1)A(0.5)" and repr(model.derive(1)[0]) == "F(1)"
    long = es.Model(text="lsystem: 1\nderivation length: 9\naxiom: A\nA --> AA\nendlsystem\n").derive()
    assert repr(long) == "A" * 100 + "... (512 modules)"
    assert repr(es.Model(shoot)).startswith("Model('") and "shoot.l" in repr(es.Scene(shoot))
    assert repr(es.process("voxel-shade", voxel=0.5)) == "process('voxel-shade', voxel=0.5)"
    frame = next(es.World(TREES).run(1))
    assert "voxels" in repr(frame.field("light"))
    assert repr(frame).startswith("Frame of step 0: 2 plants") and "internodes" in repr(frame.internodes)


def test_a_world_and_its_run_tell_the_place_on_the_map(shoot, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text("[simulation]\norigin = [592700, 0, -5432100]\n[[plant]]\nmodel = 'shoot.l'\n")
    world = es.World(scene)
    assert world.origin == [592700, 0, -5432100]
    es.record(scene, tmp_path / "run")
    assert es.open(tmp_path / "run").origin == world.origin
    es.record(shoot, tmp_path / "near")
    assert es.World(shoot).origin is es.open(tmp_path / "near").origin is None
