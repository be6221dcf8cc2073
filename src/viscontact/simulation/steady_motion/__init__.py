"""Contacts of bodies in steady motion: one contact for each speed, without steps in time."""
