/** What a panel is: a tab at the side, opened when it is chosen and closed when another one is. */

import type { Api } from "../api.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import type { View } from "../view/view.ts";

/** What a panel works with. */
export interface Studio {
  store: Store<State>;
  api: Api;
  /** Null where the browser has no WebGL: a panel must do without the picture. */
  view: View | null;
}

export interface Panel {
  /** In the address bar. */
  id: string;
  /** On the tab. */
  title: string;
  /**
   * Fill the empty host. What it does to the store and the view while open, the answer undoes: stop watching, take
   * what it drew out of the scene.
   */
  open(host: HTMLElement, studio: Studio): () => void;
}
