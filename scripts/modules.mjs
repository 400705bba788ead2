// The library as ES modules, one for each source file, for bundlers: they leave out the files that a program does not need.
// Node.js itself takes CommonJS whether it is required or imported, so that a program has one copy of it.
import { join } from 'node:path'

/** What a source file loads when it is needed. A bundler loads nothing later: there it is an import as any other. */
const REQUIRE = /\brequire\('([^']+)'\)/g

/**
 * The text with its `require` as imports. Our own files are taken as their names, a package as what it exports. A package that
 * may be absent is imported where it stands, in a function that is `async`: at the top it would end every program without it.
 */
function withImports(text, optional) {
  const imports = []
  const body = text.replace(REQUIRE, (_, specifier) => {
    if (optional.includes(specifier)) return `(await import('${specifier}'))`
    const name = `required${imports.length}`
    imports.push(`import ${specifier.startsWith('.') ? `* as ${name}` : name} from '${specifier}'\n`)
    return name
  })
  return imports.join('') + body
}

/** Nothing is bundled: every import stays one, by the name of its file. */
const perFile = (readFile, optional) => ({
  name: 'one module per file',
  setup(build) {
    build.onResolve({ filter: /.*/ }, ({ kind, path }) => {
      if (kind === 'entry-point') return undefined
      return { path: path.startsWith('.') ? `${path}.mjs` : path, external: true, sideEffects: false }
    })
    build.onLoad({ filter: /\.ts$/ }, ({ path }) => ({ contents: withImports(readFile(path), optional), loader: 'ts' }))
  },
})

/**
 * @param {readonly string[]} files from the root
 * @param {{ root: string, outdir: string, readFile(path: string): string }} options
 */
export async function buildModules(files, { root, outdir, readFile }) {
  const optional = Object.keys(JSON.parse(readFile(join(root, 'package.json'))).optionalDependencies ?? {})
  const { build } = await import('esbuild')
  await build({
    entryPoints: files.map((file) => join(root, file)),
    outbase: join(root, 'src'),
    outdir,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    format: 'esm',
    target: 'es2022',
    platform: 'neutral',
    charset: 'utf8',
    logLevel: 'error',
    plugins: [perFile(readFile, optional)],
  })
}
