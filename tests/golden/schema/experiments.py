"""Experiments as Python values: read as dsc reads YAML, written with the line of every value."""

import json
import re

import yaml


# The loader in C, where PyYAML was built with it, is several times faster.
class JsonLikeLoader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # pylint: disable=too-many-ancestors
    """PyYAML with the scalars of dsc: true, false, null and numbers as JSON has them; all else is text.

    YAML 1.1, which PyYAML reads, takes 1e3 for text, 012 for ten, yes for true and 1:30 for ninety.
    """


JsonLikeLoader.yaml_implicit_resolvers = {}
JsonLikeLoader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(true|false)$"), list("tf"))
JsonLikeLoader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile(r"^(~|null|Null|NULL|)$"), ["~", "n", "N", ""])
JsonLikeLoader.add_implicit_resolver("tag:dsc,int", re.compile(r"^-?(0|[1-9][0-9]*)$"), list("-0123456789"))
JsonLikeLoader.add_implicit_resolver(
    "tag:dsc,float", re.compile(r"^-?(0|[1-9][0-9]*)(\.[0-9]+([eE][+-]?[0-9]+)?|[eE][+-]?[0-9]+)$"), list("-0123456789"))
JsonLikeLoader.add_constructor("tag:dsc,int", lambda loader, node: int(loader.construct_scalar(node)))
JsonLikeLoader.add_constructor("tag:dsc,float", lambda loader, node: float(loader.construct_scalar(node)))


def read(text):
    return yaml.load(text, Loader=JsonLikeLoader)  # a SafeLoader


class Written:
    """The YAML of a tree, and for every path (a tuple of keys and indices) its first and last line."""

    def __init__(self, tree):
        self.lines = []
        self.places = {}
        self._map(tree, "", ())
        self.text = "\n".join(self.lines) + "\n"

    def _map(self, tree, indent, path, lead=None):
        for key, value in tree.items():
            self._value(f"{indent if lead is None else lead}{key}:", value, indent, path + (key,))
            lead = None

    def _value(self, start, value, indent, path):
        first = len(self.lines) + 1
        if isinstance(value, dict) and value:
            self.lines.append(start)
            self._map(value, indent + "  ", path)
        elif isinstance(value, list) and value and all(isinstance(item, dict) and item for item in value):
            self.lines.append(start)
            for number, item in enumerate(value):
                begin = len(self.lines) + 1
                self._map(item, indent + "    ", path + (number,), lead=indent + "  - ")
                self.places[path + (number,)] = (begin, len(self.lines))
        else:
            self.lines.append(f"{start} {json.dumps(value)}")
        self.places[path] = (first, len(self.lines))

    def place(self, path):
        """Of the path, or of what it is in where it stands on a line with it or is missing."""
        while path and path not in self.places:
            path = path[:-1]
        return self.places.get(path, (1, len(self.lines)))
