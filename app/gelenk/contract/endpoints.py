"""The table of all operations: what server, client, command line, workers and reference know of them."""

from typing import Any

from gelenk.contract import (
    compare_dh,
    convert_dh,
    dc_motor,
    derive,
    dh_from_urdf,
    dh_to_urdf,
    dynamics,
    encoder,
    fk,
    fly_over,
    gear,
    ik,
    jacobian,
    manipulability,
    mobility,
    orientation,
    planar_workspace,
    pulse_width_modulation,
    singularities,
    spline,
    statics,
    time_law,
    time_scaling,
    trajectory,
    velocity,
)
from gelenk.contract.endpoint import Endpoint, RobotEndpoint

ROBOT_ENDPOINTS: tuple[RobotEndpoint[Any, Any], ...] = (
    fk.ENDPOINT,
    jacobian.ENDPOINT,
    ik.ENDPOINT,
    statics.ENDPOINT,
    dynamics.ENDPOINT,
    manipulability.ENDPOINT,
    velocity.ENDPOINT,
    singularities.ENDPOINT,
    trajectory.ENDPOINT,
)
ENDPOINTS: tuple[Endpoint[Any, Any], ...] = (
    dh_to_urdf.ENDPOINT,
    dh_from_urdf.ENDPOINT,
    convert_dh.ENDPOINT,
    compare_dh.ENDPOINT,
    derive.ENDPOINT,
    dc_motor.ENDPOINT,
    gear.ENDPOINT,
    pulse_width_modulation.ENDPOINT,
    encoder.ENDPOINT,
    planar_workspace.ENDPOINT,
    fly_over.ENDPOINT,
    mobility.ENDPOINT,
    orientation.ENDPOINT,
    time_law.ENDPOINT,
    spline.ENDPOINT,
    time_scaling.ENDPOINT,
    *ROBOT_ENDPOINTS,
)
BY_NAME = {endpoint.name: endpoint for endpoint in ENDPOINTS}
