/**
 * The dialogs of the nodes in the real editor, in a headless browser. `MELSEC_JW_SCREENSHOTS` names a folder to keep
 * pictures of them in.
 */
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import type { Locator, Page } from 'playwright-core'
import { devices, typeNames } from '../../src/entry/address'
import { commands } from '../../src/entry/codec'
import type { LineSimulator, PlcSimulator } from '../../src/entry/simulator'
import { baudRates, profileIds, profiles, serialFrameNames } from '../../src/index'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { type FlowNode, type NodeRed, startNodeRed } from '../support/node-red'
import { filesBelow, readText } from '../support/syntax'
import { close, type Editor, edit, picture, property } from './dialog'
import {
  connectionTo,
  controlNode,
  fileNode,
  ondemandNode,
  portOf,
  readNode,
  requestNode,
  startPlc,
  writeNode,
} from './flow'
import { lineTo, startLine, stationNode } from './line-flow'

const LANGUAGES = ['en-US', 'ja', 'zh-CN', 'zh-TW'] as const

let red: NodeRed
let plc: PlcSimulator
let line: LineSimulator
let browser: HeadlessBrowser

beforeAll(async () => {
  plc = await startPlc()
  line = await startLine()
  ;[red, browser] = await Promise.all([startNodeRed(), launchBrowser()])
  const row = { name: '', address: 'D112', type: 'REAL', value: '40.5', valueType: 'num' }
  await red.deploy([
    connectionTo(plc),
    readNode({ level: 'D100:REAL', inlet: 'Y20' }, { x: 200, y: 100 }),
    writeNode({ valuesType: 'rows', items: [row], x: 200, y: 200 }),
    controlNode({ commandType: 'command', command: 'stop', x: 200, y: 300 }),
    requestNode({ command: 'readWords', message: '{"head":"D100","points":1}', messageType: 'json', x: 200, y: 400 }),
    ondemandNode({ topic: 'batches', x: 200, y: 500 }),
    fileNode({ action: 'read', file: '4:/LINE.CSV', x: 200, y: 600 }),
    lineTo(line),
    stationNode(1, { profile: '' }),
  ])
}, 90_000)

afterAll(async () => {
  await browser.close()
  await red.stop()
  await plc.close()
  await line.close()
})

/** With keys, because the palette looks at what is typed when a key is let go. */
async function type(field: Locator, text: string): Promise<void> {
  await field.fill(text)
  await field.press('End')
}

async function open(locale: string): Promise<OpenedPage> {
  return browser.openEditor(red.url, { locale, viewport: { width: 1400, height: 1000 } })
}

