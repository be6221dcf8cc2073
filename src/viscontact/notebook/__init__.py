"""What notebooks and terminals show of nouns and results: small drawings and tables.

Nouns ask for it by themselves (`viscontact.display`). Drawings are SVG written by hand, so that
they need no plotting library, take the colours of the page around them, and stay small.
"""

from viscontact.notebook.cards import display_html, display_text

__all__ = ["display_html", "display_text"]
