/** Workspace: where the tip gets to, computed by a job of the service, and looked into. */

import "../../styles/workspace.css";

import { shownChain } from "../../robot/chain.ts";
import { asProblem } from "../../robot/load.ts";
import { choosing } from "../../state.ts";
import type { JobInfo, WorkspaceSummary } from "../../types.ts";
import { button, element, section, titled } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { Cloud } from "./cloud.ts";
import { Follower, type Result } from "./job.ts";
import { Legend } from "./legend.ts";
import { Progress } from "./progress.ts";
import { meaning, Results } from "./results.ts";
import { SectionControls } from "./section.ts";
import { Settings } from "./settings.ts";

export const workspacePanel: Panel = {
  id: "workspace",
  title: "Workspace",
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

const JOB = "workspace.job";

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, api, view } = studio;
  const requests = { job: new RequestView(api, "the job"), result: new RequestView(api, "its result") };
  const problem = new ProblemView();
  const settings = new Settings(store);
  const legend = new Legend();
  const cuts = new SectionControls(store);
  const cloud = view && new Cloud(view);
  const remember = (id: string | null) => store.set(choosing(store.value, JOB, id));
  let followed: string | null = null;
  let result: Result | null = null;

  const follower = new Follower(api, requests.result.api, {
    progress: (job: JobInfo) => {
      problem.show(null);
      progress.show(job);
    },
    result: (found) => {
      result = found;
      draw();
    },
    failed: (found) => {
      problem.show(found);
      if (found.status === 404) remember(null);
    },
  });
  const guarded = async (work: () => Promise<void>) => {
    try {
      problem.show(null);
      await work();
    } catch (error) {
      problem.show(asProblem(error));
    }
  };
  const begin = () =>
    guarded(async () => {
      const chain = shownChain(store.value);
      if (!chain?.path) return;
      const job = await requests.job.api.post<JobInfo>(`${chain.path}/workspace`, { ...settings.call, ...chain.ends });
      remember(job.id);
    });
  const cancel = () =>
    guarded(async () => {
      if (followed) progress.show(await follower.end(followed));
    });
  const remove = () =>
    guarded(async () => {
      if (followed) await follower.end(followed);
      remember(null);
    });
  const progress = new Progress(
    () => void begin(),
    () => void cancel(),
  );
  const results = new Results(api, {
    goToBest: (summary) => goToBest(studio, summary),
    remove: () => void remove(),
    failed: (error) => problem.show(asProblem(error)),
  });

  const picture = section("Picture", legend.host, cuts.host);
  const elsewhere = element("div", { class: "bar", hidden: true });
  const outcome = section("Result", elsewhere, results.host);
  host.append(
    titled("Workspace", [settings.kinds.host], settings.host, progress.host, problem.host),
    picture,
    outcome,
    requests.job.host,
    requests.result.host,
  );

  /** The result as it is known, on the robot that it is of. */
  const draw = () => {
    const { model } = store.value;
    const isHere = result !== null && model?.name === result.summary.robot;
    picture.hidden = !isHere;
    outcome.hidden = result === null;
    elsewhere.hidden = isHere || result === null;
    cloud?.clear();
    results.clear();
    if (!result || !model) return;
    if (!isHere) {
      const { robot } = result.summary;
      elsewhere.replaceChildren(
        element("span", {}, `The last workspace is that of ${robot}.`),
        button(`Show ${robot}`, () => store.set({ robot, draft: null, base: null, tip: null })),
      );
      return;
    }
    const { title, range } = meaning(result);
    legend.show(title, range);
    cloud?.show(result.table, result.summary, range);
    results.show(result, model.chain(result.summary.base_frame, result.summary.tip_frame));
    place();
  };
  const place = () => {
    const { model } = store.value;
    const cut = cuts.update(result?.summary ?? null);
    if (result && model?.name === result.summary.robot)
      cloud?.place(model.link(result.summary.base_frame).matrixWorld, cut);
  };
  const follow = () => {
    const wanted = store.value.options[JOB] ?? null;
    if (wanted === followed) return;
    followed = wanted;
    result = null;
    progress.show(null);
    draw();
    if (wanted) void follower.follow(wanted);
    else follower.stop();
  };
  const stops = [
    store.watch(["options"], () => {
      settings.update();
      follow();
    }),
    store.watch(["model"], draw),
    store.watch(["options", "positions", "dark"], place),
    () => follower.stop(),
    () => cloud?.close(),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

/** Put the chain where its manipulability was largest. */
function goToBest({ store }: Studio, { joint_names, measure }: WorkspaceSummary): void {
  const best = Object.fromEntries(joint_names.map((name, i) => [name, measure.joint_positions![i]!]));
  store.set({ positions: { ...store.value.positions, ...best } });
}
