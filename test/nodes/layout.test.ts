/** How the dialogs lie in the editor: on a small screen, with many rows, on a dark theme. */
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import type { PlcSimulator } from '../../src/entry/simulator'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { type NodeRed, startNodeRed } from '../support/node-red'
import { close, edit, picture, turnTo } from './dialog'
import { connectionTo, controlNode, fileNode, ondemandNode, readNode, requestNode, startPlc, writeNode } from './flow'
import { lineNode, stationNode } from './line-flow'

/** The smallest screen that an editor is used on. */
const SMALL = { width: 1024, height: 768 }
const ROWS = 30
/** WCAG 2: text that can be read. */
const READABLE = 4.5

let red: NodeRed
let plc: PlcSimulator
let browser: HeadlessBrowser

beforeAll(async () => {
  plc = await startPlc()
  ;[red, browser] = await Promise.all([startNodeRed(), launchBrowser()])
  // With one that no PLC of the series has, one that is none, and a length beside its type.
  const special = ['D100', 'D110:STRING(20)', 'D99999999', 'D1O']
  const items = Array.from({ length: ROWS }, (_, index) => {
    const [address = `D${200 + index}`, type = 'INT'] = (special[index] ?? '').split(':').filter(Boolean)
    return { name: `v${index}`, address, type, value: '1', valueType: 'num' }
  })
  await red.deploy([
    connectionTo(plc),
    readNode([], { items, x: 200, y: 100 }),
    writeNode({ valuesType: 'rows', items, x: 200, y: 200 }),
    controlNode({ commandType: 'command', command: 'stop', x: 200, y: 300 }),
    requestNode({ command: 'readWords', message: '{"head":"D100","points":1}', messageType: 'json', x: 200, y: 400 }),
    ondemandNode({ topic: 'batches', x: 200, y: 500 }),
    fileNode({ action: 'read', file: '4:/LINE.CSV', x: 200, y: 600 }),
    lineNode({ path: '/dev/serial/by-id/usb-FTDI_FT232R_USB_UART_A10KZ7QX-if00-port0' }),
    stationNode(1, { profile: 'q-c24' }),
  ])
}, 90_000)

afterAll(async () => {
  await browser.close()
  await red.stop()
  await plc.close()
})

