/** A file from outside becomes a robot of the service. */

import type { Api, Call } from "../api.ts";
import type { RobotInfo } from "../types.ts";

const NAME = /^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$/;

export function isName(text: string): boolean {
  return NAME.test(text);
}

/** A name that the service takes, after the robot's own where it has one, else after the file's. */
export async function suggestedName(file: File): Promise<string> {
  const inside = isArchive(file)
    ? null
    : /<(?:robot|mujoco)\b[^>]*\b(?:name|model)\s*=\s*["']([^"'$]+)["']/.exec(await file.text())?.[1];
  const raw = inside ?? file.name.replace(/(\.urdf|\.xacro|\.xml|\.zip)+$/i, "");
  const name = raw
    .replace(/[^A-Za-z0-9_.-]+/g, "_")
    .replace(/^[^A-Za-z0-9]+/, "")
    .slice(0, 64);
  return isName(name) ? name : "my_robot";
}

export function isArchive(file: File): boolean {
  return /\.zip$/i.test(file.name) || file.type === "application/zip";
}

/** Add it, or put it in the place of the uploaded robot of that name; `file` says which description of a zip is meant,
 * `given` are values of a xacro's arguments. */
export async function upload(
  api: Api,
  content: File,
  name: string,
  { replace, file, given = {} }: { replace: boolean; file: string; given?: Record<string, string> },
): Promise<RobotInfo> {
  const target: Pick<Call, "method" | "path"> = replace
    ? { method: "PUT", path: `v1/robots/${encodeURIComponent(name)}` }
    : { method: "POST", path: "v1/robots" };
  const named: Record<string, string> = replace ? {} : { name };
  const hasValues = Object.keys(given).length > 0;
  if (!isArchive(content)) {
    const values = hasValues ? { arguments: given } : {};
    return api.call<RobotInfo>({ ...target, body: { ...named, urdf: await content.text(), ...values } });
  }
  const fields = { ...named, ...(file && { file }), ...(hasValues && { arguments: JSON.stringify(given) }) };
  return api.call<RobotInfo>({ ...target, form: { fields, part: "archive", files: [content] } });
}
