"""The request of the mobility calculator: a mechanism by its links and pairs, or a robot by name."""

from typing import Annotated, Any, Literal, TypeAlias, cast, get_args

from pydantic import Discriminator, Field, Tag, model_validator

from gelenk.contract.common import Payload, RobotName, optional
from gelenk.contract.options import Fraction, InLanguage
from gelenk.contract.pose import MAX_MAGNITUDE, Vector3
from gelenk.course.mobility.mechanism import GivenPair, Node
from gelenk.course.mobility.mobility import NodeCount
from gelenk.course.mobility.pairs import KINDS, LETTERS, PairGeometry
from gelenk.course.orientation.rotations import unit_axis
from gelenk.errors import InvalidField, listed, quoted

MAX_LINKS = 500
MAX_PAIRS = 1000
MAX_NODES = 100

Name = Annotated[str, Field(min_length=1, max_length=64, pattern=r"^[^\x00-\x1f\x7f-\x9f]+$")]
PairType: TypeAlias = Literal[
    "revolute", "prismatic", "rolling", "pin_in_slot", "cam", "gear",
    "screw", "universal", "cylindrical", "spherical", "planar", "sphere_in_groove", "point_contact", "fixed",
    "R", "P", "H", "U", "C", "S", "E",
]  # fmt: skip
PAIR_TYPE = (
    "Kind of the pair. With c in the plane (λ = 3): revolute 2, prismatic 2, rolling (without slip) 2, pin_in_slot 1, "
    "cam 1, gear 1, fixed 3. In space (λ = 6): revolute 5, prismatic 5, screw 5, universal 4, cylindrical 4, "
    "spherical 3, planar 3, sphere_in_groove 2, point_contact 1, fixed 6. The letters R P H U C S E stand for "
    "revolute, prismatic, screw, universal, cylindrical, spherical, planar."
)
assert set(get_args(PairType)) == {*KINDS, *LETTERS}  # noqa: S101 - the core's table is the truth


def _shape(value: Any) -> str:
    if isinstance(value, dict):
        return "<object>"
    if isinstance(value, list):
        return "<list>"
    return "<text>" if isinstance(value, str) else "<number>"


class MechanismLinkPayload(Payload):
    """A link, perhaps the ground."""

    name: Name = Field(description="Unique in the mechanism.")
    ground: bool = Field(default=False, description="Whether it is at rest.")


class PairPayload(Payload):
    """A kinematic pair: two links that touch."""

    name: Name | None = optional("Unique in the mechanism; `pair_1`, `pair_2`, … if left out.")
    link_a: Name = Field(description="The one link.")
    link_b: Name = Field(description="The other one.")
    type: PairType = Field(description=PAIR_TYPE)
    joint: Name | None = optional(
        "The joint it is part of. Links whose pairs name the same joint meet there: k links, k - 1 pairs."
    )
    point: Vector3 | None = optional(
        "Its location in the given posture: on its axis, its centre or the place of contact, [m]. In the "
        "plane all points have the same z."
    )
    axis: Vector3 | None = optional(
        "A direction, of any length but 0, no unit: of the axis to turn about or slide along, of a slot or "
        "groove, or the normal of surfaces that touch. In the plane a revolute or rolling pair needs none, as it is z; "
        "all others lie in x y."
    )
    second_axis: Vector3 | None = optional("The other axis of a universal joint, no unit.")
    pitch: float | None = optional("Of a screw: advance a radian, [m/rad].", ge=-MAX_MAGNITUDE, le=MAX_MAGNITUDE)

    def given(self, number: int) -> GivenPair:
        """Return the core's pair, the `number`-th from 0; raises InvalidField if an axis has no direction."""
        axes = {
            name: unit_axis(direction, f"pairs/{number}/{name}").tolist()
            for name in ("axis", "second_axis")
            if (direction := getattr(self, name)) is not None
        }
        geometry = PairGeometry(self.point, pitch=self.pitch, **axes) if self.has_geometry() else None
        name = self.name or f"pair_{number + 1}"
        return GivenPair(name, self.link_a, self.link_b, _kind(self.type), self.joint, geometry)

    def has_geometry(self) -> bool:
        """Check whether it gives anything about its location."""
        return any(field is not None for field in (self.point, self.axis, self.second_axis, self.pitch))


class NodePayload(Payload):
    """A joint at which more than two links meet."""

    joint: Name | None = optional("Its name; `node_1`, `node_2`, … if left out.")
    links: Annotated[
        Annotated[Annotated[int, Field(ge=3, le=MAX_LINKS)], Tag("<number>")]
        | Annotated[Annotated[list[Name], Field(min_length=3, max_length=MAX_LINKS)], Tag("<list>")],
        Discriminator(_shape),
    ] = Field(description="The k links that meet there, by name, or their number where `pairs` are counts.")
    type: PairType | None = optional(
        "Kind of the pairs that are missing there; that of the joint's other pairs, or revolute, if left out."
    )


Link = Annotated[
    Annotated[Name, Tag("<text>")] | Annotated[MechanismLinkPayload, Tag("<object>")],
    Discriminator(_shape),
]
Links = Annotated[
    Annotated[Annotated[int, Field(ge=1, le=MAX_LINKS)], Tag("<number>")]
    | Annotated[Annotated[list[Link], Field(min_length=1, max_length=MAX_LINKS)], Tag("<list>")],
    Discriminator(_shape),
]
Pairs = Annotated[
    Annotated[Annotated[list[PairPayload], Field(max_length=MAX_PAIRS)], Tag("<list>")]
    | Annotated[dict[PairType, Annotated[int, Field(ge=0, le=MAX_PAIRS)]], Tag("<object>")],
    Discriminator(_shape),
]


