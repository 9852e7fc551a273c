/** A motion as a film: pictures at fixed times of the motion, however long each takes to draw. */

import { Gif } from "./gif.ts";
import { Palette } from "./palette.ts";
import { type Picture, webm } from "./webm.ts";

export type Form = "webm" | "gif";

/** What is filmed. */
export interface Shot {
  /** Of the motion, [s]. */
  duration: number;
  /** Of the picture on the screen, [px]. */
  width: number;
  height: number;
  /** Bring everything to a time, [s], and draw it as large as the context's canvas. */
  draw(time: number, context: CanvasRenderingContext2D): void;
}

export interface Film {
  file: Blob;
  pictures: number;
}

/** Between two pictures, [s]: whole hundredths, which is what a GIF can tell. */
export const PERIOD = 0.04;
/** The longer side of the pictures, at most, [px]. */
const SIDE: Readonly<Record<Form, number>> = { webm: 1280, gif: 640 };
/** Pictures from which a GIF takes its colours. */
const SAMPLES = 6;
/** From one picture that needs no other to the next. */
const BETWEEN_KEYS = 50;
/** Bits for a pixel of a picture: lines stay sharp. */
const BITS = 0.2;
const WAITING = 4;

/** @param progress is told how many pictures of how many are there; a signal that is aborted ends it. */
export async function film(
  form: Form,
  shot: Shot,
  progress: (done: number, all: number) => void,
  signal: AbortSignal,
): Promise<Film> {
  const share = Math.min(1, SIDE[form] / Math.max(shot.width, shot.height));
  const canvas = document.createElement("canvas");
  // VP8 has colours for two by two pixels.
  canvas.width = 2 * Math.max(1, Math.round((shot.width * share) / 2));
  canvas.height = 2 * Math.max(1, Math.round((shot.height * share) / 2));
  const context = canvas.getContext("2d", { willReadFrequently: form === "gif" })!;
  const times = timesOf(shot.duration);
  const draw = async (time: number) => {
    await breath();
    signal.throwIfAborted();
    shot.draw(time, context);
  };
  const writer = form === "gif" ? await gifWriter(context, times, draw) : webmWriter(canvas, times);
  try {
    for (const [index, time] of times.entries()) {
      progress(index, times.length);
      await draw(time);
      await writer.add(index);
    }
    return { file: await writer.end(), pictures: times.length };
  } finally {
    writer.close();
  }
}

/** One each period, and the end. */
export function timesOf(duration: number): number[] {
  const count = Math.max(1, Math.ceil(duration / PERIOD - 1e-9));
  return Array.from({ length: count + 1 }, (_, i) => Math.min(i * PERIOD, duration));
}

interface Writer {
  add(index: number): Promise<void>;
  end(): Promise<Blob>;
  /** Let go what it holds, also when it has not come to its end. */
  close(): void;
}

async function gifWriter(
  context: CanvasRenderingContext2D,
  times: readonly number[],
  draw: (time: number) => Promise<void>,
): Promise<Writer> {
  const { width, height } = context.canvas;
  const pixels = () => context.getImageData(0, 0, width, height).data;
  const samples: ArrayLike<number>[] = [];
  for (let i = 0; i < SAMPLES; i += 1) {
    await draw(times[Math.round((i * (times.length - 1)) / (SAMPLES - 1))]!);
    samples.push(pixels());
  }
  const gif = new Gif(width, height, Math.round(100 * PERIOD), new Palette(samples));
  return {
    add: async () => gif.add(pixels()),
    end: async () => new Blob([gif.end()], { type: "image/gif" }),
    close: () => {},
  };
}

function webmWriter(canvas: HTMLCanvasElement, times: readonly number[]): Writer {
  const { width, height } = canvas;
  const pictures: Picture[] = [];
  let failure: DOMException | null = null;
  const encoder = new VideoEncoder({
    output: (chunk) => {
      const data = new Uint8Array(chunk.byteLength);
      chunk.copyTo(data);
      pictures.push({ time: Math.round(chunk.timestamp / 1000), isKey: chunk.type === "key", data });
    },
    error: (error) => (failure = error),
  });
  const framerate = 1 / PERIOD;
  encoder.configure({ codec: "vp8", width, height, framerate, bitrate: Math.round(BITS * width * height * framerate) });
  return {
    add: async (index) => {
      // Equally far apart, as in the GIF: the end is shown as long as the others.
      const frame = new VideoFrame(canvas, { timestamp: Math.round(index * PERIOD * 1e6) });
      encoder.encode(frame, { keyFrame: index % BETWEEN_KEYS === 0 });
      frame.close();
      while (encoder.encodeQueueSize > WAITING && !failure) await breath();
      if (failure) throw failure;
    },
    end: async () => {
      await encoder.flush();
      return webm("V_VP8", width, height, Math.round(times.length * PERIOD * 1000), pictures);
    },
    close: () => {
      if (encoder.state !== "closed") encoder.close();
    },
  };
}

/** Let the page react; a timer would wait for a second where the tab is hidden. */
function breath(): Promise<void> {
  return new Promise((done) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      done();
    };
    port2.postMessage(null);
  });
}
