/** Which strings of the sources people read, and which only look like it. */

/** Files without texts of the page, or with their own in both languages. */
export const FILES_WITHOUT =
  /^(?:schema|types|npy|glsl|texts\/index|robot\/(?:glb|originals)|panels\/exercises\/texts|ui\/mathematics)\.ts$/;

/** Properties that people read wherever they stand, single words in lower case too. */
export const READ = new Set([
  "text",
  "title",
  "label",
  "placeholder",
  "alt",
  "detail",
  "aria-label",
  "aria-valuetext",
  "aria-description",
  "aria-roledescription",
]);

/** Properties that nobody reads, wherever they stand. */
export const UNREAD =
  /^(?:class|id|role|href|src|path|accept|Accept|style|Authorization|font|cache|block|inline|pattern|url|rel|target|data-.*|on\w+)$/;

/** Properties that have words of the service, and in tables by such words sentences. */
export const WIRE = /^(?:type|value|kind|method|part|page|panel|robots?|tag|option|tone|shape|axis)$/;

/** Functions whose arguments are tags, and behind them what people read. */
export const MAKERS = new Set(["element", "svg", "node"]);

/** Functions none of whose strings people read. */
export const SILENT = new Set([
  ...["matchMedia", "colour", "paint", "chosen", "choosing", "formula", "tex", "RegExp", "URL", "Error"],
]);

/** Methods none of whose strings people read. */
export const SILENT_METHODS = new Set([
  ...["querySelector", "querySelectorAll", "closest", "matches", "getElementById", "createElement", "createElementNS"],
  ...["addEventListener", "removeEventListener", "dispatchEvent", "getPropertyValue", "setProperty", "getContext"],
  ...["getAttribute", "hasAttribute", "removeAttribute", "toggleAttribute", "getItem", "setItem", "removeItem"],
  ...[
    "startsWith",
    "endsWith",
    "includes",
    "split",
    "replace",
    "replaceAll",
    "indexOf",
    "localeCompare",
    "test",
    "exec",
  ],
  ...["has", "get", "set", "watch", "add", "toggle", "remove"],
]);

/** Units, names and words of formats, which are the same in every language. */
export const SAME =
  /\b(?:m\/s²|mm|cm|km|ms|Nm|rad|deg|kg|MB|kB|GB|dB|px|Hz|rpm|Gelenk|URDF|xacro|MJCF|STL|OBJ|DAE|PNG|SVG|CSV|JSON|LaTeX|NumPy|MATLAB|Python|curl|NaN|RPY|XYZ|ZYX|ZYZ|DH|API|NPY|TRAC|SCARA|UR5e?|Panda)\b/g;

/** Functions and constants that write programs, names in the scene or numbers, not texts; all that stands in them. */
export const WRITERS = {
  "share.ts": ["frame", "notebook"],
  "ui/matrices.ts": ["WRITINGS"],
  "ui/request.ts": ["curl", "python", "json", "literal", "flat", "write", "KEY"],
  "view/colours.ts": ["colour", "paint"],
};

/** Single words in lower case that people read all the same, in files where nothing else is that word. */
export const WORDS = {
  "panels/ik/solutions.ts": ["free: {}"],
  "panels/jacobian/axes.ts": ["unbounded"],
  "panels/jacobian/matrix.ts": ["unbounded"],
  "panels/trajectory/editor.ts": ["shortest", "none", "by"],
  "panels/trajectory/loads.ts": ["shown", "none"],
  "panels/trajectory/scene.ts": ["start"],
  "panels/trajectory/settings.ts": ["shortest", "assumed", "none"],
  "panels/trajectory/tool.ts": ["none"],
};

/** What only looks like a text: a file, and the strings as they stand there, `{}` for each value. */
export const EXCEPTIONS = {
  "construction/build.ts": ["rod {}"],
  "view/ghosts.ts": ["ghost {}"],
  "view/table.ts": ["dimension {} {}"],
  "panels/exercises/exercises.ts": ["English", "Deutsch"], // each in itself
  "page.ts": ["EN: the page in English", "DE: die Seite auf Deutsch"],
  "panels/worked/index.ts": ["cos(q₁ + q₂)"],
  "share.ts": ["embed{}"],
  "history/acts.ts": ["Shift", "Control", "Alt", "Meta", "AltGraph"],
  "panels/course/chart.ts": ["grid zero", "curve curve-{}", "mark {}"],
  "panels/course/encoder.ts": ["curve curve-{}"],
  "panels/course/flyOver.ts": ["curve curve-1"],
  "panels/course/mechanism.ts": ["link {}"], // a name that the service is sent
  "panels/course/mobility.ts": ["{} value", "bar {}", "plate {}", "mark curve-{}", "curve-{} value"],
  "panels/course/orientation.ts": ["then/{}/", "{}position", "{}project", "axis-{} value"],
  "panels/course/svg.ts": ["{} grip", "{} head"],
};
