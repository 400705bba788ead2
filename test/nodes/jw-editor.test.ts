/**
 * The dialogs of the nodes with a Sharp JW in the real editor: what a JW has is there, what it does not have is not, in every
 * language and on a small screen. `MELSEC_JW_SCREENSHOTS` names a folder to keep pictures of them in.
 */
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import { jwControls, melsecControls } from '../../nodes/control-commands'
import { families } from '../../nodes/family'
import { describeJwCommand, jwCommands } from '../../src/entry/codec'
import type { JwSimulator, PlcSimulator } from '../../src/entry/simulator'
import { jwModels, jwProbeKinds } from '../../src/index'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { type NodeRed, startNodeRed } from '../support/node-red'
import { readText } from '../support/syntax'
import { close, edit, picture, property } from './dialog'
import { connectionTo, controlNode, fileNode, ondemandNode, readNode, requestNode, startPlc, writeNode } from './flow'
import { jwConnection, startJw } from './jw-flow'

/** The smallest screen that an editor is used on. */
const SMALL = { width: 1024, height: 768 }
const LANGUAGES = ['en-US', 'ja', 'zh-CN', 'zh-TW'] as const
const PARTS = 'label|option|note|button|command|status|explain|device|test|tab|unit|line|placeholder|jwNote|jwCommand'

let red: NodeRed
let plc: JwSimulator
let melsec: PlcSimulator
let browser: HeadlessBrowser

beforeAll(async () => {
  plc = await startJw({ header: 'zero40' })
  melsec = await startPlc()
  ;[red, browser] = await Promise.all([startNodeRed(), launchBrowser()])
  const row = { name: '', address: '09112', type: 'REAL', value: '40.5', valueType: 'num' }
  await red.deploy([
    jwConnection(plc, { header: 'relay', pda: '1', psa: '2', slot: '3', relayStation: '4', timeout: '500' }),
    { ...connectionTo(melsec), id: 'plc2' },
    jwConnection(plc, { id: 'plc3', model: 'jw30h' }),
    readNode({ level: '09012:INT', running: '004033' }, { x: 200, y: 100 }),
    writeNode({ valuesType: 'rows', items: [row], x: 200, y: 200 }),
    controlNode({ version: 2, commandType: 'command', command: 'stop', x: 200, y: 300 }),
    requestNode({ command: 'readDataMemory', message: '{"head":"09000","length":4}', x: 200, y: 400 }),
    ondemandNode({ topic: 'batches', x: 200, y: 500 }),
    fileNode({ action: 'read', file: '4:/LINE.CSV', x: 200, y: 600 }),
  ])
}, 90_000)

afterAll(async () => {
  await browser.close()
  await red.stop()
  await plc.close()
  await melsec.close()
})

const TABS = ['plc', 'line', 'values'] as const

/** Shows a page of the dialog of the connection. The editor takes two clicks in a row for a double click, so it may need another. */
async function showTab(page: Page, name: (typeof TABS)[number]): Promise<void> {
  const shown = page.locator(`#melsec-jw-tab-${name}`)
  for (let tries = 1; ; tries += 1) {
    await page.locator('#melsec-jw-tabs a').nth(TABS.indexOf(name)).click()
    try {
      await shown.waitFor({ timeout: 500 })
      return
    } catch (error) {
      if (tries === 5) throw error
    }
  }
}

/** Fields that are shown, on all pages of the dialog of the connection. */
async function shownFields(page: Page): Promise<string[]> {
  const found: string[] = []
  for (const tab of TABS) {
    await showTab(page, tab)
    found.push(
      ...(await page
        .locator('[id^="node-config-input-"]:visible')
        .evaluateAll((inputs) => inputs.map(({ id }) => id.replace('node-config-input-', '')))),
    )
  }
  return found
}

