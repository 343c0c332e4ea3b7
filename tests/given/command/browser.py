"""Chromium without a window, spoken to through its DevTools: what a page does with a person."""

import json
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.request import urlopen

from websockets.sync.client import ClientConnection, connect

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
WAIT = 20.0  # s: for a browser to come up, or for something to become true, on a busy machine
ERRORS = ("Runtime.exceptionThrown", "Log.entryAdded")


def found() -> str | None:
    """The browser of this machine."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


@contextmanager
def browser(folder: Path) -> Iterator["Tab"]:
    """One tab of it, with a profile in the folder; the browser ends with the block."""
    program = found()
    assert program
    words = [program, "--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0"]
    words += [f"--user-data-dir={folder}", "--no-first-run", "about:blank"]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert process.stderr
            told = next(line for line in process.stderr if "DevTools listening on" in line)
            port = told.rpartition("ws://")[2].split("/")[0]
            with connect(_tab(port), max_size=None) as socket:
                yield Tab(socket)
        finally:
            process.terminate()


def _tab(address: str) -> str:
    until = time.monotonic() + WAIT
    while time.monotonic() < until:
        with urlopen(f"http://{address}/json") as answer:
            tabs = [tab for tab in json.load(answer) if tab["type"] == "page"]
        if tabs:
            return tabs[0]["webSocketDebuggerUrl"]
        time.sleep(0.05)
    raise TimeoutError("the browser opens no tab")


class Tab:
    """A tab, and what it said: errors, and the addresses it asked for."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket, self.asked = socket, 0
        self.errors: list[str] = []
        self.requests: list[str] = []
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **words: Any) -> dict[str, Any]:
        """One command; what the browser says meanwhile is noted."""
        self.asked += 1
        self.socket.send(json.dumps({"id": self.asked, "method": method, "params": words}))
        while True:
            said = json.loads(self.socket.recv(timeout=WAIT))
            self._noted(said)
            if said.get("id") == self.asked:
                assert "error" not in said, said
                return said["result"]

    def _noted(self, said: dict[str, Any]) -> None:
        method, words = said.get("method"), said.get("params", {})
        if method in ERRORS:
            self.errors.append(json.dumps(words))
        if method == "Runtime.consoleAPICalled" and words["type"] in ("error", "warning", "assert"):
            self.errors.append(json.dumps(words))
        if method == "Network.requestWillBeSent":
            self.requests.append(words["request"]["url"])

    def open(self, address: str, *, width: int = 1200, height: int = 900, **media: str) -> None:
        """Anew, at a size, with media features as `prefers_color_scheme`."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)  # fmt: skip
        features = [{"name": k.replace("_", "-"), "value": v} for k, v in media.items()]
        self.call("Emulation.setEmulatedMedia", features=features)
        self.call("Page.navigate", url="about:blank")  # another place in the page is no new page
        self.call("Page.navigate", url=address)
        self.until("document.readyState === 'complete'")

    def ask(self, script: str) -> Any:
        """The value of an expression; what it throws is raised."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def until(self, script: str) -> None:
        """Waits until the expression holds. Raises TimeoutError."""
        end = time.monotonic() + WAIT
        while not self.ask(f"Boolean({script})"):
            if time.monotonic() > end:
                raise TimeoutError(script)
            time.sleep(0.05)

    def press(self, key: str) -> None:
        """A key, as a person without a mouse does: `Tab`, `Enter`, an arrow."""
        code = {"Tab": 9, "Enter": 13, "ArrowRight": 39, "ArrowDown": 40}[key]
        text = {"Enter": "\r"}.get(key)
        for kind in ("keyDown", "keyUp"):
            words = {"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code}
            self.call("Input.dispatchKeyEvent", **words, **({"text": text} if text else {}))
