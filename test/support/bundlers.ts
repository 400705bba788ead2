/** Bundlers as programs use them, each as the text of a script that builds `entry` into `outfile`. */
import { execFile } from 'node:child_process'
import { writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { promisify } from 'node:util'
import { root } from './root'

const run = promisify(execFile)

const withEsbuild = (format: string, minify: boolean) => `
import { build } from 'esbuild'
await build({ entryPoints: [entry], outfile, bundle: true, platform: 'node', target: 'node20', format: '${format}', minify: ${minify}${
  format === 'esm'
    ? `, banner: { js: "import { createRequire as makeRequire } from 'node:module'; const require = makeRequire(import.meta.url);" }`
    : ''
}, logLevel: 'error' })`

export const bundlers: Readonly<Record<string, readonly [text: string, extension: string]>> = {
  'esbuild, ESM': [withEsbuild('esm', false), 'mjs'],
  'esbuild, ESM, minified': [withEsbuild('esm', true), 'mjs'],
  'esbuild, CommonJS': [withEsbuild('cjs', false), 'cjs'],
  'esbuild, CommonJS, minified': [withEsbuild('cjs', true), 'cjs'],
  'webpack in production mode': [
    `
import webpack from 'webpack'
import { basename, dirname } from 'node:path'
const stats = await new Promise((resolve, reject) => webpack({
  mode: 'production', target: 'node20', entry, experiments: { topLevelAwait: true },
  output: { path: dirname(outfile), filename: basename(outfile) },
}, (error, stats) => error ? reject(error) : resolve(stats)))
if (stats.hasErrors()) throw new Error(stats.toString())`,
    'cjs',
  ],
  'vite in production mode': [
    `
import { build } from 'vite'
import { basename, dirname } from 'node:path'
await build({
  configFile: false, mode: 'production', logLevel: 'error', root: dirname(entry), ssr: { noExternal: true, target: 'node' },
  build: { ssr: entry, target: 'node20', minify: true, outDir: dirname(outfile), emptyOutDir: false,
    rollupOptions: { output: { format: 'es', entryFileNames: basename(outfile) } } },
})`,
    'mjs',
  ],
}

/** Builds a program that lies in a project with the package, in a process of its own. */
export async function bundle(text: string, entry: string, outfile: string): Promise<void> {
  const script = join(dirname(outfile), 'build.mjs')
  const constants = `const entry = ${JSON.stringify(entry)}; const outfile = ${JSON.stringify(outfile)}`
  writeFileSync(script, resolved(`${text.trimStart()}\n`).replace(/^((?:import [^\n]*\n)*)/, `$1${constants}\n`))
  await run(process.execPath, [script], { cwd: dirname(entry) })
}

/** The bundlers are those of this project. */
function resolved(text: string): string {
  return text.replace(/from '(esbuild|webpack|vite)'/, (_, name: string) => `from ${JSON.stringify(modules[name])}`)
}

const modules: Readonly<Record<string, string>> = {
  esbuild: join(root, 'node_modules/esbuild/lib/main.js'),
  webpack: join(root, 'node_modules/webpack/lib/index.js'),
  vite: join(root, 'node_modules/vite/dist/node/index.js'),
}
