"""Expressions of Python, as they stand in models of L-Py, written in the language of Espalier."""

import ast
import math

_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
_COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
_SAME = ("exp", "log", "sqrt", "fabs", "abs", "floor", "ceil", "min", "max", "pow")
# Python's angles are radians, those of the language degrees.
_OF_RADIANS = ("sin", "cos", "tan")
_TO_RADIANS = ("asin", "acos", "atan", "atan2")
_PACKAGES = ("math", "random", "numpy", "numpy.random")
_LONGEST = 20000  # letters of an expression after functions of the model are written out


class Unknown(Exception):
    """A construct that has no twin, with the words to say so."""


def quoted(text):
    """The beginning of a text in quotes."""
    text = text.strip()
    return f"'{text[:60]}{'...' if len(text) > 60 else ''}'"


class Scope:
    """The names that an expression may use: each is written as a text, or is an Unknown that tells why it is none."""

    def __init__(self, written=(), model=None):
        self.written = dict(written)
        self.model = model or self  # the scope of the whole model, which its functions see
        if model is None:
            self.functions = {}  # name: ast.FunctionDef
            self.packages = {"math": "math", "random": "random"}  # name: what it is

    def with_names(self, written):
        """This scope and more names, which hide those that it has."""
        return Scope({**self.written, **written}, self.model)

    def bring(self, node):
        """Takes note of an import."""
        if isinstance(node, ast.Import):
            for one in node.names:
                self.packages[one.asname or one.name] = one.name
        else:
            for one in node.names:
                self.packages[one.asname or one.name] = f"{node.module}.{one.name}"


def expression(text, scope):
    """The expression `text` of Python in the names of a Scope; raises Unknown."""
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError) as error:
        raise Unknown(f"{quoted(text)} is no expression: {getattr(error, 'msg', error)}") from None
    return written(tree.body, scope)


def written(node, scope):
    """The same of a tree of Python."""
    return _Writer(scope).visit(node)


def is_random(text):
    """Whether a written expression draws a random number, so that it must not stand twice."""
    return "ran(" in text


