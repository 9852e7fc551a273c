"""What someone at a prompt sees: help, completion, what is shown of answers, and what is said of a slip."""

import inspect
import pydoc
from typing import Any

import pytest

from gelenk.client import AsyncClient, Client
from gelenk.client.refusals import Refused
from gelenk.contract.encoder import EncoderAnswer
from gelenk.contract.pose import Pose
from gelenk.course.actuators.quadrature import decoded, read_samples
from gelenk.errors import InvalidField
from tests.corpus import zips


def test_help_is_to_be_read(gelenk: Client) -> None:
    told = pydoc.plain(pydoc.render_doc(gelenk.fk))
    assert "fk(robot: str, /, *, joint_positions: Sequence[Sequence[float] | Mapping[str, float] | ndarray]" in told
    assert "pose_format: 'quaternion_xyzw' | 'quaternion_wxyz'" in told
    assert "tip_frame: Frame whose pose is computed" in told
    for method in (gelenk.fk, gelenk.arrays.ik, gelenk.jobs.trajectory, gelenk.dc_motor):
        signature = str(inspect.signature(method))
        assert not any(word in signature for word in ("FieldInfo", "Annotated", "OnTheWire", "metadata"))
        assert f"\n{method.__name__}(" in pydoc.plain(pydoc.render_doc(method))


def test_all_calls_are_completed(gelenk: Client) -> None:
    assert {"fk", "ik", "robots", "arrays", "jobs", "add_archive"} <= set(dir(gelenk))
    assert {"ik", "trajectory", "workspace"} <= set(dir(gelenk.jobs))


@pytest.mark.parametrize("taken", ["robot", "robot, array"])
def test_what_is_given_by_place_but_goes_by_name_is_no_silent_loss(gelenk: Client, taken: str) -> None:
    ask: Any = gelenk.fk if taken == "robot" else gelenk.arrays.fk
    with pytest.raises(TypeError, match=rf"^fk takes {taken} alone by place; give all else by name"):
        ask("planar_2r", [[0.3, 0.8]], "tool")
    with pytest.raises(TypeError, match=r"^ik takes robot alone by place"):
        gelenk.jobs.ik("planar_2r", [])  # type: ignore[call-arg,arg-type]
    with pytest.raises(TypeError, match=r"^dc_motor takes nothing by place"):
        gelenk.dc_motor(1.0)  # type: ignore[call-arg,arg-type]


def test_a_robot_goes_by_its_name(gelenk: Client) -> None:
    with pytest.raises(TypeError, match="given by its name, a string, not by None"):
        gelenk.fk(None, joint_positions=[[0.3, 0.8]])  # type: ignore[arg-type]


def test_one_configuration_in_the_place_of_a_batch_is_told(gelenk: Client) -> None:
    with pytest.raises(Refused, match="#/joint_positions/0: a configuration is a list of one number per joint"):
        gelenk.fk("planar_2r", joint_positions=[0.3, 0.8])  # type: ignore[list-item]


def test_what_is_large_is_shown_in_a_few_lines(gelenk: Client) -> None:
    answer = gelenk.fk("planar_2r", joint_positions=[[0.3, 0.8]] * 1000)
    assert "... 1000 in all]" in repr(answer)
    assert repr(answer).count("Pose(") == 3
    assert len(repr(answer)) < 1000
    assert "rpy" not in repr(answer)  # which it does not have
    assert str(answer) == repr(answer)
    few = gelenk.fk("planar_2r", joint_positions=[[0.3, 0.8]] * 12)
    assert repr(few).count("Pose(") == 12
    assert len(repr(gelenk.robots())) < 2000
    text = gelenk.dh_to_urdf(name="arm", dh=gelenk.dh_table("panda").dh)
    assert len(text.urdf) > 1000 > len(repr(text.urdf[:300]))
    assert len(repr(text)) < 1000


def test_a_small_answer_shows_all_that_it_holds() -> None:
    pose = Pose(position=[0.1, 0.2, 0.3], rpy=[0.0, 0.0, 0.5])
    assert repr(pose) == "Pose(position=[0.1, 0.2, 0.3], rpy=[0.0, 0.0, 0.5])"
    assert eval(repr(pose), {"Pose": Pose}) == pose  # noqa: S307


def test_clients_and_jobs_say_who_they_are(gelenk: Client) -> None:
    assert repr(gelenk) == f"Client('{gelenk.url}')"
    assert repr(AsyncClient("http://lab.invalid/gelenk/", key="secret")) == "AsyncClient('http://lab.invalid/gelenk')"
    with gelenk.jobs.workspace("planar_2r", samples=1000) as job:
        job.wait()
        assert repr(job) == f"Job('{job.id}', workspace, succeeded, 100%)"


@pytest.mark.parametrize(
    "url", ["localhost:8000", "127.0.0.1:8000", "http://", "ftp://host", "http://host:99999", "x y"]
)
def test_what_is_no_address_is_said_at_once(url: str) -> None:
    with pytest.raises(InvalidField, match="is not the address of a service, such as http://"):
        Client(url)


@pytest.mark.parametrize("page", ["/", "/docs", "/redoc/", "/v1", "//"])
def test_an_address_copied_from_a_page_is_the_service_s(url: str, page: str) -> None:
    with Client(f" {url}{page}\n") as client:
        assert client.url == url
        assert client.health().status


def test_a_key_is_never_shown() -> None:
    for key in ("schlüssel", "two\nlines"):
        with pytest.raises(InvalidField) as refused:
            Client(key=key)
        assert key not in str(refused.value)


def test_a_file_is_told_by_its_path_in_any_form(gelenk: Client, tmp_path: Any) -> None:
    file = tmp_path / "arm.zip"
    file.write_bytes(zips.good())
    assert gelenk.add_archive("by_text", str(file)).meshes
    gelenk.remove_robot("by_text")
    with pytest.raises(FileNotFoundError, match=r"none\.zip"):
        gelenk.add_archive("by_text", "none.zip")


def test_a_part_of_an_answer_is_shown_in_short_too() -> None:
    moved = decoded(read_samples("00 10 11 01 " * 250, "samples"), "x4")
    answer = EncoderAnswer(resolution=None, required=None, quadrature=moved, absolute=None, steps=[])
    assert "counts=[0, 1, 2, ... 1000 in all]" in repr(answer)
    assert len(repr(answer)) < 300
    assert "register_value" not in repr(answer)  # which it does not have
