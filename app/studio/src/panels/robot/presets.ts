/** Tables of the course, from the very files of the catalogue: bundled, so that there is one source of each. */

import anthropomorphic from "../../../../../robots/anthropomorphic/dh.json";
import anthropomorphicWrist from "../../../../../robots/anthropomorphic_wrist/dh.json";
import panda from "../../../../../robots/panda_dh/dh.json";
import planar2r from "../../../../../robots/planar_2r/dh.json";
import planar3r from "../../../../../robots/planar_3r/dh.json";
import puma from "../../../../../robots/puma560/dh.json";
import scara from "../../../../../robots/scara/dh.json";
import sphericalWrist from "../../../../../robots/spherical_wrist/dh.json";
import stanford from "../../../../../robots/stanford/dh.json";
import { t } from "../../texts/index.ts";
import type { DhTable } from "../../types.ts";

export const PRESETS: readonly { title: string; table: DhTable }[] = [
  { title: t("Planar arm, two joints"), table: planar2r as DhTable },
  { title: t("Planar arm, three joints"), table: planar3r as DhTable },
  { title: t("Anthropomorphic arm"), table: anthropomorphic as DhTable },
  { title: t("Spherical wrist"), table: sphericalWrist as DhTable },
  { title: t("Anthropomorphic arm with wrist"), table: anthropomorphicWrist as DhTable },
  { title: t("Stanford arm"), table: stanford as DhTable },
  { title: "SCARA", table: scara as DhTable },
  { title: t("PUMA 560"), table: puma as DhTable },
  { title: t("Panda, modified"), table: panda as DhTable },
];
