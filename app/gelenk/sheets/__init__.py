"""Homework: sheets of exercises, each participant with numbers of their own, and the grades of a file of answers.

- `homework`: who gets which variants; a secret decides the numbers, and nothing is kept.
  `bounds`: how many.
- `document`: the sheets and the booklet of solutions as pages; `pdf`: printed by Chromium.
- `normal_form`: answers in the one form that a comparison of numbers takes.
- `moodle`: questions for Moodle. `prairielearn`: questions for PrairieLearn.
- `key`: the right answers as a table in CSV; `grades`: what a table of answers earns.
- `bundle`: all of these in one file.
"""
