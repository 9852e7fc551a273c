/** The list of robots cut down by what is chosen, and put into groups. */

import { t } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import type { RobotSummary } from "../../types.ts";

/** What the list is cut down by; empty texts leave everything. */
export interface Wanted {
  words: string;
  /** Joints of the default chain: `6`, or `8+`. */
  joints: string;
  kind: string;
  maker: string;
}

export interface Group {
  title: string;
  robots: RobotSummary[];
}

export const MANY = 8;
const UPLOADED = "uploaded";
/** First what a course begins with. */
const ORDER = [UPLOADED, t("textbook arm"), "SCARA", t("industrial arm"), t("collaborative arm"), t("hobby arm")];

type Joints = Readonly<Record<string, number>>;

/** Those that fit, grouped by kind, in the order in which they are listed. */
export function groups(robots: readonly RobotSummary[], joints: Joints, wanted: Wanted): Group[] {
  const words = wanted.words.toLowerCase().split(/\s+/).filter(Boolean);
  const found = robots.filter(
    (robot) =>
      words.every((word) => textOf(robot).includes(word)) &&
      (!wanted.joints || wanted.joints === counted(robot, joints)) &&
      (!wanted.kind || wanted.kind === robot.kind) &&
      (!wanted.maker || wanted.maker === robot.maker),
  );
  const kinds = [...new Set(found.map(groupOf))].sort((a, b) => rank(a) - rank(b) || a.localeCompare(b));
  return kinds.map((kind) => ({ title: titled(kind), robots: found.filter((robot) => groupOf(robot) === kind) }));
}

/** The values that there are to choose from. */
export function values(robots: readonly RobotSummary[], joints: Joints): Record<"joints" | "kind" | "maker", string[]> {
  const all = (value: (robot: RobotSummary) => string | null) =>
    [...new Set(robots.map(value).filter((text) => text !== null))].sort((a, b) =>
      a.localeCompare(b, "en", { numeric: true }),
    );
  return {
    joints: all((robot) => counted(robot, joints)),
    kind: all(({ kind }) => kind),
    maker: all(({ maker }) => maker),
  };
}

export function titled(kind: string): string {
  const text = word(kind);
  return text.charAt(0).toUpperCase() + text.slice(1);
}

function counted({ name, source }: RobotSummary, joints: Joints): string | null {
  const count = source === UPLOADED || !Object.hasOwn(joints, name) ? null : joints[name]!;
  return count === null ? null : count >= MANY ? `${MANY}+` : String(count);
}

function groupOf({ source, kind }: RobotSummary): string {
  return source === UPLOADED ? UPLOADED : (kind ?? "other");
}

function rank(kind: string): number {
  const found = ORDER.indexOf(kind);
  return found < 0 ? ORDER.length : found;
}

function textOf({ name, description, format, maker, kind }: RobotSummary): string {
  return [name, description, format, maker, kind].join(" ").toLowerCase();
}
