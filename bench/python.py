"""What Python costs: prints the seconds of some work through the module, and of its yardstick, in turns.  python.py WORK

Each line is one turn: work, yardstick. PYTHONPATH names the module, ESPALIER_PROGRAM the program.
"""

import subprocess
import sys
import tempfile
import time

import numpy

import espalier as es
from espalier.program import program

ASKERS = """
environment ball;
lsystem: askers
derivation length: 1000
axiom: A
A : Q < 6 --> f(0.1)AAAAAAAAAA
A --> f(0.1)?ball(0, 0)
endlsystem
"""
FOREST = """
lsystem: tree
derivation length: 15
axiom: A(1)
A(l) --> F(l)[+(30)A(l*0.8)]/(137)-(20)A(l*0.9)
endlsystem
"""


class Ball(es.Process):
    """As the process `shape` of the library with a sphere of 5 m."""

    def answer(self, queries, answers):
        distance = numpy.linalg.norm(queries.position, axis=1) - 5
        answers[:, 0] = distance < 0
        answers[:, 1] = distance


def asking(process):
    """A world that sends 100,000 queries in every step from its sixth on."""
    world = es.World(es.Scene(plants=[es.Plant(es.Model(text=ASKERS))], processes={"ball": process}))
    for frame in world.run(6):
        pass
    assert (~numpy.isnan(frame.plants[0].string.column("?ball.1"))).sum() == 100_000
    return world


def exchange_seconds(world):
    (_,) = world.run(1)
    return world.stage_seconds["exchange"]


def queries():
    sides = asking(Ball()), asking(es.process("shape", shape="sphere", center=[0, 0, 0], radius=5))
    for _ in range(9):
        print(*map(exchange_seconds, sides), flush=True)


def seconds_of(work, times=100):
    began = time.perf_counter()
    for _ in range(times):
        work()
    return (time.perf_counter() - began) / times


def views():
    row = es.Model(text="lsystem: row\nderivation length: 1\naxiom: A\nA : Q < 6 --> AAAAAAAAAA\nA --> F(0.1)\nendlsystem\n")
    for frame in es.World(es.Scene(plants=[es.Plant(row)])).run(6):
        pass
    internodes = frame.internodes
    assert internodes.tip.shape == (100_000, 3)
    for _ in range(5):
        print(seconds_of(lambda: internodes.tip), seconds_of(lambda: internodes.tip.copy()), flush=True)


def record():
    with tempfile.TemporaryDirectory(prefix="espalier-bench-") as folder:
        model = f"{folder}/tree.l"
        with open(model, "w", encoding="utf-8") as file:
            file.write(FOREST)
        for _ in range(5):
            began = time.perf_counter()
            es.record(model, f"{folder}/module", overwrite=True)
            between = time.perf_counter()
            subprocess.run([program(), "run", model, "--output", f"{folder}/program", "--overwrite", "--quiet"], check=True)
            print(between - began, time.perf_counter() - between, flush=True)


def start():
    def importing(module):
        return seconds_of(lambda: subprocess.run([sys.executable, "-c", f"import {module}"], check=True), times=1)

    for _ in range(9):
        print(importing("espalier"), importing("numpy"), flush=True)


{"queries": queries, "record": record, "start": start, "views": views}[sys.argv[1]]()
