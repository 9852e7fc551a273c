"""Names used in results about motions of the tip, without the code that computes these."""

from typing import Literal, TypeAlias

InverseName: TypeAlias = Literal["exact", "pseudo_inverse", "damped"]
InverseStatus: TypeAlias = Literal["solved", "approximate", "singular"]
SingularityKind: TypeAlias = Literal["wrist", "elbow", "shoulder"]
