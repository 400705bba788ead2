/** The commands that need no PLC: decode, explain, profiles, help. */
import { beforeAll, describe, expect, test } from '@jest/globals'
import { profileIds } from '../../src/index'
import { build, run, runWith } from './cli'
import { runHere } from './in-process'

beforeAll(build, 120_000)

const REQUEST = '500000ffff03000c00100001040000640000a80200'
const ANSWER = 'd00000ffff03000600000005 00ffff'.replaceAll(' ', '')

/** As Python prints a byte that is no printable character. */
function escaped(byte: number): string {
  return byte === 0x64 ? 'd' : `\\x${byte.toString(16).padStart(2, '0')}`
}

/** Two bytes together. */
function grouped(pairs: string): string {
  return pairs.replace(/(..) (..)/g, '$1$2')
}

describe('decode', () => {
  test('explains a request', async () => {
    const { code, out, err } = await run('decode', REQUEST)
    expect([code, err]).toEqual([0, ''])
    expect(out).toMatch(/^3E request, binary code: Read \(word units\), D100, 2 points$/m)
    expect(out).toMatch(/^ +15 {2}64 00 00 A8 {2}head +D100 \(data register\)$/m)
  })

  test('explains a response with its request, and says without it that it is needed', async () => {
    expect((await run('decode', ANSWER, '--request', REQUEST)).out).toMatch(/D100\.\.D101: 5 -1$/m)
    const { code, out } = await run('decode', ANSWER)
    expect(code).toBe(0)
    expect(out).toMatch(/Note: .*request/)
  })

  test('as JSON', async () => {
    const { code, out } = await run('decode', ANSWER, '--request', REQUEST, '--json')
    expect(code).toBe(0)
    expect(JSON.parse(out)).toMatchObject({
      frames: [{ frame: '3E', direction: 'response', command: 'readWords', endCode: 0, rest: 0, notes: [] }],
    })
    expect(out).toContain('"value": "d000"')
  })

  test('explains a station extension frame, and an answer by the command it repeats', async () => {
    const request = '680034120000017cff030000 2c01 1200 1000 01040000 000000000000 640000a8 0100'.replaceAll(' ', '')
    const answer = 'e80034120000017cff030000 2c01 0e00 0000 01040000 000000000000 3930'.replaceAll(' ', '')
    const asked = await run('decode', request)
    expect(asked.code).toBe(0)
    expect(asked.out).toMatch(/^station extension request, binary code: Read \(word units\), D100, 1 point$/m)
    expect(asked.out).toMatch(/extensionStation +300 \(012CH\)$/m)
    expect((await run('decode', answer)).out).toMatch(/^station extension response, binary code: Read \(word units\)$/m)
    expect((await run('decode', answer, '--request', request)).out).toMatch(/D100: 12345/)
  })

  test('takes bytes as they are copied: spaces, colons, 0x, several arguments, the standard input', async () => {
    const spaced = REQUEST.replace(/../g, '$& ').trim()
    const expected = (await run('decode', REQUEST)).out
    expect((await run('decode', ...spaced.split(' '))).out).toBe(expected)
    expect((await run('decode', spaced.replaceAll(' ', ':').toUpperCase())).out).toBe(expected)
    expect((await run('decode', spaced.replace(/\S+/g, '0x$&').replaceAll(' ', ', '))).out).toBe(expected)
    expect((await runWith({ input: `${spaced}\n` }, 'decode', '-')).out).toBe(expected)
  })

  const BYTES = Buffer.from(REQUEST, 'hex')
  const pairs = REQUEST.replace(/../g, '$& ').trim()
  const tail = [pairs.slice(0, 47), pairs.slice(48)] as const
  const python = `b'${Array.from(BYTES, (byte) => (byte === 0x50 ? 'P' : byte === 0x0c ? '\\x0c' : escaped(byte))).join('')}'`
  test.each([
    ['a Buffer of Node.js', `<Buffer ${pairs}>`],
    ['a Buffer in a log', `sent: <Buffer ${pairs}> at 12:00`],
    ['bytes of Python', python],
    ['bytes of Python in a call', `s.send(b"${python.slice(2, -1)}")`],
    [
      'a dump of Wireshark',
      `0000  ${tail[0]}   P...............\n0010  ${tail[1]}                                    ...d.`,
    ],
    ['a dump without characters', `0000 ${tail[0]}\n0010 ${tail[1]}`],
    ['xxd', `00000000: ${grouped(tail[0])}  P...............\n00000010: ${grouped(tail[1])}            ...d.`],
    [
      'hexdump -C',
      `00000000  ${tail[0].slice(0, 23)}  ${tail[0].slice(24)}  |P...............|\n00000010  ${tail[1]}  |....|\n00000015\n`,
    ],
    ['tcpdump -X', `\t0x0000:  ${grouped(tail[0])}  P...............\n\t0x0010:  ${grouped(tail[1])}            ...`],
    ['a dump whose lines a shell has joined', `0000 ${tail[0]} 0010 ${tail[1]}`],
  ])('takes bytes as they are pasted: %s', async (_what, text) => {
    const expected = (await runHere(['decode', REQUEST])).out
    expect(await runHere(['decode', text])).toMatchObject({ code: 0, out: expected, err: '' })
    expect((await runHere(['decode', '-'], undefined, text)).out).toBe(expected)
    expect((await runHere(['decode', ANSWER, '--request', text])).out).toMatch(/D100\.\.D101: 5 -1$/m)
  })

  test('explains several pasted frames, and one of them that is broken does not hide the next', async () => {
    const two = `<Buffer ${pairs}>\n<Buffer ${pairs}>`
    expect(JSON.parse((await runHere(['decode', two, '--json'])).out).frames).toHaveLength(2)
    const cut = `<Buffer ${pairs.slice(0, 29)}>, <Buffer ${pairs.slice(30)}>`
    expect((await runHere(['decode', cut])).out).toBe((await runHere(['decode', REQUEST])).out)
    const broken = await runHere(['decode', `<Buffer 51 00 00>\n<Buffer ${pairs}>`])
    expect(broken.code).toBe(5)
    expect(broken.out).toMatch(/Read \(word units\), D100, 2 points/)
    const dumps = `0000  ${tail[0]}\n0010  ${tail[1]}\n\n0000  ${tail[0]}\n0010  ${tail[1]}\n`
    expect(JSON.parse((await runHere(['decode', dumps, '--json'])).out).frames).toHaveLength(2)
  })

  test.each([
    [`<Buffer ${pairs} ... 12 more bytes>`, /more bytes/],
    ['<Buffer >', /holds no bytes/],
    ["b''", /there are no bytes/],
    ["b'P\\q'", /no escape/],
    [`0000  ${tail[0]}\n0020  ${tail[1]}`, /begins at 20, the one before ends at 10/],
  ])('%j is refused', async (text, message) => {
    const { code, err } = await runHere(['decode', text])
    expect(code).toBe(2)
    expect(err).toMatch(message)
  })

  test('notes what the PLC refuses although it can be read', async () => {
    const bitUnits = await runHere(['decode', '500000FFFF03000C001000010401004C0300A80100', '--profile', 'iq-f'])
    expect(bitUnits.code).toBe(0)
    expect(bitUnits.out).toMatch(/Note: D has words, .*\(C05CH: use subcommand 0000H, word units\)/)
    const of1e = await runHere(['decode', '--frame', '1E', '00FF0A000A000000204401 00'])
    expect(of1e.out).toMatch(/Note: D has words/)
    const right = await runHere(['decode', '500000FFFF03000C001000010401004C0300900100'])
    expect(right.out).not.toContain('Note')
    const elsewhere = await runHere(['decode', '50000103FF03000600100017160000'])
    expect(elsewhere.out).toMatch(/Note: Clear Error is for the connected station only/)
    expect((await runHere(['decode', '500000FFFF03000600100017160000'])).out).not.toContain('Note')
  })

  test('an odd offset of Read File is explained, and what follows it', async () => {
    const { code, out } = await runHere(['decode', '500000FFFF03000E00100028180000 0000 03000000 0A00'])
    expect(code).toBe(0)
    expect(out).toMatch(/offset +3 /)
    expect(out).toMatch(/byteCount +10 /)
    expect(out).toMatch(/Note: offset is 3, which is no multiple of 2/)
  })

  test('takes the characters of a frame in ASCII code, and says when they were meant', async () => {
    const characters = '500000FF03FF000018001004010000D*0001000002'
    const { code, out } = await run('decode', '--text', characters)
    expect(code).toBe(0)
    expect(out).toMatch(/^3E request, ASCII code: Read \(word units\), D100, 2 points$/m)
    const digits = '500000FF03FF00000C00100619000000041234'
    const mistaken = await run('decode', digits)
    expect(mistaken.code).toBe(5)
    expect(mistaken.err).not.toContain('--text')
    const meant = await run('decode', '500000FF03FF000014001006190000000412AB')
    expect(meant.code).toBe(5)
    expect(meant.err).toContain('--text')
  })

  test('explains a broken frame up to where it is wrong', async () => {
    const { code, out } = await run('decode', REQUEST.slice(0, -2))
    expect(code).toBe(5)
    expect(out).toMatch(/head +D100 \(data register\)/)
    expect(out).toMatch(/Wrong at byte 19 \(points\)/)
    const asJson = await run('decode', REQUEST.slice(0, -2), '--json')
    expect(asJson.code).toBe(5)
    expect(JSON.parse(asJson.out)).toMatchObject({ frames: [{ fault: { offset: 19, name: 'points' } }] })
  })

  test('explains the frames of a capture one by one', async () => {
    const { code, out } = await run('decode', REQUEST + REQUEST, '--json')
    expect(code).toBe(0)
    expect(JSON.parse(out)).toMatchObject({ frames: [{ command: 'readWords' }, { command: 'readWords' }] })
  })

  test('a frame that must be said: 1E', async () => {
    expect((await run('decode', '--frame', '1e', '01ff0a006400000020440300')).out).toMatch(
      /^1E request, .*D100, 3 points$/m,
    )
  })

  test('serial frames tell themselves, also in a log with control codes in words', async () => {
    const format5 = '10021200f80000ffff030000010400006400 00a8020010033145'.replaceAll(' ', '')
    expect((await run('decode', format5)).out).toMatch(/^4C request, format 5: Read \(word units\), D100/m)
    const log = '<ENQ>00FFBR0M00100A<CR><LF>\n<STX>00FF0110101101<ETX><CR><LF>\n  <05>F90000FF00040100'
    const { code, out } = await run('decode', log)
    expect(code).toBe(5)
    expect(out).toMatch(/^1C request, format 4: Batch read \(bit units\) \(BR\), M10, 10 points$/m)
    expect(out).toMatch(/^1C response, format 4$/m)
    expect(out).toMatch(/^3C request, format 1: cut short$/m)
    const model = await run(
      'decode',
      '<STX>F90000FF00FX5U-32MR/ES    4A21<ETX>',
      '--request',
      '<ENQ>F90000FF0001010000',
    )
    expect(model.code).toBe(0)
    expect(model.out).toMatch(/4A21H \(FX5U-32MR\/ES\)/)
  })

  test('format and sum check are said where the bytes do not tell them', async () => {
    const wrong = '<ENQ>00FFTT005ABCDE79'
    expect((await run('decode', wrong)).out).toMatch(/"79" \(should be "78"\)/)
    expect((await run('decode', wrong, '--no-sum-check')).out).toMatch(/2 byte\(s\) left over/)
    expect((await run('decode', '<ACK>00FF', '--format', '4')).out).toMatch(/CR LF is missing/)
    expect((await run('decode', '<ACK>00FF', '--frame', '1C', '--format', '1', '--sum-check')).code).toBe(0)
  })

  test('X and Y as the family numbers them', async () => {
    const x = '500000ffff03000c001000010401000f00009c0100'
    expect((await run('decode', x)).out).toContain('XF (input)')
    expect((await run('decode', x, '--profile', 'iq-f')).out).toContain('X17 (input)')
  })

  test.each([
    [['decode', '5000z'], /"z" is no hexadecimal digit/],
    [['decode', '500'], /3 hexadecimal digits are no whole number of bytes/],
    [['decode', ' '], /there are no bytes/],
    [['decode', REQUEST, '--request', 'xyz'], /the request: .*hexadecimal/],
    [['decode', REQUEST, '--frame', '5E'], /3E, 4E, ext, 1E, 1C, 3C, 4C/],
    [['decode', '<FOO>00FF'], /the frame: <FOO> is no control code: STX, ETX/],
    [['decode', '<ACK>00FF', '--frame', '1C', '--format', '5'], /The 1C frame has formats 1, 4, not 5/],
    [['decode', REQUEST, '--frame', '3E', '--sum-check'], /The 3E frame has no sumCheck/],
    [['decode', '4700', '--frame', 'JW', '--format', '4'], /--format is of MELSEC only/],
    [['decode'], /missing required argument/],
  ])('%j is wrong use', async (args, message) => {
    const { code, out, err } = await runHere(args)
    expect([code, out]).toEqual([2, ''])
    expect(err).toMatch(message)
  })
})

