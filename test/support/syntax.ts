/** Source files as syntax trees, for the tests that hold the project against its own rules. */
import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { parseSync } from '@swc/core'
import { root } from './root'

/** A node of any syntax tree; acorn's and SWC's alike. */
export interface SyntaxNode {
  readonly type: string
  readonly [property: string]: unknown
}

export interface Import {
  /** As written: `./frame-3e`, `node:net`. */
  readonly specifier: string
  /** Only types: nothing is loaded for it at run time. */
  readonly typeOnly: boolean
}

/** The files below a folder, as paths from the root with forward slashes; none when there is no such folder. */
export function filesBelow(folder: string, ending: string): string[] {
  try {
    return readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' })
      .map((name) => `${folder}/${name.replaceAll('\\', '/')}`)
      .filter((name) => name.endsWith(ending))
      .sort()
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return []
    throw error
  }
}

export function readText(path: string): string {
  return readFileSync(join(root, path), 'utf8')
}

export function parseTypeScript(text: string): SyntaxNode {
  const tree: unknown = parseSync(text, { syntax: 'typescript', target: 'es2022' })
  if (!isNode(tree)) throw new Error('not a syntax tree')
  return tree
}

/** Every node of the tree, outermost first. */
export function* nodesOf(value: unknown): Generator<SyntaxNode> {
  if (Array.isArray(value)) {
    for (const item of value) yield* nodesOf(item)
  } else if (typeof value === 'object' && value !== null) {
    if (isNode(value)) yield value
    for (const item of Object.values(value)) yield* nodesOf(item)
  }
}

export function isNode(value: unknown): value is SyntaxNode {
  return typeof value === 'object' && value !== null && 'type' in value && typeof value.type === 'string'
}

/** What a string literal or an identifier says; undefined for any other node. */
export function textOf(node: unknown): string | undefined {
  if (!isNode(node)) return undefined
  return typeof node.value === 'string' ? node.value : undefined
}

/** Every way a TypeScript file names another one: import, export from, import(), require(), import type, import('x').T */
export function importsOf(tree: SyntaxNode): Import[] {
  return [...nodesOf(tree)].flatMap((node): Import[] => {
    const source = textOf(node.source)
    switch (node.type) {
      case 'ImportDeclaration':
      case 'ExportAllDeclaration':
      case 'ExportNamedDeclaration':
        return source === undefined ? [] : [{ specifier: source, typeOnly: node.typeOnly === true || onlyTypes(node) }]
      case 'CallExpression':
        return calledImport(node)
      case 'TsExternalModuleReference':
        return [{ specifier: textOf(node.expression) ?? '?', typeOnly: false }]
      case 'TsImportType':
        return [{ specifier: textOf(node.argument) ?? '?', typeOnly: true }]
      default:
        return []
    }
  })
}

/** `import { type A, type B } from`: nothing is loaded for it either. */
function onlyTypes(node: SyntaxNode): boolean {
  const specifiers = node.specifiers
  return (
    Array.isArray(specifiers) &&
    specifiers.length > 0 &&
    specifiers.every((specifier) => isNode(specifier) && specifier.isTypeOnly === true)
  )
}

function calledImport(node: SyntaxNode): Import[] {
  if (!isNode(node.callee) || !Array.isArray(node.arguments)) return []
  const isImport = node.callee.type === 'Import' || textOf(node.callee) === 'require'
  const argument: unknown = node.arguments[0]
  const expression =
    typeof argument === 'object' && argument !== null && 'expression' in argument ? argument.expression : undefined
  // A computed name cannot be checked; it is told as '?' and no table allows that.
  return isImport ? [{ specifier: textOf(expression) ?? '?', typeOnly: false }] : []
}
