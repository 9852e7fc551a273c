/** The steps of this tab, kept by the browser while its page is loaded anew. */

import { type Doc, DOCUMENT } from "./doc.ts";
import type { Row } from "./past.ts";

const NAME = "gelenk.steps";

/** Keep them for a page that opens at this address. */
export function keepSteps(hash: string, row: Row<Doc>): void {
  try {
    sessionStorage.setItem(NAME, JSON.stringify({ hash, ...row }));
  } catch {
    // A browser that keeps nothing, or not so much: then undo begins anew, and not with others' steps.
    forget();
  }
}

/** What is kept for the address; null where that is nothing, or of a page that had other documents. */
export function keptSteps(hash: string): Row<Doc> | null {
  try {
    const { hash: own, ...row } = JSON.parse(sessionStorage.getItem(NAME) ?? "{}") as Row<Doc> & { hash?: string };
    const keys = [...DOCUMENT].sort().join();
    const isWhole = row.states.every((doc) => Object.keys(doc).sort().join() === keys) && row.at in row.states;
    return own === hash && isWhole ? row : null;
  } catch {
    return null;
  }
}

function forget(): void {
  try {
    sessionStorage.removeItem(NAME);
  } catch {
    // Nothing is kept.
  }
}
