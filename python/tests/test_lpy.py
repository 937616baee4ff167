"""Models of L-Py."""

import re

import numpy
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
                                  "sin(pi/6) + atan2(1, 2)", "int(-2.5)", "0 < 1 < 1", "1 - (2 - 3)", "not 0 or 1",
                                  "radians(30) + degrees(0.1)", "round(2.5) + round(3.5) + round(-0.5) + round(-1.5)",
                                  "round(2.675001, 2)", "float(3)"])
def test_expressions_have_the_values_of_python(text):
    import math

    value = lpy(f"A(x) --> B({text})").derive(1).column("B.1")[0]
    assert value == pytest.approx(float(eval(text, vars(math).copy())), abs=1e-12)


@pytest.mark.parametrize(
    "text, line, words",
    [
        ("Axiom: A\nproduction:\nA(x) --> B(y)\n", 3, "'y' is neither"),
        ("Axiom: A\nproduction:\nA(*x) --> B\n", 3, r"\*x"),
        ("Axiom: A\nproduction:\nA << B --> B\n", 3, "contexts"),
        ("Axiom: A\nproduction:\nA:\n  nproduce B\n", 3, "nproduce"),
        ("Axiom: A([1, 2])\n", 1, "List"),
        ("Axiom: A\nproduction:\nA --> F(1, 0.1)\n", 3, "radius"),
        ("Axiom: A\nproduction:\nA --> [Frame]\n", 3, "'Frame' of L-Py's turtle"),
        ("Axiom: A\nproduction:\nA --> nF(3, 0.1)\n", 3, "'nF' of L-Py's turtle"),
        ("Axiom: A\nproduction:\nA --> F(1e999)\n", 3, "Constant"),
        ("Axiom: A\nproduction:\nA --> F(random() % 2)\n", 3, "a random number that an expression uses twice"),
        ("colours = [1, 2]\nAxiom: A\nproduction:\nA --> F(colours)\n", 4, "List"),
        ("def f(x): return f(x - 1)\nAxiom: A\nproduction:\nA --> F(f(2))\n", 4, "'f' calls itself"),
        ("def f(x): return x * x\nAxiom: A\nproduction:\nA --> F(f(random()))\n", 4, "random number 'x'"),
        ("def f(x):\n  while x: pass\nAxiom: A\nproduction:\nA --> F(f(1))\n", 5, "is no expression"),
        ("Axiom: A\nproduction:\nA:\n  for m in 'ab':\n    produce F\n", 3, "only range"),
        ("def Start():\n  global n\n  n = 3\nAxiom: A\nderivation length: n\n", 5, "derivation length"),
        ("Axiom: A\nproduction:\n?P A --> F\n", 3, "number of parameters"),
        ("Axiom: A\nproduction:\nA --> F(" + "-" * 3000 + "1)\n", 3, "nested too deeply|is no expression"),
    ],
)
def test_what_needs_python_is_named_with_its_line(text, line, words):
    with pytest.raises(es.Error, match=words) as caught:
        es.from_lpy(text)
    assert caught.value.line == line and caught.value.file is None


def test_the_first_production_that_matches_applies_whatever_the_seed():
    text = "initial seed: 3\nAxiom: AAAAAAAAAAAAAAAA\nderivation length: 1\nproduction:\nA --> B\nA --> C\n"
    assert str(es.from_lpy(text).derive()) == "B" * 16


def test_random_numbers_have_their_distributions():
    draws = "random()", "uniform(-3, -1)", "rnd.gauss(5, 0.5)", "randint(1, 6)"
    text = "import random as rnd\nfrom random import *\nAxiom: " + "A" * 4000 + "\nderivation length: 1\nproduction:\n"
    string = es.from_lpy(text + f"A --> B({', '.join(draws)})\n").derive(seed=2)
    values = numpy.array([string.column(f"B.{i}") for i in (1, 2, 3, 4)])
    assert values.mean(axis=1) == pytest.approx([0.5, -2, 5, 3.5], abs=0.1)
    assert values.std(axis=1) == pytest.approx([12**-0.5, 3**-0.5, 0.5, (35 / 12) ** 0.5], rel=0.05)
    assert sorted(set(values[3])) == [1, 2, 3, 4, 5, 6]


def test_a_number_that_a_production_draws_decides_and_is_written():
    body = "A(x):\n  r = random()\n  if r < 0.25: produce B(r)\n  r += 1\n  produce C(r)"
    string = es.from_lpy(f"Axiom: {'A(0)' * 4000}\nderivation length: 1\nproduction:\n{body}\n").derive(seed=5)
    few, many = string.column("B.1"), string.column("C.1")
    few, many = few[~numpy.isnan(few)], many[~numpy.isnan(many)]
    assert len(few) == pytest.approx(1000, abs=100) and few.max() < 0.25
    assert many.min() >= 1.25 and many.max() < 2


