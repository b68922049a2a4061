"""Constant expressions of C: their values, and how other languages write them."""
from pycparser import c_ast

from generator.model import INTEGERS, Unknown

BINARY = {
    "<<": lambda a, b: a << b,
    ">>": lambda a, b: a >> b,
    "|": lambda a, b: a | b,
    "&": lambda a, b: a & b,
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
}


def cast_type(node):
    """Name of the type that a cast casts to; None for no cast."""
    named = node.to_type.type.type if isinstance(node, c_ast.Cast) else None
    return named.names[0] if isinstance(named, c_ast.IdentifierType) and len(named.names) == 1 else None


def is_bit(node):
    """1 << n."""
    one = getattr(getattr(node, "left", None), "expr", getattr(node, "left", None))
    return isinstance(one, c_ast.Constant) and node.op == "<<" and one.value.rstrip("u") == "1"


class Evaluator:
    """Values with the name of their type; None: that of a plain number."""

    def __init__(self, integers):
        self.integers = integers  # name of a typedef -> name in INTEGERS
        self.values = {}  # of enums and macros: name -> (value, type)
        self.macros = {}  # name -> (parameters, expression)

    def fit(self, value, name, place):
        """As C converts: unsigned types wrap."""
        bits, signed = INTEGERS[self.integers[name]]
        if not signed:
            return value % (1 << bits)
        if not -(1 << (bits - 1)) <= value < 1 << (bits - 1):
            raise Unknown(place, f"{value} is no {name}")
        return value

    def evaluate(self, node, place, arguments=None):
        kind = type(node)
        if kind is c_ast.Constant and "int" in node.type:
            digits = node.value.lower().rstrip("ul")
            if digits[:1] == "0" and digits.isdigit() and len(digits) > 1:
                raise Unknown(place, f"{node.value}: octal")
            return int(digits, 0), "uint32_t" if node.value.lower().endswith("u") else None
        if kind is c_ast.ID:
            if node.name in (arguments or {}):
                return arguments[node.name]
            if node.name in self.values:
                return self.values[node.name]
        if kind is c_ast.Cast and cast_type(node) in self.integers:
            name = cast_type(node)
            return self.fit(self.evaluate(node.expr, place, arguments)[0], name, place), name
        if kind is c_ast.UnaryOp and node.op == "-":
            value, name = self.evaluate(node.expr, place, arguments)
            return (-value if name is None else self.fit(-value, name, place)), name
        if kind is c_ast.BinaryOp and node.op in BINARY:
            (left, name), (right, other) = (self.evaluate(side, place, arguments) for side in (node.left, node.right))
            name = name if node.op in ("<<", ">>") else name or other
            value = BINARY[node.op](left, right)
            return (value if name is None else self.fit(value, name, place)), name
        if kind is c_ast.FuncCall and isinstance(node.name, c_ast.ID) and node.name.name in self.macros:
            parameters, expression = self.macros[node.name.name]
            values = [self.evaluate(value, place, arguments) for value in node.args.exprs]
            return self.evaluate(expression, place, dict(zip(parameters, values)))
        raise Unknown(place, f"an expression that has no value here: {kind.__name__}")


def written(node, place, number, cast):
    """An expression of parameters in another language: number(text) and cast(type, text) write what differs."""
    if isinstance(node, c_ast.Constant) and "int" in node.type:
        return number(node.value)
    if isinstance(node, c_ast.ID):
        return node.name
    if isinstance(node, c_ast.Cast) and cast_type(node):
        return cast(cast_type(node), written(node.expr, place, number, cast))
    if isinstance(node, c_ast.BinaryOp) and node.op in BINARY:
        sides = [written(side, place, number, cast) for side in (node.left, node.right)]
        return f"({sides[0]} {node.op} {sides[1]})"
    raise Unknown(place, f"an expression that other languages have not: {type(node).__name__}")
