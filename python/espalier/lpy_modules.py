"""Modules of L-Py's strings, written in the language of Espalier."""

from .lpy_expressions import Unknown, expression

# Names that L-Py's turtle has beside the symbols.
_LONG = {
    "TurnAround": "|", "SetColor": ";", "RollL": "/", "RollR": "\\", "Right": "-", "Left": "+", "Down": "&", "Up": "^",
    "SetWidth": "_", "SB": "[", "EB": "]", "BP": "{", "EP": "}",
}  # fmt: skip
_PAIRS = ("@O", "@o", "@c", "@v", "@R", "@M", "~")
_NAMED = set("Ff+-&^/\\|[]{}._!;,%") | set(_PAIRS)
_TURNS = set("+-&^/\\")
_DOUBLED = {"_": "!", "!": "!", "@O": "@O", "@o": "@o", "@c": "@c"}  # radii there, widths and diameters here


class Modules:
    """Reads modules; remembers the numbers of parameters of those with names, which must be declared."""

    def __init__(self):
        self.declared = {}

    def declare(self, name):
        self.declared.setdefault(name, set())

    def pattern(self, text):
        """Modules of a predecessor or context: the text here, and the names of their parameters."""
        written, names = [], []
        for symbol, values in self._split(text):
            if symbol in _DOUBLED:
                raise Unknown(f"'{symbol}' in a predecessor: its parameter is a radius there and a width here")
            for value in values or ():
                if not value.isidentifier():
                    raise Unknown(f"the parameter '{value}' of a predecessor is no name")
                names.append(value)
            written.append(self._write(symbol, values))
        return "".join(written), names

    def successor(self, text, names):
        """Modules of a successor or axiom, whose parameters are expressions in `names`."""
        written = "".join(self._write(*self._same_sizes(symbol, values, names)) for symbol, values in self._split(text))
        return written or "*"

    def symbols(self, text):
        """Those of ignore: and consider:."""
        return " ".join(self._here(symbol) for symbol, _ in self._split(text))

    def _same_sizes(self, symbol, values, names):
        values = None if values is None else [expression(value, names) for value in values]
        if symbol == "F" and values and len(values) > 1:
            raise Unknown("'F' with a radius at its tip: write _(radius)F(length)")
        if symbol in _TURNS and not values:
            return symbol, ["60"]  # L-Py's default angle
        if symbol in _DOUBLED:
            if values:
                return _DOUBLED[symbol], [f"2 * {values[0]}"]
            return {"_": "#"}.get(symbol, symbol), values
        return symbol, values

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
        known = sorted([*self.declared, *_LONG, *_PAIRS], key=len, reverse=True)
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
            elif not (symbol in self.declared or symbol in _NAMED or symbol in "$" or symbol.isalnum()):
                raise Unknown(f"the symbol '{symbol}' has no twin here")
            values, place = _parameters(text, place)
            yield symbol, values


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
