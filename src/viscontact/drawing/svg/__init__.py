"""Display of objects and results in notebooks and terminals: small drawings and tables.

Objects call it by themselves (`viscontact.units.display`). Drawings are SVG written by hand, so
that they need no plotting library, take the colours of the page around them, and stay small.
"""

from viscontact.drawing.svg.display import display_html, display_text

__all__ = ["display_html", "display_text"]
