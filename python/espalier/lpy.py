"""Models of L-Py (Boudon et al. 2012), as far as they need no Python beyond numbers."""

import ast
import re
import textwrap

from . import _espalier
from .lpy_expressions import Scope, Unknown, expression, is_random, written
from .lpy_modules import Modules
from .lpy_statements import Names, Production, Statements, assigned_in, parsed
from .scene import Model

_KEY = re.compile(r"(axiom|derivation\s+length|maximum\s+depth|initial\s+seed|ignore|consider|module|group)\b\s*:?", re.I)
_SECTION = re.compile(r"\s*(production|decomposition|interpretation|homomorphism)\s*:\s*$", re.I)
_TIMES = ("Start", "StartEach", "EndEach", "End")
_TAIL = "###### INITIALISATION ######"  # written by L-Py's editor: its options, colours and curves
_LONGEST = 200  # lines of one statement at the top


def from_lpy(text):
    """The Model that a text of L-Py stands for; `.text` is what it says in the language of Espalier.

    Read are: numbers and functions of numbers at the top, Start, StartEach, EndEach and End, module, axiom, derivation
    length, ignore, consider, productions with contexts, conditions and parameters (arrows, and blocks of statements with
    produce), decomposition, interpretation or homomorphism, maximum depth, random numbers, turtle queries, and groups, of
    which only group 0 grows. What needs more of Python is an Error that names line and construct.
    """
    return Model(text=_Reader().read(text))