describe('in English', () => {
  let opened: OpenedPage
  let page: Page

  beforeAll(async () => {
    opened = await open('en-US')
    page = opened.page
  }, 60_000)

  afterAll(async () => {
    expect(opened.problems).toEqual([])
    await opened.close()
  })

  test('the palette has the nodes under PLC, with their labels', async () => {
    const category = page.locator('#red-ui-palette-PLC, [id="red-ui-palette-container-PLC"]').first()
    await category.scrollIntoViewIfNeeded()
    const labels = await category.locator('.red-ui-palette-label').allTextContents()
    // The editor breaks a long label into lines, at a hyphen too.
    const whole = labels.map((label) => label.replaceAll(/\s+/g, ' ').replace(' -', '-'))
    expect(whole.sort()).toEqual([
      'MELSEC control',
      'MELSEC file',
      'MELSEC on-demand',
      'MELSEC read',
      'MELSEC request',
      'MELSEC write',
    ])
    await picture(page, 'palette')
  })

  test.each(['slmp', 'mitsubishi', 'mc protocol', 'fx5', 'melsec', 'MCプロトコル'])(
    'the palette finds the nodes by the word %s',
    async (word) => {
      const search = page.locator('#red-ui-palette-search input')
      await type(search, word)
      await page.locator('.red-ui-palette-node[data-palette-type="inject"]').waitFor({ state: 'hidden' })
      await expect(page.locator('.red-ui-palette-node[data-palette-type^="melsec-jw-"]:visible').count()).resolves.toBe(
        6,
      )
      await type(search, '')
      await page.locator('.red-ui-palette-node[data-palette-type="inject"]').waitFor()
    },
  )

  test('a node without a name is called by its first item', async () => {
    const labels = await page.locator('.red-ui-flow-node-label-text').allTextContents()
    expect(labels).toEqual(
      expect.arrayContaining([
        'level +1',
        'D112',
        'read a file 4:/LINE.CSV',
        'remote STOP',
        'Read (word units)',
        'batches',
      ]),
    )
  })

  test('the statuses of the nodes are in words', async () => {
    await expect(page.locator('.red-ui-flow-node-status-label', { hasText: 'connected' }).count()).resolves.toBe(6)
  })

  test('the read dialog says what each row will read, while it is typed', async () => {
    await edit(page, 'read')
    const hints = page.locator('.melsec-jw-hint')
    await hints.getByText('D100 – D101 · data register · REAL · 2 words · decimal numbers').waitFor()
    await hints.getByText('Y20 · output · BOOL · 1 bit · hexadecimal numbers').waitFor()
    const address = page.getByRole('textbox', { name: 'Device' }).first()
    await address.fill('D100[3]')
    await page.getByRole('combobox', { name: 'Data type' }).first().selectOption('STRING')
    await page.getByRole('textbox', { name: 'Length in characters' }).first().fill('10')
    await hints.getByText('D100 – D114 · data register · STRING(10) × 3 · 15 words').waitFor()
    await address.fill('D10O')
    await page.locator('.melsec-jw-hint.melsec-jw-bad').waitFor()
    expect(await address.getAttribute('aria-invalid')).toBe('true')
    await picture(page, 'read')
    await address.fill('Line1.Name[0]:STRING(10)[3]')
    await hints.getByText('label Line1.Name[0] · × 3 · must be STRING(10)').waitFor()
    await address.fill('D102')
    await hints.getByText('D102 – D106').waitFor()
    await page.getByRole('button', { name: 'add' }).click()
    await page.getByRole('textbox', { name: 'Device' }).last().fill('Line1.Speed')
    await hints.getByText('label Line1.Speed · the PLC says its type').waitFor()
    await page.getByRole('textbox', { name: 'Device' }).last().fill('M10')
    await hints.getByText('M10 · internal relay').waitFor()
    await close(page, 'ok')
    expect(await property(page, 'read', 'items')).toEqual([
      { name: 'level', address: 'D102', type: 'STRING(10)' },
      { name: 'inlet', address: 'Y20', type: '' },
      { name: '', address: 'M10', type: '' },
    ])
  })

  test('the read dialog takes addresses from the message, and cancelling changes nothing', async () => {
    await edit(page, 'read')
    const before = await property(page, 'read', 'addressesType')
    await page
      .locator('#node-input-addresses ~ .red-ui-typedInput-container, .red-ui-typedInput-container')
      .first()
      .locator('button')
      .first()
      .click()
    await page.locator('.red-ui-typedInput-options:visible').getByText('msg.', { exact: true }).click()
    await page.getByText('A device such as D100:REAL').waitFor()
    expect(await page.locator('#melsec-jw-items').isVisible()).toBe(false)
    await picture(page, 'read from message')
    await close(page, 'cancel')
    expect(await property(page, 'read', 'addressesType')).toBe(before)
  })

  test('the write dialog keeps the values of its rows and says when writing is off', async () => {
    await edit(page, 'write')
    await page.getByText('This connection does not allow writing.').waitFor()
    await page.locator('.melsec-jw-hint').getByText('D112 – D113 · data register · REAL').waitFor()
    await picture(page, 'write')
    await close(page, 'ok')
    expect(await property(page, 'write', 'items')).toEqual([
      { name: '', address: 'D112', type: 'REAL', value: '40.5', valueType: 'num' },
    ])
  })

  test('the on-demand dialog shows what its text and its connection need', async () => {
    await edit(page, 'ondemand')
    const shown = (note: string) => page.locator(`.melsec-jw-${note}`).isVisible()
    expect([await shown('text'), await shown('udp'), await shown('1e')]).toEqual([false, false, false])
    await page.locator('#node-input-output').selectOption('text')
    expect(await shown('text')).toBe(true)
    await picture(page, 'ondemand')
    await close(page, 'ok')
    expect([await property(page, 'ondemand', 'output'), await property(page, 'ondemand', 'topic')]).toEqual([
      'text',
      'batches',
    ])
  })

  test('the on-demand dialog tells that 1E has none where the series of the connection speaks 1E', async () => {
    const connect = (profile: unknown, frame: unknown) =>
      page.evaluate(
        ([p, f]) => Object.assign((globalThis as unknown as Editor).RED.nodes.node('plc'), { profile: p, frame: f }),
        [profile, frame] as const,
      )
    const before = [await property(page, 'plc', 'profile'), await property(page, 'plc', 'frame')] as const
    for (const [profile, frame, is1e] of [
      ['fx3', '', true],
      ['iq-f', '', false],
      ['iq-f', '1E', true],
    ] as const) {
      await connect(profile, frame)
      await edit(page, 'ondemand')
      expect([profile, frame, await page.locator('.melsec-jw-1e').isVisible()]).toEqual([profile, frame, is1e])
      await close(page, 'cancel')
    }
    await connect(...before)
  })

  test('the control dialog shows what a command does, and what it needs', async () => {
    await edit(page, 'control')
    await page.getByText('The program stops, and outputs go off as the parameters say.').waitFor()
    await page.getByText('This connection does not allow remote control.').waitFor()
    expect(await page.locator('#node-input-clear').isVisible()).toBe(false)
    await picture(page, 'control')
    await close(page, 'ok')
    expect([await property(page, 'control', 'command'), await property(page, 'control', 'commandType')]).toEqual([
      'stop',
      'command',
    ])
  })

  test('the request dialog shows the fields of a command, puts an example, and checks the message', async () => {
    await edit(page, 'request')
    const checked = page.locator('#melsec-jw-checked')
    await checked.getByText('This PLC can be asked so.').waitFor()
    const fields = page.locator('#melsec-jw-fields')
    expect(await fields.innerText()).toMatch(/^head\na device such as "D100".*\npoints\na whole number from 1 to 65535/)
    await page.locator('#node-input-command').selectOption('writeRandomBits')
    await page.getByText('This connection does not allow writing.').waitFor()
    expect(await fields.innerText()).toContain('bits[].device')
    expect(await page.locator('#node-input-message').inputValue()).toBe('{"bits":[{"device":"M100","value":true}]}')
    await page.locator('#melsec-jw-example').click()
    await checked.getByText('This PLC can be asked so.').waitFor()
    await picture(page, 'request')
    await close(page, 'ok')
    expect([await property(page, 'request', 'command'), await property(page, 'request', 'message')]).toEqual([
      'writeRandomBits',
      '{"bits":[{"device":"M100","value":true}]}',
    ])
  })

  test('the request dialog says what is wrong, and keeps what was typed when another command is chosen', async () => {
    await edit(page, 'request')
    await page.evaluate(() => {
      const input = $('#node-input-message') as unknown as { typedInput(name: string, value: string): void }
      input.typedInput('value', '{"bits":[]}')
    })
    await page.locator('#melsec-jw-checked.melsec-jw-bad').getByText('bits has 0 element(s)').waitFor()
    await page.locator('#node-input-command').selectOption('readBits')
    expect(await page.locator('#node-input-message').inputValue()).toBe('{"bits":[]}')
    await page.locator('#melsec-jw-checked.melsec-jw-bad').getByText('it has head, points').waitFor()
    await close(page, 'cancel')
  })

  test('the request dialog reaches the buffer memory of modules', async () => {
    await edit(page, 'request')
    await page.locator('#node-input-mode').selectOption('module')
    await page.locator('#node-input-model').selectOption('Q62DA')
    await page.locator('#node-input-startIo').fill('0030')
    expect(await page.locator('#node-input-slot0').isVisible()).toBe(false)
    await picture(page, 'request module')
    await page.locator('#node-input-model').selectOption('QD62')
    await page.locator('#node-input-slot0').selectOption('1')
    await close(page, 'ok')
    await edit(page, 'request')
    expect(await page.locator('#node-input-slot0').inputValue()).toBe('1')
    await page.locator('#node-input-model').selectOption('Q62DA')
    expect(await page.locator('#node-input-slot0').inputValue()).toBe('')
    await close(page, 'ok')
    const stored = ['mode', 'model', 'startIo', 'slot0'].map((name) => property(page, 'request', name))
    expect(await Promise.all(stored)).toEqual(['module', 'Q62DA', '0030', ''])
  })

  test('the file dialog browses the drives of the PLC, and shows what the action needs', async () => {
    await edit(page, 'file')
    const browser = page.locator('#melsec-jw-browser')
    await page.locator('#melsec-jw-browse').click()
    await browser.getByRole('button', { name: 'LINE.CSV' }).waitFor()
    await browser.getByRole('button', { name: 'ARCHIVE' }).click()
    await browser.getByRole('button', { name: 'LINE2025.CSV' }).click()
    expect(await page.locator('#node-input-file').inputValue()).toBe('4:/ARCHIVE/LINE2025.CSV')
    await picture(page, 'file browse')
    await browser.getByRole('button', { name: '4:/ARCHIVE/' }).click()
    await browser.getByRole('button', { name: '4:/', exact: true }).click()
    await browser.locator('button', { hasText: 'SD memory card' }).click()
    await browser.getByRole('button', { name: 'LOGGING' }).waitFor()
    await page.locator('#node-input-output').selectOption('text')
    await page.locator('#node-input-encoding').selectOption('shift-jis')
    expect(await page.getByText('This connection does not allow writing.').isVisible()).toBe(false)
    await page.locator('#node-input-action').selectOption('write')
    await page.getByText('This connection does not allow writing.').waitFor()
    await page.locator('#node-input-mode').selectOption('replace')
    await page.getByText('The old file stays until the new one is complete.').waitFor()
    expect(await page.locator('#node-input-limit').isVisible()).toBe(false)
    await page.locator('#node-input-password').fill('Sesame-1')
    await picture(page, 'file')
    await close(page, 'ok')
    const stored = ['action', 'file', 'fileType', 'mode', 'encoding', 'password'].map((name) =>
      property(page, 'file', name),
    )
    expect(await Promise.all(stored)).toEqual(['write', '2:/', 'str', 'replace', 'shift-jis', undefined])
  })

  test('the file dialog asks for a local port over UDP only where the frame has no serial number', async () => {
    const names = ['profile', 'frame', 'transport', 'localPort'] as const
    const connect = (values: readonly unknown[]) => {
      const settings = Object.fromEntries(names.map((name, i) => [name, values[i]]))
      return page.evaluate(
        (given) => Object.assign((globalThis as unknown as Editor).RED.nodes.node('plc'), given),
        settings,
      )
    }
    const before = await Promise.all(names.map((name) => property(page, 'plc', name)))
    const shown: unknown[] = []
    const cases = [
      ['iq-r', '', 'udp', ''],
      ['iq-r', 'ext', 'udp', ''],
      ['iq-r', '3E', 'udp', ''],
      ['q', '', 'udp', ''],
      ['q', '', 'udp', '5010'],
    ]
    for (const values of cases) {
      await connect(values)
      await edit(page, 'file')
      await page.locator('#node-input-action').selectOption('read')
      shown.push(await page.locator('.melsec-jw-udp').isVisible())
      await close(page, 'cancel')
    }
    await connect(before)
    expect(shown).toEqual([false, false, true, true, false])
  })

  test('the test button shows the CPU and the round trip, and offers its series', async () => {
    await edit(page, 'plc')
    await page.locator('#node-config-input-profile').selectOption('generic')
    await page.getByRole('button', { name: 'Test connection' }).click()
    const result = page.locator('#melsec-jw-test-result')
    await result.getByText('The PLC answers').waitFor()
    expect(await result.textContent()).toMatch(/CPU: R08CPU · .+Round trip: [\d.]+ ms/)
    await picture(page, 'connection')
    await result.getByRole('button', { name: 'Use MELSEC iQ-R' }).click()
    expect(await page.locator('#node-config-input-profile').inputValue()).toBe('iq-r')
    await close(page, 'ok')
  })

  test('the test button warns of an inverter that may number W in decimal, which the page Values sets', async () => {
    const inverter = await startPlc({ profile: 'generic', model: { name: 'FR-E800-E', code: 0x054f } })
    const before = await property(page, 'plc', 'port')
    await edit(page, 'plc')
    await page.locator('#node-config-input-profile').selectOption('generic')
    await page.locator('#node-config-input-port').fill(String(inverter.tcp?.port))
    const result = page.locator('#melsec-jw-test-result')
    const told = async () => {
      await page.getByRole('button', { name: 'Test connection' }).click()
      await result.getByText('The PLC answers').waitFor()
      return result.textContent()
    }
    expect(await told()).toContain('FR-E800-E is an inverter, and inverters are said to number W in decimal')
    const numbering = page.locator('#node-config-input-wRadix')
    expect(await numbering.locator('option').first().textContent()).toContain('hexadecimal (WA follows W9)')
    // On another page of the dialog.
    await numbering.selectOption('10', { force: true })
    expect(await told()).not.toContain('decimal')
    await close(page, 'cancel')
    expect(await property(page, 'plc', 'port')).toBe(before)
    await inverter.close()
  })

  test('the note below what is allowed follows the ticks', async () => {
    await edit(page, 'plc')
    const note = page.locator('#melsec-jw-allowed')
    const [writes, controls] = ['allowWrites', 'allowControl'].map((name) => page.locator(`#node-config-input-${name}`))
    const told = [await note.textContent()]
    for (const box of [writes, controls, writes]) {
      await box?.click()
      told.push(await note.textContent())
    }
    expect(told).toEqual([
      expect.stringMatching(/^Off until you tick them/),
      'Flows can change device values of the PLC. Remote control is off.',
      expect.stringMatching(/^(?!Off until)/),
      expect.stringMatching(/^(?!Off until)/),
    ])
    expect(new Set(told).size).toBe(4)
    await close(page, 'cancel')
  })

  test('the test button lists ranked causes of a failure', async () => {
    const before = await property(page, 'plc', 'code')
    await edit(page, 'plc')
    await page.locator('#node-config-input-code').selectOption('ascii')
    await page.getByRole('button', { name: 'Test connection' }).click()
    const result = page.locator('#melsec-jw-test-result')
    await result.getByText('Possible causes, most likely first:').waitFor()
    expect(await result.locator('li').first().textContent()).toMatch(/binary/)
    await picture(page, 'connection silent')
    for (const tab of ['Communication', 'Values']) {
      await page.locator('.red-ui-tray .red-ui-tabs').getByText(tab, { exact: true }).click()
      await picture(page, `connection ${tab.toLowerCase()}`)
    }
    await close(page, 'cancel')
    expect(await property(page, 'plc', 'code')).toBe(before)
  })

  test('a PLC on a serial line is tested, its series taken over, and another station found', async () => {
    await edit(page, 'plc1')
    const result = page.locator('#melsec-jw-test-result')
    const button = page.getByRole('button', { name: 'Test connection' })
    expect(await page.locator('#node-config-input-host').isVisible()).toBe(false)
    await button.click()
    await result.getByText('The PLC answers').waitFor()
    await result.getByRole('button', { name: 'Use MELSEC iQ-F, serial (FX5)' }).click()
    expect(await page.locator('#melsec-jw-stations').textContent()).toBe('0 to 15, as set in the PLC.')
    await page.locator('#node-config-input-lineStation').fill('7')
    await button.click()
    await result.getByText('Possible causes, most likely first:').waitFor()
    expect(await result.locator('li').allTextContents()).toContainEqual(expect.stringContaining('station number 7'))
    await picture(page, 'serial silent')
    const look = result.getByRole('button', { name: 'Look for stations and formats' })
    const forms = [{ frame: '3C', messageFormat: 1, sumCheck: false }]
    await page.route('**/connection/find', (route) => route.fulfill({ json: { ok: true, station: 7, forms } }))
    await look.click()
    await result.getByText('station 7 · 3C · format 1 · no sum check code').waitFor()
    await page.unroute('**/connection/find')
    await button.click()
    await look.click()
    await result.getByRole('button', { name: 'Use station 2 · FX5U' }).click({ timeout: 30_000 })
    await result.getByText('The PLC answers').waitFor()
    expect(await page.locator('#node-config-input-lineStation').inputValue()).toBe('2')
    await close(page, 'ok')
    expect(await property(page, 'plc1', 'lineStation')).toBe('2')
    expect(await property(page, 'plc1', 'valid')).toBe(true)
  }, 60_000)

  test('the way to the PLC shows its own fields, and forgets a series that it cannot have', async () => {
    await edit(page, 'plc')
    const shown = async () =>
      Promise.all(
        ['host', 'code', 'line', 'lineStation'].map((id) => page.locator(`#node-config-input-${id}`).isVisible()),
      )
    const series = page.locator('#node-config-input-profile')
    expect(await shown()).toEqual([true, true, false, false])
    await page.locator('#node-config-input-way').selectOption('serial')
    expect(await shown()).toEqual([false, false, true, true])
    expect(await series.inputValue()).toBe('')
    await series.selectOption('q-c24')
    await page.locator('.red-ui-tray .red-ui-tabs').getByText('Communication', { exact: true }).click()
    expect(await page.locator('#node-config-input-pc').isVisible()).toBe(true)
    await picture(page, 'serial route')
    await close(page, 'cancel')
    expect(await property(page, 'plc', 'way')).not.toBe('serial')
  })

  test('the line dialog lists the ports of the machine, and offers what goes with the frame', async () => {
    await edit(page, 'line')
    await page.locator('#node-config-input-transport').selectOption('serial')
    expect(await page.locator('#node-config-input-host').isVisible()).toBe(false)
    await page.route('**/melsec-jw/line/ports', (route) =>
      route.fulfill({
        json: { ok: true, ports: [{ path: '/dev/ttyUSB0', lastingPath: '/dev/serial/by-id/x', manufacturer: 'FTDI' }] },
      }),
    )
    await page.getByRole('button', { name: 'Ports' }).click()
    await page.getByRole('button', { name: '/dev/ttyUSB0 · FTDI' }).click()
    expect(await page.locator('#node-config-input-path').inputValue()).toBe('/dev/serial/by-id/x')
    await page.unroute('**/melsec-jw/line/ports')
    const format = page.locator('#node-config-input-messageFormat')
    expect(await format.locator('option[value="5"]').isDisabled()).toBe(true)
    await page.locator('#node-config-input-frame').selectOption('4C')
    await format.selectOption('5')
    expect(await page.locator('#node-config-input-dataLength').inputValue()).toBe('8')
    await page.locator('#node-config-input-frame').selectOption('3C')
    expect(await format.inputValue()).toBe('1')
    await close(page, 'cancel')
  })

  test('the digits of X and Y in ASCII code are asked for where a series has that setting', async () => {
    await edit(page, 'plc')
    await page.locator('#node-config-input-code').selectOption('ascii')
    await page.locator('.red-ui-tray .red-ui-tabs').getByText('Values', { exact: true }).click()
    const digits = page.locator('#node-config-input-asciiXy')
    // It is on the first page, and the digits are on another one.
    const choose = (id: string) => page.locator('#node-config-input-profile').selectOption(id, { force: true })
    await choose('iq-f')
    expect(await digits.isVisible()).toBe(true)
    await digits.selectOption('octal')
    await choose('fx3')
    expect([await digits.isVisible(), await digits.inputValue()]).toEqual([false, ''])
    expect(await page.locator('#node-config-input-asciiZr').isVisible()).toBe(true)
    await close(page, 'cancel')
  })

  test('the lists of the dialogs are those of the library', async () => {
    await edit(page, 'plc')
    const values = (selector: string) =>
      page
        .locator(`${selector} option`)
        .evaluateAll((options) => options.map((option) => (option as HTMLOptionElement).value))
    const onLine = (id: (typeof profileIds)[number]) => profiles[id].serial !== undefined
    expect(await values('#node-config-input-profile')).toEqual(['', ...profileIds.filter((id) => !onLine(id))])
    await page.locator('#node-config-input-way').selectOption('serial')
    expect(await values('#node-config-input-profile')).toEqual(['', ...profileIds.filter(onLine)])
    await close(page, 'cancel')
    await edit(page, 'line')
    expect(await values('#node-config-input-baudRate')).toEqual(baudRates.map(String))
    expect((await values('#node-config-input-frame')).sort()).toEqual([...serialFrameNames])
    await close(page, 'cancel')
    await edit(page, 'read')
    expect(await values('#melsec-jw-items li:first-child .melsec-jw-type')).toEqual(['', ...typeNames])
    await close(page, 'cancel')
    await edit(page, 'request')
    expect((await values('#node-input-command')).sort()).toEqual(Object.keys(commands).sort())
    await close(page, 'cancel')
  })

  test('every dialog has its texts, and fits', () => lookThrough(page, 'en-US'), 60_000)

  test('the help of each node is shown', async () => {
    for (const [type, told] of [
      ['read', 'an item that fails makes the message fail'],
      ['write', 'A write is never repeated'],
      ['control', 'Remote control of the CPU'],
      ['request', 'Any command of the manuals'],
      ['file', 'Files on the drives of the CPU'],
      ['ondemand', 'Nothing is answered'],
      ['connection', 'How to reach a Mitsubishi MELSEC PLC'],
      ['line', 'Where a serial line is'],
    ]) {
      const help = await page.evaluate((name) => $(`script[data-help-name="melsec-jw-${name}"]`).text(), type)
      expect(help).toContain(told)
    }
  })
})

