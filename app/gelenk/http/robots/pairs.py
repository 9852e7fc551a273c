"""Bodies of a robot's links, which pairs are looked at for contacts, and a person's choices among these."""

import math
from typing import Any

from fastapi import Request
from starlette.responses import Response

from gelenk.collision.bodies import Body
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.contract.collision_bodies import CollisionBodies, CollisionBody
from gelenk.contract.collision_pairs import PairChoice, PairChoices
from gelenk.errors import InvalidField, quoted
from gelenk.http.messages.openapi import RobotPath, UploadedRobotPath, documentation
from gelenk.http.messages.payloads import JSON, BoundedRequest, JsonResponse, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.operations.robot_bodies import bodies_of


def pair_routes(pool_client: PoolClient, max_body_bytes: int) -> list[DocumentedRoute]:
    """Return the routes that list bodies, and list and choose pairs; workers answer, because they open meshes."""

    async def show(request: Request) -> Response:
        return await pool_client.answer(request, _bodies, TaskRequest(robot=request.path_params["robot"]))

    async def read(request: Request) -> Response:
        return await pool_client.answer(request, _listed, TaskRequest(robot=request.path_params["robot"]))

    async def choose(request: BoundedRequest) -> Response:
        if request.media_type != JSON:
            raise UnsupportedMediaType(request.media_type, (JSON,))
        given = TaskRequest(buffers(await request.pieces()), robot=request.path_params["robot"])
        return await pool_client.answer(request, _chosen, given)

    def collision_bodies(robot: RobotPath) -> Any: ...

    def collision_pairs(robot: RobotPath) -> Any: ...

    def chosen_pairs(robot: UploadedRobotPath, choices: PairChoices) -> Any: ...

    return [
        DocumentedRoute(collision_bodies, show, max_body_bytes, **documentation("get_collision_bodies")),
        DocumentedRoute(collision_pairs, read, max_body_bytes, **documentation("get_collision_pairs")),
        DocumentedRoute(chosen_pairs, choose, max_body_bytes, **documentation("choose_collision_pairs")),
    ]


def _bodies(context: Context, task_request: TaskRequest) -> Response:
    found = bodies_of(context.library.get(task_request.robot))
    bodies = [_body(body) for body in found.bodies]
    return JsonResponse(CollisionBodies(bodies=bodies, warnings=list(found.warnings)).model_dump(mode="json"))


def _body(body: Body) -> CollisionBody:
    numbers = {"points": body.points.tolist(), "T_link_body": body.T_link_body.tolist(), "size": list(body.size)}
    cover = {"spheres": body.spheres.tolist(), "excess": _known(body.cover_excess), "protrusion": body.protrusion}
    return CollisionBody.model_validate(
        {
            "name": body.name,
            "link": body.link,
            "kind": body.kind,
            **numbers,
            "excess": _known(body.excess),
            "cover": cover,
        }
    )


def _known(number: float) -> float | None:
    return None if math.isnan(number) else number


def _listed(context: Context, task_request: TaskRequest) -> Response:
    bodies = bodies_of(context.library.get(task_request.robot))
    return JsonResponse({"pairs": bodies.pairs, "warnings": bodies.warnings})


def _chosen(context: Context, task_request: TaskRequest) -> Response:
    choices = read_json(PairChoices, task_request.body).pairs
    _check(choices, bodies_of(context.library.get(task_request.robot)))
    context.library.choose_pairs(task_request.robot, choices)
    return _listed(context, task_request)


def _check(choices: list[PairChoice], bodies: RobotBodies) -> None:
    """Check that each choice names a pair that is there, and only once; raises InvalidField."""
    unseen = {frozenset((pair.a, pair.b)) for pair in bodies.pairs}
    known = {link for pair in unseen for link in pair}
    for index, choice in enumerate(choices):
        pair = frozenset((choice.a, choice.b))
        if pair in unseen:
            unseen.remove(pair)
            continue
        if strange := [link for link in (choice.a, choice.b) if link not in known]:
            reason = f"no link {quoted(strange[0])} has a body; `GET` lists the pairs"
        else:
            reason = "a link has no pair with itself" if choice.a == choice.b else "this pair has been given before"
        raise InvalidField(f"pairs[{index}]", reason)