_OF_A_MECHANISM = ("space", "links", "pairs", "coincident", "output", "rank_tolerance")


class MobilityRequest(InLanguage):
    """A mechanism, or a robot by name."""

    space: Literal["planar", "spatial"] | None = optional(
        "Where the mechanism moves: in the plane, λ = 3, or in space, λ = 6."
    )
    links: Links | None = optional(
        "The links by name, the ground among them: marked by `{name, ground: true}`, else the first one. "
        "Only their number n, the ground included, where `pairs` are counts."
    )
    pairs: Pairs | None = optional(
        "The pairs, each with its two links; or their number by type, which says nothing about loops and idle freedoms."
    )
    coincident: Annotated[list[NodePayload], Field(max_length=MAX_NODES)] | None = optional(
        "The joints at which more than two links meet. Each of k links is split into k - 1 pairs: those "
        "that `pairs` leaves out are added. Where `pairs` are counts, such a joint is counted there once."
    )
    output: Name | None = optional("A link whose own degrees of freedom to compute, if the pairs give their locations.")
    rank_tolerance: Fraction = Field(
        default=1e-10,
        description="Where the pairs say where they are: a singular value of the constraints counts where it exceeds "
        "this times the largest, no unit. Raise it for numbers that were rounded; less than 1e-13 counts as that.",
    )
    robot: RobotName | None = optional("Name of a robot instead of a mechanism.")

    @model_validator(mode="after")
    def _one_source(self) -> "MobilityRequest":
        """Check that one source is given; errors name a field, where a `ValueError` would be of the whole request."""
        if self.robot is not None:
            given = [
                name for name in _OF_A_MECHANISM if name in self.model_fields_set and getattr(self, name) is not None
            ]
            if given:
                reason = f"`robot` is given alone, without {', '.join(f'`{name}`' for name in given)}"
                raise InvalidField(given[0], reason)
            return self
        missing = next((name for name in ("space", "links", "pairs") if getattr(self, name) is None), None)
        if missing is not None:
            reason = f"a mechanism has `space`, `links` and `pairs` (or `robot` alone); `{missing}` is missing"
            raise InvalidField(missing, reason)
        if isinstance(self.pairs, list) and isinstance(self.links, int):
            reason = "`links` are named where `pairs` are; a number of links needs numbers of pairs"
            raise InvalidField("links", reason)
        self._check_counts()
        for name in ("output", "rank_tolerance"):
            if name in self.model_fields_set and getattr(self, name) is not None and not self.has_geometry():
                reason = f"`{name}` needs pairs that say where they are: `point` and `axis`"
                raise InvalidField(name, reason)
        return self

    def _check_counts(self) -> None:
        """Refuse a kind that is counted both under its name and under its letter."""
        counted: dict[str, str] = {}
        for name in self.pairs if isinstance(self.pairs, dict) else ():
            if (other := counted.setdefault(_kind(name), name)) != name:
                reason = f"`{other}` and `{name}` are the same kind of pair: count it under one of them"
                raise InvalidField(f"pairs/{name}", reason)

    def has_geometry(self) -> bool:
        """Check whether any pair gives its location."""
        pairs = self.pairs if isinstance(self.pairs, list) else []
        return any(pair.has_geometry() for pair in pairs)

    def output_link(self, names: tuple[str, ...]) -> int | None:
        """Return the index of the link whose freedoms are requested, if any; raises InvalidField for another name."""
        if self.output is None:
            return None
        if self.output not in names:
            raise InvalidField("output", f"there is no link {quoted(self.output)}; the links are {listed(names)}")
        return names.index(self.output)

    def link_names(self) -> tuple[tuple[str, ...], int]:
        """Return the names of the links, and the index of the ground; raises InvalidField for more than one."""
        links = cast(list[str | MechanismLinkPayload], self.links)
        grounds = [i for i, link in enumerate(links) if isinstance(link, MechanismLinkPayload) and link.ground]
        if len(grounds) > 1:
            raise InvalidField("links", f"{len(grounds)} links are marked as ground: all that is at rest is one link")
        names = tuple(link.name if isinstance(link, MechanismLinkPayload) else link for link in links)
        return names, (grounds or [0])[0]

    def link_count(self) -> int:
        """Return the number n of links, the ground included."""
        return self.links if isinstance(self.links, int) else len(self.link_names()[0])

    def given_pairs(self) -> list[GivenPair]:
        """Return the pairs, if they name their links."""
        return [pair.given(i) for i, pair in enumerate(cast(list[PairPayload], self.pairs))]

    def counts(self) -> dict[str, int]:
        """Return the number of pairs by kind, if they are given as counts."""
        return {_kind(name): count for name, count in cast(dict[str, int], self.pairs).items()}

    def nodes(self) -> list[Node]:
        """Return the joints of more than two links, with their names; raises InvalidField for a number of links."""
        nodes = []
        for i, node in enumerate(self.coincident or ()):
            if isinstance(node.links, int):
                raise InvalidField(f"coincident/{i}/links", "a list of names, because `pairs` name the links too")
            nodes.append(Node(node.joint or f"node_{i + 1}", tuple(node.links), _kind(node.type)))
        return nodes

    def node_counts(self) -> list[NodeCount]:
        """Return the joints of more than two links, with the number of links."""
        nodes = []
        for i, node in enumerate(self.coincident or (), start=1):
            count = node.links if isinstance(node.links, int) else len(node.links)
            nodes.append((node.joint or f"node_{i}", count, _kind(node.type)))
        return nodes


def _kind(name: Any) -> Any:
    return LETTERS.get(name, name)
