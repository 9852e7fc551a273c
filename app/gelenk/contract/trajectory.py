"""Trajectories: the operation."""

from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from gelenk.contract.trajectory_request import MAX_JOB_SAMPLES, TrajectoryRequest

JOINT_TRAJECTORY = "application/x-joint-trajectory+json"
YAML = "application/yaml"
URSCRIPT = "text/x-urscript"

ENDPOINT = RobotEndpoint(
    name="trajectory",
    request=TrajectoryRequest,
    answer=TrajectoryAnswer,
    summary="Trajectory",
    description="""
    A motion through segments: joints, lines, circles and splines of the tip. It begins and ends at rest, or with given
    velocities and accelerations of the joints, or out of a running motion (`at`).

    A `joint` segment moves all joints together to a configuration or a pose; `line`, `circle` and `spline` lead the
    tip along a path in space, which the joints follow within `path_tolerance`, also between samples, on one branch of
    the inverse kinematics. A spline through configurations moves the joints. The motion stops between two segments,
    except where a line is blended into the next (fly-over). Each segment has its own time law and limits, or the
    trajectory's; limits that neither the request nor the robot's description gives are assumed, and `notes` and
    `limit_sources` say so.

    A path that cannot be followed to its end (out of reach, a joint limit, a singularity, a change of branch) is
    also an answer: the motion as far as it goes, to rest, with `completed_fraction` and `failure`.

    With a `scene`, or with `min_clearance` alone, nothing may touch, or come nearer, at any time: neither the robot
    what is around it, nor one of its links another; joints off the chain stand where `other_joints` says. This is
    proved for all times, not only for samples. A path of the tip that would touch something ends before, and any other
    segment is not begun; `failure` has the `reason` `collision`, when, which pair and how deep it would be.
    `audit.clearance` says how near the motion comes. A `joint` segment to a pose leads to the nearest configuration
    that touches nothing there, as `ik` finds it; if there is none, it is not begun.

    Every motion is a list of polynomials. Before it is sent, code independent of the planner checks exact peaks
    against the limits, jumps where pieces meet, and the tip against its path, also between samples; its poses are
    recomputed through Pinocchio. `audit` holds the results.

    With `Accept: text/csv` or `application/x-npy` the samples come as a table, with `image/svg+xml`, `image/png` or
    `application/pdf` as profiles of position, velocity, acceleration and jerk.

    `format=joint_trajectory` answers with ROS 2's message `trajectory_msgs/msg/JointTrajectory`, as JSON, or as YAML
    with `Accept: application/yaml`; `format=urscript` with a program for an arm of Universal Robots. Neither was run
    on a robot.
    """,
    batch="",
    npy_answer="The samples as one array of shape (N, 1 + 3n): time, joint positions, velocities, accelerations. "
    "The headers `Gelenk-Duration` [s], `Gelenk-Completed-Fraction` and `Gelenk-Failure` (`none`, or the reason) "
    "give the outcome.",
    picture="Position, velocity, acceleration and jerk of each joint over time, with the limits; the segments "
    "are marked.",
    table="A row of names, `time`, `q_…`, `qd_…` and `qdd_…` of each joint, then one row per sample: [s], "
    "[rad or m], [rad/s or m/s], [rad/s² or m/s²]. The headers are those of the npy answer.",
    programs={
        JOINT_TRAJECTORY: "A JointTrajectory of ROS 2: a point for each sample, its time in whole nanoseconds.",
        YAML: "The same as YAML, with robot, frames and units in comments.",
        URSCRIPT: "A program that streams the samples by `servoj`, for six turning joints. If all segments are joint "
        "moves and lines with the law `trapezoidal` or `time_optimal`, it has them as `movej` and `movel` too.",
    },
    example={
        "start": [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785],
        "segments": [
            {"type": "joint", "target": [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]},
            {
                "type": "line",
                "target": {"position": [0.5, 0.2, 0.4], "rpy": [3.141592653589793, 0.0, 0.3]},
                "blend_radius": 0.05,
            },
            {"type": "line", "target": {"position": [0.5, -0.1, 0.4], "rpy": [3.141592653589793, 0.0, 0.0]}},
        ],
        "law": "trapezoidal",
        "tip_frame": "panda_link8",
        "velocity_scale": 0.5,
        "acceleration_scale": 0.5,
        "sample_period": 0.05,
    },
    job=f"{MAX_JOB_SAMPLES:,} samples",
)
