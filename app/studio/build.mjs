/** Bundles the studio into the package, to the same bytes from the same lock file. */

import { createHash } from "node:crypto";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";

import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "..", "gelenk", "studio");
const COMPRESSED = /\.(?:css|html|js|svg|txt)$/;
const OLDER_FORMATS = /,url\([^)]*\.(?:woff|ttf)\) format\("[a-z]+"\)/g;
/** Of commands that no formula of the service has; a test looks for them. */
const UNUSED_FONTS =
  /@font-face\{[^}]*KaTeX_(?:Caligraphic|Fraktur|Script|Typewriter|[A-Za-z]+-BoldItalic|SansSerif-(?:Bold|Italic))\b[^}]*\}/g;

const katexStyle = {
  name: "katex-fonts",
  setup(bundler) {
    bundler.onLoad({ filter: /katex\.min\.css$/ }, ({ path }) => ({
      contents: readFileSync(path, "utf8").replace(OLDER_FORMATS, "").replace(UNUSED_FONTS, ""),
      loader: "css",
    }));
  },
};

/** urdf-loader brings readers of meshes that the page never calls: its own come when they are needed. */
const withoutReaders = {
  name: "without-readers",
  setup(bundler) {
    bundler.onResolve({ filter: /\/(?:STL|Collada)Loader\.js$/ }, ({ importer, path }) =>
      importer.includes("/urdf-loader/") ? { path, namespace: "unused" } : undefined,
    );
    bundler.onLoad({ filter: /.*/, namespace: "unused" }, () => ({
      contents: "export class STLLoader {}\nexport class ColladaLoader {}",
    }));
  },
};

/** The module "gelenk:thumbnails": of each robot's small picture the file, named by its content. */
const thumbnails = {
  name: "thumbnails",
  setup(bundler) {
    bundler.onResolve({ filter: /^gelenk:thumbnails$/ }, ({ path }) => ({ path, namespace: "thumbnails" }));
    bundler.onLoad({ filter: /.*/, namespace: "thumbnails" }, () => ({
      contents: JSON.stringify(copiedThumbnails()),
      loader: "json",
    }));
  },
};

function copiedThumbnails() {
  const folder = join(here, "thumbnails");
  mkdirSync(join(out, "thumbnails"), { recursive: true });
  const pictures = readdirSync(folder).filter((name) => name.endsWith(".webp"));
  return Object.fromEntries(
    pictures.sort().map((name) => {
      const robot = basename(name, ".webp");
      const hash = createHash("sha256")
        .update(readFileSync(join(folder, name)))
        .digest("hex");
      const file = `thumbnails/${robot}-${hash.slice(0, 8).toUpperCase()}.webp`;
      cpSync(join(folder, name), join(out, file));
      return [robot, file];
    }),
  );
}

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const { metafile } = await build({
  absWorkingDir: here,
  entryPoints: { studio: "src/main.ts" },
  outdir: out,
  bundle: true,
  format: "esm",
  splitting: true,
  chunkNames: "chunks/[name]-[hash]",
  target: "es2022",
  minify: true,
  charset: "utf8",
  legalComments: "none",
  loader: { ".woff2": "file" },
  assetNames: "fonts/[name]-[hash]",
  plugins: [katexStyle, withoutReaders, thumbnails],
  metafile: true,
  logLevel: "warning",
});
dropLateStyles(metafile);
for (const name of ["icon.svg", "neutral.svg"]) cpSync(join(here, "page", name), join(out, name));
writeFileSync(join(out, "index.html"), preloading(readFileSync(join(here, "page", "index.html"), "utf8"), metafile));
writeFileSync(join(out, "LICENSES.txt"), licences(metafile));
for (const name of readdirSync(out, { recursive: true })) if (COMPRESSED.test(name)) compress(join(out, name));

/** The bundler writes for each later chunk the style sheets of whatever it imports, which no page asks for: those of the
 * page have them, or nothing has. */
function dropLateStyles({ outputs }) {
  const sheets = Object.entries(outputs).filter(([path]) => path.endsWith(".css"));
  const [, page] = sheets.find(([path]) => basename(path) === "studio.css");
  for (const [path, { inputs }] of sheets) {
    const lacking = Object.keys(inputs).filter((input) => !(input in page.inputs));
    if (lacking.length) throw new Error(`${lacking} is imported by what is loaded later: import it by what is at once`);
    if (basename(path) !== "studio.css") rmSync(join(out, "chunks", basename(path)));
  }
}

/** Beside a file the same by Brotli, which the service sends to who takes it. */
function compress(file) {
  const content = readFileSync(file);
  const size = { [constants.BROTLI_PARAM_SIZE_HINT]: content.length };
  writeFileSync(`${file}.br`, brotliCompressSync(content, { params: size }));
}

/** The page, which asks for what its script imports together with the script itself. */
function preloading(page, { outputs }) {
  const [, { imports }] = Object.entries(outputs).find(([path]) => path.endsWith("/studio.js"));
  const chunks = imports
    .filter(({ kind }) => kind === "import-statement")
    .map(({ path }) => `chunks/${basename(path)}`);
  const links = chunks.map((path) => `<link rel="modulepreload" href="studio/${path}">\n`);
  return page.replace("<script", `${links.join("")}<script`);
}

/** The licence of every package of which something is in the bundle. */
function licences({ inputs }) {
  const names = Object.keys(inputs).map((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1]);
  const packages = [...new Set(names.filter(Boolean))].sort();
  const texts = packages.map((name) => {
    const folder = join(here, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    // A package that leaves its licence out has it beside this script.
    const text = readFileSync(file ? join(folder, file) : join(here, "licences", `${name}.txt`), "utf8");
    return `${name} ${version} (${license})\n\n${text.trim()}\n`;
  });
  return `The studio's bundle contains parts of these packages.\n\n${texts.join(`\n${"-".repeat(72)}\n\n`)}`;
}
