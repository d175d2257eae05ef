"""`lavalight serve`: renders for whoever asks over HTTP. docs/serve.md is its manual.

Requests pass these files in turn:

    _connection.py  a client's connection, as long as it says something
    _guard.py       who may ask: Host, Origin, token; how much a request may send, and how slowly
    _app.py         which address does what
    _drake.py       POST /render of Drake's glTF client
    _preview.py     POST /render in JSON, with pictures on the way
    _scenes.py      uploads that are kept for a while
    _renders.py     the queue, and who has gone

Starlette and uvicorn come with the extra `lavalight[serve]`; nothing here is imported before the command runs.
"""

from ._command import main

__all__ = ["main"]
