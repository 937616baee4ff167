"""Statements of Python, as they stand in the productions and functions of models of L-Py, in the language of Espalier."""

import ast
import re

from .lpy_expressions import Unknown, is_random, quoted, written

_OWN = """Q Z pi e if else while do for break const field module environment define external array sin cos tan asin acos
atan atan2 exp log sqrt fabs floor ceil sign trunc ran nran bran biran srand printf min max abs round pow clamp lerp noise
stop func""".split()
_PRODUCED = "__produced__"


def parsed(text):
    """The statements of a text of Python; raises Unknown."""
    try:
        return ast.parse(text).body
    except (SyntaxError, ValueError) as error:
        line = text.splitlines()[(getattr(error, "lineno", None) or 1) - 1]
        raise Unknown(f"{quoted(line)} needs Python: {getattr(error, 'msg', error)}") from None


class Names:
    """Names of the variables and constants of the model that is written."""

    def __init__(self):
        self._taken = set(_OWN)
        self._locals = {}

    def take(self, name):
        """A name for this thing alone: its own, or with a number behind it."""
        free, number = name, 1
        while free in self._taken:
            number += 1
            free = f"{name}_{number}"
        self._taken.add(free)
        return free

    def local(self, name):
        """A name for what a production assigns before it reads it; productions share it."""
        if name not in self._locals:
            self._locals[name] = self.take(name)
        return self._locals[name]


class Production:
    """The block of a production: `branches` are its conditions and successors in the order in which they are tried.

    A block of if, elif, else and produce alone becomes conditions. One with other statements becomes the block before the
    condition of the first branch, and a variable says which branch it chose.
    """

    def __init__(self, text, scope, names):
        self._successors = []
        body = parsed(re.sub(r"\bproduce\b(.*)$", self._mark, text, flags=re.M))
        self.scope, self.before, self.branches = scope, "", []
        if _only_chooses(body) and self._find_branches(body, []) is not None:
            return
        self.branches.clear()
        chosen = names.local("branch")
        block = Statements(scope, names, body, chosen)
        self.scope = block.scope
        self.before = " ".join([f"{chosen} = 0;", *block.lines])
        self.branches = [(f"{chosen} == {i + 1}", successor) for i, successor in enumerate(self._successors)]

    def _mark(self, found):
        self._successors.append(found[1])
        return f"{_PRODUCED}({len(self._successors)})"

    def _find_branches(self, body, given):
        """Adds the branches of a block under the conditions `given`. Returns whether one of them always applies; None if a
        random condition would be drawn twice. Since branches are tried in order, a condition is denied only where its own
        block may end without produce."""
        for node in body:
            if _is_produced(node):
                self.branches.append((" && ".join(given), self._successors[_number_of(node) - 1]))
                return True
            if not isinstance(node, ast.If):
                continue
            condition = written(node.test, self.scope)
            before = len(self.branches)
            yes = self._find_branches(node.body, [*given, f"({condition})"])
            if is_random(condition) and not (yes and len(self.branches) == before + 1):
                return None
            no = self._find_branches(node.orelse, given if yes else [*given, f"!({condition})"])
            if yes is None or no is None:
                return None
            if yes and no:
                return True
        return False


def assigned_in(body):
    """The names that statements assign, but for those that they declare as global."""
    walked = [node for one in body for node in ast.walk(one)]
    shared = {name for node in walked if isinstance(node, ast.Global) for name in node.names}
    return {node.id for node in walked if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)} - shared


def _only_chooses(body):
    return all(
        isinstance(node, ast.Pass)
        or _is_produced(node)
        or (isinstance(node, ast.If) and _only_chooses(node.body) and _only_chooses(node.orelse))
        for node in body
    )


def _is_produced(node):
    if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)):
        return False
    return isinstance(node.value.func, ast.Name) and node.value.func.id == _PRODUCED


def _number_of(node):
    return node.value.args[0].value


