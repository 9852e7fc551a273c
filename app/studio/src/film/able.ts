/** Whether this browser compresses videos: those that do offer it to pages of a safe origin alone. */
export function canCompress(): boolean {
  return "VideoEncoder" in globalThis;
}
