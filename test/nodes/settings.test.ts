/** The parts of the nodes that need no Node-RED: stored settings, values, and what became of a write. */
import { describe, expect, test } from '@jest/globals'
import { networkOptionsOf, optionsOf, settingsOf } from '../../nodes/connection-settings'
import { failureOf, NodeFailure } from '../../nodes/failure'
import { currentVersion, type Migration, migrated } from '../../nodes/migration'
import { writeFailure } from '../../nodes/write-result'
import { entriesByName, isSame, typedNumber } from '../../nodes/write-values'
import {
  ClosedError,
  createMelsecClient,
  createMelsecLine,
  EndCodeError,
  encodings,
  ethernetFrameNames,
  probeKinds,
  RequestError,
  TimeoutError,
  transportNames,
} from '../../src/index'
import { readText } from '../support/syntax'

const texts = (key: string, values: object = {}): string => `${key} ${JSON.stringify(values)}`
/** The values of a list of the connection's dialog, as its html has them. */
function offered(field: string): (string | undefined)[] {
  const html = readText('nodes/melsec-jw-connection.html')
  const [, list = ''] = new RegExp(`<select id="node-config-input-${field}">(.*?)</select>`, 's').exec(html) ?? []
  return [...list.matchAll(/<option value="([^"]*)"/g)].map(([, value]) => value)
}

const resolve = (text: string): string => text

