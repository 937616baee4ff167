"""Models of L-Py (Boudon et al. 2012), as far as they need no Python."""

import re

from . import _espalier
from .lpy_expressions import Unknown, expression
from .lpy_modules import Modules
from .scene import Model

_KEY = re.compile(r"\s*(axiom|derivation\s+length|maximum\s+depth|initial\s+seed|ignore|consider|module|group)\b\s*:?", re.I)
_SECTION = re.compile(r"\s*(production|decomposition|interpretation|homomorphism)\s*:\s*$", re.I)
_CONSTANT = re.compile(r"\s*([A-Za-z_]\w*)\s*=(?!=)(.*)$")
_TAIL = "###### INITIALISATION ######"  # written by L-Py's editor: its options, colours and curves


def from_lpy(text):
    """The Model that a text of L-Py stands for; `.text` is what it says in the language of Espalier.

    Read are: constants, module, axiom, derivation length, ignore, consider, productions with contexts, conditions and
    parameters (arrows, and blocks of if, elif, else and produce), decomposition, interpretation or homomorphism,
    maximum depth, and groups, of which only group 0 grows. What needs Python is an Error that names line and construct.
    """
    return Model(text=_Reader().read(text))


class _Reader:
    def __init__(self):
        self._modules = Modules()
        self._constants = {}
        self._header = {"derivation length": "1"}
        self._productions = {"production": [], "decomposition": [], "homomorphism": []}
        self._depths = {}
        self._section = None
        self._group = 0

    def read(self, text):
        lines = _lines(text)
        while lines:
            number, line = lines.pop(0)
            try:
                self._statement(line, lines)
            except Unknown as error:
                problem = _espalier.Error(f"line {number}: {error}")
                problem.line = number
                raise problem from None
        return self._text()

    def _statement(self, line, lines):
        section, key = _SECTION.match(line), _KEY.match(line)
        if section:
            name = section[1].lower()
            self._section = "homomorphism" if name == "interpretation" else name
        elif line.strip() == "endlsystem":
            self._section = None
        elif line.strip() == "endgroup":
            self._group = 0
        elif key and "-->" not in line:
            self._keyword(" ".join(key[1].lower().split()), line[key.end() :].strip())
        elif self._section:
            self._production(line, lines)
        elif _CONSTANT.match(line):
            name, value = _CONSTANT.match(line).groups()
            self._constants[name] = expression(value, self._constants)
        elif not re.match(r"\s*(from|import)\b", line):  # what they bring is refused where it is used
            raise Unknown(f"'{line.strip()}' needs Python")

    def _keyword(self, key, value):
        if key == "module":
            for name in re.findall(r"([A-Za-z_]\w*)\s*(?:\([^)]*\))?", value):
                self._modules.declare(name)
        elif key == "group":
            self._group = int(value.rstrip(":")) if value.rstrip(":").isdigit() else 0
        elif key == "maximum depth":
            self._depths[self._section] = expression(value, self._constants)
        elif key in ("ignore", "consider"):
            self._header[key] = self._modules.symbols(value)
        elif key == "axiom":
            self._header[key] = self._modules.successor(value, self._constants)
        else:
            self._header["seed" if key == "initial seed" else key] = expression(value, self._constants)

    def _production(self, line, lines):
        arrow = line.find("-->")
        left, colon, rest = _before_colon(line if arrow < 0 else line[:arrow])
        if arrow >= 0:
            branches = [([(False, rest.strip())] if rest.strip() else [], line[arrow + 3 :])]
        elif colon:
            branches = _produced(rest, lines, _indent(line))
        else:
            raise Unknown(f"'{line.strip()}' is no production: it has neither an arrow nor a block")
        pattern, names = self._pattern(left)
        names = {*names, *self._constants}
        for conditions, successor in branches:
            words = " && ".join(_known(condition, names) for condition in conditions)
            written = f"{pattern}{words and ' : ' + words} --> {self._modules.successor(successor, names)}"
            if self._group == 0:
                self._productions[self._section].append(written)

    def _pattern(self, left):
        if "<<" in left or ">>" in left:
            raise Unknown("'<<' and '>>', new contexts")
        written, names = [], []
        for part in re.split(r"([<>])", left):
            if part in ("<", ">"):
                written.append(part)
            else:
                text, more = self._modules.pattern(part)
                written.append(text)
                names += more
        return " ".join(written), names

    def _text(self):
        if "axiom" not in self._header:
            raise _espalier.Error("the model of L-Py has no axiom")
        lines = [f"const {name} = {value};" for name, value in self._constants.items()]
        for name, counts in self._modules.declared.items():
            for count in sorted(counts):
                lines.append(f"module {name}" + (f"({', '.join('xyzuvw'[:count])})" if count else "") + ";")
        lines.append("lsystem: 1")
        lines += [f"{key}: {value}" for key, value in self._header.items()]
        for section, productions in self._productions.items():
            if productions and section != "production":
                lines.append(section)
                lines += [f"maximum depth: {self._depths[section]}"] if section in self._depths else []
            lines += productions
        return "\n".join([*lines, "endlsystem", ""])


