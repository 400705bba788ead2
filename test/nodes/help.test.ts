/** The help of the nodes as the editor shows it: Node-RED's own markdown has lists that a colon can end too early. */
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { type NodeRed, startNodeRed } from '../support/node-red'
import { filesBelow, readText } from '../support/syntax'

let red: NodeRed
let browser: HeadlessBrowser
let opened: OpenedPage

beforeAll(async () => {
  ;[red, browser] = await Promise.all([startNodeRed(), launchBrowser()])
  opened = await browser.openEditor(red.url)
}, 90_000)

afterAll(async () => {
  await browser.close()
  await red.stop()
})

interface Shown {
  readonly terms: number
  readonly emptyTerms: number
  readonly codes: readonly string[]
  /** The word "code" stands for what is in code. */
  readonly plain: string
}

/** Renders a text as the help sidebar does. */
function shown(markdown: string): Promise<Shown> {
  return opened.page.evaluate((text) => {
    const { RED } = globalThis as unknown as { RED: { utils: { renderMarkdown(text: string): string } } }
    const box = document.createElement('div')
    box.innerHTML = RED.utils.renderMarkdown(text)
    const codes = [...box.querySelectorAll('code')]
    const terms = [...box.querySelectorAll('dt, dd')]
    const seen = {
      terms: box.querySelectorAll('dt').length,
      emptyTerms: terms.filter((each) => (each.textContent ?? '').trim() === '').length,
      codes: codes.map((code) => code.textContent ?? ''),
    }
    for (const code of codes) code.replaceWith('code')
    return { ...seen, plain: box.textContent ?? '' }
  }, markdown)
}

function helpTexts(): string[] {
  return filesBelow('nodes/locales', '.html')
}

test('there is help for each node in four languages', () => {
  const { 'node-red': registered } = JSON.parse(readText('package.json')) as { 'node-red': { nodes: object } }
  const wanted = Object.keys(registered.nodes).flatMap((name) =>
    ['en-US', 'ja', 'zh-CN', 'zh-TW'].map((language) => `nodes/locales/${language}/${name}.html`),
  )
  expect(helpTexts().sort()).toEqual(wanted.sort())
})

test.each(helpTexts())('%s has all its terms and code, and nothing stray', async (path) => {
  const markdown = readText(path).replaceAll(/<\/?script[^>]*>/g, '')
  const { terms, emptyTerms, codes, plain } = await shown(markdown)
  const written = [...markdown.matchAll(/`([^`\n]+)`/g)].map(([, code]) => code)
  expect(codes).toEqual(written)
  expect({ terms, emptyTerms }).toEqual({ terms: markdown.match(/^: /gm)?.length ?? 0, emptyTerms: 0 })
  expect(plain).not.toMatch(/`|\*|^\s*[:#|-]|\s:\s/m)
})