def test_a_random_condition_is_drawn_once():
    body = "A:\n  if random() < 0.5:\n    if 1 > 2: produce B\n  else: produce C\n  produce D"
    string = es.from_lpy(f"Axiom: {'A' * 4000}\nderivation length: 1\nproduction:\n{body}\n").derive(seed=5)
    assert string.symbols.count("D") == pytest.approx(2000, abs=150)


@pytest.mark.parametrize("x", range(-3, 9))
def test_blocks_of_statements_do_what_python_does(x):
    """Loops, breaks, parameters that change, and branches without produce, beside Python itself."""
    block = """
  total = 0
  for i in range(x):
    if i == 5: break
    for j in range(i, 0, -1):
      total += j
      if total > 12: produce B(total, i, j)
  while total < x:
    total += 2
    x -= 1
    if total == 2: produce C(total, x, i)
  if x > 0:
    x *= 2
  elif x == -1: produce D(x, total, 0)
  if x == -2: produce E(x, 0, 0)
  total //= 2
"""
    python = re.sub(r"produce (\w)\((.*)\)", r"return ('\1', \2)", block)
    space = {}
    exec(f"def rule(x):\n  i = 0{python}  return ('Z', x, total, 0)", space)
    symbol, *values = space["rule"](x)
    string = lpy(f"A(x):\n  i = 0{block}  produce Z(x, total, 0)", axiom=f"A({x})").derive(1)
    assert (string[0].symbol, string[0].parameters) == (symbol, values)


def test_variables_functions_and_times():
    model = """
\"\"\"A row that counts.\"\"\"
from math import *
count = 1
step = count + 1
extern(scale=2)
def grown(x, by=1):
  "on a line"
  if x > 4:
    return x
  more = by * scale
  return x + more
def Start():
  global count
  count = 10
def EndEach():
  global count
  count += step
Axiom: A(0)
derivation length: 3
production:
A(x) --> B(count)A(grown(x))
"""
    string = es.from_lpy(model).derive()
    assert str(string) == "B(10)B(12)B(14)A(6)"


def test_a_star_produces_nothing():
    assert str(lpy("A --> *\nB:\n  produce *\nC:\n  produce", axiom="AXBC").derive(1)) == "X"


def test_places_and_directions_are_those_of_l_py():
    """A turtle of L-Py looks along z from the origin, its left is -y and its up x (Boudon et al. 2012)."""
    asked = "?P(0,0,0)?H(0,0,0)?L(0,0,0)?U(0,0,0)"
    names = "?P(a,b,c)?H(d,e,f)?L(g,h,i)?U(j,k,l)"
    rule = f"{names} A --> X(a,b,c)X(d,e,f)X(g,h,i)X(j,k,l)"

    def answers(before):
        model = lpy(rule, axiom=f"{before}{asked}A")
        *_, frame = es.World(es.Scene(plants=[es.Plant(model)])).run(1)
        return [one.parameters for one in frame.plants[0].string if one.symbol == "X"]

    assert answers("F(2)") == [[0, 0, 2], [0, 0, 1], [0, -1, 0], [1, 0, 0]]
    assert numpy.allclose(answers("MoveTo(1,2,3)+(90)F(2)"), [[1, 0, 3], [0, -1, 0], [0, 0, -1], [1, 0, 0]])
    assert numpy.allclose(answers("@R(1,0,0,0,1,0)F(2)"), [[2, 0, 0], [1, 0, 0], [0, 0, -1], [0, 1, 0]])


def test_words_of_the_turtle_are_symbols_but_declared_names_stay():
    words = lpy("A --> Left(30)Sphere(2)Frame", axiom="A", header="module Frame")
    assert str(words.derive(1)) == "+(30)@O(4)Frame"


def test_statements_stand_in_interpretations_and_decompositions_too():
    text = """
Axiom: A(3)
derivation length: 1
production:
decomposition:
A(n):
  n -= 1
  if n > 1: produce BA(n)
  else: produce C
maximum depth: 9
interpretation:
B:
  size = 2
  size *= 3
  produce F(size)
endlsystem
"""
    *_, frame = es.World(es.Scene(plants=[es.Plant(es.from_lpy(text))])).run()
    assert str(frame.plants[0].string) == "BC"
    assert frame.internodes.tip[:, 1].tolist() == [6]
