"""plumb.h and what it includes as declarations (model.py). What it does not know is an error, with file and line."""
import bisect
import itertools
import pathlib
import re

from pycparser import c_ast, c_parser

from generator import model
from generator.comments import Comments
from generator.expressions import Evaluator, cast_type, is_bit
from generator.model import Unknown
from generator.preprocess import MARKER, preprocess


def parse_error(text, file):
    try:
        c_parser.CParser().parse(text, str(file))
    except c_parser.ParseError as error:
        return str(error)
    return None


def place_of(error, text, file):
    """Where pycparser 3 does not say it: the first line with which it says the same."""
    found = re.match(r".*?:\d+", error)
    if found:
        return found.group()
    lines = text.split("\n")
    count = bisect.bisect_left(range(len(lines)), True,
                               key=lambda count: parse_error("\n".join(lines[:count]), file) == error)
    markers = [(number, MARKER.match(line)) for number, line in enumerate(lines[:count]) if MARKER.match(line)]
    number, marker = markers[-1]
    return f"{marker.group(2)}:{int(marker.group(1)) + count - number - 2}"


def parse_c(text, file):
    try:
        return c_parser.CParser().parse(text, str(file))
    except c_parser.ParseError as error:
        raise Unknown(place_of(str(error), text, file), f"no C11 that is known here: {error}") from error


