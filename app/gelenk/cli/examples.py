"""Examples for the `--help` of each command: one call that works."""

EXAMPLES = {
    "robots": "gelenk robots panda",
    "add": "gelenk add arm.urdf --name my_arm",
    "fk": "gelenk fk ur5 -q '0 -pi/2 pi/2 0 0 0' --pose rpy",
    "jacobian": "gelenk jacobian planar_2r -q '0.3 0.8'",
    "ik": "gelenk ik ur5 --to '0.4 0.2 0.5 pi 0 0' --all",
    "manipulability": "gelenk manipulability planar_2r -q '0.3 0.8' --plot ellipse.svg",
    "trajectory": "gelenk -o motion.csv trajectory planar_2r --start '0 0' --joint '0.5 0.2' --law cubic",
    "workspace": "gelenk -o points.npy workspace planar_2r --samples 10000 --plot reach.png",
    "exercises": "gelenk exercises mobility.linkage --seed 7",
    "sheet": "gelenk -o sheets.zip sheet mobility.linkage actuators.gear --class 20 --secret 'known to nobody else'",
    "grade": "gelenk grade answers.csv --secret 'known to nobody else'",
    "bench": "gelenk bench planar_2r --batch 100 --seconds 0.1",
    "ask": 'gelenk ask gear \'{"efficiency": 0.9, "ratio": 50}\'',
    "dh to-urdf": "gelenk -o arm.urdf dh to-urdf table.csv --name my_arm",
    "dh from-urdf": "gelenk -o table.csv dh from-urdf ur5 --convention modified",
    "dh convert": "gelenk dh convert table.csv --convention modified",
    "dh compare": "gelenk dh compare table.csv ur5",
    "dh derive": "gelenk dh derive table.csv --latex --plot frames.svg",
}
"""Examples by command. Commands that read files use those that other examples have written."""


def example_of(command: str) -> str | None:
    """Return the example shown below the options of a command."""
    return f"\b\nExample:\n  {EXAMPLES[command]}" if command in EXAMPLES else None
