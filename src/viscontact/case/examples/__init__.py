"""Cases that come with viscontact, to copy and to change."""
