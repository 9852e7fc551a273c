"""The studio in a real browser: Chromium without a window, driven by Playwright, against the service as a process."""
