"""Ctrl-C."""

import signal

import pytest

import espalier as es

ROW = "environment end;\nlsystem: row\nderivation length: 50\naxiom: A\nA --> F(1)?end(0)A\nendlsystem\n"


class InterruptsAt(es.Process):
    def answer(self, queries, answers):
        if queries.step == 5:
            signal.raise_signal(signal.SIGINT)


@pytest.fixture
def ctrl_c_is_heard():
    # A shell starts its background jobs with SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_an_interrupted_recording_leaves_its_frames_whole(tmp_path, ctrl_c_is_heard):
    scene = es.Scene(plants=[es.Plant(es.Model(text=ROW))], processes={"end": InterruptsAt()})
    with pytest.raises(KeyboardInterrupt):
        es.record(scene, tmp_path / "run")
    assert (tmp_path / "run" / "plants" / "0004.vtp").exists()
    assert not (tmp_path / "run" / "plants" / "0007.vtp").exists()
