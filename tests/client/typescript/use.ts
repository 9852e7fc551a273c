// A program that is typed by the schema alone: it asks a service for poses, an inverse, a robot and something wrong.
import type { components, paths } from "./schema";

type Schemas = components["schemas"];
type Body<P extends keyof paths> = paths[P] extends {
  post: { requestBody: { content: { "application/json": infer B } } };
}
  ? B
  : never;
type Answer<P extends keyof paths, S extends number = 200> = paths[P] extends {
  post: { responses: { [K in S]: { content: { "application/json": infer A } } } };
}
  ? A
  : never;

declare const service: string;

async function posted<P extends keyof paths, S extends number = 200>(
  path: P,
  robot: string,
  body: Body<P>,
): Promise<Answer<P, S>> {
  const answer = await fetch(service + path.replace("{robot}", robot), {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });
  if (!answer.ok) {
    throw (await answer.json()) as Schemas["Problem"];
  }
  return (await answer.json()) as Answer<P, S>;
}

/** What goes through the types, one after the other. */
export async function used(): Promise<unknown> {
  const configuration: Schemas["Configuration"] = { joint_1: 0.3, joint_2: 0.8 };
  const forward = await posted("/v1/robots/{robot}/fk", "planar_2r", {
    joint_positions: [[0.3, 0.8], configuration],
    pose_format: "matrix",
  });
  const poses: (number[][] | null | undefined)[] = forward.poses.map((pose) => pose.matrix);

  const target: Schemas["Pose"] = { position: [0.4, 0.2, 0.5], rpy: [3.0, 0.2, 0.4] };
  const inverse = await posted("/v1/robots/{robot}/ik", "ur5", { targets: [target], solutions: "all" });
  const branches: number = inverse.results.map((result) => result.solutions.length).reduce((a, b) => a + b, 0);

  const table: Schemas["DhTablePayload"] = {
    convention: "standard",
    joints: [{ type: "revolute", a: 1, alpha: 0, d: 0, theta: 0 }],
  };
  const added = await posted<"/v1/robots", 201>("/v1/robots", "", { name: "typed_arm", dh: table });
  const joints: string[] = added.joint_names;

  // @ts-expect-error: there is no such convention
  const wrong: Schemas["DhTablePayload"]["convention"] = "denavit";
  let problem: Schemas["Problem"] | undefined;
  try {
    await posted("/v1/dh/to-urdf", "", { name: "arm", dh: { ...table, convention: wrong } });
  } catch (error) {
    problem = error as Schemas["Problem"];
  }
  return { poses, branches, joints, status: problem?.status, detail: problem?.detail };
}

console.log(JSON.stringify(await used()));
