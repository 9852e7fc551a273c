"""The exercises of each lecture: a module, or a folder of modules if that would be long; `EXERCISES` holds them."""
