"""Tests of the operations without HTTP."""
