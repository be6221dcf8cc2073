"""Materials: elastic constants and creep law, J(t), the shipped library, cards."""
