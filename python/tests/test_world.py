"""Worlds, frames and fields."""

import gc
import pathlib
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