class _Reader:
    def __init__(self):
        self._modules = Modules()
        self._names = Names()
        self._scope = Scope()
        self._constants = {}
        self._variables = set()
        self._begin = []  # statements before those of Start
        self._times = {}  # the functions that L-Py calls itself: their statements
        self._header = {"derivation length": "1"}
        self._productions = {"production": [], "decomposition": [], "homomorphism": []}
        self._depths = {}
        self._section = None
        self._group = 0

    def read(self, text):
        lines = _lines(text)
        self._find_variables(text)
        while lines:
            number, line = lines.pop(0)
            try:
                self._statement(line, lines)
            except (Unknown, RecursionError) as error:
                said = error if isinstance(error, Unknown) else "nested too deeply"
                problem = _espalier.Error(f"line {number}: {said}")
                problem.line = number
                raise problem from None
        return self._text()

    def _find_variables(self, text):
        """What functions and productions assign as `global` is no constant."""
        for names in re.findall(r"^\s*global\s+(.*)$", text, re.M):
            self._declare(re.findall(r"\w+", names.split("#")[0]))

    def _declare(self, variables):
        for name in variables:
            if self._scope.written.get(name) in self._constants:
                raise Unknown(f"'{name}' is assigned twice at the top: give the second number another name")
            if name not in self._variables:
                self._variables.add(name)
                self._scope.written[name] = self._names.take(name)

    def _statement(self, line, lines):
        section, key = _SECTION.match(line), _KEY.match(line.strip())
        if section:
            name = section[1].lower()
            self._section = "homomorphism" if name == "interpretation" else name
        elif line.strip() == "endlsystem":
            self._section = None
        elif line.strip() == "endgroup":
            self._group = 0
        elif key and "-->" not in line:
            self._keyword(" ".join(key[1].lower().split()), line.strip()[key.end() :].strip())
        elif self._section:
            self._production(line, lines)
        else:
            for node in parsed(_whole(line, lines)):
                self._top(node)

    def _keyword(self, key, value):
        if key == "module":
            for name in re.findall(r"([A-Za-z_]\w*)\s*(?:\([^)]*\))?", value.split(":")[0]):
                self._modules.declare(name)
        elif key == "group":
            self._group = int(value.rstrip(":")) if value.rstrip(":").isdigit() else 0
        elif key == "maximum depth":
            self._depths[self._section] = self._fixed(key, value)
        elif key in ("ignore", "consider"):
            self._header[key] = self._modules.symbols(value)
        elif key == "axiom":
            self._header[key] = self._modules.successor(value, self._scope)
        elif key == "initial seed":
            self._begin.append(f"srand({expression(value, self._scope)});")
        else:
            self._header[key] = self._fixed(key, value)

    def _fixed(self, key, value):
        """An expression that must be known before anything runs."""
        text = expression(value, self._scope)
        if is_random(text) or self._reads_variable(text):
            raise Unknown(f"the {key} must be a number that nothing assigns later")
        return text

    def _top(self, node):
        """A statement of Python outside of productions."""
        if isinstance(node, (ast.Import, ast.ImportFrom)):  # what they bring is refused where it is used
            self._scope.bring(node)
        elif isinstance(node, ast.FunctionDef) and node.name in _TIMES:
            said = Statements(self._scope, self._names, node.body)
            self._times.setdefault(node.name, []).extend(said.lines)
        elif isinstance(node, ast.FunctionDef):
            self._scope.functions[node.name] = node
        elif isinstance(node, ast.Assign) and all(isinstance(one, ast.Name) for one in node.targets):
            for target in node.targets:
                self._constant(target.id, node.value)
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and ast.unparse(node.value.func) == "extern":
            for one in node.value.keywords:
                self._constant(one.arg, one.value)
        else:
            self._declare(assigned_in([node]))
            self._begin += Statements(self._scope, self._names, [node], shared=self._variables).lines

    def _constant(self, name, value):
        """A number at the top; what is none is told where it is used."""
        try:
            text = written(value, self._scope)
        except Unknown as problem:
            self._scope.written.setdefault(name, problem)
            return
        if name in self._variables or is_random(text) or self._reads_variable(text) or name in self._scope.written:
            self._declare([name])
            self._begin.append(f"{self._scope.written[name]} = {text};")
        else:
            self._scope.written[name] = self._names.take(name)
            self._constants[self._scope.written[name]] = text

    def _reads_variable(self, text):
        return not {self._scope.written[name] for name in self._variables}.isdisjoint(re.findall(r"[A-Za-z_]\w*", text))

    def _production(self, line, lines):
        arrow = line.find("-->")
        left, colon, rest = _before_colon(line if arrow < 0 else line[:arrow])
        pattern, names = self._pattern(left)
        scope = self._scope.with_names(names)
        before = ""
        if arrow >= 0:
            branches = [(f"({expression(rest, scope)})" if rest.strip() else "", line[arrow + 3 :])]
        elif colon:
            block = Production(_block(rest, lines, _indent(line)), scope, self._names)
            before, branches, scope = block.before, block.branches, block.scope
        else:
            raise Unknown(f"'{line.strip()}' is no production: it has neither an arrow nor a block")
        if not branches:
            raise Unknown("a production that produces nothing")
        for condition, successor in branches:
            head = f"{pattern} : {{ {before} }}" if before else f"{pattern}{condition and ' :'}"
            made = f"{head}{condition and ' ' + condition} --> {self._modules.successor(successor, scope)}"
            before = ""
            if self._group == 0:
                self._productions[self._section].append(made)

    def _pattern(self, left):
        if "<<" in left or ">>" in left:
            raise Unknown("'<<' and '>>', new contexts")
        parts, names = [], {}
        for part in re.split(r"([<>])", left):
            if part in ("<", ">"):
                parts.append(part)
            else:
                text, more = self._modules.pattern(part)
                parts.append(text)
                names.update(more)
        return " ".join(parts), names

    def _text(self):
        if "axiom" not in self._header:
            raise _espalier.Error("the model of L-Py has no axiom")
        lines = [f"const {name} = {value};" for name, value in self._constants.items()]
        for name, counts in self._modules.declared.items():
            for count in sorted(counts):
                parameters = ", ".join(f"p{i + 1}" for i in range(count))
                lines.append(f"module {name}" + (f"({parameters})" if count else "") + ";")
        lines.append("lsystem: 1")
        lines += [f"{key}: {value}" for key, value in self._header.items()]
        self._times["Start"] = [*self._begin, *self._times.get("Start", [])]
        lines += [f"{time}: {{ {' '.join(said)} }}" for time, said in self._times.items() if said]
        for section, productions in self._productions.items():
            if productions and section != "production":
                lines.append(section)
                lines += [f"maximum depth: {self._depths[section]}"] if section in self._depths else []
            lines += productions
        return "\n".join([*lines, "endlsystem", ""])


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


def _block(rest, lines, indent):
    """The statements of a production: those behind its colon, or the lines that are indented more."""
    if rest.strip():
        return rest.strip()
    return textwrap.dedent("\n".join(_deeper(lines, indent)))


def _deeper(lines, indent):
    """Takes the lines that are indented more than `indent` from the beginning."""
    taken = []
    while lines and _indent(lines[0][1]) > indent:
        taken.append(lines.pop(0)[1])
    return taken


def _whole(line, lines):
    """A statement of Python with its block, or with the lines up to the end of its parentheses or its text."""
    taken = [line, *_deeper(lines, _indent(line))]
    for count in range(min(len(lines), _LONGEST) + 1):
        text = "\n".join([*taken, *(more for _, more in lines[:count])])
        try:
            ast.parse(text)
        except (SyntaxError, ValueError):
            continue
        if re.match(r"\s*(elif|else|except|finally)\b", lines[count][1] if count < len(lines) else ""):
            continue
        del lines[:count]
        return text
    return "\n".join(taken)
