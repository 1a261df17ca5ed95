"""What small live pictures share: one module draws them in JupyterLab and in a built page."""

import json

import anywidget
import traitlets
from IPython.display import display

from suspension.explorer.still import RUN_NOTEBOOK, picture, still_image

__all__ = ["LABORATORY", "Instrument"]

LABORATORY = "suspension-laboratory"  # the class of every box of the laboratory in a page


class Instrument(anywidget.AnyWidget):
    """A live picture with a still one for readers without scripts, and for paper.

    Whoever inherits sets `_esm` and `_css`, and says what follows here.
    """

    facts = traitlets.Dict().tag(sync=True)

    kind = ""  # the classes of its box in a page
    to = "use it"  # what one runs the notebook for
    alt = ""  # of the still picture

    def _draw(self):
        """The still picture as SVG; none where nothing is to be seen without scripts."""
        return ""

    def _state(self):
        """What the page's script gets as JSON."""
        return {"facts": self.facts}

    def html(self):
        """The instrument as HTML; a script of the page brings it to life."""
        return self._html(self._draw())

    def _html(self, drawn, below=""):
        text = json.dumps(self._state(), separators=(",", ":")).replace("<", "\\u003c")
        still = still_image(drawn, self.alt) + below if drawn else ""
        return (
            f'<div class="{self.kind}">'
            f'<div class="se-place">{still}</div>'
            f'<script type="application/json" class="se-state">{text}</script></div>'
        )

    def _ipython_display_(self):
        drawn = self._draw()
        page = {"text/html": self._html(drawn, RUN_NOTEBOOK.replace("drive it", self.to))}
        if drawn:  # a page has the first, a notebook that was not run the second
            page["image/svg+xml"] = picture(drawn, self.to)
        display(page, raw=True)
        # Nothing as HTML: a page, or a notebook that is not trusted, has the first display.
        widget, metadata = super()._repr_mimebundle_()
        display(widget | {"text/html": ""}, raw=True, metadata=metadata)
