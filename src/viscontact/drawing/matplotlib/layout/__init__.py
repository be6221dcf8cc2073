"""Page, style, axes, labels and files of figures."""
