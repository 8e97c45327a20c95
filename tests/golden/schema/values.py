"""Good and bad values of a field as `dsc plugin describe --format json` declares it."""

import math

LISTS = {"vector of 3 reals": "real", "list of integers": "integer", "list of reals": "real", "list of strings": "string"}


class Values:
    def __init__(self, random, strategies):
        self.random = random
        self.strategies = strategies  # {kind: {id: description}}
        self.complete = False  # leave nothing out
        self.end = None  # "minimum" or "maximum": take this end of every range that has it

    # ---- good ones ----------------------------------------------------------------------------------------------

    def good(self, field):
        """One value, now and then the end of a range, a variable or null."""
        if field["optional"] and not self.complete and self.random.random() < 0.2:
            return None
        kind = field["type"]
        if kind in LISTS:
            return [self._good_item(field, LISTS[kind]) for _ in range(self._size(field))]
        if kind == "map":
            return self.good_map(field)
        if kind == "list of maps":
            return [self.good_map(field) for _ in range(self._size(field))]
        if kind == "strategy":
            return self.good_strategy(field["kind"])
        if kind == "list of strategies":
            return [self.good_strategy(field["kind"]) for _ in range(self._size(field))]
        return self._good_item(field, kind)

    def good_map(self, owner):
        """Everything required and, one by one, what is not."""
        return {f["name"]: self.good(f) for f in fields_of(owner)
                if f["required"] or needs_value(f) or self.complete or self.random.random() < 0.7}

    def good_strategy(self, kind, name=None):
        known = self.strategies[kind]
        name = name or self.random.choice(sorted(known))
        return {"type": name, **self.good_map(known[name])}

    def _size(self, field):
        if field["type"] == "vector of 3 reals":
            return 3
        least = field.get("min_size", 0)
        return self.random.randint(max(least, 1) if self.complete else least, field.get("max_size", least + 2))

    def _good_item(self, field, kind):
        if kind == "boolean":
            return self.random.choice([True, False])
        if kind in ("integer", "real"):
            return self._good_number(field, kind)
        if field.get("choices"):
            return self.random.choice(field["choices"])
        if kind == "file":
            return self._file(field)
        numbers = [7] if "or_integers" in field.get("tags", []) else []
        return self.random.choice(["text", "12", "true", "with: colon", "", "${DSC_TEST_TEXT}", *numbers])

    def _file(self, field):
        extension = self.random.choice(field.get("extensions", [".any"]))
        if self.random.random() < 0.3:
            extension = extension.upper()
        return self.random.choice([f"file{extension}", f"${{DSC_TEST_TEXT}}/file{extension}"])

    def _good_number(self, field, kind):
        low, high = field.get("minimum"), field.get("maximum")
        if self.end and field.get(self.end) and not field[self.end]["open"]:
            return int(field[self.end]["value"]) if kind == "integer" else field[self.end]["value"]
        ends = [end["value"] for end in (low, high) if end and not end["open"]]
        if ends and self.random.random() < 0.4:
            value = self.random.choice(ends)
            return int(value) if kind == "integer" else value
        begin = low["value"] if low else -100.0 if kind == "real" else 0
        end = high["value"] if high else begin + 100
        if kind == "integer":
            begin += 1 if low and low["open"] else 0
            end -= 1 if high and high["open"] else 0
            value = self.random.randint(math.ceil(begin), math.floor(end))
            # Beyond 2^53 the program takes no number with a point for an integer.
            return self.random.choice([value, float(value)]) if abs(value) < 2**53 else value
        value = begin + (end - begin) * self.random.uniform(0.01, 0.99)
        return value if value != int(value) else self.random.choice([int(value), value])

    # ---- bad ones -----------------------------------------------------------------------------------------------

    def bad(self, field):
        """(path below the field, value of the field) for every way of being wrong; `path` is where the fault is."""
        kind = field["type"]
        if not field["optional"] and kind != "map":
            yield (), None
        if kind in LISTS:
            yield from self._bad_lists(field)
        elif kind == "map":
            yield from (((), value) for value in (3, "text", [1]))
        elif kind == "list of maps":
            yield from (((), value) for value in (3, "text", {"a": 1}))
            yield (0,), [3] + [self.good_map(field)] * (field.get("min_size", 1) - 1)
            yield from self._bad_sizes(field, lambda: self.good_map(field))
        elif kind == "strategy":
            yield from (((), value) for value in (3, "text", [{"type": sorted(self.strategies[field["kind"]])[0]}]))
            yield ("type",), {"type": "no_such_strategy"}
            yield ("type",), {"type": 3}
        elif kind == "list of strategies":
            yield from (((), value) for value in (3, "text", {"type": sorted(self.strategies[field["kind"]])[0]}))
            yield (0, "type"), [{"type": "no_such_strategy"}]
            yield (0,), [3]
        else:
            yield from (((), value) for value in self._bad_items(field, kind))

    def _bad_items(self, field, kind):
        if kind == "boolean":
            yield from ("yes", "true", 1, [True], {"a": True})
        elif kind in ("integer", "real"):
            yield from ("3", "fast", True, [3], {"a": 3})
            if kind == "integer":
                yield from (2.5, "${DSC_TEST_NUMBER}")
            yield from self._outside(field, kind)
        elif field.get("choices"):
            yield from (field["choices"][0] + "x", field["choices"][0].upper(), 3, True, [field["choices"][0]])
        else:
            yield from (2.5, False, ["text"], {"a": "text"})
            if "or_integers" not in field.get("tags", []):
                yield 3
            if kind == "file":
                yield from (["file.bad"] if field.get("extensions") else []) + ([""] if field["default"] != "" else [])

    def _outside(self, field, kind):
        far = self.random.choice([1, 10, 1e6])
        for end, sign in (("minimum", -1), ("maximum", 1)):
            bound = field.get(end)
            if not bound:
                continue
            value = int(bound["value"]) if kind == "integer" else bound["value"]
            yield value + sign * (int(far) if kind == "integer" else far)
            if bound["open"]:
                yield value
            elif kind == "real":
                yield value + sign * max(abs(value), 1.0) * 1e-9

    def _bad_lists(self, field):
        item = LISTS[field["type"]]
        yield from (((), value) for value in (3, "text", {"a": 1}, True))
        good = [self._good_item(field, item) for _ in range(max(self._size(field), 1))]
        for value in self._bad_items(field, item):
            at = self.random.randrange(len(good))
            yield (at,), good[:at] + [value] + good[at + 1:]
        yield from self._bad_sizes(field, lambda: self._good_item(field, item))

    @staticmethod
    def _bad_sizes(field, make):
        least, most = field.get("min_size", 0), field.get("max_size")
        if field["type"] == "vector of 3 reals":
            least = most = 3
        if least > 0:
            yield (), [make() for _ in range(least - 1)]
        if most is not None:
            yield (), [make() for _ in range(most + 1)]


