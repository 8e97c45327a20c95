"""A browser to look at pages with: Chromium by the WebDriver protocol, and the pixels of its screenshots. Standard library only."""

import base64
import json
import re
import shutil
import struct
import subprocess
import tempfile
import urllib.error
import urllib.request
import zlib

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the protocol's name of an element


def missing():
    """The programs that are not here."""
    return [name for names in (("chromium", "chromium-browser", "google-chrome"), ("chromedriver",))
            if not any(map(shutil.which, names)) for name in names[:1]]


class Browser:
    def __init__(self, *flags, size=(1100, 900)):
        self.profile = tempfile.TemporaryDirectory(prefix="dsc-browser-")
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.port = None
        for line in self.driver.stdout:
            found = re.search(r"started successfully on port (\d+)", line)
            if found:
                self.port = int(found.group(1))
                break
        if self.port is None:
            raise RuntimeError("chromedriver did not start")
        program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
        arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--user-data-dir={self.profile.name}",
                     f"--window-size={size[0]},{size[1]}", "--hide-scrollbars", *(flags or software_webgl())]
        capabilities = {"browserName": "chrome", "goog:loggingPrefs": {"browser": "ALL"},
                        "goog:chromeOptions": {"binary": program, "args": arguments}}
        self.session = ""
        self.session = "/" + self.call("POST", "session", {"capabilities": {"alwaysMatch": capabilities}}, whole=True)["sessionId"]

    def call(self, method, path, body=None, whole=False):
        address = f"http://127.0.0.1:{self.port}/" + (path if whole else f"session{self.session}/{path}".rstrip("/"))
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(address, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{method} {path}: {error.read().decode(errors='replace')[:500]}") from error

    def close(self):
        try:
            self.call("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()
            self.driver.stdout.close()
            self.profile.cleanup()

    def open(self, address):
        self.call("POST", "url", {"url": address})

    def script(self, text, *arguments):
        return self.call("POST", "execute/sync", {"script": text, "args": list(arguments)})

    def console(self):
        """What the page has said since the last call; slow software drawing is not reported."""
        entries = self.call("POST", "se/log", {"type": "browser"})
        return [entry["message"] for entry in entries if "GL Driver Message (OpenGL, Performance" not in entry["message"]]

    def find(self, selector):
        return self.call("POST", "element", {"using": "css selector", "value": selector})[ELEMENT]

    def shot(self, selector):
        """A picture of an element, brought into view first: what is not in view is not in the picture."""
        self.script("document.querySelector(arguments[0]).scrollIntoView({block: 'center'})", selector)
        return Picture(base64.b64decode(self.call("GET", f"element/{self.find(selector)}/screenshot")))

    def page_shot(self):
        """The whole page as a PNG."""
        command = {"cmd": "Page.captureScreenshot", "params": {"captureBeyondViewport": True}}
        return base64.b64decode(self.call("POST", "goog/cdp/execute", command)["data"])

    def press(self, selector, keys):
        """Keys on the keyboard while the element has the focus."""
        self.call("POST", f"element/{self.find(selector)}/value", {"text": keys})

    def print_pdf(self):
        return base64.b64decode(self.call("POST", "print", {}))

    def drag(self, selector, dx, dy):
        pointer = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [
            {"type": "pointerMove", "duration": 0, "origin": {ELEMENT: self.find(selector)}, "x": 0, "y": 0},
            {"type": "pointerDown", "button": 0}, {"type": "pointerMove", "duration": 50, "origin": "pointer", "x": dx, "y": dy},
            {"type": "pointerUp", "button": 0}]}
        self.call("POST", "actions", {"actions": [pointer]})


def software_webgl():
    return ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


class Picture:
    """An 8-bit RGB or RGBA PNG as rows of bytes."""

    def __init__(self, png):
        self.png = png
        at, packed, header = 8, b"", None
        while at < len(png):
            size, kind = struct.unpack(">I4s", png[at:at + 8])
            if kind == b"IHDR":
                header = struct.unpack(">IIBBBBB", png[at + 8:at + 21])
            elif kind == b"IDAT":
                packed += png[at + 8:at + 8 + size]
            at += 12 + size
        self.width, self.height, depth, colour = header[:4]
        assert depth == 8 and colour in (2, 6) and header[6] == 0, header
        self.channels = 3 if colour == 2 else 4
        self.rows = self.unfilter(zlib.decompress(packed))

    def unfilter(self, data):
        n, length, rows, before = self.channels, self.width * self.channels, [], bytes(self.width * self.channels)
        for y in range(self.height):
            kind, row = data[y * (length + 1)], bytearray(data[y * (length + 1) + 1:(y + 1) * (length + 1)])
            for i in range(length):
                a, b, c = (row[i - n] if i >= n else 0), before[i], (before[i - n] if i >= n else 0)
                if kind == 1:
                    row[i] = (row[i] + a) & 255
                elif kind == 2:
                    row[i] = (row[i] + b) & 255
                elif kind == 3:
                    row[i] = (row[i] + (a + b) // 2) & 255
                elif kind == 4:
                    p = a + b - c
                    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                    row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
            rows.append(bytes(row))
            before = row
        return rows

    def pixels(self, width=None, height=None):
        n = self.channels
        return [row[i:i + 3] for row in self.rows[:height] for i in range(0, (width or self.width) * n, n)]

    def colours(self):
        return len(set(self.pixels()))

    def difference(self, other):
        """Part of the pixels that differ by more than a shade; elements side by side may be a pixel apart in size."""
        assert abs(self.width - other.width) < 3 and abs(self.height - other.height) < 3, "pictures of different sizes"
        width, height = min(self.width, other.width), min(self.height, other.height)
        mine, theirs = self.pixels(width, height), other.pixels(width, height)
        return sum(max(abs(a - b) for a, b in zip(p, q)) > 8 for p, q in zip(mine, theirs)) / len(mine)

    def covered(self):
        """Part of the pixels that are not the colour of the upper left corner's surroundings."""
        pixels = self.pixels()
        ground = pixels[self.width * 12 + 12]
        return sum(max(abs(a - b) for a, b in zip(p, ground)) > 8 for p in pixels) / len(pixels)
