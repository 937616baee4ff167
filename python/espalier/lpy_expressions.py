"""Expressions of Python, as they stand in models of L-Py, written in the language of Espalier."""

import ast

_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
_COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
_SAME = ("exp", "log", "sqrt", "fabs", "abs", "floor", "ceil", "min", "max", "pow")
# Python's angles are radians, those of the language degrees.
_OF_RADIANS = ("sin", "cos", "tan")
_TO_RADIANS = ("asin", "acos", "atan", "atan2")


class Unknown(Exception):
    """A construct that has no twin, with the words to say so."""


def expression(text, names):
    """The expression `text` of Python, where `names` are known; raises Unknown."""
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except SyntaxError as error:
        raise Unknown(f"'{text.strip()}' is no expression: {error.msg}") from None
    return _Writer(names).visit(tree.body)


class _Writer(ast.NodeVisitor):
    def __init__(self, names):
        self._names = names

    def generic_visit(self, node):
        raise Unknown(f"'{ast.unparse(node)}' ({type(node).__name__}) needs Python")

    def visit_Constant(self, node):
        if isinstance(node.value, bool):
            return str(int(node.value))
        if not isinstance(node.value, (int, float)):
            return self.generic_visit(node)
        return repr(node.value)

    def visit_Name(self, node):
        if node.id not in self._names and node.id not in ("pi", "e"):
            raise Unknown(f"'{node.id}' is neither a parameter nor a constant of the model")
        return node.id

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
        pairs = zip(sides, node.ops, sides[1:])
        return "(" + " && ".join(f"{left} {_COMPARISONS[type(op)]} {right}" for left, op, right in pairs) + ")"

    def visit_IfExp(self, node):
        return f"({self.visit(node.test)} ? {self.visit(node.body)} : {self.visit(node.orelse)})"

    def visit_Call(self, node):
        name = node.func.id if isinstance(node.func, ast.Name) else None
        values = [self.visit(value) for value in node.args] if not node.keywords else []
        if name in _OF_RADIANS and len(values) == 1:
            return f"{name}(({values[0]}) * 180 / pi)"
        if name in _TO_RADIANS and len(values) == (2 if name == "atan2" else 1):
            return f"({name}({', '.join(values)}) * pi / 180)"
        if name == "int" and len(values) == 1:
            return f"trunc({values[0]})"
        if name in _SAME and values:
            return f"{name}({', '.join(values)})"
        return self.generic_visit(node)
