"""Names that answers about motions of the tip use, without what computes them."""

from typing import Literal, TypeAlias

InverseName: TypeAlias = Literal["exact", "pseudo_inverse", "damped"]
InverseStatus: TypeAlias = Literal["solved", "approximate", "singular"]
SingularityKind: TypeAlias = Literal["wrist", "elbow", "shoulder"]