class Statements:
    """Statements as `lines` of the language; `scope` has the variables that they assign.

    Where `chosen` is the name of a variable, produce sets it to the number of its branch, and nothing follows.
    """

    def __init__(self, scope, names, body, chosen=None, shared=()):
        self._names = names
        self._chosen = chosen
        begin = self._assigned(body, scope, shared)
        self.lines = [*begin, *self._block(body, loops=0)]

    def _assigned(self, body, scope, shared):
        """Gives the names that the statements assign their variables; a parameter hands over its value."""
        own = sorted(assigned_in(body) - set(shared))
        parameters = [name for name in own if name in scope.written and name not in scope.model.written]
        variables = {name: self._names.local(f"{name}_now" if name in parameters else name) for name in own}
        self.scope = scope.with_names(variables)
        return [f"{variables[name]} = {scope.written[name]};" for name in parameters]

    def _block(self, body, loops):
        lines = []
        for i, node in enumerate(body):
            if isinstance(node, (ast.Pass, ast.Global)):
                continue
            lines += self._statement(node, loops)
            if not self._chosen or _is_produced(node) or not any(map(_is_produced, ast.walk(node))):
                continue
            if not loops:
                rest = self._block(body[i + 1 :], loops)
                return [*lines, f"if ({self._chosen} == 0) {{", *rest, "}"] if rest else lines
            if isinstance(node, (ast.For, ast.While)):
                lines.append(f"if ({self._chosen} != 0) {{ break; }}")
        return lines

    def _statement(self, node, loops):
        if self._chosen and _is_produced(node):
            return [f"{self._chosen} = {_number_of(node)};", *(["break;"] if loops else [])]
        if isinstance(node, ast.Assign):
            value = written(node.value, self.scope)
            first = self._variable(node.targets[0])
            return [f"{first} = {value};", *(f"{self._variable(one)} = {first};" for one in node.targets[1:])]
        if isinstance(node, ast.AugAssign):
            value = ast.BinOp(ast.Name(getattr(node.target, "id", "?"), ast.Load()), node.op, node.value)
            return [f"{self._variable(node.target)} = {written(value, self.scope)};"]
        if isinstance(node, ast.If):
            return self._if(node, loops)
        if isinstance(node, ast.While) and not node.orelse:
            return [f"while ({written(node.test, self.scope)}) {{", *self._block(node.body, loops + 1), "}"]
        if isinstance(node, ast.For) and not node.orelse:
            return self._for(node, loops)
        if isinstance(node, ast.Break) and loops:
            return ["break;"]
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            return []
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and isinstance(node.value.func, ast.Name):
            return self._call(node.value)
        raise Unknown(f"{quoted(ast.unparse(node).splitlines()[0])} needs Python")

    def _variable(self, target):
        if not isinstance(target, ast.Name):
            raise Unknown(f"'{ast.unparse(target)} = ...' needs Python: only names are assigned")
        return written(ast.Name(target.id, ast.Load()), self.scope)

    def _if(self, node, loops):
        lines = [f"if ({written(node.test, self.scope)}) {{", *self._block(node.body, loops), "}"]
        if node.orelse:
            lines += ["else {", *self._block(node.orelse, loops), "}"]
        return lines

    def _for(self, node, loops):
        """for i in range(...): the bounds are computed once, and i keeps its last value."""
        over = node.iter
        if not (isinstance(over, ast.Call) and isinstance(over.func, ast.Name) and over.func.id == "range"):
            raise Unknown(f"'for {ast.unparse(node.target)} in {ast.unparse(over)}' needs Python: only range is read")
        bounds = [written(bound, self.scope) for bound in over.args]
        step = over.args[2] if len(bounds) == 3 else ast.Constant(1)
        down = isinstance(step, ast.UnaryOp) and isinstance(step.op, ast.USub)
        if not 1 <= len(bounds) <= 3 or not isinstance(step.operand if down else step, ast.Constant):
            raise Unknown(f"'{ast.unparse(over)}': the step of a range is a number")
        counter, last = self._names.take("count"), self._names.take("last")
        first, end = ("0", bounds[0]) if len(bounds) == 1 else bounds[:2]
        head = f"for ({counter} = {first}; {counter} {'>' if down else '<'} {last}; {counter} += {written(step, self.scope)}) {{"
        body = [f"{self._variable(node.target)} = {counter};", *self._block(node.body, loops + 1)]
        return [f"{last} = {end};", head, *body, "}"]

    def _call(self, call):
        if call.func.id == "print" and not call.keywords:
            return [self._print(call.args)]
        if call.func.id == "seed" and len(call.args) == 1:
            return [f"srand({written(call.args[0], self.scope)});"]
        raise Unknown(f"'{ast.unparse(call)}' needs Python")

    def _print(self, values):
        formats, numbers = [], []
        for value in values:
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                text = value.value.replace("%", "%%").replace("\\", "\\\\").replace('"', '\\"')
                formats.append(text.replace("\n", "\\n"))
            else:
                formats.append("%g")
                numbers.append(written(value, self.scope))
        return f"printf({', '.join([chr(34) + ' '.join(formats) + chr(92) + 'n' + chr(34), *numbers])});"