class _Writer(ast.NodeVisitor):
    def __init__(self, scope, inside=()):
        self._scope = scope
        self._inside = inside  # functions of the model that are being written out

    def generic_visit(self, node):
        raise Unknown(f"{quoted(ast.unparse(node))} ({type(node).__name__}) needs Python")

    def visit_Constant(self, node):
        if isinstance(node.value, bool):
            return str(int(node.value))
        if not isinstance(node.value, (int, float)) or not math.isfinite(node.value):
            return self.generic_visit(node)
        return repr(node.value)

    def visit_Name(self, node):
        name = self._scope.written.get(node.id)
        if isinstance(name, Unknown):
            raise name
        if name is None and node.id not in ("pi", "e"):
            raise Unknown(f"'{node.id}' is neither a parameter nor a constant of the model")
        return name or node.id

    def visit_Attribute(self, node):
        if self._full_name(node) in ("math.pi", "math.e", "numpy.pi", "numpy.e"):
            return node.attr
        return self.generic_visit(node)

    def visit_UnaryOp(self, node):
        signs = {ast.USub: "-", ast.UAdd: "", ast.Not: "!"}
        if type(node.op) not in signs:
            return self.generic_visit(node)
        return f"{signs[type(node.op)]}({self.visit(node.operand)})"

    def visit_BinOp(self, node):
        left, right = self.visit(node.left), self.visit(node.right)
        if isinstance(node.op, ast.Pow):
            return f"pow({left}, {right})"
        if isinstance(node.op, ast.FloorDiv):
            return f"floor(({left}) / ({right}))"
        if isinstance(node.op, ast.Mod):  # of the sign of the divisor, also for fractions
            self._draw_once(left, right)
            return f"(({left}) - ({right}) * floor(({left}) / ({right})))"
        if type(node.op) not in _OPERATORS:
            return self.generic_visit(node)
        return f"({left} {_OPERATORS[type(node.op)]} {right})"

    def visit_BoolOp(self, node):
        return "(" + (" && " if isinstance(node.op, ast.And) else " || ").join(map(self.visit, node.values)) + ")"

    def visit_Compare(self, node):
        sides = [self.visit(side) for side in (node.left, *node.comparators)]
        if any(type(op) not in _COMPARISONS for op in node.ops):
            return self.generic_visit(node)
        self._draw_once(*sides[1:-1])
        pairs = zip(sides, node.ops, sides[1:])
        return "(" + " && ".join(f"{left} {_COMPARISONS[type(op)]} {right}" for left, op, right in pairs) + ")"

    def visit_IfExp(self, node):
        return f"({self.visit(node.test)} ? {self.visit(node.body)} : {self.visit(node.orelse)})"

    def visit_Call(self, node):
        if node.keywords or any(isinstance(value, ast.Starred) for value in node.args):
            return self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in self._scope.model.functions:
            return self._written_out(node)
        name = self._name_of_function(node.func)
        values = [self.visit(value) for value in node.args]
        called = self._call(name, values) if name else None
        return self.generic_visit(node) if called is None else called

    def _full_name(self, node):
        """"numpy.random.uniform" for `np.random.uniform`; None for what is no name with dots."""
        if isinstance(node, ast.Attribute):
            before = self._full_name(node.value)
            return before and f"{before}.{node.attr}"
        return self._scope.model.packages.get(node.id, node.id) if isinstance(node, ast.Name) else None

    def _name_of_function(self, node):
        package, _, name = (self._full_name(node) or "").rpartition(".")
        return name if not package or package in _PACKAGES else None

    def _call(self, name, values):
        count = len(values)
        if name in _OF_RADIANS and count == 1:
            return f"{name}(({values[0]}) * 180 / pi)"
        if name in _TO_RADIANS and count == (2 if name == "atan2" else 1):
            return f"({name}({', '.join(values)}) * pi / 180)"
        if name in ("radians", "degrees") and count == 1:
            return f"(({values[0]}) * {'pi / 180' if name == 'radians' else '180 / pi'})"
        if name == "int" and count == 1:
            return f"trunc({values[0]})"
        if name == "float" and count == 1:
            return f"({values[0]})"
        if name == "round" and count in (1, 2):
            return self._rounded(*values)
        if name in _SAME and values:
            return f"{name}({', '.join(values)})"
        return self._random(name, values)

    def _rounded(self, value, digits="0"):
        if digits != "0":
            return f"(round(({value}) * pow(10, {digits})) / pow(10, {digits}))"
        if is_random(value):
            return f"round({value})"
        return f"(({value}) - floor({value}) == 0.5 ? 2 * round(({value}) / 2) : round({value}))"  # halves to the even

    def _random(self, name, values):
        count = len(values)
        if name in ("random", "rand") and count == 0:
            return "ran(1)"
        if name in ("uniform", "randint") and count == 2:
            self._draw_once(values[0])
            if name == "uniform":
                return f"({values[0]} + ran(({values[1]}) - ({values[0]})))"
            return f"({values[0]} + floor(ran(({values[1]}) - ({values[0]}) + 1)))"
        if name == "randrange" and count == 1:
            return f"floor(ran({values[0]}))"
        if name in ("gauss", "normalvariate", "normal") and count == 2:
            return f"nran({values[0]}, {values[1]})"
        return None

    def _draw_once(self, *texts):
        if any(map(is_random, texts)):
            raise Unknown("a random number that an expression uses twice: give it a name, as in r = random()")

    def _written_out(self, node):
        function = self._scope.model.functions[node.func.id]
        names = [one.arg for one in function.args.args]
        if function.name in self._inside or len(self._inside) > 20:
            raise Unknown(f"'{function.name}' calls itself")
        missing = len(names) - len(node.args)
        defaults = function.args.defaults[len(function.args.defaults) - missing :] if missing > 0 else []
        if len(defaults) != missing or function.args.vararg or function.args.kwonlyargs:
            raise Unknown(f"{quoted(ast.unparse(node))}: '{function.name}' takes {len(names)} parameters")
        scope = self._scope.model
        for name, value in zip(names, [*node.args, *defaults]):
            scope = self._named(scope, name, self.visit(value), function)
        return self._returned(function.body, scope, function)

    @staticmethod
    def _named(scope, name, text, function):
        uses = sum(isinstance(one, ast.Name) and one.id == name for one in ast.walk(function))
        if is_random(text) and uses > 1:
            raise Unknown(f"a random number '{name}' that the function '{function.name}' uses twice")
        return scope.with_names({name: f"({text})"})

    def _returned(self, body, scope, function):
        """What a list of statements returns, as an expression."""
        writer = _Writer(scope, (*self._inside, function.name))
        for i, node in enumerate(body):
            if isinstance(node, ast.Return) and node.value is not None:
                return self._short(writer.visit(node.value), function)
            if isinstance(node, ast.If):
                rest = body[i + 1 :]
                yes, no = (self._returned([*part, *rest], scope, function) for part in (node.body, node.orelse))
                return self._short(f"({writer.visit(node.test)} ? {yes} : {no})", function)
            if isinstance(node, ast.Assign) and len(node.targets) == 1 and isinstance(node.targets[0], ast.Name):
                scope = self._named(scope, node.targets[0].id, writer.visit(node.value), function)
                writer = _Writer(scope, (*self._inside, function.name))
            elif not (isinstance(node, ast.Pass) or _is_text(node)):
                break
        raise Unknown(f"the function '{function.name}' is no expression: only =, if and return are read in it")

    @staticmethod
    def _short(text, function):
        if len(text) > _LONGEST:
            raise Unknown(f"the function '{function.name}' is too long an expression")
        return text


def _is_text(node):
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