/** jQuery, which the editor has. */
declare const $: (selector: string) => { text(): string }

/** Every dialog, held against missing texts and texts that are too long for it. */
async function lookThrough(page: Page, language: string): Promise<void> {
  for (const id of ['read', 'write', 'control', 'request', 'ondemand', 'file', 'plc', 'plc1', 'line']) {
    await edit(page, id)
    const form = page.locator('.red-ui-tray-body .melsec-jw-form').last()
    const text = (await form.innerText()) + (await form.locator('option').allTextContents()).join('\n')
    // A key without a text is shown as itself.
    expect(
      text.match(/\b(label|option|note|button|command|status|explain|device|test|tab|unit|line|placeholder)\.[\w-]+/g),
    ).toBeNull()
    expect(text).not.toContain('undefined')
    const wide = await form.evaluate((element) => element.scrollWidth - element.clientWidth)
    expect({ id, wide }).toEqual({ id, wide: 0 })
    await picture(page, `${language} ${id}`)
    await close(page, 'cancel')
  }
}

test.each(LANGUAGES.slice(1))(
  'in %s every dialog has its texts, and fits',
  async (language) => {
    const opened = await open(language)
    await lookThrough(opened.page, language)
    expect(opened.problems).toEqual([])
    await opened.close()
  },
  60_000,
)