describe('explain', () => {
  test.each(['C059', '0xc059', 'c059h'])('%s: meaning and remedy', async (text) => {
    const { code, out } = await runHere(['explain', text])
    expect(code).toBe(0)
    expect(out).toMatch(/^End code +C059H$/m)
    expect(out).toMatch(/^Meaning +\S/m)
    expect(out).toMatch(/^Remedy +\S/m)
  })

  test('with the command that got it, and in other languages', async () => {
    expect((await run('explain', 'C059', '--command', 'executeMonitor')).out).toMatch(/^Cause +\S/m)
    expect((await run('explain', 'C059', '--language', 'ja')).out).toMatch(/[ぁ-ん]/)
  })

  test('an error code of a register is not called an end code, and says where it is', async () => {
    const { code, out } = await run('explain', '7601')
    expect(code).toBe(0)
    expect(out).toMatch(/^Error code +7601H$/m)
    expect(out).toMatch(/^Where +.*SD8500/m)
    expect(out).toMatch(/^Meaning +Inverter communication: the inverter does not respond\.$/m)
    expect(out).not.toMatch(/End code/)
    expect((await run('explain', '7601', '--language', 'zh-CN')).out).toMatch(/^Where +.*串行通信/m)
  })

  test('as JSON', async () => {
    const { out } = await run('explain', 'C056', '--json')
    expect(JSON.parse(out)).toMatchObject({
      endCode: 0xc056,
      meanings: [{ family: 'slmp', about: 'item', exact: true }],
    })
  })

  test('a number of several frames: all its meanings, or that of the one the user names', async () => {
    const all = await run('explain', '10')
    expect(all.out).toMatch(/say --family/)
    expect([...all.out.matchAll(/^End code +(\w+)$/gm)].map(([, code]) => code)).toEqual(['10H', '10H', '10H'])
    expect([...all.out.matchAll(/^Where +.*\b(1E|1C) frame/gm)].map(([, frame]) => frame)).toEqual(['1E', '1C'])
    const one = await run('explain', '10', '--family', '1C')
    expect([...one.out.matchAll(/^End code/gm)]).toHaveLength(1)
    expect(one.out).not.toMatch(/say --family/)
    expect((await run('explain', 'C056', '--family', '1E')).code).toBe(2)
    expect((await run('explain', '10', '--family', 'jw')).out).toMatch(/^Meaning +The write mode does not allow it\.$/m)
    expect((await run('explain', '05', '--family', 'jw')).code).toBe(2)
  })

  test.each([
    ['0400', /No text is known for end code 0400H/],
    ['hello', /no end code: write up to four hexadecimal digits/],
  ])('%s', async (text, message) => {
    const { code, err } = await runHere(['explain', text])
    expect(code).toBe(2)
    expect(err).toMatch(message)
  })
})

