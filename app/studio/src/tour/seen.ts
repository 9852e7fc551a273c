/** Whether the tour has been seen on this device: kept by the browser. */

const NAME = "gelenk.tour";

export function isSeen(): boolean {
  try {
    return localStorage.getItem(NAME) === "seen";
  } catch {
    return false;
  }
}

export function keepSeen(): void {
  try {
    localStorage.setItem(NAME, "seen");
  } catch {
    // A browser that keeps nothing offers it again.
  }
}
