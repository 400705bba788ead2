/** `melsec-jw simulate`, and the example programs against it. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterEach, beforeAll, describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import { createPlcSimulator } from '../../src/entry/simulator'
import { createJwClient, createMelsecClient, type MelsecClient, type MelsecOptions } from '../../src/index'
import { ttyPair } from '../support/tty-pair'
import { build, example, type Running, run, start, startWith } from './cli'
import { runHere } from './in-process'

beforeAll(build, 120_000)

const running: Running[] = []
const clients: MelsecClient[] = []

afterEach(async () => {
  await Promise.all(clients.splice(0).map((client) => client.close()))
  await Promise.all(running.splice(0).map((program) => program.interrupt()))
})

/** Starts a simulated PLC on a free port. */
async function simulate(...args: readonly string[]): Promise<{ readonly program: Running; readonly port: number }> {
  const program = start('simulate', '--port', '0', ...args)
  running.push(program)
  const [, port] = await program.says(/127\.0\.0\.1:(\d+)/)
  return { program, port: Number(port) }
}

function clientOf(port: number, options: Partial<MelsecOptions> = {}): MelsecClient {
  const client = createMelsecClient({ host: '127.0.0.1', port, profile: 'iq-r', ...options })
  clients.push(client)
  return client
}

describe('simulate', () => {
  test('says where it listens, answers, and ends at Ctrl-C', async () => {
    const { program, port } = await simulate()
    expect((await clientOf(port).identify()).model).toBe('R08CPU')
    const { code, out, err } = await program.interrupt()
    expect([code, err]).toEqual([0, ''])
    expect(out).toMatch(
      /^ {2}TCP +127\.0\.0\.1:\d+\n {2}UDP +127\.0\.0\.1:\d+\n {2}Frames +4E, 3E, ext\n {2}Code +binary$/m,
    )
    expect(out).toContain(`Try: melsec-jw read --plc 127.0.0.1:${port} --profile iq-r D0 M0`)
  })

  test('answers over UDP, as another family, in ASCII code', async () => {
    const { program } = await simulate('--profile', 'iq-f', '--no-tcp', '--ascii')
    const [, port] = await program.says(/UDP +127\.0\.0\.1:(\d+)/)
    const client = clientOf(Number(port), { transport: 'udp', profile: 'iq-f', code: 'ascii' })
    expect((await client.identify()).series).toBe('iQ-F')
  })

  test('runs the demo plant, and lists its tags', async () => {
    const { program, port } = await simulate('--plant')
    await program.says(/D100:REAL +level +Level \(l\)/)
    await program.says(/D110:REAL .* may be written/)
    expect(await clientOf(port).read('D130:STRING(20)')).toBe('Apple juice')
  })

  test('has a folder as a drive', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'drive-'))
    writeFileSync(join(folder, 'LINE.CSV'), 'A,15\r\n')
    const { program, port } = await simulate('--drive', `2=${folder}`)
    const { files } = await clientOf(port).request(commands.readDirectory, { drive: 2, start: 1, count: 36 })
    expect(files.map(({ name, size }) => [name, size])).toEqual([['LINE.CSV', 6]])
    expect((await program.interrupt()).code).toBe(0)
    rmSync(folder, { recursive: true })
  })

  test.each([
    ['2', /number of the drive and a folder/],
    ['2=/no/such/folder', /cannot be a drive/],
    ['9=.', /no drive 9/],
  ])('--drive %s is refused', async (drive, text) => {
    const { code, err } = await runHere(['simulate', '--port', '0', '--drive', drive])
    expect(code).not.toBe(0)
    expect(err).toMatch(text)
  })

  test('has labels and a remote password, and locks out whoever tries too often', async () => {
    const args = ['--label', 'Line1.Speed:REAL=12.5', '--password', '--password-attempts', '1']
    const program = startWith({ MELSEC_JW_PASSWORD: 'Secret-1' }, 'simulate', '--port', '0', ...args)
    running.push(program)
    const [, digits] = await program.says(/127\.0\.0\.1:(\d+)/)
    const port = Number(digits)
    await program.says(/Labels: Line1\.Speed\nThe port is locked by a remote password\./)
    await program.says(/Try: .* --password D0 M0 label:Line1\.Speed/)
    expect(await clientOf(port, { password: 'Secret-1' }).read('Line1.Speed')).toBe(12.5)
    await expect(clientOf(port).read('Line1.Speed')).rejects.toMatchObject({ endCode: 0xc201 })
    await expect(clientOf(port, { password: 'Secret-2' }).read('D0')).rejects.toThrow('C815')
    await expect(clientOf(port, { password: 'Secret-1' }).read('D0')).rejects.toThrow('C816')
    const { out, err } = await program.interrupt()
    expect(out + err).not.toContain('Secret')
  })

  test('as JSON', async () => {
    const program = start('simulate', '--port', '0', '--no-udp', '--plant', '--json')
    running.push(program)
    await program.says(/\n}\n/)
    const { out } = await program.interrupt()
    const said = JSON.parse(out) as Readonly<Record<string, unknown>>
    expect(said).toMatchObject({ profile: 'iq-r', tcp: { host: '127.0.0.1', port: expect.any(Number) } })
    expect(said.udp).toBeUndefined()
    expect(said.plant).toContainEqual(expect.objectContaining({ name: 'level', address: 'D100:REAL' }))
  })

  test('faults', async () => {
    const { port } = await simulate(
      '--fault',
      'endCode:endCode=C056,commands=readWords+readBits,times=1',
      '--fault',
      'delay:ms=1',
    )
    const client = clientOf(port)
    await expect(client.read('D0')).rejects.toMatchObject({ endCode: 0xc056 })
    expect(await client.read('D0')).toBe(0)
  })

  test('--log prints the requests', async () => {
    const { program, port } = await simulate('--log')
    await clientOf(port).read('D0')
    await program.says(/127\.0\.0\.1:\d+ readWords: carried out/)
  })

  test.each([
    [['--fault', 'explode'], /there is no fault "explode". Faults are silence, /],
    [['--fault', 'delay:often'], /write name=value/],
    [['--fault', 'delay:hours=3'], /has no hours/],
    [['--fault', 'endCode:endCode=zz'], /no end code/],
    [['--fault', 'silence:commands=fly'], /there is no command "fly"/],
    [['--profile', 'iq-f', '--frame', '4E'], /frames is 4E; it must be 3E or 1E/],
    [['--port', '70000'], /0 to 65535/],
    [['--echo'], /--echo is for a serial line/],
    [['--no-sum-check'], /--no-sum-check is for a serial line/],
    [['--stations', '0', '--password'], /A serial line has no --password/],
    [['--stations', '0', '--no-udp'], /A serial line has no --no-udp/],
    [['--stations', '0,x'], /numbers with commas between/],
    [['--stations', '1,1'], /A station is there once/],
    [['--stations', '16'], /stations.16 is 16; it must be a whole number from 0 to 15/],
    [['--stations', '0', '--profile', 'iq-r'], /has no serial line/],
    [['--frame', '3C', '--message-format', '5'], /frames is 3C; it must be 4C/],
    [['--stations', '0', '--frame', '3E'], /frames is 3E; it must be 1C or 3C or 4C/],
    [['--serial', 'COM1', '--baud-rate', '1'], /baudRate 1: give 300/],
    [['--family', 'jw', '--profile', 'iq-f'], /--profile is of MELSEC only\. A simulated Sharp JW does not have it/],
    [['--family', 'jw', '--stations', '0'], /--stations is of MELSEC only/],
    [['--family', 'jw', '--password'], /--password is of MELSEC only/],
    [['--family', 'jw', '--write-mode', '3'], /0 to 2/],
    [['--family', 'jw', '--fault', 'silence:commands=readWords'], /there is no command "readWords"/],
    [['--family', 'jw', '--fault', 'wrongSerial'], /There is no fault "wrongSerial"/],
    [['--family', 'jw', '--fault', 'endCode:endCode=100'], /from 1 to 255/],
    [['--write-mode', '1'], /--write-mode is of Sharp JW only\. With a Sharp JW say --family jw/],
    [['--stations', '0', '--header', 'none'], /--header is of Sharp JW only/],
    [['--fault', 'otherHeader'], /There is no fault "otherHeader"/],
  ])('%j is wrong use', async (args, message) => {
    const { code, out, err } = await runHere(['simulate', ...args])
    expect([code, out]).toEqual([2, ''])
    expect(err).toMatch(message)
  })

  test('a port that is taken', async () => {
    const { port } = await simulate()
    const { code, err } = await run('simulate', '--port', String(port), '--no-udp')
    expect(code).toBe(4)
    expect(err).toMatch(new RegExp(String(port)))
    expect(err).not.toMatch(/^\s+at /m)
  })
})

