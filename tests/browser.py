# SPDX-License-Identifier: GPL-3.0-or-later
"""A page in a headless Chromium: at any width, its errors, its screenshot."""

import base64
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from voussoir.chromium import Chromium, find_browser  # noqa: E402  pylint: disable=unused-import


class Browser(Chromium):
    """with Browser() as browser: browser.open(path, width=390) ..."""

    options = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")  # WebGL without a graphics card
    hosts = Chromium.hosts + ", EXCLUDE 127.0.0.1"  # a server of the test

    def open(self, page, width, height=844):
        """Loads a file, or an address, in a window of this width, in CSS pixels."""
        self.events = []
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Page.navigate", url=page if isinstance(page, str) else page.resolve().as_uri())
        self.wait_for_load()

    def value(self, expression):
        """Of JavaScript in the page."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(str(result["exceptionDetails"]))
        return result["result"].get("value")

    def complaints(self):
        """What the page wrote to its console as an error or a warning, exceptions, and addresses it asked the network for."""
        found = []
        for event in self.events:
            method, what = event.get("method"), event.get("params", {})
            if method == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
                if "GL Driver Message (OpenGL, Performance" not in what["entry"]["text"]:  # of screenshots
                    found.append(what["entry"]["text"])
            elif method == "Runtime.exceptionThrown" or method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning"):
                found.append(json.dumps(what)[:300])
            elif method == "Network.requestWillBeSent" and not what["request"]["url"].startswith(("file:", "data:", "about:")):
                found.append("asks for " + what["request"]["url"])
        return found

    def screenshot(self, path):
        """Of the whole page."""
        data = self.call("Page.captureScreenshot", captureBeyondViewport=True, format="png")["data"]
        path.write_bytes(base64.b64decode(data))
