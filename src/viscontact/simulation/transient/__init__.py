"""The simulation: checked set-up, time stepper, observer, grid enlargement."""
