"""Endpoints of the course's exercises: quick ones are answered here, those with a picture by a worker."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any

from fastapi import APIRouter, Path, Query
from starlette.responses import Response

from gelenk.contract.common import as_lists, content_of
from gelenk.contract.exercises import ExerciseField, ExerciseGradeRequest, ExerciseInfo, ExerciseRequest
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import Variant, exercise, exercises
from gelenk.exercises.grading import graded
from gelenk.http.messages.openapi import documentation
from gelenk.http.messages.payloads import JSON, BoundedRequest, JsonResponse, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute, Handler
from gelenk.http.workers.pool_client import INLINE_BYTES, PoolClient
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.language import Language, language, translated

ExercisePath = Annotated[
    str, Path(description="Id of an exercise.", openapi_examples={"linkage": {"value": "mobility.linkage"}})
]
LanguageQuery = Annotated[
    Language, Query(description="Of the titles: English or German.", openapi_examples={"German": {"value": "de"}})
]


def exercises_router() -> APIRouter:
    """Return the router of the list of exercises."""
    router = APIRouter()

    @router.api_route(**documentation("list_exercises"))
    async def list_exercises(language: LanguageQuery = "en") -> Response:
        return JsonResponse({"exercises": _listed(language)})

    return router


def exercise_routes(pool_client: PoolClient, max_body_bytes: int) -> list[DocumentedRoute]:
    """Return the routes of a variant, of its solution and of its grade."""

    def draw(exercise: ExercisePath, request: ExerciseRequest) -> Any: ...

    def solve(exercise: ExercisePath, request: ExerciseRequest) -> Any: ...

    def grade(exercise: ExercisePath, request: ExerciseGradeRequest) -> Any: ...

    return [
        DocumentedRoute(described, _handler(pool_client, what), max_body_bytes, **documentation(what))
        for what, described in (("draw_exercise", draw), ("solve_exercise", solve), ("grade_exercise", grade))
    ]


def _handler(pool_client: PoolClient, what: str) -> Handler:
    async def handle(request: BoundedRequest) -> Response:
        if request.media_type != JSON:
            raise UnsupportedMediaType(request.media_type, (JSON,))
        pieces, task = await request.pieces(), ExerciseTask(what, request.path_params["exercise"])
        if request.length <= INLINE_BYTES and not pool_client.pool.is_starting and not task.is_heavy:
            return task.response(b"".join(pieces))
        return await pool_client.answer(request, task, TaskRequest(buffers(pieces)))

    return handle


@dataclass(frozen=True, slots=True)
class ExerciseTask:
    """Answers a request about an exercise, here or in a worker."""

    what: str
    exercise: str

    def __call__(self, _: Context, task_request: TaskRequest) -> Response:
        """Answer in a worker."""
        return self.response(task_request.body)

    @property
    def is_heavy(self) -> bool:
        """Whether this draws a picture."""
        return self.what == "draw_exercise" and exercise(self.exercise).is_drawn

    def response(self, body: bytes) -> Response:
        """Return the response to a body; raises as `read_json`, UnknownExercise, and InvalidField."""
        model = ExerciseGradeRequest if self.what == "grade_exercise" else ExerciseRequest
        request, found = read_json(model, body), exercise(self.exercise)
        with language(request.language):
            content = _CONTENTS[self.what](found.variant(request.seed), request)
        return JsonResponse({"id": found.id, "version": found.version, **as_lists(content)})


def _listed(code: Language) -> list[dict[str, Any]]:
    with language(code):
        return [content_of(ExerciseInfo, one, title=translated(one.title)) for one in exercises().values()]


def _drawn(variant: Variant[Any], _: Any) -> dict[str, Any]:
    return {
        "text": variant.exercise.text(variant.numbers),
        "picture": variant.svg and variant.svg.decode(),
        "fields": [_field(one) for one in variant.fields],
        "hints": [one.title for one in variant.steps],
    }


def _field(one: AnswerField) -> dict[str, Any]:
    choices = [{"value": value, "text": text} for value, text in one.choices().items()]
    return content_of(ExerciseField, one, unit=one.unit or None, shape=one.shape(), choices=choices)


def _solved(variant: Variant[Any], _: Any) -> dict[str, Any]:
    return {"answers": variant.answers, "steps": variant.steps}


def _graded(variant: Variant[Any], request: ExerciseGradeRequest) -> dict[str, Any]:
    grade = graded(variant, request.answers)
    return {"points": grade.points, "max_points": grade.max_points, "fields": grade.fields}


_CONTENTS: dict[str, Callable[[Variant[Any], Any], dict[str, Any]]] = {
    "draw_exercise": _drawn,
    "solve_exercise": _solved,
    "grade_exercise": _graded,
}