/** What of the uppermost dialog lies beside its tray or is a key without a text. */
async function faultsOf(page: Page): Promise<unknown> {
  const form = page.locator('.red-ui-tray-body .melsec-jw-form').last()
  const text = (await form.innerText()) + (await form.locator('option').allTextContents()).join('\n')
  const beside = await form.evaluate((element) => {
    const tray = element.closest('.red-ui-tray')?.getBoundingClientRect()
    return [...element.querySelectorAll('input, select, textarea, button, label, .melsec-jw-note')]
      .map((part) => ({ part, box: part.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && (!tray || box.left < tray.left || box.right > tray.right))
      .map(({ part }) => part.outerHTML)
  })
  return { keys: text.match(new RegExp(`\\b(${PARTS})\\.\\w[\\w.-]*`, 'g')), none: /undefined/.exec(text), beside }
}

const NO_FAULTS = { keys: null, none: null, beside: [] }

describe.each(LANGUAGES)('in %s', (language) => {
  let opened: OpenedPage
  let page: Page

  beforeAll(async () => {
    opened = await browser.openEditor(red.url, { locale: language, viewport: SMALL })
    page = opened.page
  }, 60_000)

  afterAll(async () => {
    expect(opened.problems).toEqual([])
    await opened.close()
  })

  test.each(['read', 'write', 'control', 'request', 'ondemand', 'file'])(
    'the %s dialog fits and has its texts',
    async (id) => {
      await edit(page, id)
      if (id === 'read' || id === 'write') await page.locator('.melsec-jw-hint:not(:empty)').first().waitFor()
      await picture(page, `jw ${language} ${id}`)
      expect(await faultsOf(page)).toEqual(NO_FAULTS)
      await close(page, 'cancel')
    },
  )

  test('the dialog of the connection fits and has its texts, with every header and map', async () => {
    await edit(page, 'plc')
    for (const [header, areas] of [
      ['relay', 'printed'],
      ['bytes', 'own'],
    ] as const) {
      await showTab(page, 'line')
      await page.locator('#node-config-input-header').selectOption(header)
      await showTab(page, 'values')
      await page.locator('#node-config-input-areas').selectOption(areas)
      for (const tab of TABS) {
        await showTab(page, tab)
        await picture(page, `jw ${language} connection ${header} ${tab}`)
        expect(await faultsOf(page)).toEqual(NO_FAULTS)
      }
    }
    await close(page, 'cancel')
  })

  test('the titles of commands are there; the English ones are those of the library', () => {
    const catalogue = (node: string) =>
      JSON.parse(readText(`nodes/locales/${language}/${node}.json`)) as Record<string, Record<string, string>>
    const titles = Object.fromEntries(Object.values(jwCommands).map(({ name, title }) => [name, title]))
    const own = catalogue('melsec-jw-connection').jwCommand ?? {}
    expect(Object.keys(own).sort()).toEqual(Object.keys(titles).sort())
    expect(language === 'en-US' ? own : titles).toEqual(titles)
    const control = catalogue('melsec-jw-control')
    for (const part of ['jwCommand', 'jwNote']) {
      expect(Object.keys(control[part] ?? {}).sort()).toEqual(Object.keys(jwControls).sort())
    }
    expect(Object.keys(control.command ?? {}).sort()).toEqual(Object.keys(melsecControls).sort())
  })
})

describe('in English', () => {
  let opened: OpenedPage
  let page: Page

  beforeAll(async () => {
    opened = await browser.openEditor(red.url, { locale: 'en-US', viewport: { width: 1400, height: 1000 } })
    page = opened.page
  }, 60_000)

  afterAll(async () => {
    expect(opened.problems).toEqual([])
    await opened.close()
  })

  const values = (selector: string) =>
    page
      .locator(`${selector} option`)
      .evaluateAll((options) => options.map((option) => (option as HTMLOptionElement).value))

  test('the connection has the settings of its family, and only those', async () => {
    const ofBoth = ['name', 'family', 'host', 'port', 'transport', 'allowWrites', 'allowControl', 'localAddress']
    const further = [
      'localPort',
      'timeout',
      'reconnectFirst',
      'reconnectLongest',
      'queueLimit',
      'encoding',
      'wordOrder',
    ]
    const ofJw = ['model', 'allowParameters', 'header', 'jwProbe', 'gapBytes', 'lists', 'marker', 'maxData', 'areas']
    const ofMelsec = ['way', 'profile', 'code', 'frame', 'password', 'network', 'station', 'moduleIo', 'multidrop']
    const rest = ['extensionStation', 'monitoringTimer', 'probe', 'inFlight', 'gap', 'xyRadix', 'wRadix']
    const relay = ['pda', 'psa', 'slot', 'relayStation']
    const unique = async () => [...new Set(await shownFields(page))].sort()
    await edit(page, 'plc')
    expect(await unique()).toEqual([...ofBoth, ...further, ...ofJw, ...relay].sort())
    await showTab(page, 'plc')
    await page.locator('#node-config-input-family').selectOption('melsec')
    expect(await unique()).toEqual([...ofBoth, ...further, ...ofMelsec, ...rest].sort())
    await close(page, 'cancel')
    await edit(page, 'plc2')
    expect(await unique()).toEqual([...ofBoth, ...further, ...ofMelsec, ...rest].sort())
    await close(page, 'cancel')
  })

  test('the lists are those of the library', async () => {
    await edit(page, 'plc')
    expect(await values('#node-config-input-model')).toEqual([...jwModels])
    expect(await values('#node-config-input-jwProbe')).toEqual([...jwProbeKinds])
    await close(page, 'cancel')
    await edit(page, 'read')
    expect(await values('#melsec-jw-items li:first-child .melsec-jw-type')).toEqual(['', ...families.jw.types])
    await close(page, 'cancel')
    await edit(page, 'request')
    const ofJw300 = Object.values(jwCommands)
      .map((command) => describeJwCommand(command))
      .filter(({ models }) => models?.includes('jw300') !== false)
    expect((await values('#node-input-command')).sort()).toEqual(ofJw300.map(({ name }) => name).sort())
    expect(ofJw300.length).toBe(41)
    await close(page, 'cancel')
  })

  test('another connection brings the commands and types of its family', async () => {
    await edit(page, 'read')
    await page.locator('#node-input-connection').selectOption('plc2')
    await page.locator('#melsec-jw-items li:first-child option[value=BYTE]').waitFor({ state: 'detached' })
    expect(await values('#melsec-jw-items li:first-child .melsec-jw-type')).toEqual(['', ...families.melsec.types])
    await close(page, 'cancel')
    await edit(page, 'request')
    await page.locator('#node-input-connection').selectOption('plc2')
    await page.locator('#node-input-command option[value=readWords]').waitFor({ state: 'attached' })
    expect(await page.locator('#node-input-command option[value=readDataMemory]').count()).toBe(0)
    await page.locator('#node-input-connection').selectOption('plc3')
    await page.locator('#node-input-command option[value=readDataMemory]').waitFor({ state: 'attached' })
    // A JW30H has no lists.
    expect(await page.locator('#node-input-command option[value=monitorRegisters]').count()).toBe(0)
    await close(page, 'cancel')
    await edit(page, 'control')
    expect(await page.locator('.melsec-jw-clear').isVisible()).toBe(false)
    await page.locator('#node-input-connection').selectOption('plc2')
    await page.locator('.melsec-jw-verify-note', { hasText: 'SD203' }).waitFor()
    await close(page, 'cancel')
  })

  test('items are checked in octal while they are typed', async () => {
    await edit(page, 'read')
    await page.getByText('09012 · INT · file 0, byte 004012 · octal numbers', { exact: true }).waitFor()
    await page.getByText('004033 · BOOL · file 0, byte 000403 · bit 3 · octal numbers', { exact: true }).waitFor()
    await page.locator('#melsec-jw-items li:first-child .melsec-jw-address').fill('09018')
    await page.locator('#melsec-jw-items li:first-child .melsec-jw-hint.melsec-jw-bad', { hasText: 'octal' }).waitFor()
    await close(page, 'cancel')
  })

  test.each(['ondemand', 'file'])('the %s node says that a JW has nothing for it', async (id) => {
    await edit(page, id)
    expect(await page.locator('.melsec-jw-lacks').isVisible()).toBe(true)
    await page.locator('#node-input-connection').selectOption('plc2')
    await page.locator('.melsec-jw-lacks').waitFor({ state: 'hidden' })
    await close(page, 'cancel')
  })

  test('a permission that the connection does not give is told', async () => {
    await edit(page, 'control')
    expect(await page.locator('.melsec-jw-off').isVisible()).toBe(true)
    await close(page, 'cancel')
    await edit(page, 'request')
    expect(await page.locator('.melsec-jw-off').isVisible()).toBe(false)
    await page.locator('#node-input-command').selectOption('setSecretFunction')
    expect(await page.locator('#melsec-jw-off-text').textContent()).toContain('parameters')
    await close(page, 'cancel')
  })

  test('the test names the header as the likely cause, finds the right one, and one click takes it over', async () => {
    await edit(page, 'plc')
    await showTab(page, 'line')
    await page.locator('#node-config-input-header').selectOption('none')
    await showTab(page, 'plc')
    await page.locator('#melsec-jw-test').click()
    const result = page.locator('#melsec-jw-test-result')
    await result.locator('li', { hasText: 'another header' }).first().waitFor()
    await picture(page, 'jw test failed')
    await page.getByRole('button', { name: 'Try which header the unit wants' }).click()
    await page.getByRole('button', { name: /Use 40 bytes/ }).click()
    await result.getByText(/Program memory: \d+ K words · PLC is running · write mode: all memory/).waitFor()
    await picture(page, 'jw test good')
    expect(await page.locator('#node-config-input-header').inputValue()).toBe('zero40')
    await close(page, 'ok')
    expect(await property(page, 'plc', 'header')).toBe('zero40')
    expect(await property(page, 'plc', 'version')).toBe(3)
  }, 60_000)
})