describe('migrations', () => {
  const migrations: readonly Migration[] = [
    { version: 2, up: ({ ip, ...settings }) => ({ ...settings, host: ip }) },
    { version: 3, up: (settings) => ({ ...settings, port: Number(settings.port) }) },
  ]

  test('are applied one after the other, from the version that was stored', () => {
    const newest = { version: 3, host: '10.0.0.1', port: 5007 }
    expect(migrated({ version: 1, ip: '10.0.0.1', port: '5007' }, migrations)).toEqual(newest)
    expect(migrated({ version: 2, host: '10.0.0.1', port: '5007' }, migrations)).toEqual(newest)
    expect(migrated(newest, migrations)).toBe(newest)
  })

  test('a flow written by hand without a version is of the first', () => {
    expect(migrated({ ip: 'plc', port: '1' }, migrations)).toEqual({ version: 3, host: 'plc', port: 1 })
  })

  test('settings of a later version are refused', () => {
    expect(() => migrated({ version: 4 }, migrations)).toThrow('newer')
    expect(() => migrated({ version: 'x' }, migrations)).toThrow('newer')
    expect(currentVersion(migrations)).toBe(3)
  })

  test.each([
    // With the family of the PLC.
    ['connection', 3],
    ['line', 1],
    ['read', 1],
    ['write', 1],
    // With `verify`.
    ['control', 2],
  ])('%s stores version %i, which it reads', (name, version) => {
    const [, stored] = /version: \{ value: (\d+) \}/.exec(readText(`nodes/melsec-jw-${name}.html`)) ?? []
    expect(Number(stored)).toBe(version)
    const found = [...readText(`nodes/melsec-jw-${name}.ts`).matchAll(/\{ version: (\d+), up:/g)]
    expect(Number(found.at(-1)?.[1] ?? currentVersion([]))).toBe(version)
  })
})

describe('settings of a connection', () => {
  const read = (given: object) => networkOptionsOf(settingsOf({ ...given }, { texts, resolve }), texts)

  test('become options that the client takes: the defaults of the dialog', () => {
    const html = readText('nodes/melsec-jw-connection.html')
    const defaults = [...html.matchAll(/^ {6}(\w+): \{ value: ('[^']*'|\w+)/gm)].map(([, name, value]) => [
      name,
      value?.startsWith("'") ? value.slice(1, -1) : JSON.parse(value ?? 'null'),
    ])
    expect(defaults.length).toBeGreaterThan(20)
    const options = read({ ...Object.fromEntries(defaults), host: 'plc', port: '5007', profile: 'iq-r' })
    const { profile, ...settled } = createMelsecClient(options).options
    expect(profile).toBe('iq-r')
    expect(settled).toMatchObject({ host: 'plc', port: 5007, allowWrites: false, allowControl: false })
  })

  test.each([
    ['frame', ['', ...ethernetFrameNames]],
    ['transport', transportNames.filter((name) => name !== 'serial')],
    ['probe', probeKinds],
    ['encoding', encodings],
  ])('%s: the dialog offers what the client takes', (field, values) => {
    expect(offered(field).sort()).toEqual([...values].sort())
  })

  test('a station above 120 is one of the station extension frame', () => {
    const stored = { host: 'plc', port: '5007', profile: 'iq-r', network: '1', moduleIo: '3FF', multidrop: '0' }
    const far = read({ ...stored, frame: 'ext', station: '300', extensionStation: '' })
    expect(far).toMatchObject({ frame: 'ext', route: { network: 1, station: 300, moduleIo: 0x3ff, multidrop: 0 } })
    expect(createMelsecClient(far).options.frame).toBe('ext')
    const named = read({ ...stored, frame: 'ext', station: '124', extensionStation: '125' })
    expect(named.route).toMatchObject({ station: 124, extensionStation: 125 })
    expect(() => createMelsecClient(read({ ...stored, frame: '4E', station: '300' }))).toThrow(
      'station extension frame',
    )
  })

  test('of a serial line hold what the line has not, and nothing of the other way', () => {
    const line = createMelsecLine({ host: 'server', port: 4001 })
    const stored = {
      way: 'serial',
      line: 'L',
      lineStation: '3',
      profile: 'fx5-serial',
      host: 'old',
      transport: 'udp',
      code: 'ascii',
    }
    const own = { network: '0', pc: '255', moduleIo: '3ff', multidrop: '0', selfStation: '0', messageWait: '0' }
    const onLine = (more: object = {}) =>
      optionsOf(settingsOf({ ...stored, ...own, ...more }, { texts, resolve }), texts, (id) => {
        expect(id).toBe('L')
        return line
      })
    expect(onLine()).toEqual({
      line,
      profile: 'fx5-serial',
      route: { station: 3 },
      format: {},
      reconnect: { longest: 5000 },
      allowWrites: false,
      allowControl: false,
    })
    expect(createMelsecClient(onLine()).options.line).toBe(line)
    const far = { profile: 'q-c24', network: '1', pc: '2', selfStation: '4', messageWait: '70' }
    expect(onLine(far)).toMatchObject({ route: { station: 3, network: 1, pc: 2, selfStation: 4 }, messageWait: 70 })
    expect(() => onLine({ profile: 'iq-f' })).toThrow('error.notOnLine')
    expect(() => onLine({ way: 'radio' })).toThrow('error.notChoice')
    expect(() => read({ ...stored, way: 'ethernet', port: '1' })).toThrow('error.onlyOnLine')
  })

  test.each([
    ['Ethernet', 'way', 'ethernet'],
    ['MELSEC', 'family', 'melsec'],
  ])('of a flow that knew %s only are those of it', (_what, field, only) => {
    const ups = [...readText('nodes/melsec-jw-connection.ts').matchAll(/\{ version: \d+, up: (.+) \},?\n/g)]
    expect(ups.map(([, up]) => up)).toContain(`(settings) => ({ ${field}: '${only}', ...settings })`)
  })

  test('numbers may be numbers or text, and what is empty is left to the client', () => {
    expect(
      read({ host: 'plc', port: 5007, profile: 'q', moduleIo: '3e1h', xyRadix: '16', wRadix: '10', localPort: '' }),
    ).toEqual({
      host: 'plc',
      port: 5007,
      profile: 'q',
      xyRadix: 16,
      wRadix: 10,
      route: { moduleIo: 0x3e1 },
      format: {},
      reconnect: { longest: 5000 },
      allowWrites: false,
      allowControl: false,
    })
  })

  test('the pauses between attempts and the queue are bounded as set', () => {
    const stored = { host: 'plc', port: 5007, profile: 'iq-r' }
    const given = { reconnectFirst: '200', reconnectLongest: '60000', queueLimit: '50' }
    const { reconnect, queueLimit } = createMelsecClient(read({ ...stored, ...given })).options
    expect({ reconnect, queueLimit }).toEqual({ reconnect: { first: 200, longest: 60_000 }, queueLimit: 50 })
    expect(createMelsecClient(read(stored)).options.reconnect).toMatchObject({ longest: 5000 })
    expect(() => read({ ...stored, reconnectLongest: '5 s' })).toThrow('reconnectLongest')
    expect(() => createMelsecClient(read({ ...stored, reconnectFirst: '0' }))).toThrow('reconnect.first')
    expect(() => createMelsecClient(read({ ...stored, queueLimit: '0' }))).toThrow('queueLimit')
  })

  test.each(['auto', 'typeName', 'read', 'none'])('the proof of a connection is chosen: %s', (probe) => {
    const options = read({ host: 'plc', port: 5007, profile: 'iq-r', probe })
    expect(options).toMatchObject({ probe })
    expect(createMelsecClient(options).options.probe).toBe(probe)
    expect(() => read({ host: 'plc', port: 5007, profile: 'iq-r', probe: 'ping' })).toThrow()
  })

  test('permissions are given by true and by nothing else', () => {
    const given = { host: 'plc', port: '1', profile: 'q', allowWrites: 'true', allowControl: 1 }
    expect(read(given)).toMatchObject({ allowWrites: false, allowControl: false })
  })

  test('variables are replaced in every text', () => {
    const settings = settingsOf({ host: '$x', port: '$y' }, { texts, resolve: (text) => text.replace('$', '1') })
    expect(settings).toMatchObject({ host: '1x', port: '1y' })
  })
})

describe('a failure', () => {
  test('carries everything as plain data in its cause, which Node-RED copies', () => {
    const failure = failureOf(
      new EndCodeError(0xc056, 'refused', { family: 'slmp', carriedOut: false, command: 'Read', station: 'own' }),
      texts,
    )
    expect(failure).toMatchObject({ code: 'END_CODE', outcome: 'refused', endCode: 0xc056 })
    expect(Object.getOwnPropertyNames(failure)).toEqual(expect.arrayContaining(['code', 'cause', 'stack']))
    expect(JSON.parse(JSON.stringify(failure.cause))).toMatchObject({
      endCode: 0xc056,
      command: 'Read',
      station: 'own',
    })
  })

  test('keeps causes, field and reason', () => {
    expect(failureOf(new TimeoutError('late', 'unknown', ['cable']), texts).cause).toMatchObject({ causes: ['cable'] })
    expect(failureOf(new RequestError('BAD_VALUE', 'no', 'D1'), texts).cause).toMatchObject({ field: 'D1' })
    const closed = new ClosedError('ABORTED', 'ended', 'notSent', new Error('by hand'))
    expect(failureOf(closed, texts).cause).toMatchObject({ reason: 'by hand' })
  })

  test('that nobody foresaw has an unknown outcome', () => {
    expect(failureOf(new TypeError('x is not a function'), texts)).toMatchObject({
      code: 'UNEXPECTED',
      outcome: 'unknown',
      message: 'x is not a function',
    })
    expect(failureOf('thrown text', texts).message).toBe('thrown text')
    const failure = new NodeFailure({ code: 'BAD_INPUT', message: 'm', outcome: 'notSent' })
    expect(failureOf(failure, texts)).toBe(failure)
  })
})

describe('values', () => {
  test.each([
    ['12', 12],
    [' -1.5e3 ', -1500],
    ['9007199254740993', 9007199254740993n],
    ['-9223372036854775808', -9223372036854775808n],
    ['0x10', 16],
  ])('typed %s is kept to its last digit', (text, value) => {
    expect(typedNumber(text)).toBe(value)
  })

  test.each(['', '   ', 'ten', '1,5'])('typed %j is no number', (text) => {
    expect(typedNumber(text)).toBeNaN()
  })

  test.each([
    [0.1, Math.fround(0.1), 'REAL', true],
    [0.1, Math.fround(0.1), 'LREAL', false],
    [Number.NaN, Number.NaN, 'REAL', true],
    [-0, 0, 'REAL', true],
    [5, 5n, 'LINT', true],
    [5.5, 5n, 'LINT', false],
    [5n, 5, 'DINT', true],
    ['5', 5, 'INT', false],
    [true, true, 'BOOL', true],
    [true, false, 'BOOL', false],
    [[1, 0.1], [1, Math.fround(0.1)], 'REAL', true],
    [[1, 2], [1], 'INT', false],
    [[1], 1, 'INT', false],
  ])('%p written and %p read as %s: the same is %p', (written, read, type, same) => {
    expect(isSame(written, read, type)).toBe(same)
  })

  test('names of rows come before addresses, and not from the prototype', () => {
    const rows = [{ name: 'D5', address: 'D100', type: 'REAL' }]
    expect(entriesByName({ D5: 1, D6: 2 }, rows, texts)).toEqual([
      { name: 'D5', item: { address: 'D100', type: 'REAL' }, value: 1 },
      { name: 'D6', item: 'D6', value: 2 },
    ])
    expect(() => entriesByName(Object.create({ D5: 1 }), rows, texts)).toThrow('error.noValues')
  })
})

test('of several failures of a write the unknown one speaks, and what was left out never does', () => {
  const entries = ['a', 'b', 'c'].map((name) => ({ name, item: name, value: 1 }))
  const left = { item: 'a', ok: false, error: new ClosedError('ABORTED', 'left out') } as const
  const bad = { item: 'b', ok: false, error: new RequestError('BAD_VALUE', 'bad') } as const
  const lost = { item: 'c', ok: false, error: new TimeoutError('lost', 'unknown') } as const
  expect(writeFailure(entries, [left, bad, lost], texts)).toMatchObject({ code: 'TIMEOUT', outcome: 'unknown' })
  expect(writeFailure(entries, [left, bad, { item: 'c', ok: true }], texts)).toMatchObject({
    code: 'BAD_VALUE',
    cause: { items: [{ written: false }, { name: 'b', written: false, code: 'BAD_VALUE' }, { written: true }] },
  })
  expect(writeFailure(entries, [left], texts)).toMatchObject({ code: 'ABORTED' })
  expect(
    writeFailure(
      entries,
      entries.map(({ item }) => ({ item, ok: true })),
      texts,
    ),
  ).toBeUndefined()
})
