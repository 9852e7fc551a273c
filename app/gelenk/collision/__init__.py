"""What a robot can touch: bodies of its links and of its surroundings, contacts between them, and how far they are apart.

Map:
- `bodies`: the convex pieces that everything here is about.
"""
