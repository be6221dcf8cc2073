"""What figures show, decided once for all renderers."""
