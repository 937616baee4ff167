"""Models of L-Py."""

import pytest

import espalier as es

BUSH = r"""
from math import *
R = 0.5
limit = 2 ** 3 // 3    # 2

module Apex(age, vigour), Leaf
Axiom: _(0.1)Apex(0, 1)
derivation length: 3

production:
Apex(age, vigour):
  if age < limit and not vigour == 0.25:
    produce F(vigour)[+(30)Leaf]Apex(age + 1, \
      vigour * R)
  else:
    produce Leaf

group 1:
Leaf --> F(100)
endgroup

interpretation:
Leaf --> ;(2)@O(0.2)

endlsystem
###### INITIALISATION ######
__lpy_code_version__ = 1.1
def __initialiseContext__(context):
    import openalea
"""


def lpy(productions, axiom="A(1)", header=""):
    return es.from_lpy(f"{header}\nAxiom: {axiom}\nderivation length: 4\nproduction:\n{productions}\nendlsystem\n")


def test_a_model_with_blocks_groups_and_names_grows():
    string = es.from_lpy(BUSH).derive()
    assert str(string) == "!(0.2)F(1)[+(30)Leaf]F(0.5)[+(30)Leaf]Leaf"


def test_the_interpretation_draws_and_radii_become_widths():
    for frame in es.World(es.Scene(plants=[es.Plant(es.from_lpy(BUSH))])).run():
        pass
    assert frame.internodes.radius.tolist() == [0.1, 0.1]
    assert str(frame.plants[0].string).count("Leaf") == 3


def test_arrows_contexts_and_conditions():
    assert str(lpy("A(x) --> F(x)A(x/4)").derive(2)) == "F(1)F(0.25)A(0.0625)"
    signal = lpy("B < F --> B\nB --> F", axiom="BF+FF", header="ignore: +")
    assert [str(signal.derive(n)) for n in (1, 2, 3)] == ["FB+(60)FF", "FF+(60)BF", "FF+(60)FB"]
    assert str(lpy("F > A(y) --> F(y)\nA(y) : y < 3 --> A(y + 1)", axiom="FA(1)").derive(4)) == "F(1)A(3)"


def test_a_branch_without_produce_is_no_production():
    nested = "A(x):\n  if x > 0:\n    if x > 5: produce B\n  elif x > -5: produce C\n  else: produce D\nA(x) --> E"
    grown = {x: str(lpy(nested, axiom=f"A({x})").derive(1)) for x in (6, 1, -1, -9)}
    assert grown == {6: "B", 1: "E", -1: "C", -9: "D"}


@pytest.mark.parametrize("text", ["7 % 3", "-7 % 3", "7.5 % -2", "-7 // 2", "2 ** 3 ** 2", "-2 ** 2", "1 if 2 > 3 else 4",
                                  "sin(pi/6) + atan2(1, 2)", "int(-2.5)", "0 < 1 < 1", "1 - (2 - 3)", "not 0 or 1"])
def test_expressions_have_the_values_of_python(text):
    import math

    value = lpy(f"A(x) --> B({text})").derive(1).column("B.1")[0]
    assert value == pytest.approx(float(eval(text, vars(math).copy())), abs=1e-12)


@pytest.mark.parametrize(
    "text, line, words",
    [
        ("Axiom: A\nderivation length: 1\ndef Start():\n  pass\n", 3, "def Start"),
        ("Axiom: A\nproduction:\nA:\n  x = 3\n  produce B\n", 3, "x = 3"),
        ("Axiom: A\nproduction:\nA --> B(random())\n", 3, "random"),
        ("Axiom: A\nproduction:\nA(x) --> B(y)\n", 3, "'y' is neither"),
        ("Axiom: A\nproduction:\nA(*x) --> B\n", 3, r"\*x"),
        ("Axiom: A\nproduction:\nA << B --> B\n", 3, "contexts"),
        ("Axiom: A\nproduction:\nA:\n  nproduce B\n", 3, "nproduce"),
        ("Axiom: A([1, 2])\n", 1, "List"),
        ("Axiom: A\nproduction:\nA --> F(1, 0.1)\n", 3, "radius"),
    ],
)
def test_what_needs_python_is_named_with_its_line(text, line, words):
    with pytest.raises(es.Error, match=words) as caught:
        es.from_lpy(text)
    assert caught.value.line == line and caught.value.file is None
