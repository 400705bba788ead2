// The API report: every exported name with its signature, from the declarations that `npm run build` makes.
//
//   npm run api                    writes test/api/report.txt
//   node scripts/api.mjs --print   prints as JSON what test/api/api.test.ts compares
//
// TypeScript's own programming interface reads the declarations. It is marked unstable: it may change with the version, which
// package-lock.json fixes.
import { writeFileSync } from 'node:fs'
import { join, relative } from 'node:path'
import { SyntaxKind } from 'typescript/unstable/ast'
import { API, NodeBuilderFlags, SymbolFlags } from 'typescript/unstable/sync'
import { main, root, SetupError, setup } from './setup.mjs'

const REPORT = join(root, 'test', 'api', 'report.txt')
const PACKAGE = '@melsec-jw/plc'
const entries = { '': 'index', '/address': 'entry/address', '/codec': 'entry/codec', '/simulator': 'entry/simulator' }

/** What may change in any version has this tag: the report says that it is there, and not what it looks like. */
const UNSTABLE = 'experimental'

/** The base of the classes of errors is exported as `PlcError`. */
const OTHERWISE_NAMED = ['BaseError']

const FLAGS = NodeBuilderFlags.NoTruncation | NodeBuilderFlags.InTypeAlias

const isOurs = (path) => /\/dist\/src\//.test(path)

/** As TypeScript names files on every system. */
const slashed = (path) => path.replaceAll('\\', '/')

