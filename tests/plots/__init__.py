"""Pictures, by what is drawn and by their bytes."""
