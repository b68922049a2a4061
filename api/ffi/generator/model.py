"""What a header declares, without its syntax: what parse.py finds and the writers of languages write."""
import dataclasses


class Unknown(Exception):
    """A construct that has no declaration in other languages, with the file and the line where it stands."""

    def __init__(self, place, what):
        super().__init__(f"{place}: {what}")


# --- types ------------------------------------------------------------------------------------------------------------
# The types of C that have one size everywhere, and the pointer's: bits, signed.
INTEGERS = {f"{sign}int{bits}_t": (bits, not sign) for bits in (8, 16, 32, 64) for sign in ("", "u")}
PRIMITIVES = {*INTEGERS, "double", "float", "char", "size_t", "void"}


@dataclasses.dataclass(frozen=True)
class Named:
    name: str  # a primitive, an Alias, a Struct or an Opaque


@dataclasses.dataclass(frozen=True)
class Pointer:
    target: object
    const: bool  # what it points to


@dataclasses.dataclass(frozen=True)
class Array:
    element: object
    count: int


@dataclasses.dataclass(frozen=True)
class Function:  # a pointer to one: C has them in structs, arguments and typedefs only so
    result: object
    parameters: tuple  # of (name, type)


# --- declarations; doc: what the header's comment says ----------------------------------------------------------------
@dataclasses.dataclass
class Alias:
    name: str
    type: object
    doc: str


@dataclasses.dataclass
class Opaque:
    name: str
    doc: str


@dataclasses.dataclass
class Member:
    name: str
    type: object
    doc: str


@dataclasses.dataclass
class Struct:
    name: str
    members: list
    doc: str


@dataclasses.dataclass
class Constant:
    name: str
    type: str
    value: int
    bit: bool  # written as 1 << n
    doc: str


@dataclasses.dataclass
class Constants:  # of one enum
    constants: list
    doc: str


@dataclasses.dataclass
class Text:
    name: str
    value: str
    doc: str


@dataclasses.dataclass
class Macro:  # with parameters: an expression of pycparser
    name: str
    parameters: list  # of (name, type)
    result: str
    expression: object
    doc: str


@dataclasses.dataclass
class Export:  # the function that a backend exports
    name: str
    type: Function
    doc: str


@dataclasses.dataclass
class Header:
    name: str
    doc: str
    declarations: list


def all_of(headers, kind):
    return [declaration for header in headers for declaration in header.declarations if isinstance(declaration, kind)]


def all_constants(headers):
    """Those of enums and those of macros, in order."""
    found = []
    for declaration in all_of(headers, (Constant, Constants)):
        found += declaration.constants if isinstance(declaration, Constants) else [declaration]
    return found