describe('profiles', () => {
  test('lists them', async () => {
    const { code, out } = await run('profiles')
    expect(code).toBe(0)
    expect(
      out
        .trim()
        .split('\n')
        .map((line) => line.split(' ')[0]),
    ).toEqual(['PROFILE', ...profileIds])
  })

  test('tells all about one', async () => {
    const { out } = await run('profiles', 'iq-f')
    for (const fact of ['Connections       at most 8', 'the connected station only', 'Z0 to Z23, LZ0 to LZ11', 'SD203'])
      expect(out).toContain(fact)
    expect(out).toMatch(/^X and Y +octal$/m)
    expect(out).toMatch(/- entryMonitorDevice, executeMonitor: .*readRandom/)
  })

  test('commands that are missing for one reason share a line, and what needs 4E is not said without it', async () => {
    const { out } = await run('profiles', 'fx3')
    expect(out.match(/A 1E frame has no such command/g)).toHaveLength(1)
    expect(out).toMatch(/^In flight +1 over TCP and UDP$/m)
  })

  test('as JSON', async () => {
    expect(JSON.parse((await run('profiles', '--json')).out).profiles).toHaveLength(profileIds.length)
    expect(JSON.parse((await run('profiles', 'q', '--json')).out)).toMatchObject({ id: 'q', xyRadix: 16 })
  })

  test('an unknown one is wrong use', async () => {
    const { code, err } = await runHere(['profiles', 'x'])
    expect(code).toBe(2)
    expect(err).toContain(profileIds.join(', '))
  })
})

describe('help', () => {
  test('of the program lists the commands and the exit codes', async () => {
    const { code, out } = await run('--help')
    expect(code).toBe(0)
    for (const name of ['identify', 'read', 'write', 'control', 'simulate', 'decode', 'profiles', 'explain']) {
      expect(out).toMatch(new RegExp(`^  ${name} `, 'm'))
    }
    expect(out).toMatch(/^Exit codes:$/m)
    expect(out).toMatch(/^ {2}3 {2}the PLC answered with an end code$/m)
  })

  test.each(['identify', 'read', 'write', 'control', 'simulate', 'decode', 'profiles', 'explain'])(
    'of %s has examples',
    async (name) => {
      const { code, out } = await runHere([name, '--help'])
      expect(code).toBe(0)
      expect(out).toMatch(new RegExp(`Examples:\n  melsec-jw ${name}`))
    },
  )

  test("the version is the package's", async () => {
    const { version } = require('../../package.json') as { version: string }
    expect((await run('--version')).out.trim()).toBe(version)
  })
})
