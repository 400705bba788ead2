/** Links, images, excerpts and names of files in the documentation lead somewhere. */
import { existsSync } from 'node:fs'
import { join, posix } from 'node:path'
import { describe, expect, test } from '@jest/globals'
import { root } from '../support/root'
import { filesBelow, readText } from '../support/syntax'
import { anchorsOf, codeSpansOf, fencesOf, pages, proseOf, targetsOf } from './markdown'

/** What a link of a page leads to, within this project; undefined for addresses of the Internet. */
function resolved(page: string, target: string): { readonly path: string; readonly anchor: string } | undefined {
  if (/^[a-z]+:/i.test(target)) return undefined
  const [path = '', anchor = ''] = target.split('#')
  const file = path === '' ? page : posix.join(posix.dirname(page), decodeURIComponent(path))
  return { path: file, anchor }
}

function problemOf(page: string, target: string): string | undefined {
  const found = resolved(page, target)
  if (found === undefined) return undefined
  const { path, anchor } = found
  if (path.startsWith('..')) return 'leads out of the project'
  if (!existsSync(join(root, path))) return 'does not exist'
  if (anchor === '' || anchorsOf(path).includes(anchor)) return undefined
  return `has no heading for it, only ${anchorsOf(path).join(' ')}`
}

describe.each(pages)('%s', (page) => {
  test('links and images exist, with their headings', () => {
    const problems = targetsOf(page).map((target) => ({ target, problem: problemOf(page, target) }))
    expect(problems.filter(({ problem }) => problem !== undefined)).toEqual([])
  })

  test('files that are named exist', () => {
    const named = codeSpansOf(proseOf(page)).filter((span) =>
      /^(src|nodes|test|scripts|bench|demo|docs|examples|\.ci)\/[\w./-]+$/.test(span),
    )
    expect(named.filter((path) => !existsSync(join(root, path)))).toEqual([])
  })

  test('npm scripts that are named exist', () => {
    const { scripts } = JSON.parse(readText('package.json')) as { scripts: Readonly<Record<string, string>> }
    const named = [...readText(page).matchAll(/\bnpm run ([\w:-]+)/g)].map(([, name = '']) => name)
    expect(named.filter((name) => !(name in scripts))).toEqual([])
  })

  test('excerpts are as in the file they are from', () => {
    const different = fencesOf(page).flatMap(({ line, info, text }) => {
      const at = info.indexOf('from')
      const path = info[at + 1]
      if (at < 0 || path === undefined) return []
      return readText(path).includes(text) ? [] : [`line ${line}: not in ${path}`]
    })
    expect(different).toEqual([])
  })
})

test('every page of docs/ and every example flow is linked from somewhere', () => {
  const linked = new Set(pages.flatMap((page) => targetsOf(page).map((target) => resolved(page, target)?.path)))
  const toBeFound = [...pages.filter((page) => page.startsWith('docs/')), ...filesBelow('examples', '.json')]
  expect(toBeFound.filter((path) => !linked.has(path))).toEqual([])
})

test('the rules themselves see links, anchors and excerpts', () => {
  expect(problemOf('README.md', 'docs/none.md')).toBe('does not exist')
  expect(problemOf('README.md', '../secret')).toBe('leads out of the project')
  expect(problemOf('docs/errors.md', 'addresses.md#no-such-heading')).toMatch(/has no heading/)
  expect(problemOf('docs/errors.md', 'addresses.md#x-and-y-octal-or-hexadecimal')).toBeUndefined()
  expect(problemOf('README.md', 'https://nodered.org')).toBeUndefined()
  expect(targetsOf('docs/architecture.md')).toContain('../test/vectors/README.md')
  expect(fencesOf('docs/architecture.md').some(({ info }) => info.includes('from'))).toBe(true)
})
