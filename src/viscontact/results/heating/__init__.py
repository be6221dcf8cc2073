"""Self-heating of rolling bodies: heat balances from a curve over speed."""