describe('simulate, a Sharp JW', () => {
  test('with a bottling line, written by a client, with its requests printed', async () => {
    const { program, port } = await simulate('--family', 'jw', '--plant', '--write-mode', '1', '--log')
    await program.says(/^Simulated Sharp JW300 with JW-255CM/)
    await program.says(/Header +any\n +Write mode +1, data memory may be written/)
    await program.says(/19000:UINT +bottleSize +Recipe: content \(ml\) +may be written/)
    const client = createJwClient({ host: '127.0.0.1', port, allowWrites: true })
    try {
      expect(await client.read('19000:UINT')).toBe(500)
      await client.write('19000:UINT', 600)
      expect(await client.read('19000:UINT')).toBe(600)
      await program.says(/127\.0\.0\.1:\d+ writeDataMemory: carried out/)
    } finally {
      await client.close()
    }
  })

  test('without write mode, with a fault, as JSON', async () => {
    const program = start(
      'simulate',
      '--family',
      'jw',
      '--port',
      '0',
      '--no-udp',
      '--json',
      '--header',
      'zero40',
      '--fault',
      'endCode:endCode=0F,commands=readDataMemory,times=1',
    )
    running.push(program)
    const [text] = await program.says(/\{\n.*\n\}/s)
    const said = JSON.parse(text) as { readonly tcp: { readonly port: number } }
    expect(said).toMatchObject({
      family: 'jw',
      model: 'jw300',
      header: 'zero40',
      writeMode: 0,
      tcp: { host: '127.0.0.1' },
    })
    const client = createJwClient({ host: '127.0.0.1', port: said.tcp.port, header: 'zero40', allowWrites: true })
    try {
      await expect(client.read('09012')).rejects.toMatchObject({ endCode: 0x0f })
      expect(await client.read('09012')).toBe(0)
      await expect(client.write('09012', 1)).rejects.toThrow('10H')
    } finally {
      await client.close()
    }
  })
})

