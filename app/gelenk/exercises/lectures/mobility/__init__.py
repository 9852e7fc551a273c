"""Links, pairs and Grübler's count.

- `linkages`: in the plane. `pairs`: their table. `chains`: open, closed, mixed. `platform`: an exam in space.
"""