def fields_of(owner):
    """Of a strategy, a map or a list of maps."""
    return owner.get("fields", owner.get("parameters", []))


def needs_value(field):
    """A map that lacks something where it is left out."""
    if field["type"] != "map" or field["optional"]:
        return False
    return any(f["required"] or needs_value(f) for f in field["fields"])


def fields_of_schema(schema):
    """The fields of a map in a JSON Schema, in the form of `describe`: for the experiment itself, which is not a strategy."""
    names = {"boolean": "boolean", "integer": "integer", "number": "real", "string": "string", "object": "map"}
    fields = []
    for name, value in schema["properties"].items():
        types = value.get("type", "string")
        types = types if isinstance(types, list) else [types]
        reference = next((part["$ref"] for part in value.get("allOf", []) if "$ref" in part), None)
        field = {"name": name, "optional": "null" in types, "required": False, "default": value.get("default")}
        if types[0] == "array":
            items = value["items"]
            inner = next((part["$ref"] for part in items.get("allOf", []) if "$ref" in part), None)
            if inner:
                field.update(type="list of strategies", kind=inner.rsplit("/", 1)[1])
            elif "anyOf" in items:  # a text, or a map with one key that holds the text
                (key,) = items["anyOf"][1]["properties"]
                field.update(type="list of strings", tags=[f"or_keyed {key}"])
            elif items.get("type") == "object":
                field.update(type="list of maps", fields=fields_of_schema(items))
            elif items["type"] == ["string", "integer"]:
                field.update(type="list of strings", tags=["or_integers"])
            else:
                field.update(type={"string": "list of strings", "integer": "list of integers", "number": "list of reals"}[items["type"]])
            for key, size in (("min_size", "minItems"), ("max_size", "maxItems")):
                if size in value:
                    field[key] = value[size]
            value = {**items, **value}
        elif reference:
            field.update(type="strategy", kind=reference.rsplit("/", 1)[1])
        else:
            field["type"] = names[types[0]]
            if types[0] == "object":
                field["fields"] = fields_of_schema(value)
        if "minLength" in value:
            field["type"] = "file"
        if "else" in value:
            field["choices"] = [choice for choice in value["else"]["enum"] if choice is not None]
            field["optional"] = None in value["else"]["enum"]
        for key, word in (("minimum", "inimum"), ("maximum", "aximum")):
            for keyword, is_open in ((f"{key[0]}{word}", False), (f"exclusive{key[0].upper()}{word}", True)):
                if keyword in value:
                    field[key] = {"value": value[keyword], "open": is_open}
        fields.append(field)
    return fields