class Parser:
    def __init__(self, include, compiler):
        self.include, self.compiler = pathlib.Path(include), compiler
        self.header = self.include / "plumb" / "plumb.h"
        self.known = set(model.PRIMITIVES)
        self.integers = {name: name for name in model.INTEGERS}
        self.evaluator = Evaluator(self.integers)
        self.comments = {}
        self.found = []  # (file, line, declaration)

    def place(self, node):
        return f"{node.coord.file}:{node.coord.line}"

    def comments_of(self, file):
        if file not in self.comments:
            self.comments[file] = Comments(pathlib.Path(file).read_text())
        return self.comments[file]

    def above(self, node):
        return self.comments_of(node.coord.file).above(node.coord.line)

    def around(self, node, end=""):
        """The comments above and behind a declaration."""
        return self.comments_of(node.coord.file).around(node.coord.line, end)

    # --- types --------------------------------------------------------------------------------------------------------
    def type_of(self, node, place):
        place = self.place(node) if node.coord else place
        for qualifier in getattr(node, "quals", []):
            if qualifier != "const":
                raise Unknown(place, f"a type that is {qualifier}")
        if isinstance(node, c_ast.TypeDecl):
            if getattr(node, "align", None):
                raise Unknown(place, "an alignment of its own")
            return self.type_of(node.type, place)
        if isinstance(node, c_ast.IdentifierType) and len(node.names) == 1 and node.names[0] in self.known:
            return model.Named(node.names[0])
        if isinstance(node, c_ast.IdentifierType):
            raise Unknown(place, f"type {' '.join(node.names)}, which has not one size everywhere or is not declared")
        if isinstance(node, c_ast.Struct) and node.decls is None and node.name in self.known:
            return model.Named(node.name)
        if isinstance(node, c_ast.PtrDecl) and isinstance(node.type, c_ast.FuncDecl):
            return self.function_of(node.type, place)
        if isinstance(node, c_ast.PtrDecl):
            return model.Pointer(self.type_of(node.type, place), "const" in getattr(node.type, "quals", []))
        if isinstance(node, c_ast.ArrayDecl) and node.dim is not None:
            count = self.evaluator.evaluate(node.dim, place)[0]
            return model.Array(self.type_of(node.type, place), count)
        raise Unknown(place, f"a type that other languages have not: {type(node).__name__}")

    def function_of(self, node, place):
        parameters = []
        for parameter in node.args.params if node.args else []:
            if isinstance(parameter, c_ast.EllipsisParam):
                raise Unknown(place, "a function of any number of arguments")
            found = self.type_of(parameter.type, place)
            if found == model.Named("void") and parameter.name is None:
                continue  # (void)
            if isinstance(found, model.Array) or parameter.name is None:
                raise Unknown(place, "an argument that is an array, or has no name")
            parameters.append((parameter.name, found))
        if node.args is None:
            raise Unknown(place, "a function that does not say what it takes: (void)")
        return model.Function(self.type_of(node.type, place), tuple(parameters))

    def check_plain(self, decl):
        """Nothing but a name and a type."""
        more = [*(decl.storage or []), *(getattr(decl, "funcspec", None) or []), *(getattr(decl, "align", None) or [])]
        if more or getattr(decl, "bitsize", None) is not None or getattr(decl, "init", None) is not None:
            raise Unknown(self.place(decl), f"{decl.name}: a bit field, or with a storage, alignment or value")

    # --- declarations -------------------------------------------------------------------------------------------------
    def add(self, node, declaration):
        self.found.append((node.coord.file, node.coord.line, declaration))
        if isinstance(declaration, (model.Alias, model.Struct, model.Opaque)):
            self.known.add(declaration.name)

    def add_struct(self, node, name, doc):
        self.known.add(name)  # members may point to it
        members = []
        for decl in node.decls:
            if not isinstance(decl, c_ast.Decl) or decl.name is None:
                raise Unknown(self.place(decl), f"a member of {name} that has no name")
            self.check_plain(decl)
            inner = decl.type.type if isinstance(decl.type, c_ast.TypeDecl) else None
            if isinstance(inner, c_ast.Struct) and inner.decls is not None:  # without a name: it gets one
                kind = model.Named(f"{name}_{decl.name}")
                self.add_struct(inner, kind.name, f"{name}.{decl.name}")
            else:
                kind = self.type_of(decl.type, self.place(decl))
            members.append(model.Member(decl.name, kind, self.around(decl, ";")))
        self.add(node, model.Struct(name, members, doc))

    def add_typedef(self, node):
        inner = node.type.type
        if isinstance(inner, c_ast.Struct):
            if inner.name != node.name:
                raise Unknown(self.place(node), f"struct {inner.name} is called {node.name}")
            if inner.decls is None:
                self.add(node, model.Opaque(node.name, self.around(node, ";")))
            else:
                self.add_struct(inner, node.name, self.above(inner))
            return
        found = self.type_of(node.type, self.place(node))
        if isinstance(found, model.Named) and found.name in self.integers:
            self.integers[node.name] = self.integers[found.name]
        elif not isinstance(found, model.Function):
            raise Unknown(self.place(node), f"{node.name} is neither an integer nor a function nor a struct")
        self.add(node, model.Alias(node.name, found, self.around(node, ";")))

    def add_enum(self, node):
        """Without a name of its own: of the integer type that is declared just before it."""
        if node.name is not None:
            raise Unknown(self.place(node), f"enum {node.name}, whose size C leaves open")
        constants, next_value = [], 0
        for item in node.values.enumerators:
            place = self.place(item)
            value = next_value if item.value is None else self.evaluator.evaluate(item.value, place)[0]
            next_value = value + 1
            self.evaluator.values[item.name] = (value, None)
            own_line = item.coord.line != node.coord.line
            doc = self.around(item) if own_line else self.comments_of(item.coord.file).behind(item.coord.line)
            constants.append(model.Constant(item.name, "", value, is_bit(item.value), doc))
        file, _, before = self.found[-1] if self.found else (None, None, None)
        name = "int32_t" if any(item.value < 0 for item in constants) else "uint32_t"
        if file == node.coord.file and isinstance(before, model.Alias) and before.name in self.integers:
            name = before.name
        for item in constants:
            item.type = name
            if self.evaluator.fit(item.value, item.type, self.place(node)) != item.value:
                raise Unknown(self.place(node), f"{item.name} is no {item.type}")
        self.add(node, model.Constants(constants, self.above(node)))

    def add_declaration(self, node):
        if isinstance(node, c_ast.Typedef):
            self.add_typedef(node)
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.Enum) and node.name is None:
            self.add_enum(node.type)
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.FuncDecl):
            self.check_plain(node)
            self.add(node, model.Export(node.name, self.function_of(node.type, self.place(node)), self.above(node)))
        else:
            raise Unknown(self.place(node), f"a declaration that other languages have not: {type(node).__name__}")

    # --- macros -------------------------------------------------------------------------------------------------------
    def expression_of(self, macro):
        types = "".join(f"typedef int {name};" for name in self.integers)
        try:
            unit = c_parser.CParser().parse(f"{types} int value = {macro.body};")
        except c_parser.ParseError as error:
            raise Unknown(f"{macro.file}:{macro.line}", f"{macro.name} is no value: {macro.body}") from error
        return unit.ext[-1].init

    def parameter_type(self, macro, name, expression):
        """That to which each use of a parameter is cast."""
        found, uses = set(), 0
        nodes = [expression]
        while nodes:
            node = nodes.pop()
            nodes += [child for _, child in node.children()]
            uses += isinstance(node, c_ast.ID) and node.name == name
            if isinstance(node, c_ast.Cast) and isinstance(node.expr, c_ast.ID) and node.expr.name == name:
                found.add(cast_type(node))
                uses -= 1
        if len(found) != 1 or uses != 0:
            raise Unknown(f"{macro.file}:{macro.line}", f"{macro.name} does not cast {name} to one type")
        return found.pop()

    def add_macro(self, macro):
        place = f"{macro.file}:{macro.line}"
        if not re.search(rf"#\s*define\s+{macro.name}\b", self.comments_of(macro.file).code[macro.line - 1]):
            raise Unknown(place, f"{macro.name} is not defined on this line")
        doc = self.comments_of(macro.file).around(macro.line)
        expression = self.expression_of(macro)
        if macro.parameters is not None:
            self.evaluator.macros[macro.name] = (macro.parameters, expression)
            parameters = [(name, self.parameter_type(macro, name, expression)) for name in macro.parameters]
            result = self.evaluator.evaluate(expression, place, {name: (0, kind) for name, kind in parameters})[1]
            if result is None:
                raise Unknown(place, f"{macro.name} is of no type")
            found = model.Macro(macro.name, parameters, result, expression, doc)
        elif isinstance(expression, c_ast.Constant) and expression.type == "string":
            found = model.Text(macro.name, expression.value[1:-1], doc)
            if "\\" in found.value:
                raise Unknown(place, f"{macro.name}: a text that is written otherwise in other languages")
        else:
            value, name = self.evaluator.evaluate(expression, place)
            self.evaluator.values[macro.name] = (value, name)
            name = name or ("int32_t" if value < 0 else "uint32_t")
            found = model.Constant(macro.name, name, self.evaluator.fit(value, name, place), is_bit(expression), doc)
        self.found.append((macro.file, macro.line, found))

    def parse(self):
        """The headers in the order in which they declare something, each with what it declares in its order."""
        text, definitions = preprocess(self.header, self.include, self.compiler)
        unit = parse_c(text, self.header)
        own = [node for node in unit.ext if pathlib.Path(node.coord.file or "").is_relative_to(self.include)]
        if len(own) != len([node for node in unit.ext if not self.is_standard(node)]):
            raise Unknown(self.header, f"includes what is neither in {self.include} nor stdint.h or stddef.h")
        order = list(dict.fromkeys(node.coord.file for node in own))
        order += [macro.file for macro in definitions if macro.file not in order]
        # A macro may name an enum or a typedef above it, an array's length a macro: as they stand.
        events = [(node.coord.file, self.first_line(node), self.add_declaration, node) for node in own]
        events += [(macro.file, macro.line, self.add_macro, macro) for macro in definitions]
        for _, _, add, what in sorted(events, key=lambda event: (order.index(event[0]), event[1])):
            add(what)
        headers = []
        for file, group in itertools.groupby(self.found, key=lambda found: found[0]):
            name = pathlib.Path(file).relative_to(self.include).as_posix()
            headers.append(model.Header(name, self.comments_of(file).of_file(), [found[2] for found in group]))
        return headers

    def is_standard(self, node):
        return pathlib.Path(node.coord.file).name in ("stdint.h", "stddef.h")

    def first_line(self, node):
        """A typedef's own line is that of its name, at the struct's end."""
        outer = getattr(node, "type", None)
        parts = (node, outer, getattr(outer, "type", None))
        return min(part.coord.line for part in parts if getattr(part, "coord", None))