describe('simulate, a serial line', () => {
  test('with several stations at a port, as a device server has it', async () => {
    const { program, port } = await simulate('--stations', '0,3', '--message-format', '4', '--plant', '--log')
    await program.says(/Stations +0, 3\n +Format +4, with sum check code\n/)
    await program.says(/Demo plant in each station:\n +M0:BOOL/)
    const client = clientOf(port, { profile: 'fx5-serial', frame: '3C', messageFormat: 4, route: { station: 3 } })
    expect(await client.read('D130:STRING(20)')).toBe('Apple juice')
    await program.says(/station 3 readWords: carried out/)
  })

  test('that answers later than usual is read with a longer answer time', async () => {
    const { port } = await simulate('--stations', '0', '--fault', 'delay:ms=700')
    const read = (...args: readonly string[]) =>
      run('read', 'D0', '--plc', `127.0.0.1:${port}`, '--profile', 'fx5-serial', ...args)
    const late = await read('--timeout', '9000', '--probe', 'none')
    expect([late.code, late.err]).toEqual([expect.any(Number), expect.stringContaining('answer time of the line')])
    expect(late.code).not.toBe(0)
    expect((await read('--answer-time', '2000')).code).toBe(0)
  })

  test('at a serial port', async () => {
    const pair = await ttyPair()
    try {
      const args = ['--baud-rate', '19200', '--frame', '3C', '--message-format', '4', '--stations', '0,1,2']
      const program = start('simulate', '--serial', pair.near, ...args)
      running.push(program)
      await program.says(/Serial +serial .* \(19200 7O1\)\n +Stations +0, 1, 2\n/)
      const client = createMelsecClient({
        serial: { path: pair.far, baudRate: 19_200 },
        profile: 'fx5-serial',
        frame: '3C',
        messageFormat: 4,
        route: { station: 2 },
      })
      clients.push(client)
      expect(await client.read('D0')).toBe(0)
      expect((await program.interrupt()).code).toBe(0)
    } finally {
      await pair.close()
    }
  })

  test('with faults, of another family', async () => {
    const args = ['--profile', 'q-c24', '--message-format', '5', '--fault', 'endCode:endCode=7F24,times=1', '--json']
    const program = start('simulate', '--port', '0', ...args)
    running.push(program)
    const [, port] = await program.says(/"port": (\d+)/)
    const client = clientOf(Number(port), { profile: 'q-c24', frame: '4C', messageFormat: 5 })
    expect(await client.read('D0')).toBe(0)
    const { out } = await program.interrupt()
    expect(JSON.parse(out)).toMatchObject({ profile: 'q-c24', stations: [0], messageFormat: 5, sumCheck: true })
  })
})

