/**
 * Writing a file is many requests. Here each of them fails in each way: whatever the error says must be true of the PLC.
 */
import { afterEach, describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type Fault, type PlcSimulator } from '../../src/entry/simulator'
import {
  createMelsecClient,
  type FileWriteOptions,
  type MelsecClient,
  type MelsecClientOptions,
  PlcError,
  type ProfileId,
} from '../../src/index'

const closing: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const close of closing.splice(0).reverse()) await close()
})

const OLD = Buffer.alloc(4000, 'old ')
const NEW = Buffer.alloc(4000, 'new ')
const TEMPORARY = 'MJW00.TMP'

interface Case {
  readonly title: string
  readonly profile: ProfileId
  readonly name: string
  readonly mode: NonNullable<FileWriteOptions['mode']>
  readonly old?: Buffer
}

const cases: readonly Case[] = [
  { title: 'a new file', profile: 'iq-r', name: 'A.CSV', mode: 'new' },
  { title: 'a new file of a project', profile: 'q', name: 'A.QPG', mode: 'new' },
  { title: 'a replacement', profile: 'iq-r', name: 'A.CSV', mode: 'replace', old: OLD },
  { title: 'overwriting', profile: 'iq-r', name: 'A.CSV', mode: 'overwrite', old: OLD },
]

const kinds = [
  { title: 'refused', fault: { kind: 'endCode', endCode: 0xc056 } },
  { title: 'lost on the way', fault: { kind: 'silence' } },
  { title: 'carried out, the answer lost', fault: { kind: 'drop' } },
  { title: 'carried out, the connection lost', fault: { kind: 'disconnect' } },
] as const

async function join({ profile, name, old }: Case, frame: '3E' | '4E', timeout = 3000) {
  const simulator = createPlcSimulator({ profile, drives: { 4: { files: old === undefined ? {} : { [name]: old } } } })
  await simulator.listen()
  closing.push(() => simulator.close())
  const options: MelsecClientOptions = {
    host: '127.0.0.1',
    port: simulator.tcp?.port ?? 0,
    profile,
    frame,
    allowWrites: true,
  }
  const plc = createMelsecClient({ ...options, timeout, settleGap: 1, reconnect: { first: 1 } })
  closing.push(() => plc.close())
  return { plc, simulator }
}

/** The error of writing, if there is one. */
async function written(plc: MelsecClient, { name, mode }: Case, options: FileWriteOptions = {}): Promise<unknown> {
  try {
    await plc.files.write(`4:${name}`, NEW, { mode, ...options })
    return undefined
  } catch (error) {
    return error
  }
}

/** What a machine and its people go by. */
function judge(one: Case, simulator: PlcSimulator, error: unknown): void {
  const file = simulator.files.read(4, one.name)
  const temporary = simulator.files.read(4, TEMPORARY)
  if (error === undefined) {
    expect(file).toEqual(NEW)
    expect(temporary).toBeUndefined()
    return
  }
  expect(error).toBeInstanceOf(PlcError)
  const { outcome, message } = error as PlcError
  // Of what the PLC is said not to have done nothing is to be seen.
  if (outcome !== 'unknown') {
    expect(file).toEqual(one.old)
    expect(temporary).toBeUndefined()
    expect(simulator.files.open).toEqual([])
  }
  // A replacement never loses both.
  if (one.mode === 'replace') expect(file?.equals(OLD) || file?.equals(NEW) || temporary?.equals(NEW)).toBe(true)
  // What is left behind is named.
  if (temporary !== undefined) expect(message).toContain(TEMPORARY)
  if (file !== undefined && !file.equals(one.old ?? NEW)) expect(message).toContain(one.name)
}

/**
 * Writes with a fault at one request, and judges what is left.
 * @returns how often it struck: on a busy machine a request before it may have run into the short timeout.
 */
async function struckAt(one: Case, frame: '3E' | '4E', fault: Fault, at: number): Promise<number> {
  for (const timeout of [100, 3000]) {
    const { plc, simulator } = await join(one, frame, timeout)
    try {
      await plc.connect()
    } catch (error) {
      // On a busy machine connecting may run into the short timeout, too.
      if (timeout === 3000) throw error
      continue
    }
    const active = simulator.faults.add({ ...fault, times: 1, when: () => plc.statistics.requests === at })
    judge(one, simulator, await written(plc, one))
    if (active.struck > 0) return active.struck
  }
  return 0
}

describe.each(cases)('$title', (one) => {
  describe.each(['3E', '4E'] as const)('%s', (frame) => {
    test.each(kinds)(
      'each request $title',
      async ({ fault }) => {
        const whole = await join(one, frame)
        expect(await written(whole.plc, one)).toBeUndefined()
        const requests = whole.plc.statistics.requests
        expect(requests).toBeGreaterThan(5)
        for (let at = 1; at <= requests; at++) expect(await struckAt(one, frame, fault, at)).toBe(1)
      },
      60_000,
    )

    test('given up after each request', async () => {
      const whole = await join(one, frame)
      expect(await written(whole.plc, one)).toBeUndefined()
      const requests = whole.plc.statistics.requests
      for (let at = 1; at <= requests; at++) {
        const { plc, simulator } = await join(one, frame)
        await plc.connect()
        const controller = new AbortController()
        plc.on('trace', ({ direction }) => {
          if (direction === 'received' && plc.statistics.requests === at) controller.abort()
        })
        judge(one, simulator, await written(plc, one, { signal: controller.signal }))
        expect(controller.signal.aborted).toBe(true)
      }
    }, 60_000)
  })
})

test('after closeAll() a transfer does not go on in a file that has got its pointer', async () => {
  const { plc, simulator } = await join({ title: '', profile: 'iq-r', name: 'A.CSV', mode: 'new' }, '4E')
  const gates = { a: gate(), b: gate() }
  const transfer = (name: string, part: Buffer, { begun, open }: Gate) => {
    async function* parts() {
      yield part
      begun()
      await open
      yield part
    }
    return plc.files.write(`4:${name}`, parts(), { size: 2 * part.length }).catch((error: unknown) => error)
  }
  const part = Buffer.alloc(1920, 'a')
  const a = transfer('A.CSV', part, gates.a)
  await gates.a.reached
  await plc.files.closeAll()
  const b = transfer('B.CSV', Buffer.alloc(1920, 'b'), gates.b)
  await gates.b.reached
  gates.a.go()
  expect(await a).toMatchObject({ code: 'CLOSED' })
  gates.b.go()
  expect(await b).toBeUndefined()
  expect(simulator.files.read(4, 'B.CSV')).toEqual(Buffer.alloc(3840, 'b'))
  expect(simulator.files.read(4, 'A.CSV')).toBeUndefined()
  expect(simulator.files.open).toEqual([])
})

interface Gate {
  readonly begun: () => void
  readonly reached: Promise<void>
  readonly go: () => void
  readonly open: Promise<void>
}

function gate(): Gate {
  let begun = () => {}
  let go = () => {}
  const reached = new Promise<void>((resolve) => {
    begun = resolve
  })
  const open = new Promise<void>((resolve) => {
    go = resolve
  })
  return { begun, reached, go, open }
}
