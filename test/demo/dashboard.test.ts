/** The demo in a real browser, with what people do there observed in the PLC by a client of the library. */
import { afterAll, beforeAll, describe, expect, jest, test } from '@jest/globals'
import type { Page } from 'playwright-core'
import { createMelsecClient, type MelsecClient } from '../../src/index'
import { type HeadlessBrowser, launchBrowser, type OpenedPage } from '../support/browser'
import { eventually, type RunningDemo, startDemo, widget } from './running'

jest.setTimeout(150_000)

let demo: RunningDemo
let browser: HeadlessBrowser

beforeAll(async () => {
  demo = await startDemo()
  browser = await launchBrowser()
})

afterAll(async () => {
  await browser?.close()
  await demo?.cleanUp()
})

describe.each([
  ['iqr', 'iq-r', 'R08CPU', '4E'],
  ['fx5', 'iq-f', 'FX5U', '3E'],
] as const)('the page of %s', (id, profile, model, frame) => {
  let opened: OpenedPage
  let page: Page
  let plc: MelsecClient

  beforeAll(async () => {
    const port = id === 'iqr' ? demo.iqr : demo.fx5
    plc = createMelsecClient({ host: '127.0.0.1', port, profile, frame, allowWrites: true, allowControl: true })
    opened = await browser.openPage(`${demo.dashboard}${id}`)
    page = opened.page
  })

  afterAll(async () => {
    await opened?.close()
    await plc?.close()
  })

  const head = () => widget(page, `${id}-head`).innerText()
  const level = () => widget(page, `${id}-level-text`).innerText()
  const press = (button: string) => widget(page, `${id}-${button}`).locator('button').click()
  const isOn = (led: string) =>
    page.locator(`[data-led="${led}"]`).evaluate((element) => element.classList.contains('on'))
  const cpuState = async () => Number(await plc.read('SD203:WORD')) & 15
  const control = (command: 'run' | 'stop') => page.locator(`.plc-cpu-${command}`).click()

  test('shows the connection, the CPU, its state and the round trip', async () => {
    const text = await eventually('the head', head, (shown) => /\d ms/.test(shown) && shown.includes(model))
    expect(text).toContain('Connected')
    expect(text).toContain('RUN')
    expect(text).toContain(`${frame} binary, TCP`)
  })

  test('shows the level of the tank as it changes', async () => {
    // The level stands still while a batch is heated and mixed.
    const before = await eventually('a level', level, (shown) => /\d l/.test(shown))
    await eventually('another level', level, (shown) => shown !== before, 60_000)
    const shown = Number(/([\d,]+) l/.exec(await level())?.[1]?.replace(',', ''))
    // Within what flows in three seconds.
    expect(Math.abs(shown - Number(await plc.read('D100:REAL')))).toBeLessThan(160)
  })

  test('draws gauges and charts', async () => {
    expect(await page.locator('.nrdb-ui-gauge svg, .nrdb-ui-gauge-tank').count()).toBeGreaterThanOrEqual(2)
    expect(await page.locator('.nrdb-ui-chart canvas').count()).toBe(2)
  })

  test('stops the plant with a button, and starts it again', async () => {
    await eventually(
      'automatic operation',
      () => isOn('running'),
      (on) => on,
    )
    await press('stop')
    await eventually(
      'the bit in the PLC',
      () => plc.read('M10'),
      (on) => on === false,
    )
    await eventually(
      'the light',
      () => isOn('running'),
      (on) => !on,
    )
    await press('start')
    await eventually(
      'the bit in the PLC',
      () => plc.read('M10'),
      (on) => on === true,
    )
    await eventually(
      'the light',
      () => isOn('running'),
      (on) => on,
    )
  })

  test('writes set-points of a slider and of a number', async () => {
    const slider = widget(page, `${id}-temperature-setpoint`)
    await slider.getByRole('slider').focus()
    await slider.getByRole('slider').press('ArrowRight')
    await eventually(
      'the set-point in the PLC',
      () => plc.read('D112:REAL'),
      (value) => value === 41,
    )
    const field = widget(page, `${id}-mixing-time`).locator('input')
    await field.fill('12')
    await field.press('Enter')
    await eventually(
      'the mixing time in the PLC',
      () => plc.read('D114'),
      (value) => value === 12,
    )
  })

  test('shows a set-point that somebody else has written', async () => {
    await plc.write('D114', 14)
    const field = widget(page, `${id}-mixing-time`).locator('input')
    await eventually(
      'the mixing time on the page',
      () => field.inputValue(),
      (value) => value === '14',
    )
    const shown = widget(page, `${id}-temperature-text`)
    await eventually(
      'the set-point on the page',
      () => shown.innerText(),
      (text) => text.includes('41.0 °C'),
    )
  })

  test('asks before remote STOP, and leaves the CPU alone when the answer is no', async () => {
    await control('stop')
    await page.locator('.plc-dialog-cancel').click()
    await page.locator('.plc-dialog').waitFor({ state: 'hidden' })
    expect(await cpuState()).toBe(0)
  })

  test('sets the CPU to STOP and to RUN again, each after a question', async () => {
    await control('stop')
    await page.locator('.plc-dialog-confirm').click()
    await eventually('STOP in the PLC', cpuState, (state) => state === 2)
    await eventually('STOP on the page', head, (text) => text.includes('STOP'))
    await page.getByText('Remote STOP is done.').waitFor()
    await control('run')
    await page.locator('.plc-dialog-confirm').click()
    await eventually('RUN in the PLC', cpuState, (state) => state === 0)
    await eventually('RUN on the page', head, (text) => text.includes('RUN'))
  })

  test('is as wide as a phone on a phone', async () => {
    const phone = await browser.openPage(`${demo.dashboard}${id}`, { viewport: { width: 390, height: 844 } })
    try {
      await widget(phone.page, `${id}-head`).waitFor()
      const width = await phone.page.evaluate(() => document.scrollingElement?.scrollWidth ?? 0)
      expect(width).toBeLessThanOrEqual(390)
      expect(phone.problems).toEqual([])
    } finally {
      await phone.close()
    }
  })

  test('reports no problem to the browser', () => {
    expect(opened.problems).toEqual([])
  })
})

describe('the editor', () => {
  test('shows the flow of every PLC, with every node valid and connected', async () => {
    const { page, problems, close } = await browser.openEditor(demo.editor)
    try {
      const tabs = await page.locator('#red-ui-workspace-tabs .red-ui-tab-label').allInnerTexts()
      expect(tabs.map((tab) => tab.trim())).toEqual(['MELSEC iQ-R', 'MELSEC iQ-F FX5U', 'Sharp JW300', 'Look'])
      expect(await page.locator('.red-ui-flow-node-error:not(.hide)').count()).toBe(0)
      await eventually(
        'the status of the nodes',
        () => page.locator('.red-ui-flow-node-status-label').allTextContents(),
        (texts) => texts.filter((text) => text === 'connected').length >= 3,
      )
      expect(problems).toEqual([])
    } finally {
      await close()
    }
  })
})
