from .display import display_html, display_text

__all__ = ["display_html", "display_text"]
