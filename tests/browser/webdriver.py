"""A browser driven over the WebDriver protocol (W3C) with nothing but Python's standard library."""
import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request


def missing():
    """The programs that are not installed."""
    return [name for name in ("chromium", "chromedriver") if not shutil.which(name)]


class Browser:
    """Headless Chromium in a profile of its own, WebGL in software. Use as a context manager."""

    ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of an element reference, fixed by the standard

    def __init__(self, width=1100, height=1500):
        self.width, self.height = width, height

    def __enter__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.profile = tempfile.TemporaryDirectory(prefix="snug-browser-", ignore_cleanup_errors=True)
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.root = f"http://127.0.0.1:{port}"
        try:
            self._wait_for_driver()
            self.session = ""
            options = {
                "args": ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                         "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--disable-background-networking",
                         f"--user-data-dir={self.profile.name}", f"--window-size={self.width},{self.height}"],
            }
            wanted = {"browserName": "chrome", "goog:chromeOptions": options,
                      "goog:loggingPrefs": {"performance": "ALL", "browser": "ALL"}}
            answer = self._call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
            self.session = "/session/" + answer["sessionId"]
        except BaseException:
            self._stop_driver()
            raise
        return self

    def __exit__(self, *error):
        try:
            self._call("DELETE", self.session)
        finally:
            self._stop_driver()

    def _stop_driver(self):
        self.driver.terminate()
        self.driver.wait(10)
        self.profile.cleanup()

    def _wait_for_driver(self):
        for _ in range(300):
            try:
                if self._call("GET", "/status")["ready"]:
                    return
            except (urllib.error.URLError, ConnectionError):
                time.sleep(0.1)
        raise RuntimeError("chromedriver does not answer")

    def _call(self, method, path, body=None):
        data = json.dumps(body or {}).encode() if method == "POST" else None
        request = urllib.request.Request(self.root + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def open(self, url):
        self._call("POST", self.session + "/url", {"url": url})

    def run(self, script, *arguments):
        """What a script returns that runs in the page."""
        return self._call("POST", self.session + "/execute/sync", {"script": script, "args": list(arguments)})

    def log(self, kind):
        """Entries since the last call: "performance" (network and more), "browser" (console)."""
        return self._call("POST", self.session + "/se/log", {"type": kind})

    def requests(self):
        """Addresses asked for since the last call."""
        messages = (json.loads(entry["message"])["message"] for entry in self.log("performance"))
        return [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]

    def find(self, selector):
        return self._call("POST", self.session + "/element", {"using": "css selector", "value": selector})[self.ELEMENT]

    def show(self, selector):
        """Scrolls an element to the middle of the window and gives its reference."""
        element = {self.ELEMENT: self.find(selector)}
        self.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", element)
        return element

    def click_at(self, selector, x, y):
        """Presses and releases the left button at (x, y) pixels from the middle of an element."""
        origin = self.show(selector)
        steps = [{"type": "pointerMove", "duration": 0, "origin": origin, "x": x, "y": y},
                 {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]
        self._call("POST", self.session + "/actions", {"actions": [
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": steps}]})

    def click(self, selector):
        self._call("POST", f"{self.session}/element/{self.find(selector)}/click")

    def write(self, selector, text):
        self._call("POST", f"{self.session}/element/{self.find(selector)}/value", {"text": text})

    def screenshot(self, file, selector=None):
        path = f"/element/{self.show(selector)[self.ELEMENT]}/screenshot" if selector else "/screenshot"
        with open(file, "wb") as out:
            out.write(base64.b64decode(self._call("GET", self.session + path)))
