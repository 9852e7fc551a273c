"""Mistakes of counting links, pairs, constraints and freedoms."""

from gelenk.language import marked

MISTAKES = {
    "ground_forgotten": marked("The ground is a link too: it counts in n, and it does not move."),
    "ground_moves": marked("The ground does not move: λ multiplies n - 1, not n."),
    "higher_pair_as_lower": marked(
        "A higher pair leaves rolling and sliding: in the plane it removes 1 freedom, not 2."
    ),
    "freedoms_for_constraints": marked("These are the freedoms f that the pairs leave; c = λ - f is what they remove."),
    "space_for_plane": marked("In the plane a body has λ = 3 freedoms, not 6."),
    "plane_for_space": marked("In space a body has λ = 6 freedoms, not 3."),
    "split_forgotten": marked("A joint where k links meet is k - 1 pairs, and not one."),
    "pair_per_link": marked("A joint where k links meet is k - 1 pairs, and not k."),
    "links_for_pairs": marked("Loops follow from L = j - n + 1; here n and j are exchanged."),
    "loops_without_one": marked("The tree that connects all links has n - 1 pairs: L = j - n + 1."),
    "pairs_in_loops": marked("These are the pairs in loops; asked are those in none."),
    "leg_counted_once": marked("This counts the links and pairs of one leg; the platform has several."),
    "platform_forgotten": marked("The platform is a link as well."),
    "idle_forgotten": marked("A bar between two spherical joints spins about itself: that freedom is idle."),
    "idle_as_mobility": marked("This is the number of idle freedoms, not what remains without them."),
    "universal_as_two": marked("A universal joint leaves 2 freedoms: it removes 4, and not 5."),
    "spherical_as_universal": marked("A spherical joint leaves 3 freedoms and removes 3; a universal one removes 4."),
}