def _known(condition, names):
    denied, condition = condition
    written = expression(condition, names)
    return f"!({written})" if denied else f"({written})"


def _lines(text):
    """Numbers and texts of the lines that say something; a backslash at an end joins it with the next."""
    lines, joined, begun = [], "", None
    for number, line in enumerate(text.partition(_TAIL)[0].splitlines(), 1):
        line = line.split("#")[0].rstrip()
        begun = begun or number
        if line.endswith("\\") and not line.endswith("\\\\"):
            joined += line[:-1]
            continue
        if (joined + line).strip():
            lines.append((begun, (joined + line).expandtabs()))
        joined, begun = "", None
    return lines


def _indent(line):
    return len(line) - len(line.lstrip())


def _before_colon(text):
    """Splits at the first colon outside parentheses."""
    depth = 0
    for i, sign in enumerate(text):
        depth += (sign in "([") - (sign in ")]")
        if sign == ":" and depth <= 0:
            return text[:i], ":", text[i + 1 :]
    return text, "", ""


def _produced(rest, lines, indent):
    """The conditions and successors of a block, in the order in which they are tried."""
    if rest.strip():
        block = [(indent + 1, rest.strip())]
    else:
        block = _deeper(indent, [(_indent(line), line.strip()) for _, line in lines])
        del lines[: len(block)]
    branches = []
    _find_branches(block, [], branches)
    if not branches:
        raise Unknown("a production that produces nothing")
    return branches


def _deeper(indent, block):
    """The lines at the beginning of a block that are indented more."""
    end = next((i for i, (own, _) in enumerate(block) if own <= indent), len(block))
    return block[:end]


def _find_branches(block, given, branches):
    """Adds the branches of a block under the conditions `given`; returns whether one of them always applies.

    A condition is (denied, text). Branches are tried in order, so only those that may end without produce are denied.
    """
    denied, always = [], False
    while block:
        indent, line = block.pop(0)
        word = re.match(r"(if|elif|else|produce|pass)\b(.*)$", line)
        if not word:
            raise Unknown(f"'{line}' needs Python")
        if word[1] == "produce":
            branches.append((given, word[2]))
            return True
        if word[1] == "pass":
            continue
        condition, _, rest = _before_colon(word[2])
        inner = [(indent + 1, rest.strip())] if rest.strip() else _deeper(indent, block)
        del block[: 0 if rest.strip() else len(inner)]
        if word[1] == "if":
            denied, always = [], True
        own = [(False, condition.strip())] if condition.strip() else []
        if not _find_branches(inner, given + denied + own, branches):
            denied, always = denied + [(True, condition.strip())], False
        if word[1] == "else" and always:
            return True
    return False
