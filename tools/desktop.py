"""A desktop in memory for windows that scripts work: Xvfb with the window manager openbox, and xdotool as its hands."""
import os
import shutil
import subprocess
import sys
import time


class Desktop:
    """Started when it is made; `environment` is what a program needs to open its window there."""

    def __init__(self, size="1280x800", environment=None):
        missing = [tool for tool in ("Xvfb", "openbox", "xdotool") if shutil.which(tool) is None]
        if missing:
            sys.exit(f"cannot start a desktop: {', '.join(missing)} is missing; tools/setup installs it")
        read, write = os.pipe()
        # Without -noreset the server starts again whenever its last client leaves, and manage(), coming and going to see
        # whether openbox is there, would end one that is still starting.
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size}x24", "-noreset"],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            self.environment = {**os.environ, "DISPLAY": f":{int(answer.readline())}", **(environment or {})}
        self.manager = None
        self.manage()

    def manage(self):
        """Starts openbox, where it does not run."""
        if self.manager is not None:
            if self.manager.poll() is None:
                return
            print(f"openbox had ended with {self.manager.returncode}", flush=True)
        self.manager = subprocess.Popen(["openbox", "--sm-disable"], env=self.environment, stderr=subprocess.DEVNULL)
        start = time.monotonic()
        while not self.do("get_num_desktops"):  # a window that is shown before may never be mapped
            if time.monotonic() - start > 30:
                sys.exit("cannot start a desktop: openbox does not come up")
            time.sleep(0.1)

    def do(self, *words):
        """xdotool; its failures are the caller's to explain: a window that is gone, or never comes."""
        try:
            return subprocess.run(["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True,
                                  timeout=30).stdout.strip()
        except subprocess.TimeoutExpired:
            return ""

    def window_of(self, process):
        """The number of Lavalight's window once it is shown; nothing where the process has ended before."""
        window = ""
        while not window and process.poll() is None:
            window = self.do("search", "--onlyvisible", "--name", "^Lavalight").split("\n")[0]
            time.sleep(0.1)
        return window

    def close(self):
        for process in (self.manager, self.server):
            process.terminate()
            process.wait()
