/** A typed table becomes a robot of the service, so that everything else can be asked of it. */

import { t } from "../../texts/index.ts";
import type { DhTable, RobotInfo } from "../../types.ts";
import type { Studio } from "../panel.ts";
import { naming } from "./naming.ts";

export function keep({ api, store }: Pick<Studio, "api" | "store">, table: () => DhTable | null): HTMLElement {
  const send = async (name: string, replace: boolean) => {
    const dh = table();
    if (!dh) return;
    if (replace)
      await api.call<RobotInfo>({ method: "PUT", path: `v1/robots/${encodeURIComponent(name)}`, body: { dh } });
    else await api.call<RobotInfo>({ method: "POST", path: "v1/robots", body: { name, dh } });
    store.set({ robot: name, draft: null, base: null, tip: null });
  };
  const made = naming({ id: "table-name", label: t("Name at the service"), add: t("Add to the robots"), send });
  made.name.value = "my_arm";
  return made.host;
}