test('in the example flows no node is marked as wrong', async () => {
  const flows = filesBelow('examples', '.json').map((path) => JSON.parse(readText(path)) as FlowNode[])
  await red.deploy(
    flows.flat().map((node) => (node.type === 'melsec-jw-connection' ? { ...node, port: portOf(plc) } : node)),
  )
  const { page, problems, close: closePage } = await open('en-US')
  const wrong = await page.evaluate(() => {
    const found: string[] = []
    const look = (node: { id: string; valid?: boolean }): void => {
      if (node.valid === false) found.push(node.id)
    }
    const { RED } = globalThis as unknown as Editor
    RED.nodes.eachNode(look)
    RED.nodes.eachConfig(look)
    return found
  })
  expect(wrong).toEqual([])
  for (const { id, label } of flows.flat().filter(({ type }) => type === 'tab')) {
    await page.evaluate((tab) => (globalThis as unknown as Editor).RED.workspaces.show(tab), id)
    await picture(page, `example ${String(label)}`)
  }
  expect(problems).toEqual([])
  await closePage()
}, 60_000)

describe.each(LANGUAGES)('in %s', (language) => {
  test('the titles of commands are there; the English ones are those of the library', () => {
    const catalogue = JSON.parse(readText(`nodes/locales/${language}/melsec-jw-connection.json`)) as {
      command: Record<string, string>
    }
    const titles = Object.fromEntries(Object.values(commands).map(({ name, title }) => [name, title]))
    expect(Object.keys(catalogue.command).sort()).toEqual(Object.keys(titles).sort())
    if (language === 'en-US') expect(catalogue.command).toEqual(titles)
    else expect(Object.entries(titles).filter(([name, title]) => catalogue.command[name] === title)).toEqual([])
  })

  test('the titles of devices are there; the English ones are those of the library', () => {
    const catalogue = JSON.parse(readText(`nodes/locales/${language}/melsec-jw-connection.json`)) as {
      language: string
      device: Record<string, string>
    }
    expect(catalogue.language).toBe(language)
    const titles = Object.fromEntries(devices.map(({ name, title }) => [name, title]))
    expect(Object.keys(catalogue.device).sort()).toEqual(Object.keys(titles).sort())
    expect(language === 'en-US' ? catalogue.device : titles).toEqual(titles)
  })

  test('statuses are short', () => {
    const catalogue = JSON.parse(readText(`nodes/locales/${language}/melsec-jw-connection.json`)) as {
      status: Record<string, string>
    }
    const long = Object.values(catalogue.status).filter((text) => text.replaceAll(/__\w+__/g, '1234').length >= 20)
    expect(long).toEqual([])
  })
})
