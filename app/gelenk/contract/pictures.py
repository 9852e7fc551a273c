"""The list of the course's pictures."""

from pydantic import Field

from gelenk.contract.common import Answer


class CoursePicture(Answer):
    """A picture that explains something of the course."""

    name: str = Field(description="In the path of the picture.")
    title: str = Field(description="In the language asked for.")


class CoursePictures(Answer):
    """All pictures of the course."""

    pictures: list[CoursePicture] = Field(description="By name.")
