"""Modules of L-Py's strings, written in the language of Espalier."""

from .lpy_expressions import Unknown, expression

# Words of L-Py's turtle that have a symbol here.
_LONG = {
    "TurnAround": "|", "RollToVert": "@v", "RollL": "/", "RollR": "\\", "Right": "-", "Left": "+", "Down": "&", "Up": "^",
    "SetColor": ";", "IncColor": ";", "DecColor": ",", "SetWidth": "_", "IncWidth": "_", "DecWidth": "!",
    "Sphere": "@O", "Circle": "@o", "MoveTo": "@M", "SetHead": "@R", "Cut": "%",
    "SB": "[", "EB": "]", "BP": "{", "EP": "}", "PP": ".", "GetPos": "?P", "GetHead": "?H", "GetLeft": "?L", "GetUp": "?U",
}  # fmt: skip
# Those that have none: letter by letter they would be other modules.
_REFUSED = """nF iRollL iRollR Pinpoint PinpointRel EulerAngles LeftReflection UpReflection HeadingReflection MoveRel
StartScreenProjection EndScreenProjection DivScale MultScale SetScale StartGC EndGC LineTo OLineTo LineRel OLineRel Box
QuadBox Label CpfgSurface Surface PglShape Frame Arrow Text SetContour SectionResolution SetGuide EndGuide Sweep
PositionOnGuide InterpolateColors TextureBaseColor InterpolateTextureBaseColors TextureUScale TextureVScale TextureUVScale
TextureUOffset TextureVOffset TextureRotation TextureTransformation Tropism Elasticity SetElasticity GetRight GetFrame
@2D @3D @B @b @Tp @Ts @g ?R ?F""".split()
_PAIRS = ("@O", "@o", "@c", "@v", "@R", "@M", "~", "?P", "?H", "?L", "?U")
_NAMED = set("Ff+-&^/\\|[]{}._!;,%") | set(_PAIRS)
_TURNS = set("+-&^/\\")
_DOUBLED = {"_": "!", "!": "!", "@O": "@O", "@o": "@o", "@c": "@c"}  # radii there, widths and diameters here
_VECTORS = {"?P": 3, "?H": 3, "?L": 3, "?U": 3, "@M": 3, "@R": 6}  # z is up there and y here: (x, y, z) becomes (y, z, x)


class Modules:
    """Reads modules; remembers the numbers of parameters of those with names, which must be declared."""

    def __init__(self):
        self.declared = {}

    def declare(self, name):
        self.declared.setdefault(name, set())

    def pattern(self, text):
        """Modules of a predecessor or context: the text here, and what the names of their parameters are written as."""
        parts, names = [], {}
        for symbol, values in self._split(text):
            if symbol in _DOUBLED:
                raise Unknown(f"'{symbol}' in a predecessor: its parameter is a radius there and a width here")
            for value in values or ():
                if not value.isidentifier():
                    raise Unknown(f"the parameter '{value}' of a predecessor is no name")
                names[value] = f"(-{value})" if symbol == "?U" else value  # up points the other way
            parts.append(self._write(symbol, _turned(symbol, values)))
        return "".join(parts), names

    def successor(self, text, scope):
        """Modules of a successor or axiom, whose parameters are expressions in a Scope."""
        if text.strip() == "*":
            return "*"
        return "".join(self._write(*self._same_sizes(symbol, values, scope)) for symbol, values in self._split(text)) or "*"

    def symbols(self, text):
        """Those of ignore: and consider:."""
        return " ".join(self._here(symbol) for symbol, _ in self._split(text))

    def _same_sizes(self, symbol, values, scope):
        values = None if values is None else [expression(value, scope) for value in values]
        if symbol == "F" and values and len(values) > 1:
            raise Unknown("'F' with a radius at its tip: write _(radius)F(length)")
        if symbol in _TURNS and not values:
            return symbol, ["60"]  # L-Py's default angle
        if symbol in _DOUBLED:
            if values:
                return _DOUBLED[symbol], [f"2 * {values[0]}"]
            return {"_": "#"}.get(symbol, symbol), values
        if symbol == "@R" and values and len(values) == 6:
            values[3:] = [f"-({value})" for value in values[3:]]  # up points the other way
        return symbol, _turned(symbol, values)

    def _write(self, symbol, values):
        if symbol in self.declared:
            self.declared[symbol].add(len(values or ()))
        here = self._here(symbol)
        return here + (f"({', '.join(values)})" if values else " " if len(here) > 2 else "")

    @staticmethod
    def _here(symbol):
        return "@v" if symbol == "$" else symbol

    def _split(self, text):
        """Symbols, each with the texts of its parameters, None without parentheses."""
        known = sorted([*self.declared, *_LONG, *_PAIRS, *_REFUSED], key=len, reverse=True)
        place = 0
        while place < len(text):
            if text[place].isspace():
                place += 1
                continue
            symbol = next((name for name in known if text.startswith(name, place)), text[place])
            place += len(symbol)
            if symbol == "~":
                symbol, place = text[place - 1 : place + 1], place + 1
            elif symbol in _LONG and symbol not in self.declared:
                symbol = _LONG[symbol]
            elif symbol in _REFUSED and symbol not in self.declared:
                raise Unknown(f"'{symbol}' of L-Py's turtle has no twin here")
            elif not (symbol in self.declared or symbol in _NAMED or symbol in "$" or symbol.isalnum()):
                raise Unknown(f"the symbol '{symbol}' has no twin here")
            values, place = _parameters(text, place)
            yield symbol, values


def _turned(symbol, values):
    """The components of vectors in the order of these axes."""
    size = 3 if symbol == "@R" and len(values or ()) == 3 else _VECTORS.get(symbol)
    if size is None:
        return values
    if len(values or ()) != size:
        raise Unknown(f"'{symbol}' with another number of parameters than {size}")
    return [values[i - i % 3 + (i + 1) % 3] for i in range(size)]


def _parameters(text, place):
    if not text.startswith("(", place):
        return None, place
    depth, begin, values = 0, place + 1, []
    for i in range(place, len(text)):
        depth += (text[i] in "([") - (text[i] in ")]")
        if (text[i] == "," and depth == 1) or depth == 0:
            values.append(text[begin:i].strip())
            begin = i + 1
        if depth == 0:
            return [value for value in values if value], i + 1
    raise Unknown("a parenthesis is not closed")
