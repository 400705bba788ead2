/** Labels on the command line: read, write with the types of the PLC, and those of the simulated PLC. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterAll, afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import { labelOf, labelsOf } from '../../src/cli/label-option'
import { createPlcSimulator, type PlcSimulator } from '../../src/entry/simulator'
import { runHere } from './in-process'

let plc: PlcSimulator
let folder: string
const asked: string[] = []

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'labels-'))
  plc = createPlcSimulator({
    profile: 'iq-r',
    labels: {
      'Line1.Speed': { type: 'REAL', value: 12.3 },
      'Line1.Ready': { type: 'BOOL' },
      'Line1.Name': { type: 'STRING(10)', value: 'Apple' },
      'Line1.Values': { type: 'INT', dimensions: [5], value: [1, 2, 3] },
      DD100: { type: 'DWORD', value: 31 },
    },
  })
  await plc.listen()
  plc.on('request', ({ command }) => void asked.push(String(command)))
})
afterAll(async () => {
  rmSync(folder, { recursive: true })
  await plc.close()
})
afterEach(() => {
  asked.length = 0
})

const on = () => [`--plc=127.0.0.1:${plc.tcp?.port}`, '--profile', 'iq-r']

describe('read', () => {
  test('labels beside devices, as people and programs read them', async () => {
    const items = ['D0', 'Line1.Speed', 'label:DD100', 'Line1.Values[0]:INT[3]', 'Line1.Name']
    const text = await runHere(['read', ...items, ...on()])
    expect(text).toMatchObject({ code: 0, err: '' })
    expect(text.out.split('\n').map((line) => line.split(/ {2,}/)[1])).toEqual([
      '0',
      '12.3',
      '31',
      '1, 2, 3',
      'Apple',
      undefined,
    ])
    const { out } = await runHere(['read', 'Line1.Ready', ...on(), '--json'])
    expect(JSON.parse(out).results).toEqual([
      { item: 'Line1.Ready', ok: true, value: false, type: 'BOOL', timestamp: expect.any(Number) },
    ])
  })

  test('what may be a mistyped address is not asked for', async () => {
    const { code, err } = await runHere(['read', 'DD100', ...on()])
    expect(code).not.toBe(0)
    expect(err).toContain('write label:DD100')
    expect(asked.filter((command) => command.includes('Label'))).toEqual([])
  })
})

describe('write', () => {
  test('what was typed becomes a value of the type the PLC says', async () => {
    const values = ['Line1.Speed=71.5', 'Line1.Ready=ON', 'D5=7', 'Line1.Values[1]:INT[2]=0x1F,-5', 'label:DD100=H1F']
    const { code, out, err } = await runHere(['write', ...values, 'Line1.Name=1, 2', ...on(), '--yes'])
    expect([code, err]).toEqual([0, ''])
    expect(out).toContain('Line1.Ready')
    const names = ['Line1.Speed', 'Line1.Ready', 'Line1.Values[1]', 'Line1.Values[2]', 'DD100', 'Line1.Name']
    expect(names.map((name) => plc.labels.get(name))).toEqual([71.5, true, 31, -5, 31, '1, 2'])
    expect(plc.read('D5')).toBe(7)
  })

  test('asks with the types, and writes nothing without an answer', async () => {
    const { code, questions } = await runHere(['write', 'Line1.Speed=3', 'D5=8', ...on()], 'n')
    expect(code).not.toBe(0)
    expect(questions[0]).toMatch(/Line1\.Speed +label +REAL += 3/)
    expect(questions[0]).toMatch(/D5 +data register +INT += 8/)
    expect(asked.filter((command) => command.startsWith('write'))).toEqual([])
  })

  test.each([
    ['Line1.Speed=fast', 'Line1.Speed takes a number (REAL)'],
    ['Line1.Ready=5', 'Line1.Ready takes ON or OFF'],
    ['Line1.Values[0]=70000', 'INT'],
    ['Line1.Values[0]:INT[3]=1,2', 'takes 3 values'],
    ['Line1.Nothing=1', '40C0'],
    ['Line1.Speed:DINT=1', 'Line1.Speed is REAL in the PLC, not DINT'],
    ['Line1.Name=much too long', 'STRING'],
    ['Q5=1', 'label:Q5'],
  ])('%s: nothing is written, not even the others', async (text, message) => {
    const { code, err } = await runHere(['write', 'D5=9', text, ...on(), '--yes'])
    expect(code).not.toBe(0)
    expect(err).toContain(message)
    expect(asked.filter((command) => command.startsWith('write'))).toEqual([])
  })
})

describe('--plan', () => {
  test('prints the requests and sends none', async () => {
    const read = await runHere(['read', 'D0', 'Line1.Speed', 'Line1.Ready', 'Line1.Name', 'Q5', ...on(), '--plan'])
    // Q5 is in none of them.
    expect(read).toMatchObject({ code: 2, err: '' })
    expect(read.out).toMatch(/^Read \(word units\): D0, 1 point +\d+ bytes out, \d+ in +for D0$/m)
    expect(read.out).toMatch(
      /^Label Read Random: 3 labels, %1 for Line1 +\d+ bytes out, \? in +for Line1.Speed, Line1.Ready, Line1.Name$/m,
    )
    expect(read.out).toContain('label:Q5')
    const write = await runHere(['write', 'D0=5', 'Line1.Values[0]:INT[2]=1,2', ...on(), '--plan', '--json'])
    const { requests } = JSON.parse(write.out) as { requests: { command: string }[] }
    expect(requests.map(({ command }) => command)).toEqual(['readRandomLabels', 'writeWords', 'writeArrayLabels'])
    expect(write.code).toBe(0)
    expect((await runHere(['write', 'D0=5', 'D1=70000', ...on(), '--plan'])).code).toBe(2)
    expect(asked).toEqual([])
  })
})

describe('of the simulated PLC', () => {
  test.each([
    ['Line1.Speed:REAL=12.5', 'Line1.Speed', { type: 'REAL', value: 12.5 }],
    ['Ready:BOOL=ON', 'Ready', { type: 'BOOL', value: true }],
    ['Values:INT[10]=1,2,-3', 'Values', { type: 'INT', dimensions: [10], value: [1, 2, -3] }],
    ['Table: DINT[2, 3]', 'Table', { type: 'DINT', dimensions: [2, 3] }],
    ['Name:STRING(20)=a=b, c', 'Name', { type: 'STRING(20)', value: 'a=b, c' }],
    ['Level:Word [Signed]=5', 'Level', { type: 'Word [Signed]', value: 5 }],
    ['Timer1:TIMER', 'Timer1', { type: 'TIMER' }],
  ])('%s', async (text, name, label) => {
    expect(labelOf(text)).toEqual([name, label])
    await createPlcSimulator({ labels: await labelsOf(undefined, [text]) }).close()
  })

  test.each(['Speed', 'Speed=5', ':REAL', 'Speed:', 'Speed:[3]'])('%s is none', (text) => {
    expect(() => labelOf(text)).toThrow('write name:type=value')
  })

  test('are those of a file, and then of the arguments', async () => {
    const file = join(folder, 'labels.json')
    writeFileSync(file, JSON.stringify({ Speed: { type: 'REAL', value: 1 }, List: { type: 'INT', dimensions: [2] } }))
    expect(await labelsOf(file, ['Speed:INT=2'])).toEqual({
      Speed: { type: 'INT', value: 2 },
      List: { type: 'INT', dimensions: [2] },
    })
  })

  test.each([
    ['[]', 'no object of labels'],
    ['{', 'JSON'],
    ['{"A": 5}', 'A: a label is an object'],
    ['{"A": {"type": "REAL", "vaule": 5}}', 'a label has no "vaule"'],
    ['{"A": {}}', 'its type is missing'],
    ['{"A": {"type": "REAL", "value": null}}', 'its value is'],
    ['{"A": {"type": "REAL", "dimensions": 5}}', 'dimensions are'],
  ])('a file with %s is refused', async (content, message) => {
    const file = join(folder, 'bad.json')
    writeFileSync(file, content)
    await expect(labelsOf(file, [])).rejects.toMatchObject({ code: 'BAD_OPTION', field: 'labels' })
    await expect(labelsOf(file, [])).rejects.toThrow(message)
  })

  test('a file that is not there, a type that is none, a password nobody can type: said before it listens', async () => {
    const missing = await runHere(['simulate', '--port=0', '--labels', join(folder, 'nothing.json')])
    expect([missing.code === 0, missing.err]).toEqual([false, expect.stringContaining('nothing.json')])
    const type = await runHere(['simulate', '--port=0', '--label', 'A:FOO'])
    expect([type.code === 0, type.err]).toEqual([false, expect.stringContaining('FOO')])
    const nobody = await runHere(['simulate', '--port=0', '--password'])
    expect([nobody.code === 0, nobody.err]).toEqual([false, expect.stringContaining('MELSEC_JW_PASSWORD')])
    const short = await runHere(['simulate', '--port=0', '--password'], 'abc')
    expect(short.questions).toEqual(['Remote password of the simulated PLC: '])
    expect([short.code === 0, short.err]).toEqual([false, expect.stringContaining('password')])
    expect(short.err).not.toContain('abc')
  })
})
