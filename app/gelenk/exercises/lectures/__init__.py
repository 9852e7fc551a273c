"""The exercises of each lecture, one module each; `EXERCISES` holds them."""
