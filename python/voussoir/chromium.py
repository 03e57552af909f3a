# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Chromium, controlled through a pipe by its DevTools protocol: prints a page without scripts, files and network."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
A4 = {"paperWidth": 210 / 25.4, "paperHeight": 297 / 25.4}  # inches


def find_browser():
    """The program that VOUSSOIR_BROWSER names, or the first Chromium of the PATH, or None."""
    chosen = os.environ.get("VOUSSOIR_BROWSER")
    return chosen or next((found for name in BROWSERS if (found := shutil.which(name))), None)


class Chromium:
    """One empty page: with Chromium() as chromium: chromium.call("Page.navigate", url=...). Throws OSError where it does not start."""

    hosts = "MAP * ~NOTFOUND"  # no network
    options = ()  # more of the command line

    def __enter__(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_read, self.to = os.pipe()
        self.from_, to_write = os.pipe()

        def give():  # the browser reads from 3 and writes to 4
            read, write = os.dup(to_read), os.dup(to_write)
            os.dup2(read, 3)
            os.dup2(write, 4)

        words = [find_browser(), "--headless", "--disable-gpu", "--no-first-run", "--disable-extensions", "--disable-background-networking",
                 f"--host-resolver-rules={self.hosts}", f"--user-data-dir={self.profile.name}", "--remote-debugging-pipe", *self.options, "about:blank"]
        if os.geteuid() == 0:
            words.insert(1, "--no-sandbox")  # Chromium has no sandbox for root
        self.process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        close_fds=False, preexec_fn=give)
        os.close(to_read)
        os.close(to_write)
        self.buffer, self.number, self.events, self.session = b"", 0, [], None
        try:
            target = self.call("Target.createTarget", url="about:blank")["targetId"]
            self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
            for domain in ("Page", "Log", "Runtime", "Network"):
                self.call(domain + ".enable")
        except OSError:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        os.close(self.to)
        os.close(self.from_)
        self.profile.cleanup()

    def message(self, deadline):
        """The next message of the browser. Throws OSError if it has ended or does not answer."""
        while b"\0" not in self.buffer:
            if not select.select([self.from_], [], [], max(0., deadline - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            if not (data := os.read(self.from_, 1 << 20)):
                raise ConnectionError("the browser ended")
            self.buffer += data
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, seconds=60., **parameters):
        """Returns the result of a method. Events before the result are stored."""
        self.number += 1
        words = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            words["sessionId"] = self.session
        data = json.dumps(words).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        deadline = time.monotonic() + seconds
        while True:
            message = self.message(deadline)
            if message.get("id") == self.number:
                if "error" in message:
                    raise OSError(f"{method}: {message['error'].get('message')}")
                return message["result"]
            self.events.append(message)

    def wait_for_load(self):
        """Until the page has loaded."""
        deadline = time.monotonic() + 60.
        while not any(event.get("method") == "Page.loadEventFired" for event in self.events):
            self.events.append(self.message(deadline))


def print_page(html):
    """The page as PDF, A4 with the margins of its style. It is a document without an address, so it cannot read files; its scripts do
    not run, and no network is there. Throws OSError."""
    with Chromium() as chromium:
        chromium.call("Emulation.setScriptExecutionDisabled", value=True)
        chromium.call("Network.setBlockedURLs", urls=[f"{scheme}:*" for scheme in ("file", "ftp", "http", "https", "ws", "wss")])
        frame = chromium.call("Page.getFrameTree")["frameTree"]["frame"]["id"]
        chromium.events = []
        chromium.call("Page.setDocumentContent", frameId=frame, html=html)
        chromium.wait_for_load()
        return base64.b64decode(chromium.call("Page.printToPDF", 180., printBackground=True, preferCSSPageSize=True, **A4)["data"])
