"""What notebooks and terminals show of nouns and results: small drawings and tables.

Nouns ask for it by themselves (`viscontact.display`). Drawings are SVG written by hand, so that
they need no plotting library, take the colours of the page around them, and stay small.
"""

from viscontact.notebook.cards import noun_html, noun_text

__all__ = ["noun_html", "noun_text"]