/** What of the uppermost dialog lies beside its tray, and how many fields were looked at. */
function beside(page: Page): Promise<{ fields: number; beside: string[] }> {
  return page.evaluate(() => {
    const tray = [...document.querySelectorAll('.red-ui-tray')].at(-1)?.getBoundingClientRect()
    const form = [...document.querySelectorAll('.red-ui-tray .melsec-jw-form')].at(-1)
    const shown = [...(form?.querySelectorAll('input, select, button, label, ul, .melsec-jw-note') ?? [])]
      .map((element) => ({ element, box: element.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0)
    const out = shown.filter(({ box }) => !tray || box.left < tray.left || box.right > tray.right)
    return { fields: shown.length, beside: out.map(({ element }) => element.outerHTML) }
  })
}

/** What is true of the list in the open dialog. */
function listOf(page: Page) {
  return page.evaluate(() => {
    const list = document.querySelector('.melsec-jw-list .red-ui-editableList-container')
    const frame = document.querySelector('.melsec-jw-list .red-ui-editableList-border')?.getBoundingClientRect()
    const leftsOf = (row: Element) => [...row.children].map((part) => Math.round(part.getBoundingClientRect().left))
    const rows = [...document.querySelectorAll('.melsec-jw-list .melsec-jw-row')]
    return {
      head: document.querySelector('.melsec-jw-head')?.textContent,
      scrolls: list !== null && getComputedStyle(list).overflowY === 'auto' && list.scrollHeight > list.clientHeight,
      top: list?.scrollTop,
      bottom: Math.round((list?.getBoundingClientRect().bottom ?? 0) - (frame?.bottom ?? 0)),
      height: frame?.height ?? 0,
      columns: [...new Set(rows.map((row) => leftsOf(row).join(' ')))],
      rows: rows.length,
    }
  })
}

describe.each(['en-US', 'ja', 'zh-CN'])('at 1024 pixels in %s', (locale) => {
  let opened: OpenedPage
  let page: Page

  beforeAll(async () => {
    opened = await browser.openEditor(red.url, { locale, viewport: SMALL })
    page = opened.page
  }, 60_000)

  afterAll(async () => {
    expect(opened.problems).toEqual([])
    await opened.close()
  })

  test.each(['read', 'write', 'control', 'request', 'ondemand', 'file'])(
    'no field of the %s dialog lies beside its tray',
    async (id) => {
      await edit(page, id)
      await picture(page, `${locale} small ${id}`)
      const found = await beside(page)
      expect(found).toEqual({ fields: expect.any(Number), beside: [] })
      expect(found.fields).toBeGreaterThan(2)
      await close(page, 'cancel')
    },
  )

  test('no field of the connection dialog lies beside its tray, on any of its pages', async () => {
    await edit(page, 'plc')
    for (const tab of [0, 1, 2]) {
      await turnTo(page, 'melsec-jw-tabs', tab)
      await picture(page, `${locale} small connection ${tab}`)
      expect(await beside(page)).toEqual({ fields: expect.any(Number), beside: [] })
      if (tab === 0) expect(await page.locator('#node-config-input-port').isVisible()).toBe(true)
    }
    await close(page, 'cancel')
  })

  test.each([
    ['a connection on a serial line', 'plc1', 'melsec-jw-tabs', 3],
    ['the line', 'line', 'melsec-jw-line-tabs', 2],
  ])('no field of the dialog of %s lies beside its tray, on any of its pages', async (_what, id, tabs, pages) => {
    await edit(page, id)
    for (let tab = 0; tab < pages; tab++) {
      await turnTo(page, tabs, tab)
      await picture(page, `${locale} small ${id} ${tab}`)
      const found = await beside(page)
      expect(found).toEqual({ fields: expect.any(Number), beside: [] })
      expect(found.fields).toBeGreaterThan(8)
    }
    await close(page, 'cancel')
  })

  test('no field of a connection lies beside its tray when a read dialog opened it', async () => {
    await edit(page, 'read')
    await page.locator('#node-input-btn-connection-edit').click()
    await page.locator('#node-config-input-port').waitFor()
    await page.locator('#node-config-dialog-cancel').waitFor()
    expect(await beside(page)).toEqual({ fields: expect.any(Number), beside: [] })
    await page.locator('#node-config-dialog-cancel').click()
    await page.locator('#node-config-input-port').waitFor({ state: 'detached' })
    await close(page, 'cancel')
  })
})

describe('with 30 rows', () => {
  let opened: OpenedPage
  let page: Page

  beforeAll(async () => {
    opened = await browser.openEditor(red.url, { viewport: SMALL })
    page = opened.page
  }, 60_000)

  afterAll(async () => {
    expect(opened.problems).toEqual([])
    await opened.close()
  })

  test.each(['read', 'write'])('the list of the %s dialog stays in its frame, below its head', async (id) => {
    await edit(page, id)
    // The dialog is given its height when its tray has come to rest.
    await page.waitForFunction(() => document.querySelector('.melsec-jw-list [style*="height"]') !== null)
    const list = await listOf(page)
    // The head is a row as well. A row with the length of a STRING has its columns where the others have them.
    const columns = [expect.stringMatching(/^\d+ \d+ \d+$/)]
    expect(list).toMatchObject({
      head: 'Name of the itemDeviceData type',
      scrolls: true,
      top: 0,
      columns,
      rows: ROWS + 1,
    })
    expect(Math.abs(list.bottom)).toBeLessThan(3)
    expect(list.height).toBeLessThan(SMALL.height / 2)
    const add = page.getByRole('button', { name: 'add' })
    await add.scrollIntoViewIfNeeded()
    await add.click()
    await page.waitForFunction(
      () => (document.querySelector('.melsec-jw-list .red-ui-editableList-container')?.scrollTop ?? 0) > 0,
    )
    expect((await listOf(page)).height).toBe(list.height)
    await close(page, 'cancel')
  })

  test.each([
    ['dark', '#1e1e1e', '#dddddd'],
    ['light', '#ffffff', '#555555'],
  ])('what is wrong with a row can be read on a %s theme', async (theme, background, text) => {
    await page.addStyleTag({
      content: `:root { --red-ui-primary-background: ${background}; --red-ui-secondary-background: ${background};
        --red-ui-primary-text-color: ${text}; --red-ui-text-color-error: #910000 }`,
    })
    await edit(page, 'read')
    const wrong = page.locator('.melsec-jw-hint.melsec-jw-bad')
    const doubtful = page.locator('.melsec-jw-hint.melsec-jw-doubt')
    await wrong.waitFor()
    await picture(page, `hints ${theme}`)
    expect(await contrast(wrong, 'color', background)).toBeGreaterThan(READABLE)
    expect(await contrast(doubtful, 'color', background)).toBeGreaterThan(READABLE)
    // The mark beside the text says more than its place would: 3 is asked of what is no text.
    expect(await contrast(wrong, 'borderLeftColor', background)).toBeGreaterThan(3)
    await close(page, 'cancel')
  })

  test('an address behind the last one of the series is marked, and the last one is named', async () => {
    await edit(page, 'read')
    const doubtful = page.locator('.melsec-jw-hint.melsec-jw-doubt')
    await doubtful.waitFor()
    expect(await doubtful.count()).toBe(1)
    const row = page.locator('li', { has: doubtful })
    expect(await row.getByRole('textbox', { name: 'Device' }).inputValue()).toBe('D99999999')
    expect(await doubtful.textContent()).toMatch(/iQ-R.+D\d+/)
    await close(page, 'cancel')
  })
})

/** The contrast of a colour of an element with what is behind it, as WCAG 2 computes it. */
async function contrast(
  element: ReturnType<Page['locator']>,
  property: 'color' | 'borderLeftColor',
  background: string,
): Promise<number> {
  const painted = await element.evaluate((found, name) => getComputedStyle(found)[name], property)
  const behind = background.match(/[\da-f]{2}/g)?.map((digits) => Number.parseInt(digits, 16)) ?? []
  const [high = 0, low = 0] = [luminance(painted.match(/\d+/g)?.map(Number) ?? []), luminance(behind)].sort(
    (one, other) => other - one,
  )
  return (high + 0.05) / (low + 0.05)
}

function luminance(colour: readonly number[]): number {
  const [red = 0, green = 0, blue = 0] = colour
    .map((part) => part / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4))
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue
}
