/** Compare: a second robot or table in the picture, moved by the same sliders, and what is different. */

import { shownChain } from "../../robot/chain.ts";
import { t } from "../../texts/index.ts";
import { Choice, element, section, toggle } from "../../ui/dom.ts";
import { UNITS } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { presets } from "../pose/index.ts";
import { JointList } from "../pose/joints.ts";
import type { Panel, Studio } from "../panel.ts";
import { UnitChoices } from "../units.ts";
import { choice } from "./choosing.ts";
import { Picture, titleOf } from "./picture.ts";
import { Second } from "./second.ts";
import { Verdicts } from "./verdicts.ts";
import { wanted, wanting } from "./wanted.ts";

const PLACINGS = [
  { value: "beside", text: t("Side by side") },
  { value: "over", text: t("One over the other") },
] as const;

/** The second robot in the picture alone, for a page without panels. */
export function accompany({ store, api, view }: Studio): void {
  if (view) new Picture(view, store, new Second(store, api));
}

export const open: Panel["open"] = (host, studio) => {
  const { store, api, view } = studio;
  const request = new RequestView(api);
  const second = new Second(store, request.api);
  const picture = view && new Picture(view, store, second);
  const chosen = element("div", { class: "part" });
  const close = choice(chosen, studio, second);
  const verdicts = new Verdicts(studio, second);
  const placing = new Choice(t("Where the second is drawn"), PLACINGS, (value) =>
    store.set(wanting(store.value, { placing: value === "beside" ? null : value })),
  );
  const joints = sliders(studio, second);
  host.append(
    section(t("Compare with"), chosen, view && placing.host),
    section(t("What is different"), verdicts.host),
    section(t("Joints"), ...joints.parts),
    section(t("Frames"), verdicts.frames),
    request.host,
  );
  const stops = [
    ...joints.stops,
    store.watch(["options"], (state) => placing.show(wanted(state).placing)),
    close,
    () => verdicts.close(),
    () => picture?.close(),
    () => second.close(),
    () => store.set({ joint: null }),
  ];
  return () => stops.forEach((stop) => stop());
};

/** The joints of the first; those of the second too, where they are moved by themselves. */
function sliders(studio: Studio, second: Second): { parts: HTMLElement[]; stops: (() => void)[] } {
  const { store } = studio;
  const { own, facts } = second;
  const [ours, theirs] = [new JointList(store), new JointList(own)];
  const units = new UnitChoices(store);
  const link = toggle(t("Linked joints"), t("The second moves as the first does, joint by joint"), () => {
    const isLinked = second.wanted.link === "linked";
    const q = isLinked ? (shownChain(own.value)?.configuration.join(",") ?? null) : null;
    store.set(wanting(store.value, { link: isLinked ? "free" : null, q }));
  });
  const remark = element("p", { class: "muted small", role: "status" });
  const title = element("h3");
  const other = element("div", { class: "part", role: "group" });
  const show = () => {
    const isLinked = second.wanted.link === "linked";
    link.setAttribute("aria-pressed", String(isLinked));
    other.hidden = isLinked;
    other.ariaLabel = title.textContent = titleOf(second);
    // Not merely hidden: the fields of two joints of one name would be told apart by nobody.
    other.replaceChildren(...(isLinked ? [] : [title, theirs.host]));
    remark.textContent = isLinked ? linked(second, shownChain(store.value)?.joints.length ?? 0) : "";
  };
  const stops = [
    store.watch(["model", "base", "tip", ...UNITS], (state) => {
      units.show(state);
      ours.build();
    }),
    store.watch(["positions"], () => ours.update()),
    own.watch(["model", ...UNITS], () => theirs.build()),
    own.watch(["positions"], () => theirs.update()),
    store.watch(["model", "base", "tip", "options"], show),
    own.watch(["model"], show),
    facts.watch(["verdict", "tables"], show),
  ];
  const bar = element("div", { class: "bar" }, ...presets(studio), element("span", { class: "spring" }), units.host);
  return { parts: [bar, element("div", { class: "bar" }, link), remark, ours.host, other], stops };
}

/** Which joints follow which, in a sentence. */
function linked(second: Second, count: number): string {
  const links = second.links;
  const others = shownChain(second.own.value)?.joints.length;
  if (others === undefined) return "";
  const unlike = links.flatMap((link, i) => (link ? [] : [i + 1]));
  const changed = links.flatMap((link, i) => (link && (link.sign < 0 || link.offset !== 0) ? [i + 1] : []));
  return [
    count === others
      ? t("All {count} joints are linked, by their order from the base.", { count })
      : t("The first {linked} joints are linked: the robot has {count}, the second {others}.", {
          linked: links.length,
          count,
          others,
        }),
    unlike.length && t("Not linked, as one turns and the other slides: {unlike}.", { unlike: unlike.join(", ") }),
    changed.length && t("With the sense and zero that were found: {changed}.", { changed: changed.join(", ") }),
  ]
    .filter(Boolean)
    .join(" ");
}