/** A text in the form of the report: without comments and without the files that TypeScript imports types from. */
function plain(text) {
  return (
    text
      .replaceAll(/^[ \t]*\/\*\*[\s\S]*?\*\/\n?/gm, '')
      .replaceAll(/\bimport\("[^"]+"\)\./g, '')
      .replaceAll(/^(export )?(declare )?/g, '')
      .replaceAll(/\n{2,}/g, '\n')
      // Where docstrings stood among parameters.
      .replaceAll(/\(\n\s+/g, '(')
      .replaceAll(/, *\n\s+/g, ', ')
      .trimEnd()
  )
}

const isHidden = (member) =>
  member.name?.kind === SyntaxKind.PrivateIdentifier ||
  member.modifiers?.some(({ kind }) => kind === SyntaxKind.PrivateKeyword || kind === SyntaxKind.ProtectedKeyword)

function membersOf(node) {
  return (node.members ?? []).filter((member) => !isHidden(member))
}

/** A class without what is private. */
function classText(node) {
  const [first] = node.members
  const head = first === undefined ? node.getText() : node.getText().slice(0, first.getFullStart() - node.getStart())
  return [plain(head), ...membersOf(node).map((member) => `    ${plain(member.getText())}`), '}'].join('\n')
}

function tagsOf(node) {
  return (node.jsDoc ?? []).flatMap(({ tags }) => [...(tags ?? [])].map(({ tagName }) => tagName.text))
}

/** The docstring of a declaration; that of a constant is before its statement. */
function documented(node) {
  const at = node.kind === SyntaxKind.VariableDeclaration ? node.parent.parent : node
  return { text: (at.jsDoc ?? []).map((doc) => doc.getText()).join(''), tags: tagsOf(at) }
}

function signature(name, node) {
  if (documented(node).tags.includes(UNSTABLE)) return `${name}: may change in any version`
  if (node.kind === SyntaxKind.ClassDeclaration) return classText(node)
  if (node.kind === SyntaxKind.VariableDeclaration) return `const ${plain(node.getText())}`
  return plain(node.getText())
}

/** Every name of a type in a declaration. */
function* namesIn(node) {
  if (isHidden(node)) return
  const named = node.typeName ?? (node.kind === SyntaxKind.ImportType && !node.isTypeOf ? node.qualifier : undefined)
  if (named !== undefined) yield leftmost(named)
  if (node.kind === SyntaxKind.ExpressionWithTypeArguments) yield leftmost(node.expression)
  const children = []
  node.forEachChild((child) => void children.push(child))
  for (const child of children) yield* namesIn(child)
}

/** A type that is computed from another: the steps on the way have no names for users. */
function isComputed(node) {
  return node.typeParameters !== undefined && node.type?.kind === SyntaxKind.ConditionalType
}

function hasQuery(node) {
  return (
    node.kind === SyntaxKind.TypeQuery ||
    (node.kind === SyntaxKind.TypeOperator && node.operator === SyntaxKind.KeyOfKeyword) ||
    node.forEachChild((child) => hasQuery(child) || undefined) === true
  )
}

function leftmost(name) {
  return name.left === undefined ? name : leftmost(name.left)
}

/** Members of a type, of an alias also those of the objects that it consists of. */
function ownMembers(node) {
  if (node.kind === SyntaxKind.TypeAliasDeclaration || node.kind === SyntaxKind.ParenthesizedType)
    return ownMembers(node.type)
  if (node.types !== undefined) return [...node.types].flatMap(ownMembers)
  return membersOf(node)
}

class Reader {
  constructor(project) {
    this.project = project
    this.checker = project.checker
  }

  resolved(symbol) {
    return symbol.flags & SymbolFlags.Alias ? this.checker.getAliasedSymbol(symbol) : symbol
  }

  /** Names of the entry with the symbols behind them. */
  exportsOf(file) {
    const source = this.project.program.getSourceFile(slashed(join(root, 'dist', 'src', `${file}.d.ts`)))
    const module = this.checker.getSymbolAtLocation(source)
    return this.checker.getExportsOfModule(module).map((symbol) => [symbol.name, this.resolved(symbol)])
  }

  declarationsOf(symbol) {
    return symbol.declarations.map((handle) => handle.resolve(this.project))
  }

  /** `keyof typeof devices` says nothing, nor does an alias that is not exported: what it comes to is written then. */
  isExpanded(node) {
    if (node.kind !== SyntaxKind.TypeAliasDeclaration || node.typeParameters !== undefined) return false
    return hasQuery(node) || this.missing(node).length > 0
  }

  signature(name, symbol, node) {
    const isHere = node.kind === SyntaxKind.TypeAliasDeclaration && !documented(node).tags.includes(UNSTABLE)
    if (!isHere || !this.isExpanded(node)) return signature(name, node)
    const type = this.checker.getDeclaredTypeOfSymbol(symbol)
    return `type ${name} = ${this.checker.typeToString(type, node, FLAGS)}`
  }

  /** Types of ours that a declaration names and no entry exports. */
  missingIn(name, symbol, node) {
    if (documented(node).tags.includes(UNSTABLE) || isComputed(node)) return []
    return this.missing(node)
      .map(({ name }) => name)
      .filter((type) => !this.isExpanded(node) || new RegExp(`\\b${type}\\b`).test(this.signature(name, symbol, node)))
  }

  missing(node) {
    const symbols = this.checker.getSymbolAtLocation([...namesIn(node)]).filter((symbol) => symbol !== undefined)
    return symbols
      .map((symbol) => this.resolved(symbol))
      .filter((symbol) => !(symbol.flags & SymbolFlags.TypeParameter) && !this.exported.has(symbol.id))
      .filter(
        ({ declarations, name }) => declarations.some(({ path }) => isOurs(path)) && !OTHERWISE_NAMED.includes(name),
      )
  }
}

/** A name and its members without a docstring. Of several signatures one has it for all. */
function undocumented(name, nodes) {
  if (nodes.some((node) => documented(node).tags.includes(UNSTABLE))) return []
  const members = new Map()
  for (const node of nodes) {
    for (const member of ownMembers(node).filter(({ kind }) => kind !== SyntaxKind.Constructor)) {
      const key = `${name}.${member.name?.getText() ?? member.getText()}`
      members.set(key, members.get(key) === true || documented(member).text !== '')
    }
  }
  const bare = [...members].flatMap(([key, isDocumented]) => (isDocumented ? [] : [key]))
  return nodes.some((node) => documented(node).text !== '') ? bare : [name, ...bare]
}

function read() {
  const api = new API({ cwd: root })
  try {
    const config = slashed(join(root, 'test', 'api', 'tsconfig.json'))
    const reader = new Reader(api.updateSnapshot({ openProjects: [config] }).getProject(config))
    const listed = Object.entries(entries).map(([path, file]) => [`${PACKAGE}${path}`, reader.exportsOf(file)])
    reader.exported = new Set(listed.flatMap(([, symbols]) => symbols.map(([, symbol]) => symbol.id)))
    const signatures = new Map()
    const symbolOf = new Map()
    const missing = new Set()
    const bare = new Set()
    for (const [name, symbol] of listed.flatMap(([, symbols]) => symbols)) {
      if (symbolOf.get(name) !== undefined && symbolOf.get(name) !== symbol.id) {
        throw new SetupError(`Two entries export different things as ${name}.`)
      }
      symbolOf.set(name, symbol.id)
      const nodes = reader.declarationsOf(symbol)
      signatures.set(name, nodes.map((node) => reader.signature(name, symbol, node)).join('\n'))
      for (const node of nodes) {
        for (const type of reader.missingIn(name, symbol, node)) missing.add(`${type} (${name})`)
      }
      for (const member of undocumented(name, nodes)) bare.add(member)
    }
    const lists = listed.map(([entry, symbols]) => [entry, ...symbols.map(([name]) => `    ${name}`).sort()].join('\n'))
    const texts = [...signatures].sort(([a], [b]) => (a < b ? -1 : 1)).map(([, text]) => text)
    const head = `What ${PACKAGE} exports. Written by \`npm run api\`; test/api/api.test.ts compares it.`
    const report = `${[head, ...lists, ...texts].join('\n\n')}\n`
    return { report, missing: [...missing].sort(), undocumented: [...bare].sort() }
  } finally {
    api.close()
  }
}

await main(async () => {
  const print = process.argv.includes('--print')
  if (!print) await setup({ buildOnly: true })
  const found = read()
  if (print) return void console.log(JSON.stringify(found))
  writeFileSync(REPORT, found.report)
  console.log(`${relative(root, REPORT)} is written.`)
})
