"""Models in MJCF, and where MuJoCo puts their bodies and sites.

`python -m tests.corpus.mjcf` writes the poses anew with the package mujoco, which the tests do not need.
"""

import json
from pathlib import Path
from typing import Any

POSES = Path(__file__).with_name("mjcf_poses.json")
"""By model: joint positions, [rad or m], and poses of all named bodies and sites in the root, as matrices."""

FORMS = """<mujoco model="forms">
  <compiler eulerseq="{seq}" angle="{angle}"/>
  <worldbody>
    <body name="a" pos="0.1 0.2 0.3" quat="0.8 0.2 -0.4 0.4">
      <joint name="qa" axis="1 2 3"/><geom size="0.1"/>
      <body name="b" pos="0.2 0 0" axisangle="1 -1 0.5 0.7">
        <joint name="qb"/><geom size="0.1"/>
        <body name="c" pos="0 0.3 0" euler="0.3 -0.8 1.2">
          <joint name="qc" axis="0 1 0"/><geom size="0.1"/>
          <body name="d" pos="0 0 0.4" xyaxes="1 0.2 0 0.3 1 0.5">
            <joint name="qd" type="slide" range="-1 1"/><geom size="0.1"/>
            <body name="e" zaxis="0.3 -0.4 -0.9"><geom size="0.1"/><site name="tip" pos="0 0 1" euler="1 0 0"/></body>
            <body name="f" zaxis="0 0 -2"><geom size="0.1"/></body>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>"""
MODELS = {
    "forms in degrees": FORMS.format(seq="xyz", angle="degree"),
    "forms about fixed axes": FORMS.format(seq="ZYX", angle="radian"),
    "forms about both": FORMS.format(seq="xYz", angle="radian"),
    "several joints in a body": """<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="a" pos="0 0 1" euler="0.1 0.2 0.3">
      <joint name="x" type="slide" axis="1 0 0" range="-2 2" ref="0.3"/>
      <joint name="y" type="slide" axis="0 1 0.2" range="-2 2" pos="1 1 1"/>
      <joint name="turn" pos="0.1 0.2 0" axis="0 0.1 1" ref="0.7"/>
      <joint name="tilt" pos="-0.1 0 0.3" axis="1 0 0" range="-1 1"/>
      <geom size="0.1"/>
      <body name="b" pos="1 0 0"><joint name="q" pos="0 0 0.5" axis="0 1 0"/><geom size="0.1"/></body>
    </body>
  </worldbody>
</mujoco>""",
    "defaults and frames": """<mujoco>
  <compiler autolimits="true"/>
  <default>
    <joint axis="0 1 0" range="-90 90"/>
    <geom size="0.05" type="sphere"/>
    <default class="arm">
      <joint pos="0.1 0 0"/>
      <site pos="0 0 0.2" quat="0.5 0.5 0.5 0.5"/>
      <default class="wrist"><joint axis="1 0 0" pos="0 0 0"/></default>
    </default>
  </default>
  <worldbody>
    <frame pos="0 0 0.5" euler="0 0 90">
      <body name="a" childclass="arm">
        <joint name="qa"/><geom/>
        <site name="plain"/><site name="turned" euler="90 0 0"/>
        <frame pos="0.3 0 0" euler="0 45 0" childclass="wrist">
          <body name="b"><joint name="qb"/><joint name="qc" class="main"/><geom/>
            <frame pos="0 0.1 0" axisangle="0 0 1 30">
              <site name="grip" class="wrist"/><joint name="qd" type="slide"/>
            </frame>
          </body>
        </frame>
      </body>
    </frame>
  </worldbody>
</mujoco>""",
    "equalities": """<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="a"><joint name="qa" ref="0.2"/><geom size="0.1"/>
      <body name="b" pos="1 0 0"><joint name="qb" axis="0 1 0" ref="-0.1"/><geom size="0.1"/>
        <body name="c" pos="1 0 0"><joint name="qc" type="slide" range="-9 9"/><geom size="0.1"/></body>
      </body>
    </body>
  </worldbody>
  <equality>
    <joint joint1="qb" joint2="qa" polycoef="0.3 -0.5 0 0 0"/>
    <joint joint1="qc" joint2="qb"/>
  </equality>
</mujoco>""",
    "a floating root": """<mujoco>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="trunk" pos="0 0 1" euler="10 20 30"><freejoint name="root"/><geom size="0.1"/>
      <body name="leg" pos="0.2 0 0"><joint name="hip" axis="0 1 0" range="-40 60"/><geom size="0.1"/></body>
    </body>
  </worldbody>
</mujoco>""",
    "replicas": """<mujoco>
  <compiler eulerseq="zYx"/>
  <worldbody>
    <frame pos="1 2 3" euler="10 20 30">
      <replicate count="11" offset="0.5 0.3 0.2" euler="5 6 7" sep="-">
        <body name="leg"><joint name="hip" axis="1 2 3"/><geom size="0.1"/>
          <replicate count="2" offset="0 0 1" euler="90 0 30">
            <body name="toe"><joint name="bend"/><geom size="0.1"/><site name="tip" pos="0.1 0 0"/></body>
          </replicate>
        </body>
      </replicate>
    </frame>
  </worldbody>
  <equality><joint joint1="bend1" joint2="hip" polycoef="0.1 0.5 0 0 0"/></equality>
</mujoco>""",
}


def _poses(text: str) -> list[dict[str, Any]]:
    import mujoco  # type: ignore[import-not-found]
    import numpy as np

    model = mujoco.MjModel.from_xml_string(text)
    data, random, found = mujoco.MjData(model), np.random.default_rng(7), []
    root = 1 if model.jnt_type[0] == int(mujoco.mjtJoint.mjJNT_FREE) else 0
    for _ in range(4):
        mujoco.mj_resetData(model, data)
        scalar = [joint for joint in range(model.njnt) if model.jnt_type[joint] >= int(mujoco.mjtJoint.mjJNT_SLIDE)]
        address = {joint: int(model.jnt_qposadr[joint]) for joint in scalar}
        for joint in scalar:
            low, high = model.jnt_range[joint] if model.jnt_limited[joint] else (-2.0, 2.0)
            data.qpos[address[joint]] = random.uniform(low, high)
        for equality in range(model.neq):
            one, other = (address[int(of[equality])] for of in (model.eq_obj1id, model.eq_obj2id))
            constant, slope = model.eq_data[equality][:2]
            data.qpos[one] = model.qpos0[one] + constant + slope * (data.qpos[other] - model.qpos0[other])
        mujoco.mj_kinematics(model, data)
        T_root = _matrix(data.xpos[root], data.xmat[root])
        poses = {model.body(i).name: _matrix(data.xpos[i], data.xmat[i]) for i in range(model.nbody)}
        poses |= {model.site(i).name: _matrix(data.site_xpos[i], data.site_xmat[i]) for i in range(model.nsite)}
        inside = {
            name: (np.linalg.inv(T_root) @ T).tolist() for name, T in poses.items() if root == 0 or name != "world"
        }
        found.append({"q": {model.joint(j).name: data.qpos[address[j]] for j in scalar}, "poses": inside})
    return found


def _matrix(position: Any, rotation: Any) -> Any:
    import numpy as np

    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation.reshape(3, 3), position
    return T


if __name__ == "__main__":
    POSES.write_text(json.dumps({name: _poses(text) for name, text in MODELS.items()}) + "\n")