describe('example programs', () => {
  test('read-and-write reads, writes and puts the old value back', async () => {
    const { port } = await simulate('--plant')
    const { code, out, err } = await example('read-and-write.mjs', '127.0.0.1', String(port)).ended()
    expect([code, err]).toEqual([0, ''])
    expect(out).toMatch(/^level +\d+\.\d l$/m)
    expect(out).toMatch(/product: 'Apple juice'/)
    expect(out).toMatch(/^alarm +false\nnonsense +not read: \w+$/m)
    expect(out).toMatch(/^D110 +was 800, is 650\nD110 +is 800 again$/m)
  })

  test('read-and-write says why there is no PLC', async () => {
    const simulator = createPlcSimulator({ udp: false })
    await simulator.listen()
    const port = simulator.tcp?.port
    await simulator.close()
    const { code, err } = await example('read-and-write.mjs', '127.0.0.1', String(port)).ended()
    expect(code).toBe(1)
    expect(err).toMatch(/^CONNECT_FAILED \(notSent\): /)
  })

  test('watch ends quietly when nobody reads what it prints', async () => {
    const simulator = createPlcSimulator({ profile: 'iq-r' })
    await simulator.listen()
    const watch = example('watch.mjs', '127.0.0.1', String(simulator.tcp?.port), 'D0')
    try {
      await watch.says(/ D0 +0\n/)
      watch.closeOutput()
      simulator.write('D0', 1)
      const { code, err } = await watch.ended()
      expect([code, err]).toEqual([0, ''])
    } finally {
      await simulator.close()
    }
  })

  test('watch prints what changes, and reconnects', async () => {
    const simulator = createPlcSimulator({ profile: 'iq-r', restartTime: 0 })
    await simulator.listen()
    simulator.write('D0', 5)
    const watch = example('watch.mjs', '127.0.0.1', String(simulator.tcp?.port), 'D0', 'M0')
    try {
      await watch.says(/ D0 +5\n/)
      await watch.says(/ M0 +false\n/)
      simulator.write('D0', 6)
      await watch.says(/ D0 +6\n/)
      simulator.restart()
      await watch.says(/no connection: .* connected\n.* D0 +0\n/s)
    } finally {
      const { code } = await watch.interrupt()
      expect(code).toBe(0)
      await simulator.close()
    }
  })
})
