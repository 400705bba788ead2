/** The documentation as data: headings, links, tables and fenced blocks of Markdown files. */
import { filesBelow, readText } from '../support/syntax'

/** What users read: the files of the root and everything in docs/. */
export const pages: readonly string[] = ['README.md', 'CHANGELOG.md', 'CONTRIBUTING.md', ...filesBelow('docs', '.md')]

/** A fenced block. */
export interface Fence {
  readonly page: string
  /** Line of the opening fence, counting from 1. */
  readonly line: number
  /** Words behind the backticks: the language, then what the tests look for. */
  readonly info: readonly string[]
  readonly text: string
}

const FENCE = /^( *)(```+)([^\n`]*)\n([\s\S]*?)^\1\2 *$/gm

export function fencesOf(page: string): Fence[] {
  const text = readText(page)
  return [...text.matchAll(FENCE)].map(({ index, 3: info = '', 4: block = '' }) => ({
    page,
    line: text.slice(0, index).split('\n').length,
    info: info.trim().split(/\s+/),
    text: block,
  }))
}

/** The page without its fenced blocks. */
export function proseOf(page: string): string {
  return readText(page).replace(FENCE, '')
}

/** Texts in single backticks. */
export function codeSpansOf(text: string): string[] {
  return [...text.matchAll(/(?<!`)`([^`\n]+)`(?!`)/g)].map(([, span = '']) => span)
}

/** Targets of links and images, also of those in HTML. */
export function targetsOf(page: string): string[] {
  const prose = proseOf(page).replace(/(?<!`)`[^`\n]+`(?!`)/g, '')
  const markdown = [...prose.matchAll(/\]\(\s*<?([^)\s>]+)>?(?:\s+"[^"]*")?\s*\)/g)]
  const html = [...prose.matchAll(/\b(?:src|href)="([^"]+)"/g)]
  const references = [...prose.matchAll(/^ {0,3}\[[^\]]+\]:\s*(\S+)/gm)]
  return [...markdown, ...html, ...references].map(([, target = '']) => target)
}

/** What GitHub makes of the headings, to be linked to. */
export function anchorsOf(page: string): string[] {
  const seen = new Map<string, number>()
  return [...proseOf(page).matchAll(/^#{1,6} +(.+?) *#*$/gm)].map(([, heading = '']) => {
    const slug = heading
      .toLowerCase()
      .replace(/[^\p{L}\p{N}\s_-]/gu, '')
      .trim()
      .replaceAll(' ', '-')
    const times = seen.get(slug) ?? 0
    seen.set(slug, times + 1)
    return times === 0 ? slug : `${slug}-${times}`
  })
}

/** The rows of the first table behind `<!-- mark -->`, cell by cell, without the header. Empty when there is none. */
export function tableAfter(page: string, mark: string): string[][] {
  const tables = tablesAfter(page, mark)
  return tables[0] ?? []
}

/** As `tableAfter`, for a mark that stands in front of several tables. */
export function tablesAfter(page: string, mark: string): string[][][] {
  const [, ...parts] = proseOf(page).split(`<!-- ${mark} -->`)
  return parts.map((part) => {
    const lines = part.trimStart().split('\n')
    const end = lines.findIndex((line) => !line.startsWith('|'))
    return lines.slice(2, end < 0 ? lines.length : end).map(cellsOf)
  })
}

/** `|` within a cell is written `\|`, also between backticks. */
function cellsOf(line: string): string[] {
  return line
    .trim()
    .replace(/^\||\|$/g, '')
    .split(/(?<!\\)\|/)
    .map((cell) => cell.trim().replaceAll('\\|', '|'))
}

/** The text of a cell that is one code span; undefined when it is something else. */
export function codeOf(cell: string | undefined): string | undefined {
  return /^`([^`]+)`/.exec(cell ?? '')?.[1]
}
